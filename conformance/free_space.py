"""The free-space diagram of two polygonal curves, in fractions.

A leash is long enough where a way that goes only up and to the right leads through the pairs of
points within it (Alt & Godau 1995). The free part of an edge begins and ends at a + root(b) times
the inverse of its squared length, with rational a and b; two of these are compared by squaring, so
that nothing is rounded. Time and memory O(n m).
"""

from __future__ import annotations

from fractions import Fraction

Point = tuple[Fraction, ...]
Curve = list[Point]
Position = tuple[Fraction, Fraction]  # a + root(b), in units of the edge's squared length
Part = tuple[Position, Position] | None


def square(p: Point, q: Point) -> Fraction:
    """Return the squared distance of two points."""
    return sum(((x - y) ** 2 for x, y in zip(p, q, strict=True)), Fraction(0))


def sign(x: Fraction | int) -> int:
    """Return -1, 0 or 1."""
    return (x > 0) - (x < 0)


def sign_with_roots(a: Fraction, b: Fraction, c: Fraction) -> int:
    """Return the sign of a + root(b) + root(c), where root(-x) = -sqrt(x) for x > 0."""
    roots = sign(b + c)
    if sign(a) * roots >= 0:
        return sign(a) or roots
    # a^2 against the square of the roots, which is |b| + |c| + 2 root(b c)
    e, f = a * a - abs(b) - abs(c), 4 * b * c
    larger = sign(sign(e) * e * e - f)
    return sign(a) if larger > 0 else roots if larger < 0 else 0


def is_before(x: Position, y: Position) -> bool:
    """Return whether a position is before another one of the same edge."""
    return sign_with_roots(x[0] - y[0], x[1], -y[1]) < 0


def free_part(x: Point, y: Point, z: Point, value: Fraction) -> tuple[Position, Position] | None:
    """Return the part of the edge from x to y whose squared distance from z is <= value."""
    u = [b - a for a, b in zip(x, y, strict=True)]
    w = [b - a for a, b in zip(x, z, strict=True)]
    length = sum((a * a for a in u), Fraction(0))
    begin, end = (Fraction(0), Fraction(0)), (length, Fraction(0))
    if length == 0:
        return (begin, end) if square(x, z) <= value else None
    along = sum((a * b for a, b in zip(u, w, strict=True)), Fraction(0))
    under = along * along - length * (square(x, z) - value)
    low, high = (along, -under), (along, under)
    if under < 0 or is_before(high, begin) or is_before(end, low):
        return None
    return (max_position(begin, low), end if is_before(end, high) else high)


def max_position(x: Position, y: Position) -> Position:
    """Return the later one of two positions."""
    return y if is_before(x, y) else x


def reachable(P: Curve, Q: Curve, value: Fraction) -> tuple[list[list[Part]], list[list[Part]]]:
    """Return what monotone ways reach of the sides of the free-space diagram's cells.

    The first table is of P's vertices and Q's edges, the second of P's edges and Q's vertices.
    """
    n, m = len(P), len(Q)
    at_P: list[list[Part]] = [[None] * (m - 1) for _ in range(n)]
    at_Q: list[list[Part]] = [[None] * m for _ in range(n - 1)]
    for j in range(m - 1):
        part = free_part(Q[j], Q[j + 1], P[0], value)
        begun = square(P[0], Q[0]) <= value if j == 0 else at_P[0][j - 1] is not None
        if begun and square(P[0], Q[j]) <= value:
            at_P[0][j] = part
    for i in range(n - 1):
        part = free_part(P[i], P[i + 1], Q[0], value)
        begun = square(P[0], Q[0]) <= value if i == 0 else at_Q[i - 1][0] is not None
        if begun and square(P[i], Q[0]) <= value:
            at_Q[i][0] = part
    for i in range(n - 1):
        for j in range(m - 1):
            left, below = at_P[i][j], at_Q[i][j]
            right = free_part(Q[j], Q[j + 1], P[i + 1], value)
            above = free_part(P[i], P[i + 1], Q[j + 1], value)
            at_P[i + 1][j] = entered(right, below, left)
            at_Q[i][j + 1] = entered(above, left, below)
    return at_P, at_Q


def entered(free: Part, beside: Part, opposite: Part) -> Part:
    """Return the part of a side that is reached from the side beside it and the one opposite."""
    if free is None or (beside is None and opposite is None):
        return None
    if beside is not None or opposite is None:
        return free
    low = max_position(free[0], opposite[0])
    return None if is_before(free[1], low) else (low, free[1])


def with_edges(curve: Curve) -> Curve:
    """Return a curve that has an edge: a single point twice."""
    return curve * 2 if len(curve) == 1 else curve


def has_way(P: Curve, Q: Curve, value: Fraction) -> bool:
    """Return whether a leash whose squared length is the value is long enough."""
    P, Q = with_edges(P), with_edges(Q)
    if square(P[-1], Q[-1]) > value:
        return False
    at_P, at_Q = reachable(P, Q, value)
    return at_P[-1][-1] is not None or at_Q[-1][-1] is not None
