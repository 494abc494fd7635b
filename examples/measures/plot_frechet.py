"""
Discrete Fréchet distance
=========================

Two walkers go along the points of their curves, never back. The distance is the shortest leash that
joins them all the way. So the worst place alone decides it.
"""

import matplotlib.pyplot as plt

import curvewise
from curvewise.plotting import plot_alignment, plot_table

experiment, simulation = curvewise.datasets.hysteresis_pair()

figure, axes = plt.subplots(1, 2, figsize=(10.5, 4.5), layout="constrained")
plot_alignment(experiment, simulation, axes[0], measure="frechet", normalized=True, every=4)
axes[0].set(xlabel="strain [-]", ylabel="stress [MPa]")
axes[0].locator_params(axis="x", nbins=5)
axes[0].legend(loc="center")
plot_table(experiment, simulation, axes[1], measure="frechet", normalized=True)

# %%
# Left: some of the paired points, and the pair that is furthest apart. Right: the table of the
# smallest distance up to each pair, small where it is bright, and the path through it. Stress and
# strain are scaled by the test's bounding box, since a distance in raw units would measure stress
# alone:

P, Q = curvewise.normalize(experiment, simulation)
print(f"raw {curvewise.frechet(experiment, simulation):.2f}, scaled {curvewise.frechet(P, Q):.4f}")

# %%
# One wrong point is all it takes:

spike = Q.copy()
spike[60, 1] += 0.3
print(f"with one outlier of 30 %: {curvewise.frechet(P, spike):.4f}")
