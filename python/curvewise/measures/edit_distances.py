"""Edit distances between curves, and weighted dynamic time warping.

Each is a row of the compiled library's table of recurrences (edit_distances.hpp), with the
definitions and defaults of aeon 1.6. Time O(n m), memory O(n + m) except for the table.
"""

from __future__ import annotations

from typing import Any, Literal, SupportsFloat, TypeAlias, get_args

from .._core import edit_path as compiled_path
from .._core import edit_table as compiled_table
from .._core import edr as compiled_edr
from .._core import erp as compiled_erp
from .._core import lcss as compiled_lcss
from .._core import msm as compiled_msm
from .._core import twe as compiled_twe
from .._core import wdtw as compiled_wdtw
from .._options import Metric, Missing, Order, Radius, Window, check_choice
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.missing import skip_in_pair
from ..curves.named_curve import copied
from .results import Alignment

__all__ = ["edit_path", "edit_table", "edr", "erp", "lcss", "msm", "twe", "wdtw"]

EditDistance: TypeAlias = Literal["erp", "edr", "lcss", "msm", "twe", "wdtw"]


# Shared text: curves, metric, window, cutoff, missing, invalid_window
# Signature: hausdorff(metric, p, radius), dtw(window, cutoff, missing)
def erp(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    gap: SupportsFloat = 0.0,
    window: Window = None,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
) -> float:
    """Compute the edit distance with real penalty.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : str
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.
    gap : float
        The coordinates of the reference point: an unmatched point costs its distance from it.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe-Chiba band, as for :func:`dtw`.
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        The distance, in units of the ground distance. Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, an option is unknown or out of
        range, or no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Chen & Ng, "On the marriage of Lp-norms and edit distance" (2004). The recurrence is ``c[i, j] =
    min(c[i-1, j-1] + d(P[i], Q[j]), c[i-1, j] + d(P[i], gap), c[i, j-1] + d(gap, Q[j]))``. As in
    aeon, the border before the first row and column holds the sums over all points of either curve.
    A path that begins with unmatched points therefore pays for all of that curve. Chen & Ng add up
    costs along the way instead. Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.erp([0, 1, 2, 3], [0, 2, 3])
    1.0
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_erp(P, Q, (metric, p, radius, gap, window, cutoff))


# Shared text: curves, metric, window, cutoff, missing, invalid_window
# Signature: hausdorff(metric, p, radius), dtw(window, cutoff, missing)
def edr(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    epsilon: SupportsFloat | None = None,
    window: Window = None,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
) -> float:
    """Compute the edit distance on real sequences.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : str
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.
    epsilon : float >= 0, optional
        Points nearer than this are equal. The default is a quarter of the larger standard deviation
        of all coordinates of P and of Q.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe-Chiba band, as for :func:`dtw`.
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        The least number of changes over max(n, m). Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, an option is unknown or out of
        range, or no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Chen, Özsu & Oria, "Robust and fast similarity search for moving object trajectories" (2005).
    The recurrence is ``c[i, j] = min(c[i-1, j-1] + e, c[i-1, j] + 1, c[i, j-1] + 1)``, where e is 0
    if d(P[i], Q[j]) < epsilon, else 1. As in aeon, points before the first match may be skipped
    without cost. Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.edr([0, 1, 2, 3], [0, 1, 7, 3], epsilon=0.5)
    0.25
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_edr(P, Q, (metric, p, radius, epsilon, window, cutoff))


# Shared text: curves, metric, window, cutoff, missing, invalid_window
# Signature: hausdorff(metric, p, radius), dtw(window, cutoff, missing)
def lcss(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    epsilon: SupportsFloat = 1.0,
    window: Window = None,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
) -> float:
    """Compute the longest common subsequence distance.

    It is the fraction of points of the shorter curve without a match.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : str
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.
    epsilon : float >= 0
        Points at most so far apart match.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe-Chiba band, as for :func:`dtw`.
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        1 minus the most matches in order, over min(n, m). Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, an option is unknown or out of
        range, or no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Vlachos, Kollios & Gunopulos, "Discovering similar multidimensional trajectories" (2002). The
    table holds minus the number of matches. Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.lcss([0, 1, 2, 3], [0, 9, 2, 3], epsilon=0.5)
    0.25
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_lcss(P, Q, (metric, p, radius, epsilon, window, cutoff))


# Shared text: curves, window, cutoff, missing, invalid_window
# Signature: dtw(window, cutoff, missing)
def msm(
    P: CurveLike,
    Q: CurveLike,
    *,
    cost: SupportsFloat = 1.0,
    window: Window = None,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
) -> float:
    """Compute the move-split-merge distance between two series.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    cost : float >= 0
        The cost of a split or a merge.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe-Chiba band, as for :func:`dtw`.
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        The distance, in units of the coordinates; for several coordinates, the sum over all.
        Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, an option is unknown or out of
        range, or no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Stefan, Athitsos & Das, "The move-split-merge metric for time series" (2013). A split or merge
    also costs the distance of the number from the interval of its two neighbours. Each coordinate
    has its own table, as in aeon (``independent=True``). Exact. Time O(n m d), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.msm([0, 1, 2, 3], [0, 2, 3])
    2.0
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_msm(P, Q, (cost, window, cutoff))


# Shared text: curves, metric, window, cutoff, missing, invalid_window
# Signature: hausdorff(metric, p, radius), dtw(window, cutoff, missing)
def twe(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    stiffness: SupportsFloat = 0.001,
    penalty: SupportsFloat = 1.0,
    window: Window = None,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
) -> float:
    """Compute the time warp edit distance.

    Segments are matched; deletions cost a penalty and time.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : str
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.
    stiffness : float >= 0
        The cost of each unit of time between matched points; points are one unit apart.
    penalty : float >= 0
        The cost of each deleted point.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe-Chiba band, as for :func:`dtw`.
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        In units of the ground distance. Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, an option is unknown or out of
        range, or no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Marteau, "Time warp edit distance with stiffness adjustment for time series matching" (2009),
    whose nu and lambda are `stiffness` and `penalty`. Before the first point of each curve is 0.
    Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.twe([0, 1, 2, 3], [0, 2, 3], penalty=0.5)
    2.5029999999999997
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_twe(P, Q, (metric, p, radius, stiffness, penalty, window, cutoff))


# Shared text: curves, metric, window, cutoff, missing, invalid_window
# Signature: hausdorff(p, radius), dtw(window, cutoff, missing)
def wdtw(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "sqeuclidean",
    p: Order = None,
    radius: Radius = None,
    steepness: SupportsFloat = 0.05,
    window: Window = None,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
) -> float:
    """Compute weighted dynamic time warping.

    The weight of a match grows with the distance of its indices.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : str
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.
    steepness : float >= 0
        The steepness of the rise of the weight near half of the longer curve.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe-Chiba band, as for :func:`dtw`.
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        In units of the ground distance. Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, an option is unknown or out of
        range, or no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Jeong, Jeong & Omitaomu, "Weighted dynamic time warping for time series classification" (2011):
    dtw of ground distances divided by 1 + exp(-steepness (abs(i - j) - max(n, m) / 2)). Exact.
    Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> round(curvewise.wdtw([0, 1, 2, 3], [0, 2, 3]), 6)
    0.475021
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_wdtw(P, Q, (metric, p, radius, steepness, window, cutoff))


# Shared text: measure(edit_distances)
def edit_path(P: CurveLike, Q: CurveLike, measure: EditDistance, **options: Any) -> Alignment:
    """Find a cheapest path of an edit distance through its table.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves.
    measure : str
        The edit distance: "erp", "edr", "lcss", "msm", "twe", "wdtw".
    **options
        The options of its function.

    Returns
    -------
    Alignment
        ``distance`` and ``path``, shape (k, 2). A step (1, 1) matches its points, or changes one
        into the other. A step (1, 0) skips a point of P, and (0, 1) one of Q. Among equal ones the
        first of these is taken. The path begins behind the points that are skipped at the start.

    Raises
    ------
    ValueError, TypeError
        As for the function; also ValueError for msm of several coordinates, because each has its
        own path.

    Notes
    -----
    By recursive halving of the rows: a small multiple of time O(n m), memory O((n + m) log n).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.edit_path([0, 1, 2, 3], [0, 2, 3], "msm").path.tolist()
    [[0, 0], [1, 0], [2, 1], [3, 2]]
    """
    check_choice("measure", measure, get_args(EditDistance))
    A, B = as_curves(P, Q)
    return Alignment(*compiled_path(measure, A, B, options), (copied(P, A), copied(Q, B)))


# Shared text: measure(edit_distances)
def edit_table(P: CurveLike, Q: CurveLike, measure: EditDistance, **options: Any) -> Array:
    """Return the cumulative table of an edit distance.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves.
    measure : str
        The edit distance: "erp", "edr", "lcss", "msm", "twe", "wdtw".
    **options
        The options of its function.

    Returns
    -------
    ndarray, shape (n, m)
        c[i, j], before it is divided by a length; ``inf`` outside the window. Of lcss, minus the
        number of matches; of msm, the sum over the coordinates.

    Raises
    ------
    ValueError, TypeError
        As for the function.
    MemoryError
        If the table does not fit in memory.

    Notes
    -----
    Time O(n m), memory 16 n m bytes while it is made.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.edit_table([0, 1], [0, 2, 3], "msm").tolist()
    [[0.0, 3.0, 5.0], [2.0, 1.0, 3.0]]
    """
    check_choice("measure", measure, get_args(EditDistance))
    P, Q = as_curves(P, Q)
    return compiled_table(measure, P, Q, options)
