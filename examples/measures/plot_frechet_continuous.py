"""
Continuous Fréchet distance
===========================

The two walks go along the curves themselves, edges included. Points that are added to an edge, or
left out of a straight one, change nothing.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.plotting import plot_free_space, plot_matching

t = np.linspace(0, 2 * np.pi, 200)
fine = np.column_stack([t, np.sin(t)])
coarse = fine[::33]

figure, axes = plt.subplots(1, 2, figsize=(10.5, 4.5), layout="constrained")
plot_matching(fine, coarse, axes[0])
axes[0].legend(loc="lower left")
plot_free_space(fine, coarse, axes[1])

# %%
# Left: paired points at some moments of the two walks. Right: the free-space diagram at the
# distance; both walks together are a path through its white part that never goes back.
#
# The discrete distance between the same curves compares points, and the coarse curve has few:

print(f"discrete   {curvewise.frechet(fine, coarse):.4f}")
print(f"continuous {curvewise.frechet_continuous(fine, coarse):.4f}")
low, high = curvewise.frechet_continuous(fine, coarse, bounds=True)
print(f"certified: the real number lies in [{low!r}, {high!r}]")

# %%
# "Within r of each other?" is a cheaper question than "how far?", and its answer is certified too:

print(curvewise.frechet_within(fine, coarse, 0.2), curvewise.frechet_within(fine, coarse, 0.1))
