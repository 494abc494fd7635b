"""
Where in a record a cycle occurs
================================

A closed cycle of strain and stress, and a record of twenty-five cycles with changing amplitude.
The runs of the record that are most like the cycle, the best first, without overlap.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.datasets import kinematic_hardening

t = np.arange(6000)
amplitude = np.interp(t, [0, 1500, 3000, 4500, 6000], [0.4, 1.0, 0.6, 1.0, 0.5])
strain = 0.02 * amplitude * np.sin(2 * np.pi * t / 240 + 0.5 * np.sin(t / 700))
stress = kinematic_hardening(strain, yield_stress=300.0, backstresses=[(60e3, 300.0)])
stress += np.random.default_rng(2).normal(0, 4, len(t))
record = np.column_stack([strain / 0.02, stress / 500])

phase = np.linspace(0, 2 * np.pi, 161)
path = 0.0195 * np.sin(np.concatenate([np.linspace(-3 * np.pi, 0, 300), phase]))
cycle_stress = kinematic_hardening(path, yield_stress=300.0, backstresses=[(60e3, 300.0)])
cycle = np.column_stack([path / 0.02, cycle_stress / 500])[300:]

found = curvewise.subsequence(cycle, record, k=6)
for run in found:
    print(f"distance {run.distance:6.2f}, points {run.start} to {run.stop}")

# %%

figure, (left, right) = plt.subplots(
    1, 2, figsize=(10.5, 3.5), layout="constrained", width_ratios=[1, 2.4]
)
for k, run in enumerate(found):
    label = "six runs" if k == 0 else None
    left.plot(*record[run.start : run.stop + 1].T, color="#0072b2", linewidth=0.6, label=label)
left.plot(*cycle.T, color="#d55e00", linewidth=1.6, label="the cycle")
left.set(xlabel="strain / 0.02", ylabel="stress / 500 MPa")
left.legend(loc="center")
right.plot(record[:, 0], color="0.6", linewidth=0.8)
for k, run in enumerate(found):
    right.axvspan(run.start, run.stop, color="#0072b2", alpha=0.25)
    right.text((run.start + run.stop) / 2, 1.05, str(k + 1), ha="center")
right.set(xlabel="point of the record", ylabel="strain / 0.02", ylim=(-1.1, 1.25))
