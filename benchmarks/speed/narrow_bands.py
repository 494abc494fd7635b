"""Short series and narrow bands: all pairs of many, per pair, beside aeon and dtaidistance.

    python benchmarks/speed/narrow_bands.py [--curves 64] [--rounds 7] [--points 16 24 ...]

The commonest call of time series classification: `pdist` of DTW (squared differences) in one
dimension, one thread, for each number of points and each window. Values are compared first, then
the packages are timed in turn. A package that is not installed is skipped.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import importlib
import importlib.util
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from timing import Array

import curvewise

POINTS = (16, 24, 32, 60, 64, 100, 128, 200)
SHARES = (0.0, 0.02, 0.05, 0.1)
TOLERANCE = 1e-9


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--curves", type=int, default=64)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--points", type=int, nargs="+", default=list(POINTS))
    arguments = parser.parse_args()
    print(f"curvewise {curvewise.__version__} at {timing.active_level()}; one thread")
    rows = []
    for n in timing.progress(arguments.points, "points"):
        series = np.random.default_rng(n).normal(size=(arguments.curves, n)).cumsum(axis=1)
        for window in windows(n):
            rows.append(measure(series, window, arguments.rounds))
            print("  ".join(rows[-1]), flush=True)
    header = [
        "points",
        "window",
        "curvewise µs",
        "aeon",
        "dtaidistance",
        "fastest peer / curvewise",
    ]
    timing.print_table(f"DTW of all pairs of {arguments.curves} series, per pair", header, rows)


def windows(n: int) -> list[int | None]:
    """Return the windows to time: from 0 to 10 %, and none."""
    return [
        *sorted({0, 1, 2, 3, *(round(share * n) for share in SHARES)} & {*range(n // 10 + 3)}),
        None,
    ]


def measure(series: Array, window: int | None, rounds: int) -> list[str]:
    """Return a row of the table: of each package, the microseconds of a pair."""
    calls = contenders(series, window)
    right = calls["curvewise"]()
    for name, call in calls.items():
        if not np.allclose(call(), right, rtol=TOLERANCE, atol=0.0):
            raise SystemExit(f"{name} has other values: {len(series[0])} points, window {window}")
    taken = timing.alternate({k: timing.sampler(c) for k, c in calls.items()}, lambda _: rounds)
    pairs = len(right)
    times = {name: found.seconds / pairs * 1e6 for name, found in taken.items()}
    own = times.pop("curvewise")
    ratio = f"{min(times.values()) / own:.2f}" if times else ""
    shown = [f"{times[k]:.3f}" if k in times else "" for k in ("aeon", "dtaidistance")]
    return [
        str(len(series[0])),
        "none" if window is None else str(window),
        f"{own:.3f}",
        *shown,
        ratio,
    ]


def contenders(series: Array, window: int | None) -> dict[str, Callable[[], Array]]:
    """Return the calls to time, each with the distances of all pairs in one order."""
    n = series.shape[1]
    curves = list(series)
    upper = np.triu_indices(len(series), 1)
    calls: dict[str, Callable[[], Array]] = {
        "curvewise": lambda: curvewise.pdist(
            curves, "dtw", metric="sqeuclidean", window=window, workers=1
        )
    }
    if importlib.util.find_spec("aeon"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            aeon: Any = importlib.import_module("aeon.distances")
        share = None if window is None else min(1.0, (window + 0.5) / n)
        stacked = series[:, None, :]
        calls["aeon"] = lambda: aeon.dtw_pairwise_distance(stacked, window=share)[upper]
    if importlib.util.find_spec("dtaidistance"):
        dtw: Any = importlib.import_module("dtaidistance.dtw")
        limit = None if window is None else window + 1
        calls["dtaidistance"] = lambda: (
            np.asarray(dtw.distance_matrix_fast(series, window=limit, compact=True, parallel=False))
            ** 2
        )
    return calls


if __name__ == "__main__":
    main()
