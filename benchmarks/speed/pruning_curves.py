"""The pairs of curves on which pruning is measured: real tests, and what resembles nothing.

The tests are those of CURVEWISE_DATA/loops, scaled by the first one's box and resampled along their
index.
"""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np
from timing import DATA, Array

import curvewise

LOOPS = (
    "dp780_tct_6pct",
    "eddq_tct_5pct",
    "tr1180_tct_3pct",
    "resslab_cyclic_2pct",
    "resslab_random_protocol",
)
MODERATE, WALKS, NOISE, MATERIALS = "moderate", "walks", "noise", "two materials"


def data_dir() -> Path:
    """Return the folder of the data."""
    if not (DATA / "loops").is_dir():
        raise SystemExit(f"no loops in {DATA}: set CURVEWISE_DATA to the folder that holds loops/")
    return DATA


@functools.cache
def read(file: Path) -> Array:
    """Read a curve, with or without a line of names."""
    has_names = (
        not file.read_text("utf-8").partition(",")[0].lstrip("-").startswith(tuple("0123456789"))
    )
    return np.loadtxt(file, delimiter=",", skiprows=int(has_names))


def loop(name: str) -> Array:
    """Return a test by its name."""
    return read(data_dir() / "loops" / f"{name}.csv")


def resampled(curve: Array, count: int) -> Array:
    """Take `count` points along the index, linearly between points."""
    index = np.linspace(0.0, len(curve) - 1.0, count)
    return np.column_stack([np.interp(index, np.arange(len(curve)), x) for x in curve.T])


def pair(curves: str, n: int) -> tuple[Array, Array]:
    """Make a pair: a loop's name for similar curves, or one of the other sorts."""
    random = np.random.Generator(np.random.PCG64(n))
    m = round(0.9 * n)
    if curves in (WALKS, NOISE):
        points = [random.normal(size=(count, 2)) for count in (n, m)]
        P, Q = (np.cumsum(p, axis=0) if curves == WALKS else p for p in points)
        return P, Q
    names = {
        MODERATE: ("dp780_tct_3pct", "dp780_tct_6pct"),
        MATERIALS: ("eddq_tct_5pct", "tr1180_tct_3pct"),
    }
    if curves in names:
        first, second = map(loop, names[curves])
        P, Q = curvewise.normalize(first, second)
        return resampled(P, n), resampled(Q, m)
    P, Q = curvewise.normalize(loop(curves), 1.03 * loop(curves))
    return resampled(P, n), resampled(Q, m) + random.normal(0.0, 0.001, (m, 2))
