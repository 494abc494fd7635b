"""
Dynamic time warping
====================

Every point of either curve is matched to at least one point of the other, in order; the distances
of matched points are added up. The matching with the smallest sum is the warping path.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.plotting import plot_alignment, plot_table

t = np.linspace(0, 1, 120)
P = np.exp(-(((t - 0.35) / 0.06) ** 2)) + 0.6 * np.exp(-(((t - 0.7) / 0.08) ** 2))
Q = np.exp(-(((t - 0.45) / 0.07) ** 2)) + 0.6 * np.exp(-(((t - 0.75) / 0.05) ** 2))

figure, axes = plt.subplots(1, 2, figsize=(10.5, 4.5), layout="constrained")
plot_alignment(P, Q, axes[0], measure="dtw", every=3)
axes[0].legend(loc="upper right")
plot_table(P, Q, axes[1], measure="dtw")

# %%
# Left: two series with the same peaks at different times, and the matched points. Right: the table
# of the smallest sums, small where it is bright, and the path. Point by point the series are far
# apart; warped they are close:

print(
    f"sum of differences point by point {np.abs(P - Q).sum():.2f}, warped {curvewise.dtw(P, Q):.2f}"
)

# %%
# A Sakoe–Chiba band says how far a point may be moved. Narrower bands give larger values:

for window in (None, 20, 10, 5, 0):
    print(f"window {window!s:>4}: {curvewise.dtw(P, Q, window=window):.3f}")

# %%
# It is a sum over points, so it grows with their number. Divided by n + m it does not:

test, simulation = curvewise.normalize(*curvewise.datasets.hysteresis_pair())
for every in (1, 2, 4):
    loops = test[::every], simulation[::every]
    total = curvewise.dtw(*loops)
    mean = curvewise.dtw(*loops, step_pattern="symmetric2", normalize=True)
    print(f"{len(loops[0]):>3} and {len(loops[1]):>3} points: {total:.2f}, per step {mean:.4f}")
