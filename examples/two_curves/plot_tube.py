"""
Within a tolerance, or where not
================================

A solver's new version must return the history of its reference, within 2 % of the time span and 5 %
of the height. The tube is what a rectangle of that size covers along the reference.
"""

from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon

import curvewise

t = np.linspace(0, 1, 201)
reference = np.column_stack([t, np.exp(-2 * t) * np.sin(4 * np.pi * t)])
result = np.column_stack([t + 0.005, np.exp(-1.4 * t) * np.sin(4.2 * np.pi * t)])

dx, dy = 0.02, 0.05 * np.ptp(reference[:, 1])
tube = curvewise.tube(reference, result, dx, dy)
print(tube)

# %%
# Points of the result outside the tube are marked. The first is where the result leaves it:

figure, axes = plt.subplots(figsize=(7.5, 4.2), layout="constrained")
corners = np.array([(-dx, -dy), (dx, -dy), (dx, dy), (-dx, dy), (-dx, -dy), (dx, -dy)])
for a, b in pairwise(reference):  # a rectangle moved along a segment
    for k in range(4):
        sides = np.array([a + corners[k], a + corners[k + 1], b + corners[k + 1], b + corners[k]])
        axes.add_patch(Polygon(sides, color="0.85"))
axes.plot(*reference.T, color="#0072b2", label="reference")
axes.plot(*result.T, color="#d55e00", linewidth=1, label="result")
axes.plot(*result[tube.outside].T, ".", color="#d55e00", markersize=7, label="outside")
axes.plot(*tube.first, "o", color="black", fillstyle="none", markersize=11, label="first outside")
axes.set(xlabel="time [s]", ylabel="displacement [mm]")
axes.legend()

# %%
# In a test, the tube is the assertion, and so is a verdict of measures with their limits. On the
# command line the exit status says the same (``curvewise compare --tube 2% 5% --within area=2%``):

verdict = curvewise.compare(reference, result).within({"area": "2%", "frechet": 0.1})
print(bool(tube), bool(verdict))
print(verdict)
