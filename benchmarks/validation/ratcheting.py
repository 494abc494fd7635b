"""Is a material identified from a test under stress control that ratchets?

A test of 20 cycles between 450 and -390 MPa is simulated with one back stress and white noise of
0.005 % strain. The material is identified from it with the measured stresses as the drive. Prints
for each measure and parameter the error, and how many intervals of 95 % hold the truth. The search
is the default one, or one start at the truth: 40 branches leave many local minima near the lowest
one. The intervals by `frechet` are those of the bootstrap, as the documentation advises. The last
lines have the sums over all simulated tests.

    python benchmarks/validation/ratcheting.py [tests]

Takes about a minute for each test.
"""

from __future__ import annotations

import itertools
import sys
import time
from collections import Counter

import numpy as np

from curvewise.calibration import Log, TrustRegion, identify
from curvewise.materials import ChabocheVoce

STEEL = ChabocheVoce(backstresses=1)
TRUTH = dict(zip(STEEL.names, (200e3, 300.0, 40.0, 5.0, 40e3, 200.0), strict=True))
BOUNDS = {
    "E": (150e3, 250e3),
    "yield": (200.0, 400.0),
    "Q": (0.0, 100.0),
    "b": Log(0.5, 30.0),
    "C1": Log(1e4, 1e5),
    "gamma1": Log(50.0, 500.0),
}
SAMPLES = {"area": 0, "dtw": 0, "frechet": 300}
STARTS: dict[str, dict] = {
    "default": {},
    "truth": {"start": TRUTH, "method": TrustRegion(starts=1, gain=1e-6)},
}
NOISE, CYCLES, STEPS = 5e-5, 20, 24


def noisy_test(seed: int) -> np.ndarray:
    """Return strain and stress."""
    turns = [0.0, *[450.0, -390.0] * CYCLES, 0.0]
    legs = [np.linspace(a, b, STEPS + 1)[1:] for a, b in itertools.pairwise(turns)]
    stress = np.concatenate(legs)
    noise = np.random.default_rng(seed).normal(0.0, NOISE, stress.size)
    return np.column_stack((STEEL.strain(stress, TRUTH) + noise, stress))


def main() -> None:
    """Identify and print."""
    tests = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    drift = noisy_test(0)[STEPS - 1 :: 2 * STEPS, 0]
    print(f"strain at the largest stress: {drift[0]:.5f} in cycle 1, {drift[-1]:.5f} in the last\n")
    print(f"| test | measure | start | {' | '.join(TRUTH)} | held | converged | runs | s |")
    print(f"|---:|---|---|{'---:|' * (len(TRUTH) + 4)}")
    total: Counter[tuple[str, str]] = Counter()
    for seed, (measure, samples), start in itertools.product(range(tests), SAMPLES.items(), STARTS):
        test = noisy_test(seed)
        model = STEEL.driven_by(test, control="stress")
        begin = time.perf_counter()
        options = STARTS[start]
        found = identify(model, test, BOUNDS, measure=measure, progress=False, **options)
        said = found.uncertainty(samples=samples)
        seconds = time.perf_counter() - begin
        errors = [
            f"{100.0 * (found.parameters[name] / value - 1.0):+.2f} %"
            for name, value in TRUTH.items()
        ]
        held = sum(low <= TRUTH[name] <= high for name, (low, high) in said.intervals.items())
        total[measure, start] += held
        print(
            f"| {seed} | {measure} | {start} | {' | '.join(errors)} | {held} of {len(TRUTH)} | "
            f"{found.converged} | {found.evaluations} | {seconds:.0f} |",
            flush=True,
        )
    for (measure, start), held in total.items():
        print(f"{measure}, {start}: {held} of {tests * len(TRUTH)} intervals hold the truth")


if __name__ == "__main__":
    main()
