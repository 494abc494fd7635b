"""The value of a check for two curves, and its certificate, in exact arithmetic.

Textbook algorithms on fractions: tables for dtw and the discrete Fréchet distance; for the
continuous one the squares at which the free-space diagram changes (Alt & Godau 1995), all of them
rational, and a bisection of their list. make.py writes with it, run.py shrinks counterexamples
with it; verify.py checks what comes out and knows nothing of it. O(n m), of
frechet-continuous O(n m (n + m) log).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import Any

from free_space import (
    Curve,
    Part,
    Point,
    Position,
    has_way,
    is_before,
    reachable,
    square,
    with_edges,
)
from verify import CHECKS, Terms, Warping, cross, enclosure, exact_curve, is_simple

Certified = tuple[Terms, dict[str, Any]]
ONE = Fraction(1)


def certify(
    check: str,
    P: Sequence[Sequence[float]],
    Q: Sequence[Sequence[float]],
    parameters: dict[str, Any],
) -> Certified | None:
    """Return the value's terms and its certificate; None where no path fits."""
    record = CHECKS[check]
    curves = exact_curve(P), exact_curve(Q)
    if record["measure"] == "dtw":
        return _dtw(Warping(record, parameters, *curves))
    if record["measure"] == "hausdorff":
        return _hausdorff(*curves, directed=record.get("directed", False))
    simple: dict[str, Callable[[Curve, Curve], Certified]] = {
        "frechet": _frechet,
        "frechet-continuous": _continuous,
        "area": _area,
    }
    return simple[record["measure"]](*curves)


def nearest_double(terms: Terms) -> float:
    """Return the double nearest to a value."""
    low, high = enclosure(terms)
    if float(low) != float(high):
        raise ValueError("160 bits do not say which double is the nearest")
    return float(low)


# Dynamic time warping


def _dtw(warping: Warping) -> Certified | None:
    """Fill two tables: the first says how large the value is, so how fine potentials must be."""
    costs = [
        high
        for i in range(warping.n)
        for j in range(warping.m)
        for high in enclosure(warping.cost(i, j, None))
    ]
    whole = min((_power_of_two(x) for x in costs if x), default=0)
    if warping.penalty:
        whole = min(whole, _power_of_two(warping.penalty))
    found = _table(warping, whole)
    if found is None:
        return None
    value = sum(enclosure(found[1])[1:], Fraction(0))
    irrational = any(low != high for low, high in zip(costs[::2], costs[1::2], strict=True))
    unit = whole
    if irrational and value:
        unit = math.frexp(float(value))[1] - 76
        found = _table(warping, unit)
    assert found is not None
    table, paid, path = found
    rows = [[None if x is None else str(x) for x in row] for row in table]
    return warping.value(paid), {"path": path, "unit": unit, "potentials": rows}


def _power_of_two(x: Fraction) -> int:
    """Return the exponent of the largest power of two of which a dyadic fraction is a multiple."""
    n, d = x.numerator, x.denominator
    return (n & -n).bit_length() - d.bit_length()


_Table = list[list[int | None]]


def _table(warping: Warping, unit: int) -> tuple[_Table, Terms, list[tuple[int, int]]] | None:
    """Return the table of costs rounded down to units, a best path's costs, and that path."""
    table: _Table = [[None] * warping.m for _ in range(warping.n)]
    entry: dict[tuple[int, int], tuple[int, int] | None] = {}
    for i in range(warping.n):
        for j in range(warping.m):
            if not warping.has(i, j):
                continue
            ways: list[tuple[int, tuple[int, int] | None]] = []
            if warping.begins(i, j):
                ways.append((_units(warping.cost(i, j, None), unit), None))
            for step in warping.steps:
                k, h = i - step[0], j - step[1]
                before = table[k][h] if k >= 0 and h >= 0 else None
                if before is not None:
                    ways.append((before + _units(warping.cost(i, j, step), unit), step))
            if ways:
                table[i][j], entry[i, j] = min(ways, key=lambda way: way[0])
    last = warping.n - 1
    ends = [j for j in range(warping.m) if warping.ends(last, j) and (last, j) in entry]
    if not ends:
        return None
    cell = (last, min(ends, key=lambda j: table[last][j] or 0))
    path, paid = [], []
    while True:
        step = entry[cell]
        path.insert(0, cell)
        paid += warping.cost(*cell, step)
        if step is None:
            return table, paid, path
        cell = (cell[0] - step[0], cell[1] - step[1])


def _units(terms: Terms, unit: int) -> int:
    return math.floor(enclosure(terms, 400)[0] / Fraction(2) ** unit)


# Distances of points


def _frechet(P: Curve, Q: Curve) -> Certified:
    n, m = len(P), len(Q)
    far = {(i, j): square(P[i], Q[j]) for i in range(n) for j in range(m)}
    table: dict[tuple[int, int], Fraction] = {}
    entry: dict[tuple[int, int], tuple[int, int]] = {}
    for i, j in far:
        before = [c for c in ((i - 1, j - 1), (i - 1, j), (i, j - 1)) if c in table]
        table[i, j] = far[i, j]
        if before:
            entry[i, j] = min(before, key=lambda c: table[c])
            table[i, j] = max(far[i, j], table[entry[i, j]])
    cell = (n - 1, m - 1)
    value, coupling = table[cell], [cell]
    while cell in entry:
        cell = entry[cell]
        coupling.insert(0, cell)
    # What is nearer than the value can be walked from the beginning as far as these cells.
    near = {c for c in far if table[c] < value}
    after = {(i + a, j + b) for i, j in near for a, b in ((0, 1), (1, 0), (1, 1))} | {(0, 0)}
    blocked = sorted(c for c in after if c in far and far[c] >= value)
    return [(ONE, value)], {"coupling": coupling, "blocked": blocked}


def _hausdorff(P: Curve, Q: Curve, directed: bool) -> Certified:
    partners, worst = {}, []
    for side, points, others in (("P", P, Q), ("Q", Q, P))[: 1 if directed else 2]:
        near = [min(range(len(others)), key=lambda k: square(p, others[k])) for p in points]
        partners[side] = near
        for index, (p, k) in enumerate(zip(points, near, strict=True)):
            worst.append((square(p, others[k]), side, index))
    value, side, index = max(worst, key=lambda x: x[0])
    return [(ONE, value)], {"farthest": [side, index], "partners": partners}


# The Fréchet distance of polygonal curves


def _continuous(P: Curve, Q: Curve) -> Certified:
    ends = max(square(P[0], Q[0]), square(P[-1], Q[-1]))
    squares = sorted({ends, *(x for x in _critical(with_edges(P), with_edges(Q)) if x > ends)})
    low, high = 0, len(squares) - 1
    while low < high:
        middle = (low + high) // 2
        if has_way(P, Q, squares[middle]):
            high = middle
        else:
            low = middle + 1
    value = squares[low]
    matching = [[str(s), str(t)] for s, t in _matching(P, Q, value)]
    return [(ONE, value)], {"matching": matching}


def _critical(P: Curve, Q: Curve) -> Iterator[Fraction]:
    """Yield the squares at which a side opens, or a monotone way between two sides."""
    for points, edges in ((P, Q), (Q, P)):
        for x, y in itertools.pairwise(edges):
            u = tuple(b - a for a, b in zip(x, y, strict=True))
            length = _dot(u, u)
            for i, p in enumerate(points):
                yield square(p, x)
                yield square(p, y)
                if length == 0:
                    continue
                t = _dot(u, tuple(b - a for a, b in zip(x, p, strict=True))) / length
                if 0 < t < 1:
                    yield square(p, _between(x, y, t))
                for q in points[i + 1 :]:
                    # where the edge is as far from p as from q
                    slope = 2 * _dot(u, tuple(b - a for a, b in zip(p, q, strict=True)))
                    t = (square(q, x) - square(p, x)) / slope if slope else Fraction(-1)
                    if 0 <= t <= 1:
                        yield square(p, _between(x, y, t))


def _dot(u: Point, v: Point) -> Fraction:
    return sum((a * b for a, b in zip(u, v, strict=True)), Fraction(0))


def _between(x: Point, y: Point, t: Fraction) -> Point:
    return tuple(a + t * (b - a) for a, b in zip(x, y, strict=True))


def _matching(P: Curve, Q: Curve, value: Fraction) -> list[tuple[Fraction, Fraction]]:
    """Go back from the end through sides that are reached, at rational places."""
    E, F = with_edges(P), with_edges(Q)
    at_P, at_Q = reachable(E, F, value)
    i, j = len(E) - 2, len(F) - 2
    s, t = Fraction(len(E) - 1), Fraction(len(F) - 1)
    rows = [(s, t)]
    while (i, j) != (0, 0):
        left = _at_most(at_P[i][j], square(F[j], F[j + 1]), t - j) if i or j else None
        below = _at_most(at_Q[i][j], square(E[i], E[i + 1]), s - i)
        if left is not None and i > 0:
            s, t, i = Fraction(i), j + left, i - 1
        else:
            assert below is not None
            s, t, j = i + below, Fraction(j), j - 1
        rows.insert(0, (s, t))
    rows.insert(0, (Fraction(0), Fraction(0)))
    last = (len(P) - 1, len(Q) - 1)
    return [(min(a, Fraction(last[0])), min(b, Fraction(last[1]))) for a, b in rows]


def _at_most(part: Part, length: Fraction, limit: Fraction) -> Fraction | None:
    """Return a rational fraction of an edge in its reached part, the limit or below."""
    if part is None:
        return None
    if length == 0:
        return Fraction(0)
    low, high = part
    if not is_before((limit * length, Fraction(0)), low):
        if not is_before(high, (limit * length, Fraction(0))):
            return limit
        for bits in (4, 16, 64, 256, 1024):
            root = _root_below(high, bits)
            if not is_before((root, Fraction(0)), low):
                return root / length
        raise ArithmeticError("a part of an edge is too short")
    return None


def _root_below(position: Position, bits: int) -> Fraction:
    """Return a rational number near a + root(b), not above it; the number itself if it is one."""
    a, b = position
    low, high = enclosure([(ONE, abs(b))], bits)
    return a + (low if b > 0 else -high)


# The area between two curves


def _area(P: Curve, Q: Curve) -> Certified:
    more, fewer = (P, Q) if len(P) >= len(Q) else (Q, P)
    segments = list(itertools.pairwise(fewer))
    depths = [[0] for _ in segments]
    for _ in range(len(more) - len(fewer)):
        lengths = [
            (square(*segments[k]) / 4**depth, -k, -place)
            for k, row in enumerate(depths)
            for place, depth in enumerate(row)
        ]
        _, k, place = max(lengths)  # the least place among equals, since places are negated
        row = depths[-k]
        row[-place : 1 - place] = [row[-place] + 1] * 2
    refined = [fewer[0]]
    for (x, y), row in zip(segments, depths, strict=True):
        at = Fraction(0)
        for depth in row:
            at += Fraction(1, 2**depth)
            refined.append(_between(x, y, at))
    quadrilaterals, total = [], Fraction(0)
    for i in range(len(more) - 1):
        corners = (more[i], more[i + 1], refined[i + 1], refined[i])
        order = [0, 1, 2, 3]
        if not is_simple(corners):
            swapped = [corners[k] for k in (1, 0, 2, 3)]
            order = [1, 0, 2, 3] if is_simple(swapped) else [0, 2, 1, 3]
        a, b, c, d = (corners[k] for k in order)
        area = abs(cross(a, c, b, d)) / 2
        quadrilaterals.append([order, str(area)])
        total += area
    return [(total, ONE)], {"depths": depths, "quadrilaterals": quadrilaterals}
