"""The symmetric difference of two polygons by the nonzero rule, slab by slab, as trapezoids.

A point is inside a polygon that winds around it. Between neighbouring x of points and of crossings,
edges have a fixed order, and each gap between them is inside both polygons, one or neither. All
pairs of edges are tested for crossings: time O((n + m)² (n + m + k)), memory O((n + m)²).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..curves.inputs import Array
from ..curves.scaling import times_power_of_two

__all__ = ["symmetric_difference"]


def symmetric_difference(P: Array, Q: Array, exponent: int) -> tuple[Array, Array]:
    """Return trapezoids, (k, 4, 2), and their areas, (k,), in units of 2**exponent."""
    P, Q = times_power_of_two(P, -exponent), times_power_of_two(Q, -exponent)
    origin = P[0]  # so that areas far from (0, 0) are as exact
    of_p, of_q = _edges(P - origin, 0), _edges(Q - origin, 1)
    edges, windings = map(np.concatenate, zip(of_p, of_q, strict=True))
    x = np.unique(np.concatenate([edges[:, :, 0].ravel(), _crossings(edges)]))
    trapezoids = [_gaps(edges, windings, *slab) for slab in pairwise(x)]
    quads = np.concatenate([quads for quads, _ in trapezoids] or [np.empty((0, 4, 2))])
    areas = np.concatenate([areas for _, areas in trapezoids] or [np.empty(0)])
    return quads + origin, areas


def _edges(curve: Array, polygon: int) -> tuple[Array, Array]:
    """Return the edges that are not vertical, from left to right, shape (k, 2, 2).

    Also their windings around points above them, shape (k, 2): of P, of Q.
    """
    edges = np.stack([curve, np.roll(curve, -1, axis=0)], axis=1)
    edges = edges[edges[:, 0, 0] != edges[:, 1, 0]]
    falls = edges[:, 0, 0] > edges[:, 1, 0]
    edges[falls] = edges[falls, ::-1]
    windings = np.zeros((len(edges), 2))
    windings[:, polygon] = np.where(falls, -1, 1)
    return edges, windings


def _crossings(edges: Array) -> Array:
    """Return the x at which two edges cross."""
    a, d = edges[:, 0], edges[:, 1] - edges[:, 0]
    slope = d[:, 1] / d[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = a[:, 1] - a[:, 0] * slope
        x = (apart[:, np.newaxis] - apart) / (slope - slope[:, np.newaxis])
    low = np.maximum.outer(edges[:, 0, 0], edges[:, 0, 0])
    high = np.minimum.outer(edges[:, 1, 0], edges[:, 1, 0])
    return np.asarray(x[(x > low) & (x < high)])


def _gaps(edges: Array, windings: Array, left: float, right: float) -> tuple[Array, Array]:
    """Return the gaps between two x that are inside one polygon, and their areas."""
    middle = left + 0.5 * (right - left)
    there = (edges[:, 0, 0] < middle) & (edges[:, 1, 0] > middle)
    edges, windings = edges[there], windings[there]
    at_left, at_middle, at_right = (_heights(edges, x) for x in (left, middle, right))
    order = np.argsort(at_middle, kind="stable")
    is_inside = np.cumsum(windings[order], axis=0)[:-1] != 0
    counts = is_inside[:, 0] != is_inside[:, 1]
    low, high = order[:-1][counts], order[1:][counts]
    corners = [(left, at_left[low]), (right, at_right[low])]
    corners += [(right, at_right[high]), (left, at_left[high])]
    quads = np.stack([np.column_stack([np.full(len(y), x), y]) for x, y in corners], axis=1)
    return quads, (right - left) * (at_middle[high] - at_middle[low])


def _heights(edges: Array, x: float) -> Array:
    """Return the y of all edges at x, which lies on them."""
    a, b = edges[:, 0], edges[:, 1]
    h = (x - a[:, 0]) / (b[:, 0] - a[:, 0])
    return np.asarray(a[:, 1] + h * (b[:, 1] - a[:, 1]))
