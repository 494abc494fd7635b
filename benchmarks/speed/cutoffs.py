"""Time `pdist` with a cutoff in relation to `pdist` without one.

    python benchmarks/speed/cutoffs.py [--curves 200] [--rounds 5] [--points 16 32 ...]

The cutoff is a quantile of the distances. The curves are z-normalised random walks, smooth sums of
sines with noise, and white noise, whose pairs have no useful bounds. One thread; processor time of
alternating samples. Values are compared first. Writes cutoffs.md.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from timing import RESULTS, Array

import curvewise

POINTS = (16, 32, 64, 100, 200, 500, 1000)
QUANTILES = (0.01, 0.1, 0.5)
MOST_CELLS = 6e8  # of the tables of all pairs; longer curves are fewer


def main() -> None:
    """Measure, print and write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--curves", type=int, default=200)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--points", type=int, nargs="+", default=list(POINTS))
    parser.add_argument("--output", type=Path, default=RESULTS)
    arguments = parser.parse_args()
    header = ["measure", "d", "points", "window", *columns()]
    lines = [f"# Time without a cutoff / time with it, `{timing.active_level()}`", ""]
    lines += [f"| {' | '.join(header)} |", "|---" * len(header) + "|"]
    for measure, dim, window in settings():
        for n in timing.progress(arguments.points, f"{measure}, {dim}-D, {window or 'no window'}"):
            names = [measure, str(dim), str(n), window_name(window)]
            row = [*names, *ratios(measure, dim, n, window, arguments)]
            lines.append(f"| {' | '.join(row)} |")
            print(lines[-1], flush=True)
    (arguments.output / "cutoffs.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def settings() -> list[tuple[str, int, float | None]]:
    """Return the measures, dimensions and windows."""
    of_dtw = [("dtw", dim, window) for dim in (1, 2) for window in (0.05, 0.1, None)]
    return [*of_dtw, ("frechet", 1, None), ("frechet", 2, None)]


def window_name(window: float | None) -> str:
    """Return what the table shows."""
    return "none" if window is None else f"{window:.0%}"


def columns() -> list[str]:
    """Return the names of the columns of ratios."""
    return [f"{kind} {quantile:.0%}" for kind in CURVES for quantile in QUANTILES]


def walks(random: np.random.Generator, shape: tuple[int, int, int]) -> Array:
    """Return z-normalised random walks."""
    found = random.normal(size=shape).cumsum(axis=1)
    return (found - found.mean(axis=1, keepdims=True)) / found.std(axis=1, keepdims=True)


def smooth(random: np.random.Generator, shape: tuple[int, int, int]) -> Array:
    """Return sums of three sines of random phases and sizes, with a little noise."""
    count, n, dim = shape
    found = random.normal(scale=0.05, size=shape)
    for k in (1, 2, 3):
        phase = random.normal(size=(count, 1, dim))
        size = random.normal(1.0, 0.3, size=(count, 1, dim)) / k
        found += size * np.sin(2.0 * np.pi * k * np.linspace(0.0, 1.0, n)[:, None] + phase)
    return found


def noise(random: np.random.Generator, shape: tuple[int, int, int]) -> Array:
    """Return white noise."""
    return random.normal(size=shape)


CURVES = {"walks": walks, "smooth": smooth, "noise": noise}


def ratios(
    measure: str, dim: int, n: int, window: float | None, arguments: argparse.Namespace
) -> list[str]:
    """Return the ratios of a row, one for each kind of curves and each quantile."""
    count = min(arguments.curves, max(16, int((2.0 * MOST_CELLS / n**2) ** 0.5)))
    options: dict[str, Any] = {"metric": "sqeuclidean"} if measure == "dtw" else {}
    if window is not None:
        options["window"] = max(1, round(window * n))
    found = []
    for make in CURVES.values():
        curves = list(make(np.random.default_rng([n, dim]), (count, n, dim)))
        values = curvewise.pdist(curves, measure, **options)
        calls: dict[float | None, Callable[[], Array]] = {}
        for quantile in (None, *QUANTILES):
            cutoff = None if quantile is None else float(np.quantile(values, quantile))
            calls[quantile] = partial(curvewise.pdist, curves, measure, cutoff=cutoff, **options)
            expected = values if cutoff is None else np.where(values > cutoff, np.inf, values)
            if not np.array_equal(calls[quantile](), expected):
                raise SystemExit(f"other values: {measure}, {n} points, cutoff {cutoff}")
        taken = dict.fromkeys(calls, np.inf)
        for _ in range(arguments.rounds):
            for quantile, call in calls.items():
                taken[quantile] = min(taken[quantile], seconds(call))
        found += [f"{taken[None] / taken[quantile]:.2f}" for quantile in QUANTILES]
    return found


def seconds(call: Callable[[], Array]) -> float:
    """Return the processor time of a call."""
    start = time.process_time()
    call()
    return time.process_time() - start


if __name__ == "__main__":
    main()
