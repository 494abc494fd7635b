"""
What the objective looks like
=============================

The values of three measures over two parameters of a model. The test has noise. Where a minimum is
long and flat, the test says little about one direction.
"""

import matplotlib.pyplot as plt
import numpy as np

from curvewise.calibration import Objective
from curvewise.datasets import hysteresis_pair, kinematic_hardening

test, simulation = hysteresis_pair()
strain = simulation[::3, 0]


def model(C, gamma):
    stress = kinematic_hardening(
        strain,
        youngs_modulus=195e3,
        yield_stress=330.0,
        backstresses=[(C, gamma), (10e3, 60.0), (2e3, 0.0)],
    )
    return np.column_stack([strain, stress])


C = np.linspace(60e3, 160e3, 21)
gamma = np.linspace(300, 900, 21)
loops = [model(c, g) for g in gamma for c in C]

# %%
# Bright is small. A cross marks what made the test, a dot the smallest value on the grid:

figure, axes = plt.subplots(1, 3, figsize=(11, 3.9), sharey=True, layout="constrained")
for ax, measure in zip(axes, ("area", "dtw", "frechet"), strict=True):
    objective = Objective(test[::2], measure)
    values = np.array([objective(loop) for loop in loops]).reshape(21, 21)
    levels = np.geomspace(1.01 * values.min(), values.max(), 12)
    ax.contourf(C / 1e3, gamma, values, levels, cmap="viridis_r", extend="min")
    lowest = np.unravel_index(np.argmin(values), values.shape)
    ax.plot(C[lowest[1]] / 1e3, gamma[lowest[0]], "o", color="w", markeredgecolor="k")
    ax.plot(110, 600, "x", color="#d55e00", markersize=9, markeredgewidth=2)
    ax.set(title=measure, xlabel="C [GPa]")
    print(f"{measure:>8}: {values.min():.3g} to {values.max():.3g}, smallest at", end=" ")
    print(f"C = {C[lowest[1]]:.0f} MPa, gamma = {gamma[lowest[0]]:.0f}")
axes[0].set_ylabel("gamma [-]")
