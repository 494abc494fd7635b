"""The longest section of a curve that another curve also has, within a distance."""

from __future__ import annotations

from typing import SupportsFloat

from .._core import common_part as compiled_common_part
from .._options import Metric, Order, Radius
from ..curves.inputs import CurveLike, as_curves
from .results import CommonPart

__all__ = ["common_part"]


# Shared text: curves, metric
def common_part(
    P: CurveLike,
    Q: CurveLike,
    distance: SupportsFloat,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
) -> CommonPart:
    """Find the longest section of P that has a similar section of Q.

    Two sections are similar if their discrete Fréchet distance (:func:`frechet`) is at most
    `distance`. Use it for two tracks that share a part of their ways.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    distance : float >= 0
        The largest distance of two paired points, in units of the ground distance.
    metric : str
        The ground distance between points: "euclidean", "sqeuclidean", "cityblock", "chebyshev",
        "minkowski", "haversine". "haversine" is the distance along the great circle, for points
        (longitude, latitude) in degrees.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    radius : float > 0, optional
        The radius of the sphere of "haversine", in the unit of the distances. The default is
        6371008.8, the mean radius of the Earth in metres.

    Returns
    -------
    CommonPart
        The section of P, the section of Q, and the length of the section of P. Both sections are
        empty if all pairs of points are farther apart than `distance`.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, `distance` is nan or negative, or
        an option is unknown or out of range.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Sections are runs of points. The length of a section is the sum of the ground distances of its
    neighbouring points. Among equally long sections of P, the one that ends first is chosen, and
    its section of Q begins and then ends first. The result is not symmetric. It is one contiguous
    section; the partial Fréchet similarity of Buchin, Buchin and Wang [1]_ adds up all pieces that
    match, at the continuous distance. The points should be denser than `distance`: resample sparse
    tracks first (:func:`curvewise.curves.resample`).

    Each pair of points within the distance keeps the earliest point of P from which a coupling
    reaches it. Time O(n m), memory O(n + m).

    References
    ----------
    .. [1] K. Buchin, M. Buchin, Y. Wang, "Exact algorithms for partial curve matching via the
       Fréchet distance", Proceedings of the 20th ACM-SIAM Symposium on Discrete Algorithms (2009)
       645-654.

    Examples
    --------
    >>> import curvewise
    >>> home, detour = [(0, 0), (1, 0), (2, 0), (3, 0)], [(0, 5), (1, 0.1), (2, 0.1), (3, 4)]
    >>> part = curvewise.common_part(home, detour, 0.5)
    >>> part.length, home[part.of_p], detour[part.of_q]
    (1.0, [(1, 0), (2, 0)], [(1, 0.1), (2, 0.1)])
    """
    P, Q = as_curves(P, Q)
    ground = {"metric": metric, "p": p, "radius": radius}
    length, of_p, of_q = compiled_common_part(P, Q, distance, ground)
    return CommonPart(length, slice(*of_p), slice(*of_q))
