"""The same nasty pairs, given to other packages: how often their distances are wrong.

    pip install shapely traj-dist-rs dtaidistance
    python tests/stress/peers_on_nasty_pairs.py --pairs 5000 --seed 1

The right number comes from tables whose distances neither overflow nor vanish (hypot), or, for
squares, from fractions. A "wrong" number is a nan, or differs by more than 1e-9 of the right one.
Refusals are counted separately. So are pairs with coordinates beyond 1e100 or below 1e-100 in
magnitude, whose squares overflow or vanish. Then the script tests each package with invalid curves:
nan, infinity, no points; and with 1000 random pairs with one coordinate that is nan.
"""

from __future__ import annotations

import argparse
import importlib
import math
import warnings
from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
from nasty_pairs import Array, draw

import curvewise

Call = Callable[[Array, Array], float]

GOOD = np.array([[0.0, 0], [1, 1], [2, 0]])
BAD = {
    "a nan in Q": (GOOD, np.array([[0.0, 0], [1, np.nan], [2, 0]])),
    "all of Q nan": (GOOD, np.full((3, 2), np.nan)),
    "an infinity": (
        np.array([[0.0, 0], [1, 1], [2, 0]]),
        np.array([[0.0, 0], [np.inf, 1], [2, 0]]),
    ),
    "no points": (GOOD, np.empty((0, 2))),
    "x, y and z": (GOOD, np.array([[0.0, 0, 5], [1, 1, 9]])),
}


def peers() -> dict[str, tuple[str, dict[str, Any], Call]]:
    """Return, by name, the measure that a package's function computes, its options, the call."""
    shapely = importlib.import_module("shapely")
    traj = importlib.import_module("traj_dist_rs")
    dtai = importlib.import_module("dtaidistance.dtw_ndim")

    def shapely_frechet(P: Array, Q: Array) -> float:
        return float(shapely.frechet_distance(shapely.linestrings(P), shapely.linestrings(Q)))

    def traj_frechet(P: Array, Q: Array) -> float:
        return float(traj.discret_frechet(P, Q, "euclidean").distance)

    def traj_dtw(P: Array, Q: Array) -> float:
        return float(traj.dtw(P, Q, "euclidean").distance)

    def dtai_dtw(P: Array, Q: Array) -> float:
        return float(dtai.distance_fast(P, Q))

    def root_of_squared(P: Array, Q: Array) -> float:
        return float(np.sqrt(curvewise.dtw(P, Q, metric="sqeuclidean")))

    squared = {"metric": "sqeuclidean"}
    return {
        "curvewise frechet": ("frechet", {}, curvewise.frechet),
        "shapely frechet": ("frechet", {}, shapely_frechet),
        "traj-dist-rs frechet": ("frechet", {}, traj_frechet),
        "curvewise dtw": ("dtw", {}, curvewise.dtw),
        "traj-dist-rs dtw": ("dtw", {}, traj_dtw),
        "curvewise dtw, root of squares": ("dtw", squared, root_of_squared),
        "dtaidistance dtw, root of squares": ("dtw", squared, dtai_dtw),
    }


def frechet(P: Array, Q: Array) -> float:
    """Return the discrete Fréchet distance by its definition."""
    table: dict[tuple[int, int], float] = {}
    for i, a in enumerate(P.tolist()):
        for j, b in enumerate(Q.tolist()):
            before = [table[k] for k in ((i - 1, j), (i, j - 1), (i - 1, j - 1)) if k in table]
            table[i, j] = max(math.dist(a, b), min(before, default=0.0))
    return table[len(P) - 1, len(Q) - 1]


def dtw(P: Array, Q: Array, squares: bool) -> float:
    """Return dtw by its definition; with squares, the root of the smallest sum, in fractions."""
    table: dict[tuple[int, int], Any] = {}
    for i, a in enumerate(P.tolist()):
        for j, b in enumerate(Q.tolist()):
            before = [table[k] for k in ((i - 1, j), (i, j - 1), (i - 1, j - 1)) if k in table]
            cost: Any = math.dist(a, b)
            if squares:
                pairs = zip(a, b, strict=True)
                cost = sum((Fraction(x) - Fraction(y)) ** 2 for x, y in pairs)
            table[i, j] = cost + min(before, default=0)
    total = table[len(P) - 1, len(Q) - 1]
    return root(total) if squares else float(total)


def root(x: Fraction) -> float:
    """Return the square root of a fraction, to the last bits."""
    if x == 0:
        return 0.0
    shift = 2 * ((x.numerator.bit_length() - x.denominator.bit_length() - 120) // 2)
    whole = int(x / Fraction(2) ** shift)
    try:
        return math.ldexp(float(math.isqrt(whole)), shift // 2)
    except OverflowError:
        return math.inf


def said(call: Call, P: Array, Q: Array) -> float | str:
    """Return a call's number, or the name of its exception."""
    try:
        return call(P, Q)
    except BaseException as error:  # A panic in Rust is not an Exception.
        if isinstance(error, KeyboardInterrupt):
            raise
        return type(error).__name__


def said_of_nan(call: Call, pairs: int, seed: int) -> Counter[str]:
    """Count the results of a call for random pairs with one coordinate that is nan."""
    random = np.random.default_rng(seed)
    counts: Counter[str] = Counter()
    for _ in range(pairs):
        pair = [random.normal(size=(random.integers(1, 6), 2)) for _ in range(2)]
        spoilt = pair[random.integers(2)]
        spoilt[random.integers(len(spoilt)), random.integers(2)] = math.nan
        found = said(call, *pair)
        is_number = isinstance(found, float) and math.isfinite(found)
        counts["a number" if is_number and found else str(found)] += 1
    return counts


def main() -> None:
    """Run as the module's documentation says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pairs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    counts: dict[str, Counter[str]] = {name: Counter() for name in peers()}
    examples: dict[str, str] = {}
    for number in range(args.pairs):
        pair = draw(args.seed, number)
        if pair.P.shape[1] != 2:
            continue  # what all of them take
        P, Q = (np.ascontiguousarray(curve) for curve in (pair.P, pair.Q))
        sizes = np.abs(np.concatenate([P, Q]))
        is_extreme = bool((sizes > 1e100).any() or ((sizes > 0) & (sizes < 1e-100)).any())
        part = "extreme" if is_extreme else "usual"
        for name, (measure, options, call) in peers().items():
            with np.errstate(all="ignore"):
                right = frechet(P, Q) if measure == "frechet" else dtw(P, Q, bool(options))
                found = said(call, P, Q)
            counts[name][part] += 1
            if isinstance(found, str):
                counts[name][f"{part}, refused"] += 1
            elif found != right and not abs(found - right) <= 1e-9 * right + 5e-324:
                counts[name][f"{part}, wrong"] += 1
                text = f"e.g. pair {number}: {found} for {right!r}"
                examples.setdefault(f"{name}, {part}", text)
    for name, count in counts.items():
        for part in ("usual", "extreme"):
            wrong, refused = count[f"{part}, wrong"], count[f"{part}, refused"]
            print(
                f"{name:35} {part:8} {count[part]:6} pairs, {wrong:6} wrong, {refused:6} refused  "
                f"{examples.get(f'{name}, {part}', '')}"
            )
    for what, (P, Q) in BAD.items():
        for name, (_, _, call) in peers().items():
            print(f"{what:14} {name:35} {said(call, P, Q)}")
    for name, (_, _, call) in peers().items():
        print(f"{name:35} of 1000 pairs with a nan: {dict(said_of_nan(call, 1000, args.seed))}")


if __name__ == "__main__":
    main()
