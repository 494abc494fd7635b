"""The continuous Fréchet distance: the shortest leash for two walks along the curves themselves.

A leash of length r is long enough where a path that goes only up and to the right leads through
the free space, the pairs of points at most r apart (Alt & Godau, 1995). The diagram has a cell for
every edge of P and edge of Q, and the free space of a cell is convex: what is reached of a side of
it is an interval that ends where the free part of that side ends. The value is the least double
that is long enough, found by bisection on the bit patterns of doubles, whose order is that of
their values.

Nothing is rounded. All coordinates and r are whole multiples of one power of two, and a position
on an edge, times the square of its length, is a + s sqrt(c) with whole a and c and s of -1, 0 or
1; two of these are compared by squaring. Time O(n m) a decision, of which a value takes 63; memory
O(n m).
"""

from __future__ import annotations

import math
import struct
from fractions import Fraction
from typing import SupportsFloat, TypeAlias

import numpy as np

from .._curves import Array, CurveLike, as_curves
from .checks import check_pair

__all__ = ["frechet_continuous", "frechet_within"]

_Point: TypeAlias = list[int]


def frechet_continuous(
    P: CurveLike, Q: CurveLike, *, bounds: bool = False
) -> float | tuple[float, float]:
    """Continuous Fréchet distance.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d), or (n,) and (m,)
        The vertices of polygonal curves, of any d.
    bounds : bool, default False
        Return the interval that holds the distance instead of its upper end.

    Returns
    -------
    float, or tuple of two floats
        The least double that is not below the distance, in the unit of the coordinates; with
        `bounds`, the greatest that is not above it and that. Symmetric.

    Raises
    ------
    ValueError
        A curve is not finite or empty; the curves differ in d.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Time 63 n m steps in whole numbers of any size, memory O(n m). Alt & Godau, "Computing the
    Fréchet distance between two polygonal curves" (1995).

    Examples
    --------
    >>> from curvewise import reference
    >>> reference.frechet_continuous([(0, 0), (10, 0)], [(0, 0), (7, 0), (3, 0), (10, 0)])
    2.0
    """
    P, Q = check_pair(*as_curves(P, Q), "frechet_continuous")
    low, high = -1, _bits(math.inf)  # too short, and long enough
    while high - low > 1:
        middle = (low + high) // 2
        if _is_long_enough(P, Q, _double(middle)):
            high = middle
        else:
            low = middle
    value = _double(high)
    if not bounds:
        return value
    is_exact = math.isfinite(value) and not _is_long_enough(P, Q, value, strictly=True)
    return (value if is_exact else _double(low)), value


def frechet_within(
    P: CurveLike, Q: CurveLike, distance: SupportsFloat, *, continuous: bool = True
) -> bool:
    """Whether the Fréchet distance is at most a number.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d), or (n,) and (m,)
        The curves, of any d.
    distance : float
        The number, at least 0.
    continuous : bool, default True
        Whether the distance meant is the continuous one, or the discrete one.

    Returns
    -------
    bool
        Exact: of the real number, not of a rounded one.

    Raises
    ------
    ValueError
        `distance` is below 0 or nan; a curve is not finite or empty; the curves differ in d.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Time and memory O(n m), in whole numbers of any size.

    Examples
    --------
    >>> from curvewise import reference
    >>> P, Q = [(0, 0), (10, 0)], [(0, 0), (7, 0), (3, 0), (10, 0)]
    >>> reference.frechet_within(P, Q, 2), reference.frechet_within(P, Q, 1.9999)
    (True, False)
    """
    P, Q = as_curves(P, Q)
    distance = float(distance)
    if not distance >= 0:
        raise ValueError(f"distance is {distance:g}; give a number >= 0")
    P, Q = check_pair(P, Q, "frechet_within")
    return _is_long_enough(P, Q, distance) if continuous else _is_coupled(P, Q, distance)


class _Position:
    """A point of an edge: its distance from the first vertex, times the length of the edge.

    This is `a` plus the square root of `c`, or minus that of -`c`, where `c` is below 0.
    """

    def __init__(self, a: int, c: int = 0) -> None:
        self.a, self.c = a, c

    def __lt__(self, other: _Position) -> bool:
        return _sign_with_roots(self.a - other.a, self.c, -other.c) < 0

    def __le__(self, other: _Position) -> bool:
        return not other < self


_Part: TypeAlias = tuple[_Position, _Position] | None
"""What is free, or reached, of an edge: from one position to another, or nothing."""


class _Diagram:
    """The free-space diagram of two curves in whole numbers."""

    def __init__(self, P: Array, Q: Array, radius: float, strictly: bool = False) -> None:
        unit = max(_exponent(x) for x in (*P.flat, *Q.flat, radius))
        self.P, self.Q = ([[_whole(x, unit) for x in point] for point in C] for C in (P, Q))
        self.square = _whole(radius, unit) ** 2
        self.strictly = strictly

    def is_free(self, i: int, j: int) -> bool:
        """Whether the leash holds P[i] and Q[j]."""
        square = _dot(w := _minus(self.P[i], self.Q[j]), w)
        return square < self.square or (square == self.square and not self.strictly)

    def free(self, x: _Point, y: _Point, z: _Point, reached: _Position | None = None) -> _Part:
        """What of the edge from `x` to `y` is within reach of `z`, from `reached` on."""
        u, w = _minus(y, x), _minus(z, x)
        length, middle = _dot(u, u), _dot(u, w)
        half = middle**2 - length * (_dot(w, w) - self.square)
        if length == 0:
            excess = _dot(w, w) - self.square
            is_free = excess < 0 or (excess == 0 and not self.strictly)
            return (_Position(0), _Position(0)) if is_free else None
        if half < 0:
            return None
        low = max(_Position(0), _Position(middle, -half))
        low = low if reached is None else max(low, reached)
        high = min(_Position(length), _Position(middle, half))
        return (low, high) if low < high or (low <= high and not self.strictly) else None


def _is_long_enough(P: Array, Q: Array, radius: float, *, strictly: bool = False) -> bool:
    """Whether a path leads through the free space; `strictly`: through its inside."""
    if math.isinf(radius):
        return True
    P, Q = (np.repeat(C, 2, axis=0) if len(C) == 1 else C for C in (P, Q))
    diagram = _Diagram(P, Q, radius, strictly)
    n, m = len(P) - 1, len(Q) - 1  # edges
    if not (diagram.is_free(0, 0) and diagram.is_free(n, m)):
        return False
    p, q = diagram.P, diagram.Q
    # What is reached of the lower sides of the cells (i, j), i = 0: as far as all is free.
    lower: list[_Part] = []
    for j in range(m):
        starts = diagram.is_free(0, j) and (j == 0 or lower[-1] is not None)
        lower.append(diagram.free(q[j], q[j + 1], p[0]) if starts else None)
    left_end_is_reached = True
    for i in range(n):
        left_end_is_reached = left_end_is_reached and diagram.is_free(i, 0)
        left = diagram.free(p[i], p[i + 1], q[0]) if left_end_is_reached else None
        for j in range(m):
            # Cell (i, j): its upper and right sides, from its lower and left ones.
            below, beside = lower[j], left
            lower[j] = left = None
            if beside is not None:
                lower[j] = diagram.free(q[j], q[j + 1], p[i + 1])
                left = diagram.free(p[i], p[i + 1], q[j + 1], beside[0])
            if below is not None:
                left = diagram.free(p[i], p[i + 1], q[j + 1])
                if beside is None:
                    lower[j] = diagram.free(q[j], q[j + 1], p[i + 1], below[0])
    return lower[-1] is not None


def _is_coupled(P: Array, Q: Array, radius: float) -> bool:
    """Whether a coupling of the vertices keeps the leash."""
    if math.isinf(radius):
        return True
    diagram = _Diagram(P, Q, radius)
    reached: list[bool] = []
    for i in range(len(P)):
        above, reached = reached, []
        for j in range(len(Q)):
            comes = (i == 0 and j == 0) or (i > 0 and (above[j] or (j > 0 and above[j - 1])))
            reached.append((comes or (j > 0 and reached[-1])) and diagram.is_free(i, j))
    return reached[-1]


def _sign(x: int) -> int:
    return (x > 0) - (x < 0)


def _sign_with_roots(x: int, c: int, e: int = 0) -> int:
    """Return the sign of x + sqrt(c) + sqrt(e), where the root of -c is minus that of c."""
    whole, roots = _sign(x), _sign(c + e)
    if whole * roots >= 0:
        return whole or roots
    # The square of the roots' sum is |c| + |e| + 2 sqrt(c e).
    rest = x * x - abs(c) - abs(e)
    return whole * (_sign(rest) if c * e == 0 else _sign_with_roots(rest, -4 * c * e))


def _minus(x: _Point, y: _Point) -> _Point:
    return [a - b for a, b in zip(x, y, strict=True)]


def _dot(x: _Point, y: _Point) -> int:
    return sum(a * b for a, b in zip(x, y, strict=True))


def _exponent(x: float) -> int:
    """Return k such that x is a whole multiple of 2**-k, at least 0."""
    return x.as_integer_ratio()[1].bit_length() - 1


def _whole(x: float, exponent: int) -> int:
    return int(Fraction(x) * 2**exponent)


def _bits(x: float) -> int:
    return int.from_bytes(struct.pack(">d", x), "big")


def _double(bits: int) -> float:
    return float(struct.unpack(">d", bits.to_bytes(8, "big"))[0])
