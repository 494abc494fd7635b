"""
Is the simulation within the scatter of the tests?
==================================================

Eight repeated tests differ from each other. A simulation is as good as a test if it is at most as
far from the tests as they are from one another.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.datasets import kinematic_hardening

random = np.random.default_rng(7)


def loop(yield_stress, hardening, points, noise):
    strain = 0.02 * np.sin(np.linspace(0, 2.5 * np.pi, points))
    stress = kinematic_hardening(
        strain, yield_stress=yield_stress, backstresses=[(hardening, 300.0)]
    )
    return np.column_stack([strain, stress + random.normal(0, noise, points)])


tests = [loop(random.normal(300, 8), random.normal(60e3, 2e3), 150, 3) for _ in range(8)]
candidates = {"A": loop(304, 61e3, 90, 0), "B": loop(330, 40e3, 90, 0)}

# %%
# Strain and stress are divided by one box for all, so that every pair has the same scale. A row of
# the matrix has the distances of one curve from each test:

box = np.ptp(np.concatenate(tests), axis=0)
scaled = [test / box for test in tests]
between = curvewise.pdist(scaled, "frechet_continuous")
for name, curve in candidates.items():
    away = curvewise.cdist([curve / box], scaled, "frechet_continuous")[0]
    print(
        f"{name}: {np.median(away):.3f} from the tests (median), tests from each other "
        f"{np.median(between):.3f}; {np.mean(between >= np.median(away)):.0%} of their pairs are "
        "further apart"
    )

# %%

figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
for k, test in enumerate(tests):
    left.plot(*test.T, color="0.7", linewidth=0.8, label=None if k else "eight tests")
right.hist(between, bins=12, color="0.75", label="tests, from each other")
for (name, curve), colour in zip(candidates.items(), ("#0072b2", "#d55e00"), strict=True):
    left.plot(*curve.T, color=colour, label=f"simulation {name}")
    away = curvewise.cdist([curve / box], scaled, "frechet_continuous")[0]
    right.plot(
        away, np.full(8, -0.35), "|", color=colour, markersize=14, label=f"{name}, from them"
    )
left.set(xlabel="strain [-]", ylabel="stress [MPa]")
left.legend(loc="upper left", fontsize=8)
right.set(xlabel="continuous Fréchet distance, scaled", ylabel="pairs")
right.legend(fontsize=8)
