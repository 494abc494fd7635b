"""Do the intervals hold the truth where the model is wrong? Measured loops, a fitted material.

Chaboche's back stresses with Voce's hardening, compiled, are fitted to a measured loop by least
squares. The fitted parameters are the truth; what the fit leaves is the error of the model, which a
test of each set has shifted along the loop by a number of points that is drawn, for half of the
sets turned round and for half with the other sign, so that it is no longer what a fit has left. A
white noise of 2 MPa comes upon it. Beside that: white noise of 5 MPa alone.

    pip install ".[calibration]"
    python benchmarks/validation/wrong_models.py --sets 200
    python benchmarks/validation/wrong_models.py --sets 50 --first 150 --case "dp780 3 %, area"

Prints for every case how many per cent of the sets have the truth in the interval of 95 %, by
parameter, and how many times the errors are those of white noise (the median over the sets). Every
set is kept in --records as soon as it is done. A set takes 0.2 s by squares and 2 s by area.
"""

from __future__ import annotations

import argparse
import functools
import json
import logging
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from places import BUILD, LOOPS
from scipy.optimize import least_squares

import curvewise
from curvewise.calibration import LeastSquares, TrustRegion, WideBoundsWarning, identify
from curvewise.curves import resample
from curvewise.materials import ChabocheVoce

BOUNDS = {
    "E": (150e3, 230e3),
    "yield": (50.0, 800.0),
    "Q": (-400.0, 600.0),
    "b": (0.5, 80.0),
    "C1": (5e3, 500e3),
    "gamma1": (50.0, 2000.0),
    "C2": (500.0, 50e3),
    "gamma2": (0.0, 200.0),
}


class Case(NamedTuple):
    """A loop of so many points, a measure, and the noise that comes upon the fitted curve."""

    loop: str
    points: int
    measure: str
    with_model_error: bool
    sigma: float

    def __str__(self) -> str:
        noise = f"model error and {self.sigma:g} MPa" if self.with_model_error else "white"
        return f"{self.loop}, {self.points} points, {self.measure}, {noise}"


CASES = [
    Case(loop, points, measure, wrong, 2.0 if wrong else 5.0)
    for loop, points in (("dp780_tct_3pct", 600), ("dp780_tct_6pct", 300), ("tr1180_tct_3pct", 200))
    for measure in ("sum_of_squares", "area")
    for wrong in (True, False)
]
CASES += [
    Case("dp780_tct_3pct", 150, "area", wrong, 2.0 if wrong else 5.0) for wrong in (True, False)
]


class Truth(NamedTuple):
    """The fitted model: its curve, its parameters, and what it leaves of the loop."""

    model: Any
    parameters: dict[str, float]
    curve: np.ndarray
    error: np.ndarray


@functools.cache
def truth_of(loop: str, points: int) -> Truth:
    """Fit a loop, from six places."""
    test = np.asarray(resample(curvewise.read_curve(LOOPS / f"{loop}.csv")[:, :2], points))
    material = ChabocheVoce(backstresses=2)
    low, high = np.array([BOUNDS[name] for name in material.names]).T

    def parameters(unit: np.ndarray) -> dict[str, float]:
        return dict(zip(material.names, (low + unit * (high - low)).tolist(), strict=True))

    def residuals(unit: np.ndarray) -> np.ndarray:
        try:
            return material.stress(test[:, 0], parameters(unit)) - test[:, 1]
        except ValueError:  # a yield stress that would soften to nothing
            return np.full(points, 1e4)

    starts = np.random.default_rng(0).uniform(0.2, 0.8, (6, len(low)))
    fits = [
        least_squares(residuals, start, bounds=(0.0, 1.0), x_scale="jac", max_nfev=200)
        for start in starts
    ]
    best = min(fits, key=lambda fit: fit.cost).x
    model = material.driven_by(test)
    (curve,) = model(parameters(best))
    return Truth(model, parameters(best), curve, test[:, 1] - curve[:, 1])


def test_of(case: Case, seed: int) -> np.ndarray:
    """Return the curve of the truth with the noise of one set."""
    truth, random = truth_of(case.loop, case.points), np.random.default_rng(seed)
    test = truth.curve.copy()
    test[:, 1] += random.normal(0.0, case.sigma, len(test))
    if case.with_model_error:
        error = np.roll(truth.error, random.integers(len(test)))
        error = error[::-1] if random.random() < 0.5 else error
        test[:, 1] += error * random.choice((-1.0, 1.0))
    return test


def judged(case: Case, seed: int) -> dict[str, Any]:
    """Return which intervals hold the truth, and errors in units of those of white noise."""
    truth = truth_of(case.loop, case.points)
    squares = case.measure == "sum_of_squares"
    found = identify(
        truth.model,
        [test_of(case, seed)],
        BOUNDS,
        measure=case.measure,
        method=LeastSquares() if squares else TrustRegion(initial_range=0.1, gain=1e-4),
        start=truth.parameters,
        progress=False,
        **({"abscissa": "points"} if squares else {}),
    )
    uncertainty = found.uncertainty()
    as_white = found.uncertainty(sigma=float(uncertainty.sigma[0]))
    return {
        "seed": seed,
        "inside": [
            low <= truth.parameters[name] <= high
            for name, (low, high) in uncertainty.intervals.items()
        ],
        "widths": [
            np.ptp(uncertainty.intervals[name]) / np.ptp(as_white.intervals[name])
            for name in BOUNDS
        ],
        "determined": list(uncertainty.determined.values()),
    }


def main() -> None:
    """Count, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--sets", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="the seed of the first set")
    parser.add_argument("--case", action="append", choices=list(map(str, CASES)), help="no others")
    parser.add_argument("--records", type=Path, default=BUILD / "wrong_models")
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    warnings.simplefilter("ignore", WideBoundsWarning)  # the fit has these bounds
    options.records.mkdir(parents=True, exist_ok=True)
    print(f"| case | correlation | sets | {' | '.join(BOUNDS)} |")
    print("|---|---:|---:|" + "---:|" * len(BOUNDS))
    for case in CASES:
        if options.case and str(case) not in options.case:
            continue
        file = options.records / f"{case}.jsonl".replace("/", " ")
        known = {}
        if file.exists():
            known = {row["seed"]: row for row in map(json.loads, file.read_text().splitlines())}
        for seed in range(options.first, options.first + options.sets):
            if seed not in known:
                known[seed] = judged(case, seed)
                with file.open("a") as lines:
                    lines.write(json.dumps(known[seed]) + "\n")
        rows = list(known.values())
        error = truth_of(case.loop, case.points).error
        rho = np.corrcoef(error[1:], error[:-1])[0, 1] if case.with_model_error else 0.0
        inside = 100.0 * np.mean([row["inside"] for row in rows], axis=0)
        widths = np.median([row["widths"] for row in rows], axis=0)
        cells = [f"{a:.1f} (×{b:.1f})" for a, b in zip(inside, widths, strict=True)]
        print(f"| {case} | {rho:.2f} | {len(rows)} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
