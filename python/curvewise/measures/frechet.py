"""The discrete Fréchet distance, a coupling that attains it, and its table.

Eiter & Mannila (1994). Time O(n m), memory O(n + m) except for the table.
"""

from __future__ import annotations

from typing import SupportsFloat, SupportsIndex

from .._core import frechet as compiled_frechet
from .._core import frechet_info as compiled_frechet_info
from .._core import frechet_path as compiled_frechet_path
from .._core import frechet_table as compiled_frechet_table
from .._options import GroundDistance, Missing, Order, Radius
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.missing import skip_in_pair
from ..curves.named_curve import copied
from .closed import closed_alignment, closed_value
from .results import Alignment, WarpingInfo

__all__ = ["frechet", "frechet_info", "frechet_path", "frechet_table"]


# Shared text: curves, ground, workers, prune, cutoff, missing, closed, closed_notes, own_distances
def frechet(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    workers: SupportsIndex = 1,
    prune: bool = True,
    cutoff: SupportsFloat | None = None,
    missing: Missing = "refuse",
    closed: bool = False,
) -> float:
    """Compute the discrete Fréchet distance between two curves.

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

    Returns
    -------
    float
        The distance, in units of the ground distance. Symmetric, if a user-defined metric is. Not
        below the continuous Fréchet distance of the same metric (except for "sqeuclidean"), and
        above it by at most the longest edge of either curve.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, or the curves differ in d. If an option is unknown or out
        of range. If a user-defined distance is nan or negative, or its shape does not fit.
    TypeError
        If a curve, or a user-defined distance, does not hold real numbers.

    See Also
    --------
    curvewise.frechet_path : The paired points, and the distance.
    curvewise.frechet_continuous : The distance with the edges of the curves.
    curvewise.cdist : Distances between many curves.
    curvewise.dtw : The sum of the distances of paired points.

    Notes
    -----
    Eiter & Mannila, "Computing discrete Fréchet distance" (1994): c[i, j] = max(d(P[i], Q[j]),
    min(c[i-1, j], c[i, j-1], c[i-1, j-1])). Exact. Time O(n m), memory O(n + m).

    ``closed=True``: the first point of a closed curve is arbitrary, and a last point that equals it
    only closes the curve. A path goes once around both curves by steps of one point of either or of
    both, and returns to its first pair, which counts once. The value is the smallest over all first
    points of P and of Q.

    The value is found by bisection, each step in time O(n m), or less for similar curves.
    Memory O(n + m). Exact.

    A user-defined metric is computed in one thread and without pruning. A callable is called once
    for every 256 rows of the table (fewer if these are more than 2^21 pairs), so that memory stays
    O(n + m), and up to three times for a path. It need not be symmetric. Its exceptions are not
    caught.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 3)])
    3.0
    >>> curvewise.frechet([1, 2, 4], [1, 4], metric=[[0, 2], [1, 1], [2, 0]])
    1.0
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    if closed:
        return closed_value("frechet", P, Q, {"metric": metric, "p": p, "radius": radius}, cutoff)
    return compiled_frechet(P, Q, (metric, p, radius, workers, prune, cutoff))


# Signature: frechet without cutoff, missing, closed
def frechet_info(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    workers: SupportsIndex = 1,
    prune: bool = True,
) -> WarpingInfo:
    """Compute the discrete Fréchet distance, with statistics on the table.

    Parameters
    ----------
    P, Q, metric, p, radius, workers, prune
        As for :func:`frechet`.

    Returns
    -------
    WarpingInfo
        The value, the cells that were swept and their share of the table, the bounds, and the
        seconds by phase.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet`.

    Notes
    -----
    As for :func:`frechet`, whose value it has.

    Examples
    --------
    >>> import curvewise
    >>> info = curvewise.frechet_info([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 3)])
    >>> info.value, info.cells_swept, info.share  # short curves are swept as a whole
    (3.0, 6, 1.0)
    """
    P, Q = as_curves(P, Q)
    options = (metric, p, radius, workers, prune, None)
    return WarpingInfo(*compiled_frechet_info(P, Q, options))


# Signature: frechet without cutoff, missing
def frechet_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    workers: SupportsIndex = 1,
    prune: bool = True,
    closed: bool = False,
) -> Alignment:
    """Compute the discrete Fréchet distance with a coupling that attains it.

    Parameters
    ----------
    P, Q, metric, p, radius, workers, prune, closed
        As for :func:`frechet`.

    Returns
    -------
    Alignment
        ``distance`` and ``path``, shape (k, 2). Among equal predecessors the diagonal is taken,
        then (i-1, j), then (i, j-1). The largest ground distance along the path equals the
        distance to the bit.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet`.

    Notes
    -----
    As for :func:`frechet`, by divide and conquer over rows: up to three times the time of the
    distance, memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_path([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 3)]).path.tolist()
    [[0, 0], [1, 0], [2, 1]]
    """
    if closed:
        return closed_alignment("frechet", P, Q, {"metric": metric, "p": p, "radius": radius})
    A, B = as_curves(P, Q)
    options = (metric, p, radius, workers, prune, None)
    return Alignment(*compiled_frechet_path(A, B, options), (copied(P, A), copied(Q, B)))


# Signature: frechet without workers, prune, cutoff, missing, closed
def frechet_table(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
) -> Array:
    """Return the cumulative table of the discrete Fréchet distance.

    Parameters
    ----------
    P, Q, metric, p, radius
        As for :func:`frechet`.

    Returns
    -------
    ndarray, shape (n, m)
        c[i, j]: the distance between the first i + 1 points of P and the first j + 1 of Q.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet`.
    MemoryError
        If the table does not fit in memory.

    Notes
    -----
    As for :func:`frechet`. Time O(n m), memory 8 n m bytes.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_table([0, 1, 2], [0, 2]).tolist()
    [[0.0, 2.0], [1.0, 1.0], [2.0, 1.0]]
    """
    P, Q = as_curves(P, Q)
    options = (metric, p, radius, 1, True, None)
    return compiled_frechet_table(P, Q, options)
