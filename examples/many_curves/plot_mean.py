"""
The mean of curves whose features are shifted
=============================================

Fifteen recordings have the same two peaks, at different times. The mean point by point has neither
peak; the mean under dynamic time warping has both.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

random = np.random.default_rng(5)
t = np.linspace(0, 1, 150)


def recording():
    first, second = random.normal(0.3, 0.05), random.normal(0.65, 0.05)
    peaks = np.exp(-(((t - first) / 0.04) ** 2)) + 0.6 * np.exp(-(((t - second) / 0.05) ** 2))
    return peaks + random.normal(0, 0.02, t.size)


recordings = [recording() for _ in range(15)]
by_point = np.mean(recordings, axis=0)
mean = curvewise.dtw_mean(recordings, window=0.2)
typical = recordings[curvewise.medoid(recordings, "dtw", window=0.2)]

figure, ax = plt.subplots(figsize=(7, 4.2), layout="constrained")
for k, one in enumerate(recordings):
    ax.plot(t, one, color="0.8", linewidth=0.7, label=None if k else "fifteen recordings")
ax.plot(t, by_point, color="#0072b2", linewidth=2, label="mean, point by point")
ax.plot(t, mean.curve, color="#d55e00", linewidth=2, label="mean under dtw")
ax.set(xlabel="time", ylabel="signal")
ax.legend()

# %%
# The height of the first peak, in the mean over the recordings 1.0, in each of the curves:

print(f"mean point by point {by_point.max():.2f}, under dtw {mean.curve.max():.2f}")
print(f"converged: {mean.converged}; the medoid, one of the recordings, has {typical.max():.2f}")
