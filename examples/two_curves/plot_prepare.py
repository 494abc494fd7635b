"""
From a raw test to a curve
==========================

Strain in per cent, slack at the start, noise, engineering instead of true stress: what a test
machine writes is not yet what a simulation computes. Five steps, each one call.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.curves import engineering_to_true, resample, shift_to_origin, smooth, turning_points

random = np.random.default_rng(0)
path = np.interp(np.arange(1200), [0, 400, 700, 1199], [0, 0.04, 0.01, 0.08])
true_stress = curvewise.datasets.kinematic_hardening(path, backstresses=[(6e3, 25.0)])
raw = np.column_stack([np.expm1(path), true_stress / np.exp(path)])  # engineering
seated = np.maximum.accumulate(raw[:, 1])
raw[:, 0] += 0.002 * (1 - np.exp(-seated / 20))  # slack, which the first loading takes up
raw = raw * [100, 1] + random.normal(0, 1, raw.shape) * [0.004, 4]  # per cent, noise

# %%
# First convert units. Then shift the origin to where the straight part between 60 and 250 MPa meets
# zero stress. Then compute true strain and stress, filter the noise branch by branch, and space the
# points evenly:

curve = raw * [0.01, 1]
curve = shift_to_origin(curve, elastic=(60, 250))
curve = engineering_to_true(curve)
turns = turning_points(curve)
curve = smooth(curve, window=31, turns=turns)
curve = resample(curve, 40, turns=turns)

figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
left.plot(*raw.T, color="#0072b2", linewidth=0.8)
left.set(xlabel="engineering strain [%]", ylabel="engineering stress [MPa]", title="As recorded")
right.plot(path, true_stress, color="0.75", linewidth=4, label="what was done")
right.plot(*curve.T, ".-", color="#d55e00", linewidth=0.8, label="prepared")
right.set(xlabel="true strain [-]", ylabel="true stress [MPa]", title="Prepared")
right.legend(loc="lower right")

# %%
# The errors that remain, in MPa:

truth = np.column_stack([path, true_stress])
for name, one in (("as recorded", raw * [0.01, 1]), ("prepared", curve)):
    compared = curvewise.compare(truth, one, measures=["area"])
    print(f"{name:>12}: {compared.deviations['area'].mean:5.1f} in the mean")
