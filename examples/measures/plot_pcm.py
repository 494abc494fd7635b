"""
Partial curve mapping
=====================

The shorter curve is laid onto the longer one at many offsets along it. At each offset, the area
between the two is computed; the measure is the smallest area. Nothing outside the mapped section
counts.
"""

import matplotlib.pyplot as plt

import curvewise
from curvewise.plotting import plot_pcm

_, loop = curvewise.datasets.hysteresis_pair()
piece = loop[45:100] * [1.0, 1.04]  # a test that started late and ended early, 4 % too stiff

figure, ax = plt.subplots(figsize=(7, 5), layout="constrained")
plot_pcm(loop, piece, ax)
ax.set(xlabel="strain [-]", ylabel="stress [MPa]")
ax.legend(loc="center")

# %%
# A short curve fits somewhere along a long one. So report with the value the share of the longer
# curve that was compared:

match = curvewise.pcm_match(loop, piece)
print(f"value {match.value:.4f}, coverage {match.coverage:.2f}, mapped: {match.mapped}")

# %%
# The offset is looked for on a grid of 200, as in the paper, or exactly:

exact = curvewise.pcm_match(loop, piece, offsets="continuous")
print(f"value {exact.value:.4f} at {exact.offset:.4f} instead of {match.offset:.4f}")
