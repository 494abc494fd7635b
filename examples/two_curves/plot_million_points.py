"""
A million points
================

The table of two curves of a million points has 10¹² cells. If the curves are similar, nearly all
cells cannot matter, and are skipped; the values are bitwise identical.
"""

import time

import matplotlib.pyplot as plt
import numpy as np

import curvewise

points = (1_000, 10_000, 100_000, 1_000_000)
seconds, shares = [], []
for n in points:
    t = np.linspace(0, 2 * np.pi, n)
    P = np.column_stack([np.sin(3 * t), np.cos(2 * t)])
    t = np.linspace(0, 2 * np.pi, int(0.9 * n))
    Q = 1.03 * np.column_stack([np.sin(3 * t), np.cos(2 * t)])
    start = time.perf_counter()
    info = curvewise.frechet_info(P, Q)
    seconds.append(time.perf_counter() - start)
    shares.append(info.share)
    print(
        f"n = {n:>9,}: {info.value:.6f} in {seconds[-1]:.4f} s, {100 * info.share:.3g} % of cells"
    )

# %%

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
left.plot(*P[::1000].T, label="P, a million points")
left.plot(*Q[::900].T, label="Q, 900,000")
left.set(aspect="equal", xlabel="x", ylabel="y")
left.legend(loc="lower center", bbox_to_anchor=(0.5, 0.02), fontsize=8)
right.loglog(points, seconds, "o-", label="time taken")
right.loglog(points, np.array(points) * seconds[1] / points[1], ":", color="0.5", label="∝ n")
right.set(xlabel="n", ylabel="seconds")
right.legend()

# %%
# ``prune=False`` sweeps the whole table, in linear memory and time that grows with n²:

n = 10_000
t = np.linspace(0, 2 * np.pi, n)
P = np.column_stack([np.sin(3 * t), np.cos(2 * t)])
Q = 1.03 * P[: -n // 10]
for prune in (True, False):
    start = time.perf_counter()
    value = curvewise.frechet(P, Q, prune=prune)
    print(f"prune={prune!s:<5}: {value!r} in {time.perf_counter() - start:.4f} s")
