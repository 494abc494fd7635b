"""
How few points will do?
=======================

A track of four thousand points, thinned with a guarantee: the line that is kept is nowhere further
from the track than a tolerance, walked from start to end.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

random = np.random.default_rng(1)
heading = np.cumsum(random.normal(0, 0.06, 4000))
track = np.cumsum(np.column_stack([np.sin(heading), np.cos(heading)]), axis=0)  # metres


def simplified(track, tolerance):
    """Keep from each point the furthest one that may follow it, found by doubling and halving."""
    kept, here = [0], 0
    while here < len(track) - 1:

        def fits(end, here=here):
            return curvewise.frechet_within(track[here : end + 1], track[[here, end]], tolerance)

        step = 1
        while here + 2 * step < len(track) and fits(here + 2 * step):
            step *= 2
        low, high = here + step, min(here + 2 * step, len(track))
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if fits(middle) else (low, middle)
        here = low
        kept.append(here)
    return track[kept]


# %%
# ``frechet_within`` decides "is it within the tolerance?", which is cheaper than the distance. The
# whole line is then checked once more, by the distance itself:

figure, ax = plt.subplots(figsize=(8, 4.2), layout="constrained")
ax.plot(*track.T, color="0.75", linewidth=4, label=f"{len(track)} points")
for tolerance, colour in ((5, "#0072b2"), (50, "#d55e00")):
    line = simplified(track, tolerance)
    away = curvewise.frechet_continuous(track, line)
    print(f"tolerance {tolerance:>2} m: {len(line):>3} points, {away:.2f} m away at most")
    ax.plot(*line.T, ".-", color=colour, linewidth=1, label=f"{len(line)} points, {tolerance} m")
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
ax.legend()
