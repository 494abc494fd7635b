"""Write the cases: curves are chosen here, values and certificates come from exact.py.

    python conformance/make.py

is the one place that writes the folder cases, always the same bytes. Curves are small lattice walks
from a fixed seed, edge cases by hand, both ends of the range of a double, and pairs on which some
package was found to differ. A value is kept if 160 bits say which double is the nearest.
"""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from exact import certify, nearest_double
from verify import CHECKS, ROOM, verify

Rows = list[list[float]]
Drawn = tuple[str, str, Rows, Rows]  # name, kind, P, Q

TINY = 5e-324
USUAL = 24

TRIANGLE = [[0.0, 0.0], [3.0, 4.0], [6.0, 0.0]]
LINE = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]
SQUARE = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]
ZIGZAG = [[0.0, 0.0], [4.0, 1.0], [1.0, 1.0], [5.0, 0.0]]
EDGE: list[tuple[str, Rows, Rows]] = [
    ("one-point-each", [[1.0, 2.0]], [[4.0, 6.0]]),
    ("one-point-and-many", [[1.0, 1.0]], TRIANGLE),
    ("many-and-one-point", TRIANGLE, [[1.0, 1.0]]),
    ("equal-points", [[2.0, 3.0]], [[2.0, 3.0]]),
    ("equal-curves", TRIANGLE, TRIANGLE),
    ("equal-curves-of-thirds", [[1 / 3, 0.1], [2 / 3, 0.7]], [[1 / 3, 0.1], [2 / 3, 0.7]]),
    ("reversed", TRIANGLE, [[6.0, 0.0], [3.0, 5.0], [0.0, 1.0]]),
    ("repeated-points", [[0.0, 0.0]] * 3 + [[3.0, 4.0]] * 2, [[0.0, 1.0], [3.0, 4.0], [3.0, 4.0]]),
    ("all-points-equal", [[1.0, 1.0]] * 3, [[4.0, 5.0]] * 4),
    ("all-distances-equal", [[0.0, 0.0]] * 2, [[3.0, 4.0], [-3.0, 4.0], [5.0, 0.0]]),
    ("ties", SQUARE, [[1.0, 1.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]),
    ("a-loop-and-its-piece", SQUARE, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]),
    ("to-and-fro", ZIGZAG, [[0.0, 0.0], [5.0, 0.0]]),
    ("to-and-fro-twice", [[0.0], [4.0], [1.0], [5.0], [2.0], [6.0]], [[0.0], [3.0], [6.0]]),
    ("long-and-short", [[float(k), float(k % 3)] for k in range(20)], [[0.0, 1.0], [19.0, 1.0]]),
    ("short-and-long", [[0.0], [9.0]], [[float(k * k % 7)] for k in range(15)]),
    ("a-point-far-off", LINE, [[0.0, 1.0], [1.0, 100.0], [2.0, 1.0], [3.0, 1.0]]),
    ("signed-zeros", [[0.0, -0.0], [-0.0, 1.0]], [[-0.0, 0.0], [2.0, -0.0]]),
    ("five-dimensions", [[1.0, 0, 2, 0, 3], [0, 1.0, 0, 2, 0]], [[0, 0, 0, 0, 0.0], [1.0] * 5]),
]
# Pairs on which a package was found to differ, as short as deleting points made them.
KNOWN: list[tuple[str, Rows, Rows]] = [
    (
        "leash-past-a-corner",
        [[2.0, 5], [3, 3], [4, 3], [5, 4], [0, 0], [3, 4]],
        [[0.0, 4], [4, 4], [5, 1]],
    ),
]
REFUSED: list[tuple[str, list[list[Any]], list[list[Any]]]] = [
    ("nan-inside-Q", TRIANGLE, [[0.0, 0.0], [1.0, "nan"], [2.0, 0.0]]),
    ("nan-first-in-P", [["nan", 0.0], [1.0, 1.0], [2.0, 0.0]], TRIANGLE),
    ("nan-last-in-Q", TRIANGLE, [[0.0, 0.0], [1.0, 1.0], [2.0, "nan"]]),
    ("all-of-Q-nan", TRIANGLE, [["nan", "nan"], ["nan", "nan"]]),
    ("infinity-in-Q", TRIANGLE, [[0.0, 0.0], ["inf", 1.0], [2.0, 0.0]]),
    ("no-points-in-Q", TRIANGLE, []),
    ("no-points-at-all", [], []),
    ("two-and-three-coordinates", TRIANGLE, [[0.0, 0.0, 5.0], [1.0, 1.0, 9.0]]),
]


def walk(rng: random.Random, n: int, dim: int, unit: float) -> Rows:
    """Return a walk on a lattice."""
    at = [rng.randrange(-3, 4) for _ in range(dim)]
    rows = []
    for _ in range(n):
        rows.append([x * unit for x in at])
        at = [x + rng.randrange(-3, 4) for x in at]
    return rows


def usual(dims: tuple[int, ...], lengths: str) -> Iterator[Drawn]:
    """Yield walks of 2 to 7 points; lengths: "equal", "unequal" or "any"."""
    rng = random.Random(20180412)
    count = 0
    while count < USUAL:
        dim, unit = dims[count % len(dims)], 0.125 if count % 4 == 3 else 1.0
        n, m = rng.randrange(2, 8), rng.randrange(2, 8)
        if lengths == "equal":
            m = n
        P, Q = walk(rng, n, dim, unit), walk(rng, m, dim, unit)
        if lengths == "unequal" and n == m:
            continue
        count += 1
        yield f"walk-{count}", "usual", P, Q


def scaled(curve: Rows, factor: float) -> Rows:
    """Return a curve times a number, exactly."""
    return [[x * factor for x in row] for row in curve]


def extreme(dim: int) -> Iterator[Drawn]:
    """Yield curves whose squares overflow or vanish, and curves far from zero."""
    P, Q = [[0, 0], [3, 4], [6, 1]], [[1, 0], [3, 2], [5, 5], [6, 2]]
    P, Q = ([[float(x) for x in row[:dim]] for row in curve] for curve in (P, Q))
    powers = {"2^1000": 2.0**1000, "2^600": 2.0**600, "2^-600": 2.0**-600, "2^-1020": 2.0**-1020}
    for name, factor in {**powers, "subnormal": TINY}.items():
        yield f"times-{name}-{dim}d", "extreme", scaled(P, factor), scaled(Q, factor)
    yield f"1e300-{dim}d", "extreme", [[1e300] * dim] * 2, [[-1e300] * dim, [0.0] * dim]
    yield f"1e-300-{dim}d", "extreme", [[1e-300] * dim] * 2, [[-1e-300] * dim, [0.0] * dim]
    far = [[[x + 2.0**50 for x in row] for row in curve] for curve in (P, Q)]
    yield f"at-2^50-{dim}d", "extreme", *far
    near = [[x + 1.0 for x in row] for row in scaled(Q, 2.0**-52)]
    yield f"last-bits-{dim}d", "extreme", [[1.0] * dim, [1.0 + 2.0**-52] * dim], near


def by_hand() -> Iterator[Drawn]:
    """Yield edge cases and what is known of packages."""
    for name, P, Q in EDGE:
        yield name, "edge", P, Q
    for name, P, Q in KNOWN:
        yield name, "known", P, Q


def parameters(check: str, P: Rows, Q: Rows) -> list[dict[str, float]]:
    """Return the parameters with which a pair is asked."""
    if CHECKS[check].get("window"):
        n, m = len(P), len(Q)
        radii = sorted({1, 2, abs(n - m), max(n, m)})
        return [{"radius": r} for r in radii if r < max(n, m) + (n == m == 1)]
    if check == "dtw-penalty":
        return [{"penalty": p} for p in (0.25, 4.0)]
    return [{}]


def pairs(check: str) -> Iterator[Drawn]:
    """Yield the pairs of a check."""
    record = CHECKS[check]
    if record["measure"] == "area":
        fitting = (d for d in by_hand() if min(len(d[2]), len(d[3])) > 1 and len(d[2][0]) == 2)
        yield from usual((2,), "any")
        yield from fitting
        yield from (d for d in extreme(2) if "1000" not in d[0] and "1e" not in d[0])
        return
    equal = check == "dtw-window"
    lengths = "equal" if equal else "unequal" if record.get("window") else "any"
    yield from usual((1, 2, 2, 3), lengths)
    for drawn in by_hand():
        n, m = len(drawn[2]), len(drawn[3])
        if lengths == "any" or (n == m) == equal:
            yield drawn
    if lengths == "any":
        yield from extreme(1)
        yield from extreme(2)


def make(check: str) -> Iterator[dict[str, Any]]:
    """Yield the cases of a check."""
    for name, kind, P, Q in pairs(check):
        for chosen in parameters(check, P, Q):
            case = certified(check, f"{check}/{name}", kind, P, Q, chosen)
            if case is not None:
                yield case
    chosen = (parameters(check, TRIANGLE, TRIANGLE) or [{}])[0]
    for name, P, Q in REFUSED:
        yield {
            "id": f"{check}/{name}",
            "check": check,
            "kind": "refused",
            "P": P,
            "Q": Q,
            "parameters": chosen,
            "value": None,
            "certificate": None,
        }


def certified(
    check: str, name: str, kind: str, P: Rows, Q: Rows, chosen: dict[str, float]
) -> dict[str, Any] | None:
    """Return a case with its value and certificate, verified; None where there is no value."""
    found = certify(check, P, Q, chosen)
    try:
        double = nearest_double(found[0]) if found else None
    except OverflowError:  # beyond the range of a double
        return None
    if found is None or double is None:
        return None
    terms, certificate = found
    if double < 2.0**-1022 and any(terms[0]) and CHECKS[check].get("squared"):
        return None  # squares that vanish: what a double can say of them is nothing
    case = {
        "id": name + "".join(f"/{key}={value:g}" for key, value in chosen.items()),
        "check": check,
        "kind": kind,
        "P": P,
        "Q": Q,
        "parameters": chosen,
        "value": {
            "terms": [[str(k), str(q)] for k, q in terms],
            "double": repr(double),
            "hex": double.hex(),
        },
        "certificate": certificate,
    }
    verify(json.loads(json.dumps(case)))
    return case


def main(folder: Path = ROOM / "cases") -> None:
    """Write a file for each check."""
    folder.mkdir(exist_ok=True)
    for check in CHECKS:
        lines = [json.dumps(case, separators=(",", ":")) for case in make(check)]
        (folder / f"{check}.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")
        print(f"{check:24} {len(lines):4} cases")


if __name__ == "__main__":
    main()
