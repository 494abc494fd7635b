"""The Hausdorff distance between polygonal curves, by candidate places.

Let x + t u be a point of an edge. Its squared distance to a vertex of the other curve, or to the
line through one of the other curve's edges, is a quadratic in t. The smallest distance to the other
curve is greatest at an end of the edge, or at a place where two of these quadratics are equal.
Between such places the nearest vertex or line is the same, and the distance to it is convex. The
distance to the curve is computed at all of these places; superfluous places give smaller distances.
Time O(n m^3), memory O(m^2).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from .checks import check_pair

__all__ = ["hausdorff_continuous"]


def hausdorff_continuous(P: CurveLike, Q: CurveLike, *, directed: bool = False) -> float:
    """Time O(n m^3 + m n^3), memory O((n + m)^2)."""
    P, Q = as_curves(P, Q)
    P, Q = check_pair(P, Q, "hausdorff_continuous")
    exponent = int(np.frexp(max(np.abs(P).max(), np.abs(Q).max()))[1])
    P, Q = (times_power_of_two(curve, -exponent) for curve in (P, Q))
    farthest = _farthest(P, Q)
    if not directed:
        farthest = max(farthest, _farthest(Q, P))
    return float(times_power_of_two(np.array(farthest), exponent))


def _farthest(P: Array, Q: Array) -> float:
    """Return how far the point of P is from Q that is farthest from it."""
    ends = pairwise(P) if len(P) > 1 else [(P[0], P[0])]
    return max(float(_distances(_places(x, y - x, Q), Q).max()) for x, y in ends)


def _places(x: Array, u: Array, Q: Array) -> Array:
    """Return the ends of the edge from x to x + u, and its points where quadratics are equal."""
    a, b, c = np.array([*_of_points(x, u, Q), *_of_lines(x, u, Q)]).T
    first, second = np.triu_indices(len(a), 1)
    t = _roots(a[first] - a[second], b[first] - b[second], c[first] - c[second])
    return np.array([x, x + u, *(x + t[(t > 0) & (t < 1), np.newaxis] * u)])


def _of_points(x: Array, u: Array, Q: Array) -> list[list[float]]:
    """Return a, b, c with the square a t^2 + 2 b t + c of the distance to each vertex."""
    return [[float(u @ u), float(u @ (x - z)), float((x - z) @ (x - z))] for z in Q]


def _of_lines(x: Array, u: Array, Q: Array) -> list[list[float]]:
    """Return the same for the lines through the edges (normal components)."""
    quadratics = []
    for start, end in pairwise(Q):
        along = end - start
        if not along.any():
            continue
        along = along / np.abs(along).max()
        along = along / np.linalg.norm(along)
        w = x - start
        across, off = u - (u @ along) * along, w - (w @ along) * along
        quadratics.append([float(across @ across), float(across @ off), float(off @ off)])
    return quadratics


def _roots(a: Array, b: Array, c: Array) -> Array:
    """Return the real roots of a t^2 + 2 b t + c; an empty array for a constant."""
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(np.maximum(b * b - a * c, 0.0))  # of equal roots, rounded
        q = -(b + np.copysign(root, b))
        t = np.concatenate([q / a, c / q])
    return np.asarray(t[np.isfinite(t)])


def _distances(points: Array, Q: Array) -> Array:
    """Return the distances of points from a curve."""
    starts, along = (Q[:-1], np.diff(Q, axis=0)) if len(Q) > 1 else (Q, np.zeros_like(Q))
    squares = np.sum(along * along, axis=1)
    w = points[:, np.newaxis] - starts
    share = np.sum(w * along, axis=2) / np.where(squares > 0, squares, 1.0)
    off = w - np.clip(share, 0.0, 1.0)[..., np.newaxis] * along
    return np.asarray(np.sqrt(np.sum(off * off, axis=2)).min(axis=1))
