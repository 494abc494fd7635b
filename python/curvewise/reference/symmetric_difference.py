"""The area that exactly one of two closed curves encloses, slab by slab.

The even-odd rule for the edges of both curves together gives the symmetric difference. Between
neighbouring x of points and of crossings, edges have a fixed order, and every second gap is
enclosed. All pairs of edges are tested for crossings: time O((n + m)² (n + m + k)), memory O((n +
m)²).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import range_exponent, times_power_of_two
from .checks import check_pair

__all__ = ["symmetric_difference"]


def symmetric_difference(P: CurveLike, Q: CurveLike) -> float:
    """Even-odd rule, by slabs between all x of points and crossings (Shamos & Hoey, 1976)."""
    P, Q = as_curves(P, Q)
    P, Q = check_pair(P, Q, "symmetric_difference", planar=True)
    exponent = range_exponent(P, Q)
    edges = np.concatenate([_edges(times_power_of_two(curve, -exponent)) for curve in (P, Q)])
    x = np.unique(np.concatenate([edges[:, :, 0].ravel(), _crossings(edges)]))
    total = sum(
        (right - left) * _enclosed(edges, left + 0.5 * (right - left))
        for left, right in pairwise(x)
    )
    return float(times_power_of_two(np.asarray(float(total)), 2 * exponent))


def _edges(curve: Array) -> Array:
    """Return the edges that are not vertical, from left to right, shape (k, 2, 2)."""
    edges = np.stack([curve, np.roll(curve, -1, axis=0)], axis=1)
    edges = edges[edges[:, 0, 0] != edges[:, 1, 0]]
    falls = edges[:, 0, 0] > edges[:, 1, 0]
    edges[falls] = edges[falls, ::-1]
    return np.asarray(edges)


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


def _enclosed(edges: Array, x: float) -> float:
    """Return how much of the line at x is enclosed."""
    a, b = edges[:, 0], edges[:, 1]
    there = (a[:, 0] < x) & (b[:, 0] > x)
    a, b = a[there], b[there]
    h = (x - a[:, 0]) / (b[:, 0] - a[:, 0])
    heights = np.sort(a[:, 1] + h * (b[:, 1] - a[:, 1]))
    return float(np.sum(heights[1::2] - heights[::2]))
