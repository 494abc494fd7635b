"""
Two recordings on one clock
===========================

The same process, recorded twice at changing speed. The warping path says which moment of one
recording is which moment of the other, and so puts both on one clock.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

random = np.random.default_rng(3)


def process(phase):
    return np.sin(2 * np.pi * phase) + 0.5 * np.sin(6 * np.pi * phase) * phase


t = np.linspace(0, 1, 300)
speed = 1 + 0.7 * np.sin(5 * t)  # the second machine runs faster, then slower
phase = np.cumsum(speed) / np.sum(speed)
first = process(t) + random.normal(0, 0.05, t.size)
second = process(phase) + random.normal(0, 0.05, t.size)

path = curvewise.dtw_path(first, second, window=0.3).path

# %%
# Each moment of the first recording gets the mean of the points matched to it:

count = np.bincount(path[:, 0])
aligned = np.bincount(path[:, 0], second[path[:, 1]]) / count
clock = np.bincount(path[:, 0], t[path[:, 1]]) / count

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11, 3.8), layout="constrained")
left.plot(t, first, color="#0072b2", label="first")
left.plot(t, second, color="#d55e00", label="second")
left.set(xlabel="time of each", title="As recorded")
left.legend(loc="upper right")
middle.plot(t, clock, color="k", label="found")
middle.plot(phase, t, ":", color="0.5", label="true")
middle.set(xlabel="time of the first", ylabel="time of the second", title="The clock")
middle.legend()
right.plot(t, first, color="#0072b2")
right.plot(t, aligned, color="#d55e00")
right.set(xlabel="time of the first", title="On one clock")

# %%

true = np.interp(t, phase, t)
print(f"mean difference before {np.abs(first - second).mean():.2f}, after", end=" ")
print(f"{np.abs(first - aligned).mean():.2f}; the noise of two recordings is 0.06")
print(f"the clock is wrong by {np.abs(clock - true).mean():.3f} in the mean")
