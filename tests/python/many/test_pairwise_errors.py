"""What cdist, pdist and Prepared refuse: by type and exact words, with the place in the list."""

from __future__ import annotations

import re
from functools import partial
from typing import get_args

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise import Index, Prepared, cdist, dtw_mean, medoid, pdist
from curvewise._options import Metric
from curvewise.measures.registry import MEASURES

GOOD = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]
POINT = [(1, 1), (1, 1)]
FRAME = pd.DataFrame({"x": [0.0, 1.0]})
STRESS = FRAME.rename(columns={"x": "stress"})
NO_LIST = (
    "XA has 2 array dimensions; give k curves as shape (k, n, d) or as a list: [XA] for a single "
    "curve, list(XA) for k curves with d = 1"
)
ALL_MEASURES = ", ".join(sorted(MEASURES))
VALUES = {
    "XA[1][1, 1] is nan; curves must be finite": lambda: cdist(
        [GOOD, [(0, 0), (1, np.nan)]], [GOOD]
    ),
    "XB[2][0, 0] is inf; curves must be finite": lambda: cdist([GOOD], [GOOD, GOOD, [(np.inf, 0)]]),
    "X[1][1] is -inf; curves must be finite": lambda: pdist([[1.0, 2.0], [1.0, -np.inf]]),
    "XA[0] has shape (3, 2) and XB[1] has shape (1, 3); "
    "both need the same number of coordinates": lambda: cdist([GOOD], [GOOD, [(0, 0, 0)]]),
    "X[0] has shape (3, 2) and X[1] has shape (2,); "
    "both need the same number of coordinates": lambda: pdist([GOOD, [1.0, 2.0]]),
    "X[1] has shape (0, 2); frechet needs at least 1 point": lambda: pdist(
        [GOOD, np.zeros((0, 2))], "frechet"
    ),
    "XB[1] has shape (1, 2); area needs at least 2 points": lambda: cdist(
        [GOOD], [GOOD, GOOD[:1]], "area"
    ),
    "XA[0] has shape (2, 3); pcm needs 2 coordinates, x and y": lambda: cdist(
        [[(0, 0, 0), (1, 1, 1)]], measure="pcm"
    ),
    "XA[1] has zero length (all its points are equal); pcm needs two different points": lambda: (
        cdist([GOOD, POINT], [GOOD], "pcm")
    ),
    "XB[1] has zero length (all its points are equal); pcm needs two different points": lambda: (
        cdist([GOOD], [GOOD, POINT], "pcm")
    ),
    "XB[0] has zero length (all its points are equal); "
    "curve_length needs two different points": lambda: cdist([GOOD], [POINT], "curve_length"),
    "the mean of XA[1]'s x is 0 to rounding; use scale='mean_abs' or scale='range'": lambda: cdist(
        [GOOD, [(-1, 1), (1, 1)]], [GOOD], "curve_length"
    ),
    "window=0 admits no path between 3 and 2 points; use at least 1": lambda: cdist(
        [GOOD], [GOOD[:2]], window=0
    ),
    f"unknown metric 'manhattan'; choose from {', '.join(get_args(Metric))}"
    "; did you mean 'cityblock'?": lambda: cdist([GOOD], metric="manhattan"),
    "'euclidean' is a ground distance, between points; the measure is of curves, one of "
    f"{ALL_MEASURES}: use measure='dtw', metric='euclidean' for example": lambda: cdist(
        [GOOD], [GOOD], "euclidean"
    ),
    "'dtw' is a measure, of curves; the metric is the ground distance between their points, "
    f"one of {', '.join(get_args(Metric))}: use measure='dtw'": lambda: cdist(
        [GOOD], [GOOD], metric="dtw"
    ),
    f"unknown measure 'no_such'; choose from {ALL_MEASURES}": lambda: cdist(
        [GOOD], measure="no_such"
    ),
    f"unknown measure 'dwt'; choose from {ALL_MEASURES}; did you mean 'dtw'?": lambda: Index(
        [GOOD], "dwt"
    ),
    "pdist needs a symmetric measure, and 'curve_length', scale='range' is not: use cdist, "
    "which computes both directions": lambda: pdist([GOOD], "curve_length", scale="range"),
    "workers is 0; give a whole number >= 1, or -1 for all cores": lambda: cdist([GOOD], workers=0),
    "cutoff is -1.0; give a number >= 0, or None": lambda: cdist([GOOD], cutoff=-1.0),
    "cutoff is '1'; give a number >= 0, or None": lambda: pdist([GOOD], cutoff="1"),
    "cutoff is 1j; give a number >= 0, or None": lambda: cdist([GOOD], [GOOD], cutoff=1j),
    "cutoff is nan; give a number >= 0, or None": lambda: cdist([GOOD], cutoff=np.nan),
    NO_LIST: lambda: cdist(np.zeros((4, 2))),
    "X[0] has columns ['x'] and X[1] has columns ['stress']; name and order them alike": lambda: (
        pdist([FRAME, STRESS])
    ),
    "XA[0] has columns ['x'] and XB[0] has columns ['stress']; name and order them alike": lambda: (
        cdist([FRAME], [STRESS])
    ),
    "out has shape (2, 2); cdist of these curves needs (1, 1)": lambda: cdist(
        [GOOD], out=np.empty((2, 2))
    ),
    "out has dtype <f4; pdist needs float64": lambda: pdist(
        [GOOD, GOOD], out=np.empty(1, dtype=np.float32)
    ),
    "out must be C-contiguous, aligned and writeable; cdist fills it": lambda: cdist(
        [GOOD, GOOD], out=np.empty((2, 2), order="F")
    ),
    "P[0, 1] is nan; curves must be finite": lambda: Prepared([(0.0, np.nan)]),
    "P has shape (3, 2) and Q has shape (1, 3); both need the same number of coordinates": lambda: (
        Prepared(GOOD, "dtw")([(0.0, 1.0, 2.0)])
    ),
    "Q[1] has shape (1, 2); area needs at least 2 points": lambda: Prepared(GOOD, "area")(
        [GOOD, GOOD[:1]]
    ),
    "the mean of P's x is 0 to rounding; use scale='mean_abs' or scale='range'": lambda: Prepared(
        [(-1, 1), (1, 1)], "curve_length"
    ),
    "unknown measure <function": lambda: Prepared(GOOD, lambda P, Q: 0.0),
}
TYPES = {
    "frechet has no option 'window'; it has metric, p, radius, prune": lambda: cdist(
        [GOOD], measure="frechet", window=3
    ),
    "frechet has no option 'n_jobs'; it has metric, p, radius, prune; did you mean 'workers'?": (
        lambda: pdist([GOOD], "frechet", n_jobs=2)
    ),
    "frechet_continuous has no option 'prune'; it has none": lambda: cdist(
        [GOOD], measure="frechet_continuous", prune=False
    ),
    **{
        f"{name} has closed=True for one pair, in curvewise.cdist and curvewise.pdist; for nearest "
        f"curves, sort the rows of cdist(queries, curves, {name!r}, closed=True)": partial(
            Index, [GOOD], name, closed=True
        )
        for name in ("dtw", "frechet", "frechet_continuous")
    },
    "workers is an option of the calls that compute; give it to them": lambda: Index(
        [GOOD], workers=2
    ),
    "edr has no option 'epsilo'; it has metric, p, radius, epsilon, window; did you mean "
    "'epsilon'?": lambda: Prepared(GOOD, "edr", epsilo=1),
    "XA[1] is None; give a curve": lambda: cdist([GOOD, None]),
    "XA is of type str; give a list of curves": lambda: cdist("curves.csv"),
    "XA is of type int; give a list of curves": lambda: cdist(3),
    "XB[0] is complex; a curve is real: give real and imaginary as columns": lambda: cdist(
        [GOOD], [[1j, 2j]]
    ),
    "out is of type list; give a numpy array": lambda: cdist([GOOD], out=[[0.0]]),
}


@pytest.mark.parametrize(
    ("message", "call", "error"),
    [
        *((*case, ValueError) for case in VALUES.items()),
        *((*case, TypeError) for case in TYPES.items()),
    ],
)
def test_errors(message, call, error):
    with pytest.raises(error) as caught:
        call()
    text = str(caught.value)
    assert text.startswith(message) if message.endswith("<function") else text == message


@pytest.mark.parametrize(
    ("call", "advice"),
    [
        (
            lambda: Prepared(GOOD, dependent=False),
            "prune; dtw, and cdist and pdist of dtw, have it; else add dtw(P[:, c], Q[:, c]) over "
            "all c",
        ),
        (
            lambda: Prepared(GOOD, "frechet", weights=[1.0, 2.0]),
            "; multiply the coordinates: P * w and Q * w, with the roots of weights of squares",
        ),
        (
            lambda: pdist([GOOD], "twe", time_stamps=[0, 1]),
            "; points are one unit of time apart",
        ),
        (lambda: pdist([GOOD], "dtw", step_pattern="itakura"), "; did you mean 'typeIIIc'?"),
        (
            lambda: curvewise.wddtw,
            "'wddtw'; write wdtw(derivative(P), derivative(Q)), with curvewise.curves.derivative",
        ),
        (
            lambda: Index([GOOD], lambda P, Q: 0.0),
            "np.argsort(curvewise.cdist(queries, curves, ...), axis=1, kind='stable')[:, :k], or "
            "give an estimator of curvewise.sklearn a function of two curves as its measure",
        ),
        (
            lambda: Index([GOOD], metric=lambda p, q: np.abs(p[:, :1] - q[:, 0])),
            "np.argsort(curvewise.cdist(queries, curves, ...), axis=1, kind='stable')[:, :k], or "
            "give an estimator of curvewise.sklearn a function of two curves as its measure",
        ),
    ],
)
def test_what_other_packages_have_names_the_way_that_works(call, advice):
    with pytest.raises((AttributeError, TypeError, ValueError)) as caught:
        call()
    assert str(caught.value).endswith(advice)


def test_a_frame_is_no_list_of_curves():
    said = NO_LIST.replace("list(XA)", "dict(XA.items())")
    with pytest.raises(ValueError, match=f"^{re.escape(said)}$"):
        cdist(FRAME.assign(y=[0.0, 1.0]))


def test_a_matrix_that_is_too_large_says_what_to_do(monkeypatch):
    def refuse(shape):
        raise MemoryError("Unable to allocate")

    curves = [[0.0]] * 3000
    monkeypatch.setattr("curvewise.many.pairwise.np.empty", refuse)
    message = (
        r"^pdist of these curves returns 0 GB, .* curvewise\.dask\.pdist with store='distances"
    )
    with pytest.raises(MemoryError, match=message):
        pdist(curves)
    with pytest.raises(MemoryError, match=r"^cdist of these .* curvewise\.dask\.cdist with"):
        cdist(curves)


class Degrees:
    is_geographic, name = True, "WGS 84"


def test_degrees_are_not_taken_for_a_plane():
    class Tracks(pd.Series):
        crs = Degrees()

    tracks = Tracks([np.zeros((3, 2)), np.ones((3, 2))])
    for call in (pdist, cdist, Index, medoid, dtw_mean):
        with pytest.raises(ValueError, match=r"^\w+ is in degrees \(WGS 84\), .* metric='hav"):
            call(tracks)


def test_out_of_a_read_only_array():
    out = np.empty((1, 1))
    out.flags.writeable = False
    with pytest.raises(ValueError, match="out must be C-contiguous, aligned and writeable"):
        cdist([GOOD], out=out)


@pytest.mark.parametrize(
    ("measure", "advice"),
    [
        ("soft_dtw", "measure=curvewise.soft_dtw"),
        ("sbd", "measure=curvewise.sbd"),
        ("lb_keogh", "measure=curvewise.lb_keogh"),
        ("wddtw", "curvewise.curves.derivative.* and measure='wdtw'"),
    ],
)
def test_what_is_not_a_measure_by_its_name_says_what_works(measure, advice):
    curves = [[0.0, 1.0, 3.0], [1.0, 2.0]]
    for call in (cdist, pdist, Index):
        with pytest.raises(
            ValueError, match=f"'{measure}' is not a measure by its name: .*{advice}"
        ):
            call(curves, measure=measure)
