"""The plane measures in numbers of as many bits as it takes (mpmath), for accuracy.py.

Written from the definitions (the paper's Algorithm 1, partial curve mapping, OF2), not from the
library. Only what is decided on rounded numbers by definition is rounded: lengths to 34 bits,
before the longest segment is sought, and the samples that `spacing="matched"` aligns, to 30 bits.
O(n²) and slow: for curves of some thirty points.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise

import mpmath
import numpy as np
from mpmath import mpf

import curvewise
from curvewise.curves.travel import travel_on_grid

mpmath.mp.prec = 2300  # holds 2^1023 + 2^-1074

Point = tuple[mpf, mpf]
Points = list[Point]


def exact(curve: np.ndarray) -> Points:
    return [(mpf(x), mpf(y)) for x, y in curve.tolist()]


def scaled(curve: Points, box_of: Points) -> Points:
    """Return the curve in units of a box; a direction in which it has no extent is not scaled."""
    sides = []
    for c in range(2):
        low, high = min(p[c] for p in box_of), max(p[c] for p in box_of)
        sides.append((low, high - low if high > low else mpf(1)))
    return [((x - sides[0][0]) / sides[0][1], (y - sides[1][0]) / sides[1][1]) for x, y in curve]


def lengths(curve: Points) -> list[mpf]:
    steps = [mpmath.sqrt((c - a) ** 2 + (d - b) ** 2) for (a, b), (c, d) in pairwise(curve)]
    return [mpf(0), *accumulate(steps)]


def between(a: Point, b: Point, h: mpf) -> Point:
    return a[0] + h * (b[0] - a[0]), a[1] + h * (b[1] - a[1])


def at_length(curve: Points, s: Sequence[mpf], u: mpf) -> Point:
    """Return the point at arc length u, cut at the curve's ends."""
    for k in range(len(s) - 1):
        if u <= s[k + 1] and s[k + 1] > s[k]:
            return between(curve[k], curve[k + 1], (u - s[k]) / (s[k + 1] - s[k]))
    return curve[-1]


def rounded(length: mpf, bits: int) -> mpf:
    if length == 0:
        return length
    exponent = bits - int(mpmath.floor(mpmath.log(length, 2))) - 1
    return mpmath.ldexp(mpmath.nint(mpmath.ldexp(length, exponent)), -exponent)


def refined(curve: Points, count: int, spacing: str) -> Points:
    """Bisect the longest part, the first among equals, until there are `count` points."""
    parts = []  # length, ends
    for a, b in pairwise(curve):
        dx, dy = b[0] - a[0], b[1] - a[1]
        length = abs(dx) if spacing == "x" else mpmath.sqrt(dx * dx + dy * dy)
        parts.append((rounded(length, 34), a, b))
    while len(parts) < count - 1:
        k = max(range(len(parts)), key=lambda k: parts[k][0])
        length, a, b = parts[k]
        middle = between(a, b, mpf(0.5))
        parts[k : k + 1] = [(length / 2, a, middle), (length / 2, middle, b)]
    return [curve[0], *(b for _, _, b in parts)]


def facing(P: Points, Q: Points, spacing: str) -> tuple[Points, Points]:
    if spacing != "arc_length":
        count = max(len(P), len(Q))
        longer, shorter = (P, Q) if len(P) >= len(Q) else (Q, P)
        return refined(longer, count, spacing), refined(shorter, count, spacing)
    s, t = lengths(scaled(P, P)), lengths(scaled(Q, P))
    relative = sorted({a / s[-1] for a in s} | {b / t[-1] for b in t})
    return (
        [at_length(P, s, r * s[-1]) for r in relative],
        [at_length(Q, t, r * t[-1]) for r in relative],
    )


def cross(a: Point, b: Point) -> mpf:
    return a[0] * b[1] - a[1] * b[0]


def minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1]


def is_simple(quad: Points) -> bool:
    edges = [minus(quad[(k + 1) % 4], quad[k]) for k in range(4)]
    turns = [cross(edges[k], edges[(k + 1) % 4]) for k in range(4)]
    return sum(turn >= 0 for turn in turns) >= 3 or sum(turn <= 0 for turn in turns) >= 3


def gauss(quad: Points) -> mpf:
    return cross(minus(quad[2], quad[0]), minus(quad[3], quad[1])) / 2


def quad_area(quad: Points) -> mpf:
    """Return the area; of a complex one with vertices swapped."""
    A, B, C, D = quad
    if not is_simple(quad):
        quad = [B, A, C, D]
        if not is_simple(quad):
            quad = [A, C, B, D]
    return abs(gauss(quad))


def area(P: Points, Q: Points, spacing: str) -> mpf:
    if spacing == "matched":
        return matched_area(P, Q)
    A, B = facing(P, Q, spacing)
    quads = zip(A, A[1:], B[1:], B, strict=False)
    return mpmath.fsum(quad_area(list(quad)) for quad in quads)


def matched_area(P: Points, Q: Points) -> mpf:
    """Return the sum over the pieces of a warping path, each with its areas' signs."""
    p, q = scaled(P, P), scaled(Q, P)
    on_grid = [[float(mpmath.nint(x * 2**30)) for x in side] for side in zip(*p, strict=True)]
    boxes = sum(travel_on_grid(np.array(side) / 2.0**30) for side in on_grid) / 2.0**30
    pieces = max(1, math.ceil(10 * boxes))
    samples = 5 * pieces
    at_p = [s / lengths(p)[-1] * samples for s in lengths(p)]
    at_q = [s / lengths(q)[-1] * samples for s in lengths(q)]
    path = curvewise.dtw_path(
        sampled(p, at_p, samples), sampled(q, at_q, samples), metric="cityblock"
    ).path.tolist()
    cuts = [mpf(10 * k) for k in range(1, pieces + 1)]
    places = sorted(
        {mpf(i + j) for i, j in path}
        | set(cuts)
        | set(places_of(at_p, path))
        | set(places_of(at_q, [(j, i) for i, j in path]))
    )
    A = [at_length(P, at_p, on_path(place, path, 0)) for place in places]
    B = [at_length(Q, at_q, on_path(place, path, 1)) for place in places]
    total, piece = mpf(0), mpf(0)
    for k in range(len(places) - 1):
        piece += gauss([A[k], A[k + 1], B[k + 1], B[k]])
        if places[k + 1] in cuts:
            total, piece = total + abs(piece), mpf(0)
    return total


def sampled(curve: Points, positions: list[mpf], samples: int) -> np.ndarray:
    points = [at_length(curve, positions, mpf(k)) for k in range(samples + 1)]
    return np.array([[float(mpmath.nint(x * 2**30)) for x in point] for point in points])


def places_of(positions: list[mpf], path: list[Sequence[int]]) -> list[mpf]:
    """Return where along the path the vertices lie that lie between samples."""
    places = []
    for at in positions:
        if mpmath.isint(at):
            continue
        for (i, j), (i_next, j_next) in pairwise(path):
            if i < at < i_next:
                places.append(i + j + (at - i) * (1 + j_next - j))
    return places


def on_path(place: mpf, path: list[Sequence[int]], side: int) -> mpf:
    """Return the position of P (side 0) or Q (1) at a place i + j."""
    for cell, after in pairwise(path):
        low, high = sum(cell), sum(after)
        if place <= high:
            return cell[side] + (place - low) / (high - low) * (after[side] - cell[side])
    return mpf(path[-1][side])


def pcm(P: Points, Q: Points, offsets: int) -> mpf:
    p, q = scaled(P, P), scaled(Q, P)
    s, t = lengths(p), lengths(q)
    if s[-1] - t[-1] > mpf(10) ** -12 * s[-1]:
        p, q, s, t = q, p, t, s
    slack = max(t[-1] - s[-1], mpf(0))
    areas = []
    for k in range(offsets):
        offset = slack * k / max(offsets - 1, 1)
        d = [
            mpmath.hypot(*minus(at_length(q, t, min(u + offset, t[-1])), point))
            for u, point in zip(s, p, strict=True)
        ]
        parts = ((d[i] + d[i + 1]) / 2 * (s[i + 1] - s[i]) for i in range(len(s) - 1))
        areas.append(mpmath.fsum(parts))
    return min(areas)


def curve_length(P: Points, Q: Points) -> mpf:
    """Return OF2, with scale="range"."""

    def in_own_units(curve: Points) -> Points:
        x, y = (max(abs(p[c]) for p in curve) or mpf("1e-15") for c in range(2))
        return [(a / x, b / y) for a, b in curve]

    s, t = lengths(in_own_units(P)), lengths(in_own_units(Q))
    ranges = [max(p[c] for p in P) - min(p[c] for p in P) for c in range(2)]
    total = mpf(0)
    for u, point in zip(s, P, strict=True):
        found = at_length(Q, t, u * t[-1] / s[-1])
        for c in range(2):
            total += mpmath.log1p(abs((point[c] - found[c]) / ranges[c])) ** 2
    return mpmath.sqrt(total)
