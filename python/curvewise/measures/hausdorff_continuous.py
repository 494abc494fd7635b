"""The Hausdorff distance between polygonal curves, and the points that attain it.

The distance between the points of an edge and one edge of the other curve is a convex function. The
farthest point of an edge is an end, or a point where the nearest edge of the other curve changes
(Alt, Behrends & Blömer 1995). Edges that cannot hold the farthest point are skipped, and a tree of
boxes finds nearest edges: near-linear time for similar curves, memory O(n + m).
"""

from __future__ import annotations

import numpy as np

from .._core import hausdorff_continuous as compiled_hausdorff_continuous
from .._core import hausdorff_continuous_points as compiled_hausdorff_continuous_points
from ..curves.inputs import CurveLike, as_curves
from ..curves.named_curve import copied
from .results import FarthestPoints

__all__ = ["hausdorff_continuous", "hausdorff_continuous_points"]


def hausdorff_continuous(P: CurveLike, Q: CurveLike, *, directed: bool = False) -> float:
    """Compute the Hausdorff distance between polygonal curves.

    The curves are the points and the straight edges between them. Unlike :func:`hausdorff`, which
    compares the points alone, it does not depend on how a curve was sampled.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    directed : bool
        Compute the largest distance of a point of P from Q alone. By default, the larger of that
        and the largest distance of a point of Q from P.

    Returns
    -------
    float
        The distance, in units of the coordinates. It differs from the real number by at most 2^-46
        times the largest coordinate. Symmetric, except with `directed`. The direction of a curve
        does not matter. inf if it is beyond the range of a double.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, or the curves differ in d.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    At most :func:`frechet_continuous`, and :func:`hausdorff` plus half of the longest edge. Alt,
    Behrends & Blömer (1995), "Approximate matching of polygonal shapes". The curves are not
    sampled. Time about O((n + m) log(n + m)) for similar curves, O(n m) at worst; memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> square = [(0, 0), (10, 0), (10, 6), (0, 6), (0, 0)]
    >>> without_bottom = [(0, 0), (0, 6), (10, 6), (10, 0)]
    >>> curvewise.hausdorff_continuous(square, without_bottom)
    5.0
    >>> curvewise.hausdorff_continuous(without_bottom, square, directed=True) < 1e-12
    True
    """
    return compiled_hausdorff_continuous(P, Q, (directed,))


def hausdorff_continuous_points(
    P: CurveLike, Q: CurveLike, *, directed: bool = False
) -> FarthestPoints:
    """Compute the Hausdorff distance of polygonal curves, with its points.

    Parameters
    ----------
    P, Q, directed
        As for :func:`hausdorff_continuous`.

    Returns
    -------
    FarthestPoints
        The distance, both directed distances, and where the farthest points and the points nearest
        to them lie. Of equally far points one is returned.

    Raises
    ------
    ValueError, TypeError
        As for :func:`hausdorff_continuous`.

    Notes
    -----
    As for :func:`hausdorff_continuous`.

    Examples
    --------
    >>> import curvewise
    >>> square = [(0, 0), (10, 0), (10, 6), (0, 6), (0, 0)]
    >>> found = curvewise.hausdorff_continuous_points(square, [(0, 0), (0, 6), (10, 6), (10, 0)])
    >>> found.distances  # of the bottom's middle from the other curve; nothing the other way
    array([5., 0.])
    >>> float(found.parameters[0, 0])  # on the square: half of its first edge
    0.5
    >>> found.points[0, 0]
    array([5., 0.])
    """
    p, q = as_curves(P, Q)
    distance, *ways = compiled_hausdorff_continuous_points(p, q, {"directed": directed})
    found = np.array(ways[:1] if directed else ways)
    return FarthestPoints(distance, found[:, 0], found[:, 1:], (copied(P, p), copied(Q, q)))
