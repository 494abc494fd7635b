"""
One curve is a piece of the other
=================================

A test that ended early against a simulation of the whole cycle. Measures that compare from end to
end count the missing part; partial curve mapping, and dynamic time warping with open ends, do not.
"""

import matplotlib.pyplot as plt

import curvewise
from curvewise.plotting import plot_alignment, plot_pcm

experiment, simulation = curvewise.datasets.hysteresis_pair()
piece = experiment[:120]  # into compression, then the specimen buckled
P, Q = curvewise.normalize(simulation, piece)

figure, axes = plt.subplots(1, 2, figsize=(10.5, 4.5), sharey=True, layout="constrained")
plot_pcm(simulation, piece, axes[0])
plot_alignment(piece, simulation, axes[1], measure="dtw", normalized=True, open_end=True, every=5)
for ax, title in zip(axes, ("pcm", "dtw, open_end=True"), strict=True):
    ax.set(title=title, xlabel="strain [-]", ylabel="stress [MPa]")
    ax.locator_params(axis="x", nbins=5)
    ax.legend(loc="center")

# %%
# The values of the section next to those of the whole test, each against the same simulation:

whole = curvewise.normalize(simulation, experiment)[1]
print(f"{'':>20}   piece   whole")
for name, value in {
    "area": lambda curve: curvewise.area(P, curve, spacing="matched"),
    "dtw per point": lambda curve: curvewise.dtw(curve, P) / len(curve),
    "dtw, open_end": lambda curve: curvewise.dtw(curve, P, open_end=True) / len(curve),
    "pcm": lambda curve: curvewise.pcm(P, curve),
}.items():
    print(f"{name:>20}  {value(Q):.4f}  {value(whole):.4f}")

# %%
# Where the piece begins in the middle as well, ``open_begin=True`` lets the path begin anywhere:

middle = piece[40:100]
path = curvewise.dtw_path(
    curvewise.normalize(simulation, middle)[1], P, open_begin=True, open_end=True
).path
print(f"points 40 to 99 of the test lie on points {path[0, 1]} to {path[-1, 1]} of the simulation")
