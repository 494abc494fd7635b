"""
What noise does to each measure
===============================

The same loop is compared twice: raw, and with more and more noise. A measure that averages grows
slowly. A measure of the worst point, or of arc length, grows faster.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

_, loop = curvewise.datasets.hysteresis_pair()
moved = loop * [1.0, 1.05]  # what a difference of 5 % of the stress amounts to
random = np.random.default_rng(0)
levels = np.array([0.0025, 0.005, 0.01, 0.02, 0.04])
height = np.ptp(loop[:, 1])

values = {}
for level in levels:
    noisy = loop + random.normal(0, 1, loop.shape) * [0, level * height]
    for name, value in curvewise.compare(loop, noisy).values.items():
        values.setdefault(name, []).append(value)
unit = curvewise.compare(loop, moved).values

# %%
# Every value is divided by that of the loop with its stress raised by 5 %: at 1, noise looks as
# large as that. Partial curve mapping and curve length see noise as length, and should be given
# filtered curves.

figure, ax = plt.subplots(figsize=(7, 4.5), layout="constrained")
for (name, row), marker in zip(values.items(), "os^Dv", strict=True):
    ax.loglog(100 * levels, np.array(row) / unit[name], marker=marker, label=name)
ax.axhline(1, color="0.5", linewidth=0.8)
ax.set(xlabel="noise [% of the height]", ylabel="value / value at 5 % more stress")
ax.set_xticks(100 * levels, [f"{100 * level:g}" for level in levels])
ax.minorticks_off()
ax.legend(ncols=2)

# %%
# A filter that leaves the turning points alone:

from curvewise.curves import smooth, turning_points

smoothed = smooth(noisy, window=0.2, turns=turning_points(loop))
for name, value in curvewise.compare(loop, smoothed).values.items():
    print(f"{name:>12}: {values[name][-1] / unit[name]:7.2f} becomes {value / unit[name]:5.2f}")
