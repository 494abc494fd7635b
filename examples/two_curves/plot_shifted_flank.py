"""
A steep flank, a little late
============================

Two steps of equal shape, one of them 4 % later. Point by point, where the curves have the same
time, they look as different as if the step were missing. Measures that look for what belongs
together do not make this mistake.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise

t = np.linspace(0, 1, 201)
step = 1 / (1 + np.exp(-(t - 0.5) / 0.01))
late = 1 / (1 + np.exp(-(t - 0.54) / 0.01))
lower = 0.8 * step
P, late, lower = (np.column_stack([t, y]) for y in (step, late, lower))

# %%
# Each value is divided by that of the curve that is too low. Above 1, a measure takes the late
# step for the worse one:

measures = {
    "mean square": curvewise.mse,
    "area": lambda P, Q: curvewise.area(P, Q, spacing="matched"),
    "frechet": curvewise.frechet_continuous,
    "dtw": curvewise.dtw,
}
ratios = {name: measure(P, late) / measure(P, lower) for name, measure in measures.items()}
for name, ratio in ratios.items():
    print(f"{name:>12}: {ratio:.2f}")

# %%

figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
for curve, label, style in (
    (P, "measured", {"color": "#0072b2", "linewidth": 2}),
    (late, "late by 4 %", {"color": "#d55e00"}),
    (lower, "too low by 20 %", {"color": "#009e73"}),
):
    left.plot(*curve.T, label=label, **style)
left.set(xlabel="time", ylabel="signal")
left.legend(loc="upper left")
right.barh(list(ratios), list(ratios.values()), color=["#d55e00", *["#0072b2"] * 3])
right.axvline(1, color="0.5", linewidth=0.8)
right.set(xlabel="late by 4 % / too low by 20 %")
right.invert_yaxis()
