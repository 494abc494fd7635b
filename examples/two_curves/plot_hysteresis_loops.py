"""
Energy, backbone and damping of a cyclic test
=============================================

A cyclic test becomes loops, the energy that each dissipates, the backbone curve through their tips,
and a stiffness and a damping ratio for each cycle. The record is dense and noisy; its reversals are
read from averages.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.curves import (
    backbone,
    damping,
    loop_energy,
    loops,
    peaks_and_valleys,
    reversals,
    stiffness,
    turning_points,
)

random = np.random.default_rng(0)
amplitudes = np.repeat([0.005, 0.007, 0.01, 0.014, 0.02], 2)  # two cycles of each
ends = [0.0, *np.ravel([amplitudes, -amplitudes], order="F"), 0.0]
rows = np.arange(2000 * (len(ends) - 1) + 1)
strain = np.interp(rows / 2000, np.arange(len(ends)), ends)
stress = curvewise.datasets.kinematic_hardening(strain)
test = np.column_stack([strain, stress]) + random.normal(0, 1, (rows.size, 2)) * [1e-4, 4]

# %%
# Each cycle has a loop, and each loop an energy: the area that it encloses, in MJ/m³.

energy = loop_energy(test)
figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
colours = plt.colormaps["plasma_r"](np.linspace(0.1, 0.9, len(energy)))
for loop, colour in zip(loops(test), colours, strict=True):
    left.plot(*loop.T, color=colour, linewidth=1)
left.set(xlabel="strain [-]", ylabel="stress [MPa]", title="Loops")
right.bar(np.arange(1, len(energy) + 1), energy, color=colours)
right.set(xlabel="cycle", title="Energy of each loop [MJ/m³]")

# %%
# The backbone curve joins the tips of the first cycle of each amplitude:

skeleton = backbone(test)
figure, axes = plt.subplots(figsize=(6.5, 4.2), layout="constrained")
axes.plot(*test[::10].T, color="0.75", linewidth=0.6, label="test")
axes.plot(*skeleton.T, "o-", color="#0072b2", label="backbone curve")
axes.set(xlabel="strain [-]", ylabel="stress [MPa]")
axes.legend(loc="lower right")

# %%
# The secant stiffness falls with the amplitude, and the damping ratio rises. The stiffness after
# unloading stays that of the elastic material, 200 GPa:

cycles = np.arange(1, len(energy) + 1)
figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
for kind, mark in (("secant", "o-"), ("unloading", "s--")):
    left.plot(cycles, stiffness(test, kind=kind) / 1e3, mark, label=kind)
left.set(xlabel="cycle", title="Stiffness [GPa]", ylim=0)
left.legend(loc="center right")
right.plot(cycles, 100 * damping(test), "o-", color="#d55e00")
right.set(xlabel="cycle", title="Equivalent viscous damping [%]", ylim=0)

# %%
# In noise, the extreme of a branch is an extreme of the noise. `reversals` locates the reversals by
# averages of both branches:

figure, axes = plt.subplots(figsize=(6.5, 3.6), layout="constrained")
near = slice(1850, 2150)
axes.plot(rows[near], 100 * test[near, 0], ".", color="0.7", markersize=3, label="test")
axes.plot(rows[near], 100 * strain[near], color="black", linewidth=1, label="without noise")
for find, colour in ((turning_points, "#d55e00"), (reversals, "#0072b2")):
    axes.axvline(find(test)[0], color=colour, label=find.__name__)
axes.set(xlabel="row", ylabel="strain [%]")
axes.legend(loc="lower left")

# %%
# The reversals of the first cycle of each amplitude, in per cent and MPa:

for peak, valley in peaks_and_valleys(test)[::2] * [100, 1]:
    print("peak {:5.2f} {:4.0f}   valley {:5.2f} {:4.0f}".format(*peak, *valley))
