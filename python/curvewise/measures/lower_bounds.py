"""Lower bounds of dtw, by the names and definitions of their papers.

A point of P is matched to some points of Q only. The box around these is its envelope, and its
distance from the envelope is a lower bound of each of its pairs (Keogh & Ratanamahatana 2005).
"""

from __future__ import annotations

from typing import get_args

from .._core import lb_improved as compiled_lb_improved
from .._core import lb_keogh as compiled_lb_keogh
from .._core import lb_kim as compiled_lb_kim
from .._options import BoundMetric, Window, check_choice
from ..curves.inputs import CurveLike, as_curves

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
    return compiled_lb_keogh(*as_curves(P, Q), {"metric": metric, "window": window})


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
    return compiled_lb_improved(*as_curves(P, Q), {"metric": metric, "window": window})


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
    return compiled_lb_kim(*as_curves(P, Q), {"metric": metric})
