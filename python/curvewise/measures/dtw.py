"""Dynamic time warping, a warping path that attains it, and its table.

Sakoe & Chiba (1978); open ends: Müller (2007). Time O(n m), memory O(n + m) except for the table.
"""

from __future__ import annotations

from typing import SupportsFloat, SupportsIndex

from .._core import dtw as compiled_dtw
from .._core import dtw_info as compiled_dtw_info
from .._core import dtw_path as compiled_dtw_path
from .._core import dtw_table as compiled_dtw_table
from .._options import GroundDistance, Missing, Order, Radius, Relax, Window, check_closed
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.missing import skip_in_pair
from ..curves.named_curve import copied
from .closed import closed_alignment, closed_value
from .independent import sum_over_coordinates
from .results import Alignment, WarpingInfo
from .step_pattern import Steps

__all__ = ["dtw", "dtw_info", "dtw_path", "dtw_table"]


# Shared text: curves, ground, workers, prune, cutoff, missing, closed, closed_notes, own_distances
def dtw(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    step_pattern: Steps = "symmetric1",
    penalty: SupportsFloat = 0.0,
    window: Window = None,
    open_begin: bool = False,
    open_end: bool = False,
    relax: Relax = None,
    normalize: bool = False,
    workers: SupportsIndex = 1,
    prune: bool = True,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
    closed: bool = False,
    dependent: bool = True,
) -> float:
    """Compute dynamic time warping between two curves.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : str, array_like of shape (n, m), or callable, default "euclidean"
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees. A user-defined distance is an array of the distances of
        all points of P and Q, or a function. The function receives some points of each curve, of
        shapes (p, d) and (q, d), and returns their distances, of shape (p, q). Distances are at
        least 0; inf forbids a pair.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.
    step_pattern : str or StepPattern, default "symmetric1"
        "symmetric1" counts each step once. "symmetric2" counts a diagonal step twice; it is the
        default of R's dtw and of ``preset="paper"``. The others of R's dtw are "asymmetric",
        "symmetricP0", "symmetricP05", "symmetricP1", "symmetricP2", the same four as "asymmetricP0"
        and so on, "typeIa" to "typeId", "typeIas" to "typeIds", "typeIIa" to "typeIId", "typeIIIc",
        "typeIVc", "rigid", "mori2006". A custom pattern is a ``StepPattern``.
    penalty : float >= 0, default 0
        Cost added to each step that advances by different numbers of points in P and Q, in units of
        the ground distance.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe–Chiba band: abs(i (m-1) - j (n-1)) <= window (max(n, m) - 1), that is abs(i - j) <=
        window if n = m. Unlimited if n = 1 or m = 1. A fraction is one of max(n, m), rounded down.
    open_begin, open_end : bool, default False
        Match P to a part of Q that may begin, or end, anywhere (subsequence DTW). Not allowed with
        a window. "symmetric1" without a penalty accepts both, and the cheapest part counts.
        `open_end` also accepts every pattern that `normalize` accepts, with the end of the smallest
        cost for the weight of its path. `open_begin` also accepts the patterns normalised by N,
        such as "asymmetric".
    relax : sequence of four int >= 0, optional
        Numbers of points that may be left out: at the beginning and end of P, then at the beginning
        and end of Q (four numbers). The cheapest path counts, not normalised by length. At least
        one pair of points is matched. Requires "symmetric1", with or without a penalty, and
        excludes `window`, open ends and `normalize`.
    normalize : bool, default False
        Whether to divide by the sum of the step weights, which must be the same for all paths: n +
        m with "symmetric2", else that of the pattern (``StepPattern.normalization``). The result is
        a distance per step, which does not grow with the number of points. Not allowed with
        "symmetric1" and other patterns whose paths differ in length, as in R's dtw and dtw-python.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.
    prune : bool, default True
        Whether to skip table cells that cannot affect the result. The result does not change.
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.
    closed : bool, default False
        Whether both curves are closed, so that their first points do not matter. See Notes.
    dependent : bool, default True
        Whether one path matches all coordinates. If False, each coordinate has a path of its own,
        and the value is the sum over the coordinates. A `metric` must be named, and not
        "haversine".

    Returns
    -------
    float
        The smallest sum of ground distances along a warping path, in units of the ground distance.
        It is not divided by the length of the path unless ``normalize``. It is inf if the step
        pattern does not admit a path between curves of so different lengths. Symmetric, except with
        open ends or an asymmetric step pattern.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, or the curves differ in d. If an option is unknown or out
        of range. If no path fits the window (window = 0 and n != m). If a user-defined distance is
        nan or negative, or its shape does not fit.
    TypeError
        If a curve, or a user-defined distance, does not hold real numbers.

    See Also
    --------
    curvewise.dtw_path : The warping path, and the distance.
    curvewise.cdist : Distances between many curves.
    curvewise.subsequence : The best parts of a long record.
    curvewise.frechet : The largest distance of paired points instead of the sum.

    Notes
    -----
    Sakoe & Chiba (1978): c[i, j] = min(min(c[i-1, j], c[i, j-1]) + d, c[i-1, j-1] + w d), with w =
    1 for "symmetric1" and 2 for "symmetric2". Open ends: Müller (2007), Tormene et al. (2009).
    Exact. Time O(n m), or the cells of the band; memory O(n + m). With another pattern or a
    penalty, in one thread and without pruning, O(n m) times the number of weights. Then c[i, j] is
    the least value over the steps of the pattern. A step's value is c at its beginning, plus the
    penalty, plus the weighted distances of the cells that it visits, added in this order.

    ``closed=True``: the first point of a closed curve is arbitrary, and a last point that equals it
    only closes the curve. A path goes once around both curves by steps of one point of either or of
    both, and returns to its first pair, which counts once. The value is the smallest over all first
    points of P and of Q.

    The value is found by divide and conquer over the beginning of Q (Maes, "On a cyclic
    string-to-string correction problem", 1990). Time O(n m log m), memory n m bytes. The value is
    exact except for the order in which distances are added. Only the metric, missing and cutoff
    apply.

    A user-defined metric is computed in one thread and without pruning. A callable is called once
    for every 256 rows of the table (fewer if these are more than 2^21 pairs), so that memory stays
    O(n + m), and up to three times for a path. It need not be symmetric. Its exceptions are not
    caught.

    This table gives the options for the DTW of other packages:

    =============================================  ===========================================
    dtw-python, R's dtw: ``distance``              ``step_pattern="symmetric2"``
    their ``normalizedDistance``                   the same, ``normalize=True``
    dtaidistance, tslearn: ``distance``, ``dtw``   ``sqrt(dtw(metric="sqeuclidean"))``
    aeon: ``dtw_distance``                         ``metric="sqeuclidean"``
    dtaidistance's ``window=w``                    ``window=w - 1``
    dtaidistance's ``psi=(a, b, c, d)``            ``relax=(a, b, c, d)``
    tslearn's ``sakoe_chiba_radius=r``             ``window=r``
    aeon's ``window=f``, of n = m points           ``window=f``
    aeon's ``adtw_distance(warp_penalty=w)``       ``metric="sqeuclidean", penalty=w``
    =============================================  ===========================================

    Examples
    --------
    >>> import curvewise
    >>> curvewise.dtw([0, 1, 2, 3], [0, 2, 3])
    1.0
    >>> curvewise.dtw([0, 1, 2, 3], [0, 2, 3], step_pattern="symmetric2", normalize=True)
    0.14285714285714285
    >>> curvewise.dtw([1, 2], [9, 1, 2, 9], open_begin=True, open_end=True)
    0.0
    >>> curvewise.dtw([2, 2, 2], [2, 5, 5, 5, 5], relax=(0, 0, 0, 1))
    9.0
    >>> curvewise.dtw([0, 1, 2, 3], [0, 2, 3], step_pattern="typeIIa", penalty=0.5)
    0.5
    >>> import numpy as np
    >>> curvewise.dtw([1, 2, 4], [1, 4], metric=lambda p, q: np.abs(np.log2(p) - np.log2(q).T))
    1.0
    >>> curvewise.dtw([1, 2, 4], [1, 4], metric=[[0, 2], [1, 1], [2, 0]])
    1.0
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    if not dependent:
        return sum_over_coordinates(dtw, locals())
    if closed:
        check_closed(locals())
        return closed_value("dtw", P, Q, {"metric": metric, "p": p, "radius": radius}, cutoff)
    options = (
        metric,
        p,
        radius,
        step_pattern,
        penalty,
        window,
        open_begin,
        open_end,
        relax,
        normalize,
        workers,
        prune,
        cutoff,
    )
    return compiled_dtw(P, Q, options)


# Signature: dtw without normalize, cutoff, missing, closed, dependent
def dtw_info(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    step_pattern: Steps = "symmetric1",
    penalty: SupportsFloat = 0.0,
    window: Window = None,
    open_begin: bool = False,
    open_end: bool = False,
    relax: Relax = None,
    workers: SupportsIndex = 1,
    prune: bool = True,
) -> WarpingInfo:
    """Compute dynamic time warping, with statistics on the table.

    Parameters
    ----------
    P, Q
        As for :func:`dtw`.
    metric, p, radius, step_pattern, penalty, window, open_begin, open_end, relax, workers, prune
        As for :func:`dtw`.

    Returns
    -------
    WarpingInfo
        The value, the cells that were swept and their share of the table, the bounds, and the
        seconds by phase.

    Raises
    ------
    ValueError, TypeError
        As for :func:`dtw`.

    Notes
    -----
    As for :func:`dtw`, whose value it has.

    Examples
    --------
    >>> import curvewise
    >>> info = curvewise.dtw_info([0, 1, 2, 3], [0, 2, 3])
    >>> info.value, info.cells_swept, info.share  # short curves are swept as a whole
    (1.0, 12, 1.0)
    """
    P, Q = as_curves(P, Q)
    options = (
        metric,
        p,
        radius,
        step_pattern,
        penalty,
        window,
        open_begin,
        open_end,
        relax,
        False,
        workers,
        prune,
        None,
    )
    return WarpingInfo(*compiled_dtw_info(P, Q, options))


# Shared text: closed
# Signature: dtw without normalize, cutoff, missing, dependent
def dtw_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    step_pattern: Steps = "symmetric1",
    penalty: SupportsFloat = 0.0,
    window: Window = None,
    open_begin: bool = False,
    open_end: bool = False,
    relax: Relax = None,
    workers: SupportsIndex = 1,
    prune: bool = True,
    closed: bool = False,
) -> Alignment:
    """Compute dynamic time warping with an optimal warping path.

    Parameters
    ----------
    P, Q
        As for :func:`dtw`.
    metric, p, radius, step_pattern, penalty, window, open_begin, open_end, relax, workers, prune
        As for :func:`dtw`.
    closed : bool, default False
        Whether both curves are closed, so that their first points do not matter. See Notes.

    Returns
    -------
    Alignment
        ``distance`` and ``path``, shape (k, 2). Among equal predecessors the diagonal is taken,
        then (i-1, j), then (i, j-1), or that of the first step in the pattern; with an open end,
        the first best j. The sum of step weight times ground distance, in path order, equals the
        distance to the bit. Of a step over several cells, all that it visits are in the path.
        If the step pattern admits no path, ``distance`` is inf and ``path`` is empty, shape (0, 2).
        If every path is infinite, ``path`` is one that the step pattern admits.

    Raises
    ------
    ValueError, TypeError
        As for :func:`dtw`.

    Notes
    -----
    As for :func:`dtw`, by divide and conquer over rows: up to three times the time of the
    distance, memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.dtw_path([0, 1, 2, 3], [0, 2, 3]).path.tolist()
    [[0, 0], [1, 0], [2, 1], [3, 2]]
    """
    if closed:
        check_closed(locals())
        return closed_alignment("dtw", P, Q, {"metric": metric, "p": p, "radius": radius})
    A, B = as_curves(P, Q)
    options = (
        metric,
        p,
        radius,
        step_pattern,
        penalty,
        window,
        open_begin,
        open_end,
        relax,
        False,
        workers,
        prune,
        None,
    )
    return Alignment(*compiled_dtw_path(A, B, options), (copied(P, A), copied(Q, B)))


# Signature: dtw without normalize, workers, prune, cutoff, missing, closed, dependent
def dtw_table(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    step_pattern: Steps = "symmetric1",
    penalty: SupportsFloat = 0.0,
    window: Window = None,
    open_begin: bool = False,
    open_end: bool = False,
    relax: Relax = None,
) -> Array:
    """Return the cumulative table of dynamic time warping.

    Parameters
    ----------
    P, Q, metric, p, radius, step_pattern, penalty, window, open_begin, open_end, relax
        As for :func:`dtw`. An open end does not change the table: the value is then the smallest
        entry of its last row. With `relax`, it is the smallest entry at the ends of its last row
        and last column.

    Returns
    -------
    ndarray, shape (n, m)
        c[i, j]; ``inf`` outside the window.

    Raises
    ------
    ValueError, TypeError
        As for :func:`dtw`.
    MemoryError
        If the table does not fit in memory.

    Notes
    -----
    As for :func:`dtw`. Time O(n m), memory 8 n m bytes.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.dtw_table([0, 1], [0, 2, 3]).tolist()
    [[0.0, 2.0, 5.0], [1.0, 1.0, 3.0]]
    """
    P, Q = as_curves(P, Q)
    options = (
        metric,
        p,
        radius,
        step_pattern,
        penalty,
        window,
        open_begin,
        open_end,
        relax,
        False,
        1,
        True,
        None,
    )
    return compiled_dtw_table(P, Q, options)
