"""
Tracks in space
===============

Fréchet distances and dynamic time warping take points of any number of coordinates. Here: tracks
of aircraft on two approaches, and one that is neither.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

random = np.random.default_rng(4)


def track(approach, points):
    """Return a descent along a bent path, in kilometres, with an error of some 100 m."""
    t = np.linspace(0, 1, points)
    x = 40 * (1 - t)
    y = approach * 12 * np.sin(np.pi * t) ** 2
    z = 3 * (1 - t) ** 1.5
    drift = random.normal(0, 0.1, (points, 3)).cumsum(axis=0) / 4
    return np.column_stack([x, y, z]) + drift * [1, 1, 0.1]


tracks = [track((-1, 1)[i % 2], random.integers(80, 160)) for i in range(20)]
go_around = track(1, 120)
go_around[80:] += np.linspace(0, 1, 40)[:, np.newaxis] * [-12, 6, 4]
tracks.append(go_around)

# %%
# How far is every track from its nearest neighbour, at the worst place of the best walk?

distances, neighbours = curvewise.Index(tracks, "frechet_continuous").kneighbors(n_neighbors=1)
odd = int(np.argmax(distances))
print(
    f"track {odd} is {distances[odd, 0]:.1f} km from any other; the others at most "
    f"{np.delete(distances, odd).max():.1f} km"
)

# %%

figure = plt.figure(figsize=(8, 5), layout="constrained")
ax = figure.add_subplot(projection="3d")
for i, curve in enumerate(tracks):
    style = {"color": "#d55e00", "linewidth": 2} if i == odd else {"color": "#0072b2", "alpha": 0.5}
    ax.plot(*curve.T, **style)
ax.set(xlabel="x [km]", ylabel="y [km]", zlabel="height [km]", box_aspect=(2, 1.4, 0.8))

# %%
# Kilometres sideways and in height have the same weight here. For other weights, scale the columns
# first: ``curve * [1, 1, 5]``.
