"""What a call from Python costs, and what the compiled library does not: counted as in calls.cpp.

    python calls.py MARKS       (MARKS is the compiled marks.cpp; counts.py runs this)

Sizes are small, since the work on long curves is counted there. A call is made several times
between two marks, so that a cache of Python's that grows now and then hardly shows, and what the
marks and the loop cost themselves is taken off.
"""

from __future__ import annotations

import ctypes
import gc
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

import curvewise

REPEATS = 20
NOTHING = "nothing"


def loop(n: int, size: float) -> Any:
    """Return a cycle of loading that no mathematical library has a part in."""
    t = np.arange(n) * 3.0 / n
    strain = np.where(t < 1.0, t, np.where(t < 2.0, 3.0 - 2.0 * t, 2.0 * t - 5.0))
    return size * np.column_stack([strain, strain - 0.3 * strain**3 + 0.01 * (np.arange(n) % 7)])


def calls() -> dict[str, Callable[[], object]]:
    """Return every public function of curves, by name and size."""
    found: dict[str, Callable[[], object]] = {}
    for n in (5, 10, 100, 1000):
        P, Q = loop(n, 1.0), loop(n - n // 10, 1.03)
        for name in ("area", "pcm", "frechet", "dtw", "curve_length", "frechet_continuous"):
            found[f"{name} {n}"] = partial(getattr(curvewise, name), P, Q)
    P, Q, R = loop(10, 1.0), loop(9, 1.03), loop(10, 1.02)
    for name in (
        "area_quads",
        "compare",
        "curve_length_residuals",
        "dtw_info",
        "dtw_path",
        "dtw_table",
        "frechet_continuous_path",
        "frechet_info",
        "frechet_path",
        "frechet_table",
        "pcm_match",
        "subsequence",
    ):
        found[f"{name} 10"] = partial(getattr(curvewise, name), P, Q)
    for name in ("mae", "mse", "sum_of_squares", "normalize"):
        found[f"{name} 10"] = partial(getattr(curvewise, name), P, R)
    rows, single = P.tolist(), P.astype(np.float32)
    curves = [loop(10, 1.0 + 0.1 * i) for i in range(5)]
    series = [loop(16, 1.0 + 0.1 * i)[:, 1].copy() for i in range(64)]
    options = {"metric": "cityblock", "step_pattern": "symmetric2", "window": 4}
    return found | {
        "frechet_within 10": partial(curvewise.frechet_within, P, Q, 0.1),
        "dtw 10 with options": partial(curvewise.dtw, P, Q, **options),
        "dtw 10 of lists": partial(curvewise.dtw, rows, rows),
        "dtw 10 of float32": partial(curvewise.dtw, single, single),
        "value_and_gradient 10": partial(curvewise.value_and_gradient, P, Q, "dtw"),
        "values_and_gradients 10": partial(curvewise.values_and_gradients, P[None], Q[None]),
        "soft_dtw 10": partial(curvewise.soft_dtw, P, Q),
        "hausdorff 10": partial(curvewise.hausdorff, P, Q),
        "msm 10": partial(curvewise.msm, P, Q),
        "Prepared dtw 10": partial(curvewise.Prepared(P, "dtw"), Q),
        "cdist dtw 5 x 5 of 10": partial(curvewise.cdist, curves, curves),
        "pdist dtw 5 of 10": partial(curvewise.pdist, curves),
        "pdist dtw 64 of 16": partial(curvewise.pdist, series, metric="sqeuclidean", window=1),
        "Index dtw 5 of 10": partial(curvewise.Index, curves, "dtw"),
        "kneighbors dtw 5 of 10": partial(curvewise.Index(curves, "dtw").kneighbors, [Q], 2),
        "dtw_mean 5 of 10": partial(curvewise.dtw_mean, curves),
    }


def main(marks: ctypes.PyDLL) -> None:
    """Make every call between two marks, `REPEATS` times, after some that are not counted."""
    gc.disable()  # it runs when it likes
    for name, call in {NOTHING: lambda: None, **calls()}.items():
        for _ in range(30):
            call()
        mark = name.encode()
        marks.counts_begin()
        for _ in range(REPEATS):
            call()
        marks.counts_end(mark)


if __name__ == "__main__":
    main(ctypes.PyDLL(sys.argv[1]))
