"""What cdist, pdist and Prepared refuse: by type and exact words, with the place in the list."""

from __future__ import annotations

from collections.abc import Callable
from typing import get_args

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise._options import Metric

GOOD = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]
BAD: list[tuple[Callable[[], object], type[Exception], str]] = [
    (
        lambda: curvewise.cdist([GOOD, [(0, 0), (1, np.nan)]], [GOOD]),
        ValueError,
        "XA[1][1, 1] is nan; curves must be finite",
    ),
    (
        lambda: curvewise.cdist([GOOD], [GOOD, GOOD, [(np.inf, 0)]]),
        ValueError,
        "XB[2][0, 0] is inf; curves must be finite",
    ),
    (
        lambda: curvewise.pdist([[1.0, 2.0], [1.0, -np.inf]]),
        ValueError,
        "X[1][1] is -inf; curves must be finite",
    ),
    (
        lambda: curvewise.cdist([GOOD], [GOOD, [(0, 0, 0)]]),
        ValueError,
        "XA[0] has shape (3, 2) and XB[1] has shape (1, 3); "
        "both need the same number of coordinates",
    ),
    (
        lambda: curvewise.pdist([GOOD, [1.0, 2.0]]),
        ValueError,
        "X[0] has shape (3, 2) and X[1] has shape (2,); both need the same number of coordinates",
    ),
    (
        lambda: curvewise.pdist([GOOD, np.zeros((0, 2))], "frechet"),
        ValueError,
        "X[1] has shape (0, 2); frechet needs at least 1 point",
    ),
    (
        lambda: curvewise.cdist([GOOD], [GOOD, GOOD[:1]], "area"),
        ValueError,
        "XB[1] has shape (1, 2); area needs at least 2 points",
    ),
    (
        lambda: curvewise.cdist([[(0, 0, 0), (1, 1, 1)]], measure="pcm"),
        ValueError,
        "XA[0] has shape (2, 3); pcm needs 2 coordinates, x and y",
    ),
    (
        lambda: curvewise.cdist([GOOD, [(1, 1), (1, 1)]], [GOOD], "pcm"),
        ValueError,
        "XA[1] has zero length (all its points are equal); pcm needs two different points",
    ),
    (
        lambda: curvewise.cdist([GOOD], [GOOD, [(1, 1), (1, 1)]], "pcm"),
        ValueError,
        "XB[1] has zero length (all its points are equal); pcm needs two different points",
    ),
    (
        lambda: curvewise.cdist([GOOD], [[(1, 1), (1, 1)]], "curve_length"),
        ValueError,
        "XB[0] has zero length (all its points are equal); curve_length needs two different points",
    ),
    (
        lambda: curvewise.cdist([GOOD, [(-1, 1), (1, 1)]], [GOOD], "curve_length"),
        ValueError,
        "the mean of XA[1]'s x is 0 to rounding; use scale='mean_abs' or scale='range'",
    ),
    (
        lambda: curvewise.cdist([GOOD], [GOOD[:2]], window=0),
        ValueError,
        "window=0 admits no path between 3 and 2 points; use at least 1",
    ),
    (
        lambda: curvewise.cdist([GOOD], metric="manhattan"),
        ValueError,
        f"unknown metric 'manhattan'; choose from {', '.join(get_args(Metric))}",
    ),
    (
        lambda: curvewise.cdist([GOOD], [GOOD], "euclidean"),
        ValueError,
        "'euclidean' is a ground distance, between points; the measure is of curves, one of area, "
        "curve_length, dtw, frechet, frechet_continuous, pcm: use measure='dtw', "
        "metric='euclidean' for example",
    ),
    (
        lambda: curvewise.cdist([GOOD], [GOOD], metric="dtw"),
        ValueError,
        "'dtw' is a measure, of curves; the metric is the ground distance between their points, "
        f"one of {', '.join(get_args(Metric))}: use measure='dtw'",
    ),
    (
        lambda: curvewise.cdist([GOOD], measure="no_such"),
        ValueError,
        "unknown measure 'no_such'; choose from area, curve_length, dtw, frechet, "
        "frechet_continuous, pcm",
    ),
    (
        lambda: curvewise.cdist([GOOD], measure="frechet", window=3),
        TypeError,
        "frechet has no option 'window'; it has metric, p, prune",
    ),
    (
        lambda: curvewise.pdist([GOOD], "curve_length", scale="range"),
        ValueError,
        "pdist needs a symmetric measure, and 'curve_length', scale='range' is not: use cdist, "
        "which computes both directions",
    ),
    (
        lambda: curvewise.cdist([GOOD], workers=0),
        ValueError,
        "workers is 0; give a whole number >= 1, or -1 for all cores",
    ),
    (
        lambda: curvewise.cdist([GOOD], cutoff=-1.0),
        ValueError,
        "cutoff is -1.0; give a number >= 0, or None",
    ),
    (
        lambda: curvewise.cdist([GOOD], cutoff=np.nan),
        ValueError,
        "cutoff is nan; give a number >= 0, or None",
    ),
    (
        lambda: curvewise.cdist(np.zeros((4, 2))),
        ValueError,
        "XA has 2 array dimensions; give k curves as shape (k, n, d) or as a list: [XA] for a "
        "single curve, list(XA) for k curves with d = 1",
    ),
    (
        lambda: curvewise.cdist(pd.DataFrame({"x": [0.0, 1.0], "y": [0.0, 1.0]})),
        ValueError,
        "XA has 2 array dimensions; give k curves as shape (k, n, d) or as a list: [XA] for a "
        "single curve, list(XA) for k curves with d = 1",
    ),
    (
        lambda: curvewise.cdist("curves.csv"),
        TypeError,
        "XA is of type str; give a list of curves",
    ),
    (lambda: curvewise.cdist(3), TypeError, "XA is of type int; give a list of curves"),
    (
        lambda: curvewise.cdist([GOOD], [[1j, 2j]]),
        TypeError,
        "XB[0] is complex; a curve is real: give real and imaginary as columns",
    ),
    (
        lambda: curvewise.pdist(
            [pd.DataFrame({"x": [0.0, 1.0]}), pd.DataFrame({"stress": [0.0, 1.0]})]
        ),
        ValueError,
        "X[0] has columns ['x'] and X[1] has columns ['stress']; name and order them alike",
    ),
    (
        lambda: curvewise.cdist(
            [pd.DataFrame({"x": [0.0, 1.0]})], [pd.DataFrame({"stress": [0.0, 1.0]})]
        ),
        ValueError,
        "XA[0] has columns ['x'] and XB[0] has columns ['stress']; name and order them alike",
    ),
    (
        lambda: curvewise.cdist([GOOD], out=[[0.0]]),
        TypeError,
        "out is of type list; give a numpy array",
    ),
    (
        lambda: curvewise.cdist([GOOD], out=np.empty((2, 2))),
        ValueError,
        "out has shape (2, 2); cdist of these curves needs (1, 1)",
    ),
    (
        lambda: curvewise.pdist([GOOD, GOOD], out=np.empty(1, dtype=np.float32)),
        ValueError,
        "out has dtype <f4; pdist needs float64",
    ),
    (
        lambda: curvewise.cdist([GOOD, GOOD], out=np.empty((2, 2), order="F")),
        ValueError,
        "out must be C-contiguous, aligned and writeable; cdist fills it",
    ),
    (
        lambda: curvewise.Prepared([(0.0, np.nan)]),
        ValueError,
        "P[0, 1] is nan; curves must be finite",
    ),
    (
        lambda: curvewise.Prepared(GOOD, "dtw")([(0.0, 1.0, 2.0)]),
        ValueError,
        "P has shape (3, 2) and Q has shape (1, 3); both need the same number of coordinates",
    ),
    (
        lambda: curvewise.Prepared(GOOD, "area")([GOOD, GOOD[:1]]),
        ValueError,
        "Q[1] has shape (1, 2); area needs at least 2 points",
    ),
    (
        lambda: curvewise.Prepared([(-1, 1), (1, 1)], "curve_length"),
        ValueError,
        "the mean of P's x is 0 to rounding; use scale='mean_abs' or scale='range'",
    ),
    (
        lambda: curvewise.Prepared(GOOD, lambda P, Q: 0.0),
        ValueError,
        "unknown measure <function",
    ),
]


@pytest.mark.parametrize(("call", "error", "message"), BAD)
def test_errors(call, error, message):
    with pytest.raises(error) as caught:
        call()
    text = str(caught.value)
    assert text.startswith(message) if message.endswith("<function") else text == message


def test_out_of_a_read_only_array():
    out = np.empty((1, 1))
    out.flags.writeable = False
    with pytest.raises(ValueError, match="out must be C-contiguous, aligned and writeable"):
        curvewise.cdist([GOOD], out=out)
