"""The continuous Fréchet distance, by exact free-space decisions.

The distance is at most r if a monotone path leads through the free space, which is the set of pairs
of points at most r apart (Alt & Godau, 1995). The diagram has a cell for every edge of P and edge
of Q, and the free space of a cell is convex. The reachable part of a side is therefore an interval
that ends with the free part of that side. The value is the smallest double that is an upper bound,
found by bisection on the bit patterns of doubles, whose order is that of their values.

Nothing is rounded. All coordinates and r are integer multiples of one power of two. A position on
an edge, times the square of its length, is a + s sqrt(c) with integers a and c, and s of -1, 0 or
1. Two positions are compared by squaring. A value takes 63 decisions of time O(n m) each; memory
O(n m).

Closed curves are Q twice around against P once. If a path leads from some point of Q to the same
point one turn later, one leads from the first such point. This is a vertex of Q, or a point where
an edge of Q enters the reach of a vertex of P. A decision tries all of these: O(n² m²) at worst.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable
from fractions import Fraction
from itertools import product
from typing import Literal, SupportsFloat, TypeAlias, overload

import numpy as np

from .._options import real_number
from ..curves.inputs import Array, CurveLike, as_curves
from ..measures.results import Matching
from .checks import check_pair
from .closed import without_repeated_end

__all__ = [
    "frechet_continuous",
    "frechet_continuous_part",
    "frechet_continuous_path",
    "frechet_within",
]

_Point: TypeAlias = list[int]


@overload
def frechet_continuous(
    P: CurveLike, Q: CurveLike, *, bounds: Literal[False] = False, closed: bool = False
) -> float: ...


@overload
def frechet_continuous(
    P: CurveLike, Q: CurveLike, *, bounds: bool, closed: bool = False
) -> float | tuple[float, float]: ...


def frechet_continuous(
    P: CurveLike, Q: CurveLike, *, bounds: bool = False, closed: bool = False
) -> float | tuple[float, float]:
    """63 decisions in whole numbers of any size, O(n m) each; memory O(n m)."""
    P, Q = check_pair(*as_curves(P, Q), "frechet_continuous")
    decide = _leads_around if closed else _is_long_enough
    value = _least_double(lambda radius: decide(P, Q, radius))
    if not bounds:
        return value
    if value == 0 or (math.isfinite(value) and not decide(P, Q, value, strictly=True)):
        return value, value
    return _double(_bits(value) - 1), value


def frechet_continuous_path(P: CurveLike, Q: CurveLike, *, closed: bool = False) -> Matching:
    """From the end back, each cell is left by its lower side where it can have been entered there.

    The walks are others than those of the compiled library. Time and memory as for
    frechet_continuous.
    """
    P, Q = check_pair(*as_curves(P, Q), "frechet_continuous")
    value = frechet_continuous(P, Q, closed=closed)
    if not closed:
        path = _trace(_Diagram(*_with_edges(P, Q), value))
    else:
        P, Q = _around(P, Q)
        path = _trace(diagram := _Diagram(P, Q, value), _beginning(diagram))
    return _measured(P, Q, value, path)


def frechet_continuous_part(P: CurveLike, Q: CurveLike) -> Matching:
    """Of the least distance, the section that ends first.

    The walks are others than those of the compiled library. Time and memory as for
    frechet_continuous.
    """
    P, Q = check_pair(*as_curves(P, Q), "frechet_continuous")
    edges = _with_edges(P, Q)

    def ends(radius: float) -> list[_Part]:
        return _Diagram(*edges, radius, is_open=True).reached()[0][-1]

    value = _least_double(lambda radius: math.isinf(radius) or any(ends(radius)))
    return _measured(P, Q, value, _trace(_Diagram(*edges, value, is_open=True)))


def frechet_within(
    P: CurveLike, Q: CurveLike, distance: SupportsFloat, *, continuous: bool = True
) -> bool:
    """One decision in whole numbers of any size: time and memory O(n m)."""
    P, Q = as_curves(P, Q)
    distance = real_number("distance", distance, -math.inf, "give a number >= 0")
    if not distance >= 0:
        raise ValueError(f"distance is {distance:g}; give a number >= 0")
    P, Q = check_pair(P, Q, "frechet_continuous")
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

    def fraction(self, x: _Point, y: _Point) -> float:
        """Return the position as a fraction of the edge from x to y, rounded."""
        length = _dot(u := _minus(y, x), u)
        if length == 0:
            return 0.0
        # 64 more bits of the root than of the rest.
        shift = 2 * max(0, 64 + length.bit_length() - abs(self.c).bit_length() // 2)
        root = Fraction(math.isqrt(abs(self.c) << shift), 1 << (shift // 2))
        return float((self.a + (root if self.c > 0 else -root)) / length)


_Part: TypeAlias = tuple[_Position, _Position] | None
"""What is free, or reached, of an edge: from one position to another, or nothing."""


class _Diagram:
    """The free-space diagram of two curves in whole numbers.

    If it is open, paths begin and end anywhere in its first and its last row.
    """

    def __init__(
        self, P: Array, Q: Array, radius: float, strictly: bool = False, is_open: bool = False
    ) -> None:
        unit = max(_exponent(x) for x in (*P.flat, *Q.flat, radius))
        self.P, self.Q = ([[_whole(x, unit) for x in point] for point in C] for C in (P, Q))
        self.square = _whole(radius, unit) ** 2
        self.strictly = strictly
        self.is_open = is_open

    def is_free(self, i: int, j: int) -> bool:
        """Return whether P[i] and Q[j] are at most r apart."""
        square = _dot(w := _minus(self.P[i], self.Q[j]), w)
        return square < self.square or (square == self.square and not self.strictly)

    def free(self, x: _Point, y: _Point, z: _Point, reached: _Position | None = None) -> _Part:
        """Return the edge's part within reach of `z`, from `reached` on."""
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

    def reached(
        self, start: tuple[int, _Position] | None = None
    ) -> tuple[list[list[_Part]], list[list[_Part]]]:
        """Return the reachable parts of the lower and the left side of every cell.

        There is one more row of lower sides, and one more column of left sides, than there are
        cells. If a position on an edge of Q is given, paths begin there.
        """
        p, q = self.P, self.Q
        n, m = len(p) - 1, len(q) - 1  # edges
        lower: list[list[_Part]] = [[None] * m for _ in range(n + 1)]
        left: list[list[_Part]] = [[None] * (m + 1) for _ in range(n)]
        first, low = start or (0, None)
        for j in range(first, m):  # along the sides of the diagram as far as all is free
            begins = self.is_open or j == (first if start else -1)
            if begins or (self.is_free(0, j) and (j == 0 or lower[0][j - 1])):
                lower[0][j] = self.free(q[j], q[j + 1], p[0], low if j == first else None)
        for i in range(n if start is None else 0):
            if self.is_free(i, 0) and (i == 0 or left[i - 1][0]):
                left[i][0] = self.free(p[i], p[i + 1], q[0])
        for i, j in product(range(n), range(m)):
            below, beside = lower[i][j], left[i][j]
            if below or beside:
                upper_from = None if beside else below and below[0]
                right_from = None if below else beside and beside[0]
                lower[i + 1][j] = self.free(q[j], q[j + 1], p[i + 1], upper_from)
                left[i][j + 1] = self.free(p[i], p[i + 1], q[j + 1], right_from)
        return lower, left


def _measured(P: Array, Q: Array, value: float, path: list[tuple[float, float]]) -> Matching:
    """Return a matching of that value, or of what its rounded parameters come to."""
    parameters = np.minimum(np.array(path), (len(P) - 1, len(Q) - 1))
    leashes = [_leash(_point(P, x), _point(Q, y)) for x, y in parameters.tolist()]
    return Matching(max([value, *leashes]), parameters)


def _with_edges(P: Array, Q: Array) -> tuple[Array, Array]:
    """Return both curves, a single point as an edge of no length."""
    P, Q = (np.repeat(C, 2, axis=0) if len(C) == 1 else C for C in (P, Q))
    return P, Q


def _is_long_enough(P: Array, Q: Array, radius: float, *, strictly: bool = False) -> bool:
    """Return whether a path leads through the free space; `strictly`: through its inside."""
    if math.isinf(radius):
        return True
    diagram = _Diagram(*_with_edges(P, Q), radius, strictly)
    n, m = len(diagram.P) - 1, len(diagram.Q) - 1
    if not (diagram.is_free(0, 0) and diagram.is_free(n, m)):
        return False
    return diagram.reached()[0][n][m - 1] is not None


def _around(P: Array, Q: Array) -> tuple[Array, Array]:
    """Return P once around and Q twice, each with its first point at the end."""
    P, Q = without_repeated_end(P), without_repeated_end(Q)
    return np.concatenate([P, P[:1]]), np.concatenate([Q, Q, Q[:1]])


def _leads_around(P: Array, Q: Array, radius: float, *, strictly: bool = False) -> bool:
    """Return whether a path goes once around both closed curves and returns to where it began."""
    if math.isinf(radius):
        return True
    return _beginning(_Diagram(*_around(P, Q), radius, strictly)) is not None


def _beginning(diagram: _Diagram) -> tuple[int, _Position] | None:
    """Return the edge of Q, and the first place on it, where a path around begins."""
    turn = (len(diagram.Q) - 1) // 2
    for j in range(turn):
        edge = diagram.Q[j], diagram.Q[j + 1]
        free = diagram.free(*edge, diagram.P[0])
        if free is None:
            continue
        entered = (diagram.free(*edge, z, free[0]) for z in diagram.P)
        for low in {(part[0].a, part[0].c): part[0] for part in entered if part}.values():
            if diagram.free(*edge, diagram.P[0], low) is None:
                continue
            again = diagram.reached((j, low))[0][-1][j + turn]
            if again and again[0] <= low:
                return j, low
    return None


def _trace(
    diagram: _Diagram, start: tuple[int, _Position] | None = None
) -> list[tuple[float, float]]:
    """Return the parameters of a path from corner to corner, from row to row, or around."""
    lower, left = diagram.reached(start)
    p, q = diagram.P, diagram.Q
    i, j = len(left) - 1, len(lower[0]) - 1  # the cell that the path leaves
    x, y, begin = i + 1.0, j + 1.0, 0.0
    if diagram.is_open:
        j, (end, _) = next((k, part) for k, part in enumerate(lower[-1]) if part)
        y = j + end.fraction(q[j], q[j + 1])
    if start is not None:
        begin = start[0] + start[1].fraction(q[start[0]], q[start[0] + 1])
        j = start[0] + len(lower[0]) // 2
        y = begin + len(lower[0]) // 2
    path = [(x, y)]
    while i >= 0 and j >= 0:
        below, beside = lower[i][j], left[i][j]
        y_from = j + below[0].fraction(q[j], q[j + 1]) if below else math.inf
        if below and (y_from <= y or beside is None):
            x, y, i = float(i), min(y, max(y_from, j)), i - 1
        else:
            assert beside is not None
            x_from = i + beside[0].fraction(p[i], p[i + 1])
            x, y, j = min(x, max(x_from, i)), float(j), j - 1
        path.append((x, y))
    # Along a side of the diagram.
    if not diagram.is_open:
        back = range(math.ceil(y) - 1, math.floor(begin) - 1, -1) if x == 0 else ()
        path += [(0.0, max(float(k), begin)) for k in back]
    path += [(float(k), 0.0) for k in range(math.ceil(x) - 1, -1, -1) if x > 0]
    return path[::-1]


def _leash(x: list[Fraction], y: list[Fraction]) -> float:
    """Return the least double that is not below the distance of two points."""
    square = sum((a - b) ** 2 for a, b in zip(x, y, strict=True))
    return _least_double(lambda leash: Fraction(leash) ** 2 >= square)


def _point(C: Array, parameter: float) -> list[Fraction]:
    i = min(int(parameter), max(len(C) - 2, 0))
    j = min(i + 1, len(C) - 1)
    t = Fraction(parameter) - i
    ends = zip(C[i].tolist(), C[j].tolist(), strict=True)
    return [Fraction(a) + t * (Fraction(b) - Fraction(a)) for a, b in ends]


def _is_coupled(P: Array, Q: Array, radius: float) -> bool:
    """Return whether the discrete Fréchet distance is at most `radius`."""
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


def _least_double(is_enough: Callable[[float], bool]) -> float:
    """Return the least double from 0 on that is enough, as all above it are: inf, if no other."""
    low, high = -1, _bits(math.inf)  # too short, and long enough
    while high - low > 1:
        middle = (low + high) // 2
        if is_enough(_double(middle)):
            high = middle
        else:
            low = middle
    return _double(high)


def _bits(x: float) -> int:
    return int.from_bytes(struct.pack(">d", x), "big")


def _double(bits: int) -> float:
    return float(struct.unpack(">d", bits.to_bytes(8, "big"))[0])
