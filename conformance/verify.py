"""Check every certificate of the cases in exact arithmetic, with Python's fractions alone.

A value is a sum of k sqrt(q) with rational k and q, all of them >= 0. Its certificate says why it
is not larger, and why it is not smaller:

- dtw: a path of that cost, and potentials: numbers that no step can raise by more than it costs,
  so that no path to the end costs less than the potential there;
- frechet: a coupling that is nowhere longer, and cells at least that far apart that every coupling
  has to cross;
- frechet-continuous: a matching that is nowhere longer; and the free-space diagram of a square
  smaller by 2^-100 of itself has no way through (free_space.py, Alt & Godau 1995);
- hausdorff: a near point for each, and the one point that has no nearer one;
- area: depths of the cuts, the vertices' order and the area of each quadrilateral.

O(n m) operations a case. Nothing here knows how a value was found (exact.py does that).
"""

from __future__ import annotations

import itertools
import json
import math
import sys
from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from free_space import Curve, Point, has_way, square

ROOM = Path(__file__).resolve().parent
CHECKS: dict[str, dict[str, Any]] = json.loads((ROOM / "checks.json").read_text(encoding="utf-8"))
GAP = Fraction(1, 2**60)

Terms = list[tuple[Fraction, Fraction]]
Case = dict[str, Any]


class WrongError(Exception):
    """A case does not show what it claims."""


def read_cases(folder: Path = ROOM / "cases") -> Iterator[Case]:
    """Yield all cases, by file and line."""
    for name in CHECKS:
        with (folder / f"{name}.jsonl").open(encoding="utf-8") as lines:
            for line in lines:
                yield json.loads(line)


def main() -> None:
    """Verify all cases; print how many, or what is wrong."""
    counts: dict[str, int] = {}
    for case in read_cases():
        try:
            verify(case)
        except WrongError as error:
            sys.exit(f"{case['id']}: {error}")
        counts[case["check"]] = counts.get(case["check"], 0) + 1
    for name, count in counts.items():
        print(f"{name:24} {count:4} cases verified")


def verify(case: Case) -> None:
    """Raise WrongError unless the case's value is shown to be the right one."""
    if case["kind"] == "refused":
        if case["value"] is not None:
            raise WrongError("what is to be refused has no value")
        return
    terms = [(Fraction(k), Fraction(q)) for k, q in case["value"]["terms"]]
    P, Q = exact_curve(case["P"]), exact_curve(case["Q"])
    check_double(case["value"], terms)
    VERIFIERS[CHECKS[case["check"]]["measure"]](case, P, Q, terms)


def exact_curve(rows: Sequence[Sequence[float]]) -> Curve:
    """Return points as fractions: a double is one."""
    return [tuple(Fraction(x) for x in row) for row in rows]


def demand(condition: bool, text: str) -> None:
    """Raise WrongError with a text unless the condition holds."""
    if not condition:
        raise WrongError(text)


def enclosure(terms: Terms, bits: int = 160) -> tuple[Fraction, Fraction]:
    """Return two fractions with the sum of k sqrt(q) between them, equal where it is rational."""
    low = high = Fraction(0)
    for k, q in terms:
        # sqrt(n / d) = sqrt(n d) / d, with so many bits behind the point of sqrt(n d)
        whole = q.numerator * q.denominator << 2 * bits
        root = math.isqrt(whole)
        low += k * Fraction(root, q.denominator << bits)
        high += k * Fraction(root + (root * root < whole), q.denominator << bits)
    return low, high


def check_double(value: dict[str, Any], terms: Terms) -> None:
    """Check that the double is the one nearest to the value."""
    demand(all(k >= 0 and q >= 0 for k, q in terms), "a term is below 0")
    low, high = enclosure(terms)
    demand(float(low) == float(high), "160 bits do not say which double is the nearest")
    demand(float.fromhex(value["hex"]) == float(low), "hex is not the nearest double")
    demand(float(value["double"]) == float(low), "double is not the nearest double")


def only_square(terms: Terms) -> Fraction:
    """Return q of a value that is a single sqrt(q)."""
    demand(len(terms) == 1 and terms[0][0] == 1, "the value is not one square root")
    return terms[0][1]


# Dynamic time warping


def in_window(rule: str | None, radius: int, i: int, j: int, n: int, m: int) -> bool:
    """Return whether a cell is inside of the window."""
    if rule == "difference":
        return abs(i - j) <= radius
    if rule == "scaled":
        return abs(i * (m - 1) - j * (n - 1)) <= radius * (max(n, m) - 1)
    if rule == "widened":
        return -radius - max(0, m - n) <= i - j <= radius + max(0, n - m)
    return True


class Warping:
    """What a case of dtw asks: where paths begin, step and end, and what that costs."""

    def __init__(self, check: dict[str, Any], parameters: dict[str, Any], P: Curve, Q: Curve):
        self.P, self.Q, self.check = P, Q, check
        self.n, self.m = len(P), len(Q)
        self.steps = {(di, dj): weight for di, dj, weight in check["steps"]}
        self.radius = int(parameters.get("radius", 0))
        self.penalty = Fraction(parameters.get("penalty", 0))

    def has(self, i: int, j: int) -> bool:
        """Return whether a cell is in the table and in the window."""
        inside = 0 <= i < self.n and 0 <= j < self.m
        return inside and in_window(self.check.get("window"), self.radius, i, j, self.n, self.m)

    def begins(self, i: int, j: int) -> bool:
        """Return whether a path may begin in a cell."""
        return i == 0 and (j == 0 or self.check.get("open_begin", False))

    def ends(self, i: int, j: int) -> bool:
        """Return whether a path may end in a cell."""
        return i == self.n - 1 and (j == self.m - 1 or self.check.get("open_end", False))

    def cost(self, i: int, j: int, step: tuple[int, int] | None) -> Terms:
        """Return what a cell costs that is entered by a step, or begun in (None)."""
        weight = Fraction(self.steps[step] if step else 1)
        far = square(self.P[i], self.Q[j])
        terms = [(weight * far, Fraction(1))] if self.check.get("squared") else [(weight, far)]
        if step not in (None, (1, 1)) and self.penalty:
            terms.append((self.penalty, Fraction(1)))
        return terms

    def value(self, terms: Terms) -> Terms:
        """Return the value that belongs to a path's costs, terms of one radicand together."""
        sums: dict[Fraction, Fraction] = {}
        for k, q in terms:
            if k and q:
                sums[q] = sums.get(q, Fraction(0)) + k
        if self.check.get("root"):
            return [(Fraction(1), sums.get(Fraction(1), Fraction(0)))]
        return sorted((k, q) for q, k in sums.items()) or [(Fraction(0), Fraction(1))]


def is_at_most(x: Fraction, terms: Terms) -> bool:
    """Return whether x <= the sum of a k sqrt(q) and rational terms."""
    x -= sum((k for k, q in terms if q == 1), Fraction(0))
    roots = [(k, q) for k, q in terms if q != 1]
    return x <= 0 or (len(roots) == 1 and x * x <= roots[0][0] ** 2 * roots[0][1])


def check_dtw(case: Case, P: Curve, Q: Curve, terms: Terms) -> None:
    """Check a path of the value's cost, and potentials that allow none below."""
    warping = Warping(CHECKS[case["check"]], case["parameters"], P, Q)
    path = [tuple(cell) for cell in case["certificate"]["path"]]
    demand(warping.begins(*path[0]) and warping.ends(*path[-1]), "the path's ends are not allowed")
    demand(all(warping.has(*cell) for cell in path), "the path leaves the window")
    paid = warping.cost(*path[0], None)
    for before, cell in itertools.pairwise(path):
        step = (cell[0] - before[0], cell[1] - before[1])
        demand(step in warping.steps, f"the path has the step {step}")
        paid += warping.cost(*cell, step)
    demand(warping.value(paid) == sorted(terms), "the path's cost is not the value")

    unit = Fraction(2) ** case["certificate"]["unit"]
    table = [
        [None if x is None else int(x) * unit for x in row]
        for row in case["certificate"]["potentials"]
    ]
    shape = [len(row) for row in table]
    demand(shape == [len(Q)] * len(P), "the potentials have another shape")
    for i, row in enumerate(table):
        for j, potential in enumerate(row):
            if warping.has(i, j):
                check_potential(warping, table, i, j, potential)
    ends = [x for j, x in enumerate(table[-1]) if x is not None and warping.ends(len(P) - 1, j)]
    demand(bool(ends), "no end can be reached")
    low, high = enclosure(paid)
    gap = high - min(ends)
    demand(gap == 0 if low == high else gap <= high * GAP, "the potentials leave a gap")


def check_potential(
    warping: Warping, table: list[list[Fraction | None]], i: int, j: int, potential: Fraction | None
) -> None:
    """Check that no way into a cell costs less than the potential rises; None is not reached."""
    if warping.begins(i, j):
        fits = potential is not None and is_at_most(potential, warping.cost(i, j, None))
        demand(fits, f"the potential of ({i}, {j}) is above the cost of beginning there")
    for di, dj in warping.steps:
        if not warping.has(i - di, j - dj):
            continue
        before = table[i - di][j - dj]
        if before is not None:
            fits = potential is not None and is_at_most(
                potential - before, warping.cost(i, j, (di, dj))
            )
            demand(fits, f"the potential of ({i}, {j}) rises by more than a step costs")


# Distances of points


def check_frechet(case: Case, P: Curve, Q: Curve, terms: Terms) -> None:
    """Check a coupling that is nowhere longer, and cells that every coupling crosses."""
    value = only_square(terms)
    last = (len(P) - 1, len(Q) - 1)
    coupling = [tuple(cell) for cell in case["certificate"]["coupling"]]
    demand(coupling[0] == (0, 0) and coupling[-1] == last, "the coupling's ends are others")
    for (i, j), (k, h) in itertools.pairwise(coupling):
        demand((k - i, h - j) in ((0, 1), (1, 0), (1, 1)), "the coupling has another step")
    longest = max(square(P[i], Q[j]) for i, j in coupling)
    demand(longest == value, "the coupling's longest distance is not the value")

    blocked = {tuple(cell) for cell in case["certificate"]["blocked"]}
    demand(all(square(P[i], Q[j]) >= value for i, j in blocked), "a blocked cell is closer")
    reached: set[tuple[int, int]] = set()
    for i in range(len(P)):
        for j in range(len(Q)):
            before = {(i - 1, j), (i, j - 1), (i - 1, j - 1)} & reached
            if (i, j) not in blocked and (before or i == j == 0):
                reached.add((i, j))
    demand(last not in reached, "a coupling avoids the blocked cells")


def check_hausdorff(case: Case, P: Curve, Q: Curve, terms: Terms) -> None:
    """Check a partner near each point, and a point that has no nearer one."""
    value = only_square(terms)
    certificate = case["certificate"]
    sides = {"P": (P, Q), "Q": (Q, P)}
    named = ("P",) if CHECKS[case["check"]].get("directed") else ("P", "Q")
    for side in named:
        points, others = sides[side]
        partners = certificate["partners"][side]
        demand(len(partners) == len(points), f"not every point of {side} has a partner")
        near = (square(p, others[k]) <= value for p, k in zip(points, partners, strict=True))
        demand(all(near), f"a partner of {side} is farther than the value")
    side, index = certificate["farthest"]
    demand(side in named, "the farthest point is of the other curve")
    points, others = sides[side]
    demand(all(square(points[index], q) >= value for q in others), "the farthest point has nearer")


# The Fréchet distance of polygonal curves


def point_at(curve: Curve, s: Fraction) -> Point:
    """Return the point of a curve at a vertex's number and a fraction."""
    k = min(math.floor(s), len(curve) - 1)
    if s == k:
        return curve[k]
    return tuple(a + (s - k) * (b - a) for a, b in zip(curve[k], curve[k + 1], strict=True))


def check_continuous(case: Case, P: Curve, Q: Curve, terms: Terms) -> None:
    """Check a matching whose rows are on one edge each, and that no shorter leash has a way."""
    value = only_square(terms)
    rows = [(Fraction(s), Fraction(t)) for s, t in case["certificate"]["matching"]]
    ends = (rows[0], rows[-1])
    demand(ends == ((0, 0), (len(P) - 1, len(Q) - 1)), "the matching's ends are others")
    for before, row in itertools.pairwise(rows):
        for a, b in zip(before, row, strict=True):
            demand(a <= b <= math.floor(a) + 1, "the matching goes back, or over a vertex")
    # Between two rows the leash is convex: it is longest at one of them.
    longest = max(square(point_at(P, s), point_at(Q, t)) for s, t in rows)
    demand(longest <= value, "the matching is longer than the value")
    below = value * (1 - Fraction(1, 2**100))
    demand(value == 0 or not has_way(P, Q, below), "a shorter leash is long enough")


# The area between two curves


def cross(o: Point, p: Point, q: Point, r: Point) -> Fraction:
    """Return the cross product of the vectors from o to p and from q to r."""
    return (p[0] - o[0]) * (r[1] - q[1]) - (p[1] - o[1]) * (r[0] - q[0])


def is_simple(corners: Sequence[Point]) -> bool:
    """Return whether at least three of the four turns of a quadrilateral agree."""
    a, b, c, d = corners
    turns = [cross(a, b, b, c), cross(b, c, c, d), cross(c, d, d, a), cross(d, a, a, b)]
    return sum(t >= 0 for t in turns) >= 3 or sum(t <= 0 for t in turns) >= 3


def check_area(case: Case, P: Curve, Q: Curve, terms: Terms) -> None:
    """Check the cuts, and each quadrilateral's order and area; the value is their sum."""
    certificate = case["certificate"]
    more, fewer = (P, Q) if len(P) >= len(Q) else (Q, P)
    refined = check_cuts(fewer, certificate["depths"])
    demand(len(refined) == len(more), "the refined curve has another number of points")
    quadrilaterals = certificate["quadrilaterals"]
    demand(len(quadrilaterals) == len(more) - 1, "quadrilaterals are missing")
    total = Fraction(0)
    for i, (order, area) in enumerate(quadrilaterals):
        corners = (more[i], more[i + 1], refined[i + 1], refined[i])
        tried = [[0, 1, 2, 3], [1, 0, 2, 3], [0, 2, 1, 3]]
        simple = [o for o in tried[:2] if is_simple([corners[k] for k in o])]
        demand(order == (simple or tried[2:])[0], f"quadrilateral {i} has another order")
        a, b, c, d = (corners[k] for k in order)
        demand(Fraction(area) == abs(cross(a, c, b, d)) / 2, f"quadrilateral {i} has another area")
        total += Fraction(area)
    demand(terms == [(total, Fraction(1))], "the areas' sum is not the value")


def check_cuts(curve: Curve, depths: list[list[int]]) -> Curve:
    """Check that always the first of the longest pieces was cut; return the refined curve."""
    demand(len(depths) == len(curve) - 1, "not every segment has its depths")
    refined, kept, cut = [curve[0]], [], []
    for k, (x, y) in enumerate(itertools.pairwise(curve)):
        at, parents = Fraction(0), set()
        for depth in depths[k]:
            kept.append((square(x, y) / 4**depth, k + at))
            parents |= {(d, math.floor(at * 2**d)) for d in range(depth)}
            at += Fraction(1, 2**depth)
            refined.append(tuple(a + at * (b - a) for a, b in zip(x, y, strict=True)))
        demand(at == 1, f"the depths of segment {k} do not add up to it")
        cut += [(square(x, y) / 4**d, k + Fraction(which, 2**d)) for d, which in parents]
    for length, place in cut:
        right = (length > other or (length == other and place <= at) for other, at in kept)
        demand(all(right), "a piece was cut while a longer one, or an earlier one, was not")
    return refined


VERIFIERS = {
    "dtw": check_dtw,
    "frechet": check_frechet,
    "frechet-continuous": check_continuous,
    "hausdorff": check_hausdorff,
    "area": check_area,
}


if __name__ == "__main__":
    main()
