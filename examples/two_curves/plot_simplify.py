"""
How few points will do?
=======================

A track of four thousand points, simplified with a guarantee: the line that is kept is nowhere
farther from the track than a tolerance, walked from start to end.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.curves import simplify

random = np.random.default_rng(1)
heading = np.cumsum(random.normal(0, 0.06, 4000))
track = np.cumsum(np.column_stack([np.sin(heading), np.cos(heading)]), axis=0)  # metres

# %%
# No line of fewer points of the track is within the tolerance, edge by edge. The continuous Fréchet
# distance checks the whole line once more:

figure, ax = plt.subplots(figsize=(8, 4.2), layout="constrained")
ax.plot(*track.T, color="0.75", linewidth=4, label=f"{len(track)} points")
for tolerance, colour in ((5, "#0072b2"), (50, "#d55e00")):
    line = simplify(track, tolerance)
    away = curvewise.frechet_continuous(track, line)
    print(f"tolerance {tolerance:>2} m: {len(line):>3} points, {away:.2f} m away at most")
    ax.plot(*line.T, ".-", color=colour, linewidth=1, label=f"{len(line)} points, {tolerance} m")
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
ax.legend()
