"""
A test under stress control
===========================

Unequal stresses in tension and compression: each of 20 cycles leaves more strain (ratcheting). The
material is driven by the measured stresses, and identified by the area between the curves. A sum
of squares at equal strains does not apply, because the strains drift.
"""

import itertools

import matplotlib.pyplot as plt
import numpy as np

from curvewise.calibration import Log, identify
from curvewise.materials import ChabocheVoce

random = np.random.default_rng(0)
steel = ChabocheVoce(backstresses=1)
TRUE = dict(zip(steel.names, (200e3, 300.0, 40.0, 5.0, 40e3, 200.0), strict=True))

turns = [0.0, *[450.0, -390.0] * 20, 0.0]
stress = np.concatenate([np.linspace(a, b, 25)[1:] for a, b in itertools.pairwise(turns)])
test = np.column_stack([steel.strain(stress, TRUE), stress])
test[:, 0] += random.normal(0, 5e-5, len(test))  # noise of the extensometer

bounds = {
    "E": (150e3, 250e3),
    "yield": (200.0, 400.0),
    "Q": (0.0, 100.0),
    "b": Log(0.5, 30.0),
    "C1": Log(1e4, 1e5),
    "gamma1": Log(50.0, 500.0),
}
model = steel.driven_by(test, control="stress")
found = identify(model, test, bounds, measure="area", progress=False)
uncertainty = found.uncertainty()
print(uncertainty)

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), width_ratios=(2, 1))
left.plot(100 * test[:, 0], test[:, 1], ".", markersize=3, zorder=3, label="test")
left.plot(
    100 * found.simulations[0][:, 0], found.simulations[0][:, 1], lw=0.8, label="fitted material"
)
left.set(xlabel="strain [%]", ylabel="stress [MPa]")
left.legend(loc="lower right")
peaks = np.arange(23, 48 * 20, 48)
right.plot(100 * test[peaks, 0], "o", markersize=4)
right.plot(100 * found.simulations[0][peaks, 0])
right.set(xlabel="cycle", ylabel="strain at the largest stress [%]")
plt.tight_layout()
plt.show()
