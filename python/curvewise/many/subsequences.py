"""Occurrences of a short curve in a long one, by subsequence DTW or Fréchet.

Müller, "Information Retrieval for Music and Motion" (2007), chapter 7, for curves of any dimension
and for several answers that do not overlap. The work is done by the compiled library.
"""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from typing import Any, SupportsFloat, SupportsIndex, get_args

import numpy as np

from .._core import dtw_subsequences, frechet_subsequences
from .._options import (
    Default,
    Metric,
    Order,
    Radius,
    WarpingName,
    Window,
    check_choice,
    real_number,
    whole_number,
    window_radius,
)
from ..curves.checks import check_finite
from ..curves.ground_distance import check_metric
from ..curves.inputs import Array, CurveLike, as_curves, in_columns
from ..curves.layouts import ask_about_curves, settled_layout
from ..curves.z_normalization import z_normalized
from ..measures.registry import WARPINGS
from ..measures.results import Subsequence
from .normalized_runs import NormalizedRuns
from .run_bounds import run_bounds

__all__ = ["subsequence"]

_CUTOFF_ADVICE = "give a number >= 0, or None"


# Shared text: measure(warpings), metric, workers, invalid
def subsequence(
    P: CurveLike,
    Q: CurveLike,
    *,
    k: SupportsIndex = 1,
    measure: WarpingName = "dtw",
    metric: Metric = Default.metric,
    p: Order = Default.p,
    radius: Radius = Default.radius,
    cutoff: SupportsFloat | None = Default.cutoff,
    path: bool = False,
    normalize: bool = False,
    window: Window = None,
    workers: SupportsIndex = Default.workers,
) -> list[Subsequence]:
    """Find the subsequences of Q that are most similar to P.

    The first answer is the best of all sections of consecutive points of Q: the result of ``dtw(P,
    Q, open_begin=True, open_end=True)``. Each later one is the best section of the rest, where
    every remaining part of Q is searched separately. The answers therefore do not overlap, and
    their distances never fall. Of equal distances the section that ends first is the better.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The query, e.g. a cycle, and the curve to search, e.g. a long record; of any d.
    k : int >= 1
        Maximum number of answers.
    measure : str
        The measure: "dtw", "frechet". dtw uses the step pattern "symmetric1", and a window only
        with `normalize`.
    metric : str
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.
    cutoff : float >= 0, optional
        Upper limit of the answers' distances.
    path : bool
        Whether to return the answers with their paths.
    normalize : bool
        Whether to find sections that differ by a shift and a scale, too. Every section then has the
        length of P, and both are compared after :func:`curvewise.curves.z_normalized`.
    window : int >= 0 or 0 < float < 1, optional
        With `normalize` and dtw, the half-width of the Sakoe-Chiba band; 0 compares point by point.
        A fraction is one of the length of P, rounded down. Unlimited by default.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.

    Returns
    -------
    list of Subsequence
        The best first; fewer than `k` if Q is exhausted, or the cutoff excludes the rest.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, or an option is unknown or out of
        range.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Exact. The table is filled once, in O(n m) time, together with the start in Q of every path.
    After each answer, only the ends behind it whose paths began before its end are computed again.
    Memory O(n + m). A path takes that of dtw_path, or frechet_path, for its section.

    With `normalize`, the search of Rakthanmanon et al. ("Searching and mining trillions of time
    series subsequences under dynamic time warping", 2012). Every window gets a lower bound in O(n)
    by the envelope of P, and only windows whose bound is at most the best distance are computed.
    Mean and deviation are computed from the window's numbers, in two passes. A coordinate that is
    constant in a window is normalised to 0. Memory O(m).

    Examples
    --------
    >>> import curvewise
    >>> record = [0, 0, 1, 2, 1, 0, 0, 1, 2.5, 1, 0]
    >>> for found in curvewise.subsequence([1, 2, 1], record, k=2):
    ...     print(found.distance, found.start, found.stop)
    0.0 2 4
    0.5 7 9
    """
    try:
        P, Q = as_curves(P, Q)
    except ValueError:
        _check_one(P)
        raise
    ask_about_curves(P, Q)
    count = min(whole_number("k", k, 1, "give a whole number >= 1"), sys.maxsize)
    check_choice("measure", measure, get_args(WarpingName))
    ground: dict[str, Any] = {"metric": metric, "p": p, "radius": radius}
    if normalize:
        with settled_layout():
            return _normalized(P, Q, count, measure, ground, window, cutoff, path, workers)
    if window is not None:
        raise ValueError("window needs normalize=True: other runs have no length of their own")
    find = dtw_subsequences if measure == "dtw" else frechet_subsequences
    how = {**ground, "workers": workers, "cutoff": cutoff}
    answers = [Subsequence(*answer) for answer in find(P, Q, count, how)]
    if not path:
        return answers
    runs = ((answer, Q[answer.start : answer.stop + 1]) for answer in answers)
    with settled_layout():
        return [_with_path(P, run, measure, ground, answer) for answer, run in runs]


def _check_one(P: Any) -> None:
    """Refuse a list of queries, and show the call that searches for each."""
    first = P[0] if isinstance(P, list | tuple) and len(P) > 0 else None
    if getattr(P, "ndim", 0) == 3 or getattr(first, "ndim", 0) == 2:
        raise ValueError(
            "P is a list of curves; a search is for one of them: "
            "[curvewise.subsequence(query, Q) for query in P]"
        )


def _with_path(
    P: Array, run: Array, measure: WarpingName, options: dict[str, Any], answer: Subsequence
) -> Subsequence:
    """Return an answer with its path, which begins and ends with the run."""
    alignment = WARPINGS[measure].path(P, run, **options)
    return replace(answer, path=alignment.path + np.array([0, answer.start]))


def _normalized(
    P: Array,
    Q: Array,
    count: int,
    measure: WarpingName,
    options: dict[str, Any],
    window: Any,
    cutoff: Any,
    path: bool,
    workers: Any,
) -> list[Subsequence]:
    """Return the answers of runs that are normalised."""
    metric, order = check_metric(**options)
    if metric == "haversine":
        raise ValueError("normalize needs coordinates to scale; metric='haversine' has none")
    if window is not None:
        if measure != "dtw":
            raise ValueError("window needs measure='dtw'")
        window = window_radius(window, len(P), len(P))
        options = {**options, "window": window}
    WARPINGS[measure].path(P[:1], Q[:1])  # what both refuse: shapes, and curves without points
    limit = math.inf if cutoff is None else real_number("cutoff", cutoff, 0.0, _CUTOFF_ADVICE)
    P, columns = z_normalized(P), in_columns(Q)
    check_finite(Q, "Q")
    rows, n = in_columns(P), len(P)
    bounds = run_bounds(rows, columns, measure, metric, order, window)
    runs = NormalizedRuns(rows, columns, bounds, measure, options, workers)
    answers = [Subsequence(*found, found[1] + n - 1) for found in runs.best(count, limit)]
    if not path:
        return answers
    windows = ((answer, z_normalized(Q[answer.start : answer.stop + 1])) for answer in answers)
    return [_with_path(P, run, measure, options, answer) for answer, run in windows]
