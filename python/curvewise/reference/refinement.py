"""Refinement of two curves to the same number of vertices, for the area.

Bisection (the paper's Algorithm 1) repeatedly halves the longest part of the curve with fewer
points, until the numbers agree. A heap finds that part: O((n - m) log m). Refinement by arc length
gives each curve a vertex at every relative arc length at which the other has one, by a merge of the
two lists: O(n + m).
"""

from __future__ import annotations

import heapq
import math

import numpy as np

from .._options import Spacing
from ..curves.arc_length import box_scaled_arc_lengths
from ..curves.inputs import Array
from ..curves.scaling import times_power_of_two

__all__ = ["facing_curves"]


def facing_curves(P: Array, Q: Array, spacing: Spacing, exponent: int) -> tuple[Array, Array]:
    """Return A and B, the curves with as many vertices each; A is the one with more points.

    Both come out in units of 2**exponent. With "arc_length", after which both have more, A is P.
    """
    # This comes first: a coordinate that is small compared with the other may vanish in these
    # units.
    lengths = (
        [_relative_arc_lengths(curve, P) for curve in (P, Q)] if spacing == "arc_length" else []
    )
    P, Q = times_power_of_two(P, -exponent), times_power_of_two(Q, -exponent)
    if lengths:
        return _merged_by_arc_length(_Walk(P, lengths[0]), _Walk(Q, lengths[1]))
    A, B = (P, Q) if len(P) >= len(Q) else (Q, P)
    return A, _bisected(B, len(A) - len(B), spacing)


def _bisected(curve: Array, count: int, spacing: Spacing) -> Array:
    """Return `curve` with `count` more vertices."""
    edges = np.diff(curve, axis=0)
    # Every vertex as the place h along a segment: originals at h = 0, then the cuts.
    places = [(segment, 0.0) for segment in range(len(edges))]
    places += _bisection_cuts(_segment_lengths(edges, spacing), count)
    places.sort()
    segment = np.array([place[0] for place in places])
    h = np.array([place[1] for place in places])[:, np.newaxis]
    return np.concatenate([curve[segment] + h * edges[segment], curve[-1:]])


def _bisection_cuts(lengths: Array, count: int) -> list[tuple[int, float]]:
    """Return the cuts as pairs (segment, place h in it, 0 < h < 1)."""
    # A part of a segment: its length (negative, because a heap has the smallest on top), then the
    # tie-breakers, the segment and its beginning; last, the number of its bisections.
    parts = [(-length, segment, 0.0, 0) for segment, length in enumerate(lengths.tolist())]
    heapq.heapify(parts)
    cuts = []
    for _ in range(count):
        _, segment, begin, times = parts[0]
        times += 1
        length = math.ldexp(lengths[segment], -times)
        middle = begin + math.ldexp(1.0, -times)
        cuts.append((segment, middle))
        heapq.heapreplace(parts, (-length, segment, begin, times))
        heapq.heappush(parts, (-length, segment, middle, times))
    return cuts


def _segment_lengths(edges: Array, spacing: Spacing) -> Array:
    dx, dy = edges.T
    with np.errstate(under="ignore"):
        lengths = np.abs(dx) if spacing == "x" else np.sqrt(dx * dx + dy * dy)
        # To 34 bits: which of two equally long segments comes first must not hang on rounding,
        # lest the area change when both curves are moved.
        mantissa, exponent = np.frexp(lengths)
        return np.asarray(np.ldexp(np.rint(np.ldexp(mantissa, 34)), exponent - 34))


def _merged_by_arc_length(p: _Walk, q: _Walk) -> tuple[Array, Array]:
    A, B = [p.curve[0]], [q.curve[0]]
    while not (p.at_end() and q.at_end()):
        u = min(p.next_u(), q.next_u())
        A.append(p.advance(u))
        B.append(q.advance(u))
    return np.array(A), np.array(B)


def _relative_arc_lengths(curve: Array, box_of: Array) -> Array:
    """Return the arc length of every vertex, 0 to 1, after scaling by a bounding box."""
    lengths = box_scaled_arc_lengths(curve, box_of)
    total = lengths[-1]
    # A curve without a length, or with one beyond a double, stays at its first point to the end.
    u = lengths / total if 0 < total < math.inf else np.zeros(len(curve))
    u[-1] = 1.0
    return u


class _Walk:
    """A curve walked by relative arc length u."""

    def __init__(self, curve: Array, u: Array) -> None:
        self.curve = curve
        self.u = u
        self.vertex = 0

    def at_end(self) -> bool:
        return self.vertex == len(self.curve) - 1

    def next_u(self) -> float:
        """Return the place of the next vertex; infinity after the last."""
        return math.inf if self.at_end() else float(self.u[self.vertex + 1])

    def advance(self, u: float) -> Array:
        """Return the point at u, at most next_u(); pass the vertex that is there."""
        if self.next_u() == u:
            self.vertex += 1
        begin, end = float(self.u[self.vertex]), self.next_u()
        point: Array = self.curve[self.vertex]
        if u == begin:
            return point
        edge: Array = self.curve[self.vertex + 1] - point
        return point + (u - begin) / (end - begin) * edge
