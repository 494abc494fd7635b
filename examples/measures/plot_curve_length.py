"""
Curve length
============

Every point of P is compared with the point of Q at the same fraction of its curve's length. The
differences, relative and logarithmic, are residuals that least squares can use.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.plotting import plot_curve_length

strain = np.linspace(0, 0.05, 40)
P = np.column_stack([strain, 500 * (1 - np.exp(-strain / 0.01))])
Q = np.column_stack([strain * 1.05, 450 * (1 - np.exp(-strain / 0.014))])

figure, axes = plt.subplots(1, 2, figsize=(10.5, 4.5), layout="constrained")
plot_curve_length(P, Q, axes[0], scale="mean_abs")
axes[0].set(xlabel="strain [-]", ylabel="stress [MPa]")
axes[0].legend(loc="lower right")
residuals = curvewise.curve_length_residuals(P, Q, scale="mean_abs")
axes[1].plot(np.linspace(0, 1, len(P)), residuals, ".-", label=["strain", "stress"])
axes[1].set(xlabel="point of P [share of all]", ylabel="residual [-]")
axes[1].legend()

# %%
# The measure is the root of the sum of their squares:

print(curvewise.curve_length(P, Q, scale="mean_abs"), np.sqrt(np.sum(residuals**2)))

# %%
# Noise adds length. On a noisy curve, equal fractions of the length are different places:

noisy = Q + np.random.default_rng(0).normal(0, 1, Q.shape) * [0.0005, 5]
print(f"with noise of 1 %: {curvewise.curve_length(P, noisy, scale='mean_abs'):.3f}")
