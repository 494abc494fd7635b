"""Lower bounds of dtw, by the names and definitions of their papers.

A point of P is matched to some points of Q only. The box around these is its envelope, and its
distance from the envelope is a lower bound of each of its pairs (Keogh & Ratanamahatana 2005). All
envelopes are computed together: a section of points is covered by two blocks whose numbers of
points are powers of two. Rounding is monotone, so no sum over the points of P exceeds the table's.
"""

from __future__ import annotations

from typing import get_args

import numpy as np
import numpy.typing as npt

from .._options import BoundMetric, Window, check_choice, window_radius
from ..curves.ground_distance import ground_distances, in_range
from ..curves.inputs import Array, CurveLike
from ..curves.pairs import checked_pair
from ..curves.scaling import times_power_of_two

__all__ = ["lb_improved", "lb_keogh", "lb_kim"]


def lb_keogh(
    P: CurveLike, Q: CurveLike, *, metric: BoundMetric = "euclidean", window: Window = None
) -> float:
    """Compute LB_Keogh, a lower bound of dtw: how far P is outside the envelope of Q.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d. They cannot be exchanged: ``lb_keogh(Q, P)`` is another bound.
    metric : {"euclidean", "sqeuclidean", "cityblock", "chebyshev"}
        The ground distance of dtw.
    window : int >= 0 or 0 < float < 1, optional
        The window of dtw; None, without a window, has a weaker bound.

    Returns
    -------
    float
        At least 0, and at most ``dtw(P, Q, metric=metric, window=window)``, also after rounding.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, or the curves differ in d. If an option is unknown or out
        of range. If no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    See Also
    --------
    lb_improved : A larger bound, which takes twice the time.
    lb_kim : A bound from four features.
    curvewise.Index : Nearest curves, found by such bounds.
    curvewise.cdist : Distances up to a cutoff, which uses such bounds.

    Notes
    -----
    The sum of the distances of P's points from their boxes. The box of a point is the smallest that
    contains the points of Q in its window. In one dimension and with "sqeuclidean", the square of
    the paper's bound. A penalty and the step pattern "symmetric2" raise dtw, so the bound is also
    one of these. Time and memory O(n d + m d log m).

    Computed in numpy, for studies of bounds. Below about 3,000 points, a call takes longer than
    :func:`dtw`. To skip pairs, use the compiled bounds: a cutoff of :func:`cdist` or
    :class:`Prepared`, or :class:`Index`.

    Keogh & Ratanamahatana, "Exact indexing of dynamic time warping", Knowledge and Information
    Systems (2005).

    Examples
    --------
    >>> import curvewise
    >>> P, Q = [0, 1, 5, 1], [0, 2, 3, 2]
    >>> curvewise.lb_keogh(P, Q, window=1)
    3.0
    >>> curvewise.dtw(P, Q, window=1)
    4.0
    """
    check_choice("metric", metric, get_args(BoundMetric))
    first, second = checked_pair(P, Q, "lb_keogh")
    first, second, exponent = in_range(first, second, metric)
    nearest = _projection(first, second, window)
    return _restored(_sum(ground_distances(first, nearest, metric, 2.0)), exponent)


def lb_improved(
    P: CurveLike, Q: CurveLike, *, metric: BoundMetric = "euclidean", window: Window = None
) -> float:
    """Compute LB_Improved, a lower bound of dtw that is at least LB_Keogh.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves. They cannot be exchanged.
    metric : {"euclidean", "sqeuclidean", "cityblock", "chebyshev"}
        The ground distance of dtw: any in one dimension, "sqeuclidean" or "cityblock" in several.
    window : int >= 0 or 0 < float < 1, optional
        The window of dtw.

    Returns
    -------
    float
        At most ``dtw(P, Q, metric=metric, window=window)``, also after rounding.

    Raises
    ------
    ValueError
        As for :func:`lb_keogh`. If the curves have several coordinates, for other metrics.
    TypeError
        If a curve does not hold real numbers.

    See Also
    --------
    lb_keogh : The first of its two terms.

    Notes
    -----
    LB_Keogh of P and Q, plus LB_Keogh of Q and H. H is P, with each point moved to the nearest of
    its box around points of Q. A matched pair costs at least the way from P to H plus that from H
    to Q. Sums of coordinates have this property, and "euclidean" of several does not. The result is
    reduced by the bound of its rounding, a part of about (n + m + d) 2^-52. Twice the time of
    :func:`lb_keogh`.

    Lemire, "Faster retrieval with a two-pass dynamic-time-warping lower bound", Pattern Recognition
    (2009).

    Examples
    --------
    >>> import curvewise
    >>> P, Q = [0, 1, 5, 1], [0, 2, 3, 2]
    >>> curvewise.lb_keogh(Q, P, window=1)
    0.0
    >>> round(curvewise.lb_improved(Q, P, window=1), 12)
    3.0
    """
    check_choice("metric", metric, get_args(BoundMetric))
    first, second = checked_pair(P, Q, "lb_improved")
    if first.shape[1] > 1 and metric not in ("sqeuclidean", "cityblock"):
        raise ValueError(
            f"metric is {metric!r}; lb_improved of {first.shape[1]} coordinates needs "
            "metric='sqeuclidean' or 'cityblock'; lb_keogh has the others"
        )
    first, second, exponent = in_range(first, second, metric)
    nearest = _projection(first, second, window)
    back = _projection(second, nearest, window)
    total = _sum(ground_distances(first, nearest, metric, 2.0))
    total += _sum(ground_distances(second, back, metric, 2.0))
    rounding = (len(first) + len(second) + first.shape[1] + 16) * 2.0**-52
    return _restored(total * (1.0 - rounding), exponent)


def lb_kim(P: CurveLike, Q: CurveLike, *, metric: BoundMetric = "euclidean") -> float:
    """Compute LB_Kim, a lower bound of dtw from the ends and the extremes of the curves.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : {"euclidean", "sqeuclidean", "cityblock", "chebyshev"}
        The ground distance of dtw.

    Returns
    -------
    float
        At most ``dtw(P, Q, metric=metric)``, with any window and also after rounding. Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, or the curves differ in d. If the metric is unknown.
    TypeError
        If a curve does not hold real numbers.

    See Also
    --------
    lb_keogh : A bound that is usually larger.

    Notes
    -----
    The largest of four: the distance of the first points, that of the last points, and the
    differences of the smallest and of the largest numbers. In several dimensions each coordinate
    has such differences. Time O(n d + m d).

    Kim, Park & Chu, "An index-based approach for similarity search supporting time warping in large
    sequence databases", ICDE 2001.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.lb_kim([0, 1, 5, 1], [0, 2, 3, 2])
    2.0
    """
    check_choice("metric", metric, get_args(BoundMetric))
    first, second = checked_pair(P, Q, "lb_kim")
    first, second, exponent = in_range(first, second, metric)
    zeros = np.zeros(first.shape[1])
    lowest, highest = (
        np.diag(extreme(first, axis=0) - extreme(second, axis=0)) for extreme in (np.min, np.max)
    )
    ends = ground_distances(first[[0, -1]], second[[0, -1]], metric, 2.0)
    extremes = ground_distances(np.concatenate([lowest, highest]), zeros, metric, 2.0)
    return _restored(max(ends.max(), extremes.max()), exponent)


def _sum(terms: Array) -> float:
    """Return a sum in the order of the table, in which no partial sum exceeds a path's."""
    with np.errstate(over="ignore", under="ignore"):
        return float(np.add.accumulate(terms)[-1])


def _restored(value: float, exponent: int) -> float:
    return float(times_power_of_two(np.array(value), exponent))


def _projection(P: Array, Q: Array, window: Window) -> Array:
    """Return each point of P, moved to the nearest of its box around points of Q."""
    first, last = _band(len(P), len(Q), window)
    spans = np.ldexp(1.0, np.frexp(last - first + 1.0)[1] - 1).astype(np.int64)  # powers of two
    low, high = np.empty(P.shape), np.empty(P.shape)
    lows = highs = Q
    span = 1
    while True:
        rows = np.flatnonzero(spans == span)
        ends = last[rows] - span + 1
        low[rows] = np.minimum(lows[first[rows]], lows[ends])
        high[rows] = np.maximum(highs[first[rows]], highs[ends])
        if span == spans.max():
            return np.clip(P, low, high)
        lows = np.minimum(lows[:-span], lows[span:])
        highs = np.maximum(highs[:-span], highs[span:])
        span *= 2


def _band(n: int, m: int, window: Window) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Return the first and the last column of each row in the Sakoe-Chiba band."""
    radius = window_radius(window, n, m)
    if radius is None or n == 1 or m == 1:
        return np.zeros(n, dtype=np.int64), np.full(n, m - 1)
    limit = min(radius, max(n, m)) * (max(n, m) - 1)
    middle = np.arange(n) * (m - 1)
    first = np.maximum(-((limit - middle) // (n - 1)), 0)
    return first, np.minimum((middle + limit) // (n - 1), m - 1)
