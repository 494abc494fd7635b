"""
How far apart, where, and in which unit
=======================================

A value of 0.07 says little. The deviations of a comparison are in the unit of y, and the matched
points say where on the curve they are large.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

test, simulation = curvewise.datasets.hysteresis_pair()
compared = curvewise.compare(test, simulation)
for name in ("area", "frechet", "dtw"):
    print(f"{name:>8} {compared.values[name]:8.4f}   {compared.deviations[name]}")

# %%
# The warping path matches every point of the test with a point of the simulation. Their difference
# in stress, along the test:

P, Q = curvewise.normalize(test, simulation)
i, j = curvewise.dtw_path(P, Q).path.T
gap = np.abs(test[i, 1] - simulation[j, 1])

figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
left.plot(*simulation.T, color="0.6", linewidth=1, label="simulation")
points = left.scatter(*test[i].T, c=gap, s=12, cmap="plasma_r", label="test")
figure.colorbar(points, ax=left, label="stress apart [MPa]")
left.set(xlabel="strain [-]", ylabel="stress [MPa]")
left.legend(loc="center")
left.locator_params(axis="x", nbins=5)
right.plot(i, gap, color="#d55e00", linewidth=1)
for turn in curvewise.curves.turning_points(test):
    right.axvline(turn, color="0.7", linewidth=0.8)
right.set(xlabel="point of the test (grey: it turns)", ylim=0)

# %%
# The difference grows along each branch, and restarts after each turn:

worst = int(np.argmax(gap))
print(f"{gap[worst]:.0f} MPa at strain {test[i[worst], 0]:.4f}, point {i[worst]}")
