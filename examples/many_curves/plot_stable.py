"""
When has a cyclic test become stable?
=====================================

A steel hardens over its first cycles, until each cycle equals the one before. The script compares
each cycle of the record with the one before it.
"""

from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.curves import turning_points
from curvewise.datasets import kinematic_hardening

random = np.random.default_rng(2)
t = np.linspace(0, 40, 40 * 120 + 1)  # in cycles
strain = 0.01 * np.sin(2 * np.pi * t)
stress = kinematic_hardening(strain, yield_stress=250.0, backstresses=[(40e3, 250.0)])
stress = stress * (1.3 - 0.3 * np.exp(-t / 6)) + random.normal(0, 2, t.size)
record = np.column_stack([strain, stress])

# %%
# A cycle goes from one largest strain to the next, which are every second turning point:

turns = turning_points(record, reversal=0.5)[::2]
cycles = [record[start : stop + 1] for start, stop in pairwise(turns)]

# %%
# How many MPa separate a cycle from the one before? The mean of ``area``, by matched points, in
# units of stress, tells. The cycles need not have the same points:

change = [
    curvewise.compare(before, after, measures=["area"]).deviations["area"].mean
    for before, after in pairwise(cycles)
]
noise = 2.0
stable = next(k for k, one in enumerate(change) if one < noise) + 2
print(f"{len(cycles)} cycles; from cycle {stable} on, the change is below the noise of {noise} MPa")

figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
colours = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(cycles)))
for cycle, colour in zip(cycles[::3], colours[::3], strict=True):
    left.plot(*cycle.T, color=colour, linewidth=0.8)
left.set(
    xlabel="strain [-]", ylabel="stress [MPa]", title="Every third cycle, the last ones bright"
)
left.locator_params(axis="x", nbins=5)
right.semilogy(np.arange(2, len(cycles) + 1), change, ".-", color="#d55e00")
right.axhline(noise, color="0.5", linewidth=0.8, label="noise of the load cell")
right.set(xlabel="cycle", ylabel="mean change to the cycle before [MPa]")
right.legend()
