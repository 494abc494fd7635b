"""The Hausdorff distance between the points of two curves. Time O(n m), memory O(n + m)."""

from __future__ import annotations

from typing import SupportsFloat

from .._core import hausdorff as compiled_hausdorff
from .._options import Metric, Order, Radius
from ..curves.inputs import CurveLike

__all__ = ["hausdorff"]


# Shared text: curves, metric, cutoff, invalid
def hausdorff(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    cutoff: SupportsFloat | None = None,
) -> float:
    """Compute the Hausdorff distance between the points of two curves.

    It is the largest distance of a point of either curve from the other curve's points.

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
    cutoff : float >= 0, optional
        Upper limit: return inf for distances above it, which takes less time.

    Returns
    -------
    float
        In units of the ground distance. Symmetric. The order of points does not matter.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, or an option is unknown or out of
        range.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    The larger of the two that ``scipy.spatial.distance.directed_hausdorff`` returns for (P, Q)
    and (Q, P). At most the discrete Fréchet distance. Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.hausdorff([0, 1, 2, 3], [3, 0, 1])
    1.0
    """
    return compiled_hausdorff(P, Q, (metric, p, radius, cutoff))
