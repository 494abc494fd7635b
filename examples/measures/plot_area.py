"""
Area between curves
===================

The area is cut into quadrilaterals, each with an edge of either curve, and added up. What faces
what decides which quadrilaterals these are.
"""

import matplotlib.pyplot as plt

import curvewise
from curvewise.plotting import plot_area

experiment, simulation = curvewise.datasets.hysteresis_pair()

# %%
# The paper's way refines the curve with fewer points until both have the same number; point i then
# faces point i. Raw stress and strain need ``spacing="x"``, since a length in both units at once
# would measure stress alone. ``spacing="matched"`` matches the curves, and adds signed areas in
# short pieces.

figure, axes = plt.subplots(1, 2, figsize=(10, 4.5), sharey=True, layout="constrained")
for ax, spacing in zip(axes, ("x", "matched"), strict=True):
    plot_area(experiment, simulation, ax, spacing=spacing)
    ax.locator_params(axis="x", nbins=5)
    value = curvewise.area(experiment, simulation, spacing=spacing)
    ax.set(
        title=f'spacing="{spacing}": {value:.2f} MPa', xlabel="strain [-]", ylabel="stress [MPa]"
    )
axes[0].legend(loc="lower right")
axes[1].set_ylabel("")

# %%
# The value has the units of both axes: a stress times a strain. Other points on the same curve are
# another matter to the first than to the second. Here every second point of the simulation is left
# out, which changes the curve by next to nothing:

for spacing in ("x", "distance", "matched"):
    before, after = (
        curvewise.area(*curvewise.normalize(experiment, curve), spacing=spacing)
        for curve in (simulation, simulation[::2])
    )
    print(f"{spacing:>8}: {before:.4f} becomes {after:.4f}")
