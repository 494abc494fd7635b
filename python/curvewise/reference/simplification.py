"""Simplification of a curve: every edge between two vertices is tried.

The fewest points under the continuous Fréchet distance are a shortest path through all edges that
are within the tolerance of their sections (Imai & Iri, 1988). It is found from the last vertex
backwards: time O(n^3). Douglas & Peucker (1973) split recursively: time O(n^2). Distances are
compared with the tolerance in whole numbers of any size. Memory O(n).
"""

from __future__ import annotations

import numpy as np

from ..curves.checks import checked_curve
from ..curves.inputs import Array, CurveLike
from .frechet_continuous import frechet_within

__all__ = ["simplified_rows"]


def simplified_rows(curve: CurveLike, tolerance: float, measure: str = "frechet") -> list[int]:
    """Return the indices of the kept points; see :func:`curvewise.curves.simplify`."""
    points = checked_curve(curve, 1)
    last = len(points) - 1
    if measure == "frechet":
        return _fewest(points, tolerance)
    return sorted({0, last, *_splits(points, tolerance, 0, last)})


def _fewest(points: Array, tolerance: float) -> list[int]:
    """Return the fewest vertices, each followed by the last possible one."""
    last = len(points) - 1
    edges = {last: 0}  # how many lead from a vertex to the last one
    following: dict[int, int] = {}
    for i in range(last - 1, -1, -1):
        reachable = [
            j
            for j in range(i + 1, last + 1)
            if frechet_within(points[i : j + 1], points[[i, j]], tolerance)
        ]
        following[i] = max(reachable, key=lambda j: (-edges[j], j))
        edges[i] = edges[following[i]] + 1
    rows = [0]
    while rows[-1] < last:
        rows.append(following[rows[-1]])
    return rows


def _splits(points: Array, tolerance: float, start: int, end: int) -> list[int]:
    """Return the vertices at which a section is split, until every edge is near its section."""
    edge = points[[start, end]]
    inside = points[start + 1 : end]
    # A point and an edge are within the tolerance if a curve through the point and both ends is.
    if all(frechet_within(np.array([edge[0], x, edge[1]]), edge, tolerance) for x in inside):
        return []
    split = start + 1 + int(np.argmax([_square_distance(x, *edge) for x in inside]))
    return [
        split,
        *_splits(points, tolerance, start, split),
        *_splits(points, tolerance, split, end),
    ]


def _square_distance(x: Array, start: Array, end: Array) -> float:
    """Return the square of the distance of a point and an edge, in the library's order."""
    length = product = total = 0.0
    for a, b, c in zip(start.tolist(), end.tolist(), x.tolist(), strict=True):
        length += (b - a) * (b - a)
        product += (b - a) * (c - a)
    # The square of so short an edge has no correct digits.
    t = 0.5 if length < 2.0**-960 else min(max(product * (1.0 / length), 0.0), 1.0)
    for a, b, c in zip(start.tolist(), end.tolist(), x.tolist(), strict=True):
        h = (c - a) - t * (b - a)
        total += h * h
    return total
