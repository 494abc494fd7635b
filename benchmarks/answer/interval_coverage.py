"""Do the intervals hold what they promise? How many of 1,000 noise sets have the truth inside.

A straight line and a parabola by the sum of squares, whose standard errors are held against those
of lmfit; and a hardening model of three parameters on a cycle by area, dtw and curve_length. Noise
is normal. For the bootstrapped measures the basic interval that `uncertainty` gives stands beside
its mirror image about the optimum (the percentile interval), which doubles a measure's bias.

    pip install ".[calibration,plot]" lmfit
    python benchmarks/answer/interval_coverage.py --sets 1000

Writes coverage.json and coverage.md. Sets are shared out among --workers processes.
"""

from __future__ import annotations

import argparse
import itertools
import json
import logging
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from curvewise import datasets
from curvewise.calibration import identify

HERE = Path(__file__).resolve().parent
X = np.linspace(0.0, 1.0, 40)
STRAIN = np.concatenate(
    [np.linspace(a, b, 30, endpoint=False) for a, b in itertools.pairwise((0.0, 0.02, -0.02, 0.02))]
)


def parabola(p):
    return np.column_stack((X, p["a"] + p["b"] * X + p["c"] * X**2))


def hardening(p):
    stress = datasets.kinematic_hardening(
        STRAIN,
        youngs_modulus=p["E"],
        yield_stress=p["yield"],
        backstresses=((p["C"], 400.0), (5e3, 20.0)),
    )
    return np.column_stack((STRAIN, stress))


PROBLEMS: dict[str, tuple[Callable, dict, dict, float]] = {
    "parabola": (
        parabola,
        {"a": 1.0, "b": -2.0, "c": 3.0},
        {"a": (-10.0, 10.0), "b": (-20.0, 20.0), "c": (-20.0, 20.0)},
        0.1,
    ),
    "hardening": (
        hardening,
        {"E": 200e3, "yield": 300.0, "C": 80e3},
        {"E": (150e3, 260e3), "yield": (150.0, 500.0), "C": (20e3, 200e3)},
        4.0,
    ),
}


def noisy(problem: str, seed: int) -> np.ndarray:
    model, truth, _, sigma = PROBLEMS[problem]
    curve = model(truth)
    curve[:, 1] += np.random.default_rng(seed).normal(0.0, sigma, len(curve))
    return curve


def judged(problem: str, measure: str, samples: int, known: bool, seed: int):
    """Return for every parameter: interval and its mirror image hold the truth, and its z."""
    model, truth, bounds, sigma = PROBLEMS[problem]
    found = identify(
        model,
        noisy(problem, seed),
        bounds,
        measure=measure,
        method="trust-region",
        method_options={"initial_range": 0.1, "gain": 1e-5},
        start=truth,
        progress=False,
    )
    uncertainty = found.uncertainty(samples=samples, sigma=sigma if known else None)
    rows = []
    for name, value in truth.items():
        best = found.parameters[name]
        low, high = uncertainty.intervals[name]
        mirrored = 2 * best - high <= value <= 2 * best - low
        rows.append(
            (low <= value <= high, mirrored, (best - value) / uncertainty.standard_errors[name])
        )
    return rows


def against_lmfit() -> dict[str, float]:
    """Return the largest relative difference of standard errors from lmfit's, over 20 sets."""
    from lmfit import Model

    differences = []
    for seed in range(20):
        test = noisy("parabola", seed)
        theirs = Model(lambda x, a, b, c: a + b * x + c * x**2).fit(
            test[:, 1], x=test[:, 0], a=0.0, b=0.0, c=0.0
        )
        model, _, bounds, _ = PROBLEMS["parabola"]
        ours = identify(
            model, test, bounds, measure="sum_of_squares", method="trust-region", progress=False
        ).uncertainty()
        for name, error in ours.standard_errors.items():
            differences.append(abs(error / theirs.params[name].stderr - 1.0))
    return {"largest": max(differences), "sets": 20}


def main() -> None:
    """Count, print, write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--sets", type=int, default=1000)
    parser.add_argument("--bootstrap-sets", type=int, default=1000, help="of the other measures")
    parser.add_argument("--samples", type=int, default=200, help="of each bootstrap")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--output", type=Path, metavar="DIR", default=HERE)
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    results: dict = {"samples": options.samples, "lmfit": against_lmfit()}
    print("standard errors, largest difference from lmfit's:", results["lmfit"])
    lines = [
        "| problem | measure | noise | sets | parameter | interval, % | mirrored, % | "
        "mean of z | deviation of z |",
        "|---|---|---|---:|---|---:|---:|---:|---:|",
    ]
    cases = [("parabola", "sum_of_squares", False), ("parabola", "sum_of_squares", True)]
    cases += [("hardening", measure, False) for measure in ("area", "dtw", "curve_length")]
    with ProcessPoolExecutor(options.workers) as pool:
        for problem, measure, known in cases:
            task = partial(judged, problem, measure, options.samples, known)
            count = options.sets if measure == "sum_of_squares" else options.bootstrap_sets
            rows = np.array(list(pool.map(task, range(count), chunksize=10)))
            for i, name in enumerate(PROBLEMS[problem][1]):
                inside, mirrored, z = rows[:, i].T
                line = (
                    f"| {problem} | {measure} | {'given' if known else 'residuals'} | {count} | "
                    f"{name} | "
                    f"{100 * inside.mean():.1f} | {100 * mirrored.mean():.1f} | "
                    f"{z.mean():.2f} | {z.std():.2f} |"
                )
                lines.append(line)
                print(line, flush=True)
            results[f"{problem} {measure} {known}"] = rows.mean(axis=0).tolist()
    options.output.mkdir(exist_ok=True)
    (options.output / "coverage.json").write_text(json.dumps(results, indent=1) + "\n")
    (options.output / "coverage.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
