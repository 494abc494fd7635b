"""Do the intervals hold what they promise? How many of 1,000 noise sets have the truth inside.

A parabola by the sum of squares, whose standard errors are held against those of lmfit; and a
hardening model of three parameters on a cycle by area (matched, which is the default, and split),
dtw and curve_length. Noise is normal. For the bootstrapped measures the basic interval that
`uncertainty` gives stands beside its mirror image about the optimum (the percentile interval),
which doubles a measure's bias.

    pip install ".[calibration,plot]" lmfit
    python benchmarks/validation/interval_coverage.py --sets 1000 --minutes 40

Writes coverage.json and coverage.md of the sets that are done. Every set is kept in --records as
soon as it is; started again, the script goes on where it was, and a script of other code needs
another folder. Area split, dtw and curve_length (1.2 s a set) take turns, so that they have as many
sets when time is up; area matched (2 s), and curve_length with the noise given and on a filtered
test, come after them.
"""

from __future__ import annotations

import argparse
import functools
import itertools
import json
import logging
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from material_points import THREE, THREE_BOUNDS, material_point, of_three, strain_path
from places import BUILD, RESULTS

from curvewise.calibration import Identification, TrustRegion, identify
from curvewise.curves import smooth

X = np.linspace(0.0, 1.0, 40)
STRAIN = strain_path(0.0, 0.02, -0.02, 0.02, points=30)
TURNS = (30, 60)


def parabola(p):
    return [np.column_stack((X, p["a"] + p["b"] * X + p["c"] * X**2))]


PROBLEMS: dict[str, tuple[Callable, dict, dict, float]] = {
    "parabola": (
        parabola,
        {"a": 1.0, "b": -2.0, "c": 3.0},
        {"a": (-10.0, 10.0), "b": (-20.0, 20.0), "c": (-20.0, 20.0)},
        0.1,
    ),
    "hardening": (
        material_point(of_three, STRAIN),
        THREE,
        THREE_BOUNDS,
        4.0,
    ),
}


class Case(NamedTuple):
    """What is counted: a problem, a measure with its options, and whether sigma is given."""

    problem: str
    measure: str
    options: tuple[tuple[str, str], ...]
    known: bool
    name: str  # of the measure with its options
    order: int  # cases of one order take turns, and the next ones begin when they are through
    window: int = 0  # of a filter on the test


SPLIT = (("spacing", "distance"), ("crossing", "split"))
CASES = (
    Case("parabola", "sum_of_squares", (), False, "sum_of_squares", 0),
    Case("parabola", "sum_of_squares", (), True, "sum_of_squares", 0),
    Case("hardening", "area", (), False, "area, matched", 2),
    Case("hardening", "area", SPLIT, False, "area, split", 1),
    Case("hardening", "dtw", (), False, "dtw", 1),
    Case("hardening", "curve_length", (), False, "curve_length", 1),
    Case("hardening", "curve_length", (), True, "curve_length", 3),
    Case("hardening", "curve_length", (), False, "curve_length, filtered test", 3, 7),
)


def noisy(problem: str, seed: int) -> np.ndarray:
    model, truth, _, sigma = PROBLEMS[problem]
    (curve,) = model(truth)
    curve[:, 1] += np.random.default_rng(seed).normal(0.0, sigma, len(curve))
    return curve


@functools.lru_cache(maxsize=1)  # cases that differ in `known` alone follow each other
def fitted(case: Case, seed: int) -> Identification:
    """Return what is identified from a noise set."""
    model, truth, bounds, _ = PROBLEMS[case.problem]
    test = noisy(case.problem, seed)
    if case.window:
        test = smooth(test, window=case.window, turns=TURNS)
    return identify(
        model,
        [test],
        bounds,
        measure=case.measure,
        method=TrustRegion(initial_range=0.1, gain=1e-5),
        start=truth,
        progress=False,
        **dict(case.options),
    )


def judged(case: Case, samples: int, seed: int) -> list[list[float]]:
    """Return for every parameter: interval and its mirror image hold the truth, and its z."""
    _, truth, _, sigma = PROBLEMS[case.problem]
    found = fitted(case._replace(known=False), seed)
    draws = 0 if case.measure == "sum_of_squares" else samples
    uncertainty = found.uncertainty(samples=draws, sigma=sigma if case.known else None)
    rows = []
    for name, value in truth.items():
        best = found.parameters[name]
        low, high = uncertainty.intervals[name]
        mirrored = 2 * best - high <= value <= 2 * best - low
        z = (best - value) / uncertainty.standard_errors[name]
        rows.append([float(low <= value <= high), float(mirrored), z])
    return rows


def counted(records: Path, sets: int, samples: int, minutes: float) -> list[list[Any]]:
    """Return the rows of every case and set; look up those that are in the folder of records."""
    records.mkdir(parents=True, exist_ok=True)
    files = [records / f"{i} {case.name}, {samples} samples.jsonl" for i, case in enumerate(CASES)]
    done = [[json.loads(line) for line in file.open()] if file.exists() else [] for file in files]
    turns = itertools.product(range(len(CASES)), range(sets))
    turns = sorted(turns, key=lambda pair: (CASES[pair[0]].order, pair[1]))
    for i, seed in turns:
        if seed < len(done[i]):
            continue
        if time.process_time() > 60.0 * minutes:
            break
        done[i].append(judged(CASES[i], samples, seed))
        with files[i].open("a") as lines:
            lines.write(json.dumps(done[i][-1]) + "\n")
    return done


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
            model, [test], bounds, measure="sum_of_squares", method="trust-region", progress=False
        ).uncertainty()
        for name, error in ours.standard_errors.items():
            differences.append(abs(error / theirs.params[name].stderr - 1.0))
    return {"largest": max(differences), "sets": 20}


def main() -> None:
    """Count, print, write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--sets", type=int, default=1000)
    parser.add_argument("--samples", type=int, default=200, help="of each bootstrap")
    parser.add_argument("--minutes", type=float, default=1e9, help="of CPU time, and no more")
    parser.add_argument("--records", type=Path, default=BUILD / "coverage")
    parser.add_argument("--output", type=Path, metavar="DIR", default=RESULTS)
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    results: dict = {"samples": options.samples, "lmfit": against_lmfit()}
    print("standard errors, largest difference from lmfit's:", results["lmfit"], flush=True)
    lines = [
        "| problem | measure | noise | sets | parameter | interval, % | mirrored, % | "
        "mean of z | deviation of z |",
        "|---|---|---|---:|---|---:|---:|---:|---:|",
    ]
    done = counted(options.records, options.sets, options.samples, options.minutes)
    for case, rows in zip(CASES, done, strict=True):
        if not rows:
            continue
        noise = "given" if case.known else "residuals"
        table = np.array(rows)
        for i, name in enumerate(PROBLEMS[case.problem][1]):
            inside, mirrored, z = table[:, i].T
            lines.append(
                f"| {case.problem} | {case.name} | {noise} | {len(rows)} | {name} | "
                f"{100 * inside.mean():.1f} | {100 * mirrored.mean():.1f} | "
                f"{z.mean():.2f} | {z.std():.2f} |"
            )
        key = f"{case.problem}, {case.name}, noise {noise}"
        results[key] = {"sets": len(rows), "means": table.mean(axis=0).tolist()}
    print("\n".join(lines))
    options.output.mkdir(exist_ok=True)
    (options.output / "coverage.json").write_text(json.dumps(results, indent=1) + "\n")
    (options.output / "coverage.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
