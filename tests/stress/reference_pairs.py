"""Random nasty pairs and options: the installed curvewise against curvewise.reference.

    CURVEWISE_ISA=v3 python tests/stress/reference_pairs.py --pairs 20000 --seed 1 --state v3.json

dtw and frechet, their paths and tables, and both ends of frechet_continuous must be bitwise
identical. The other measures are compared to 1e-12 of the value. If curves nearly coincide, the
value is a small remainder of larger numbers; then it is 1e-12 of the largest possible value. Every
error must have the same words. A run can be stopped, and continues from its state. The reference
takes milliseconds a pair, so this is the small run; random_pairs.cpp is the large one. The exit
status is 1 if anything was wrong.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from nasty_pairs import TAME, Array, Pair, draw

import curvewise as cw
from curvewise import _core, reference

TOLERANCE = 1e-12


class Record:
    """Counts of comparisons and of errors, and the skipped comparisons with their reasons."""

    def __init__(self) -> None:
        self.compared: Counter[str] = Counter()
        self.wrong: Counter[str] = Counter()
        self.skipped: Counter[str] = Counter()
        self.next = 0

    def note(self, what: str, holds: bool, number: int, seed: int, more: object = "") -> None:
        """Count a comparison, and print it if it fails."""
        self.compared[what] += 1
        if not holds:
            self.wrong[what] += 1
            print(f"WRONG {what}: --seed {seed} --pair {number} {more}", flush=True)

    def write(self, path: Path) -> None:
        """Write all counts to a file."""
        path.write_text(json.dumps(self.__dict__))

    def read(self, path: Path) -> None:
        """Go on from what write() wrote."""
        for name, value in json.loads(path.read_text()).items():
            setattr(self, name, Counter(value) if isinstance(value, dict) else value)


def outcome(function: Callable[..., Any], *args: Any, **options: Any) -> Any:
    """Return what a function returns, or the text of its refusal."""
    try:
        return function(*args, **options)
    except ValueError as error:
        return str(error)


def same_bits(ours: Any, theirs: Any) -> bool:
    """Tell whether two outcomes are equal to the last bit."""
    if isinstance(ours, str) or isinstance(theirs, str):
        return bool(ours == theirs)
    a, b = np.asarray(ours, dtype=np.float64), np.asarray(theirs, dtype=np.float64)
    return a.shape == b.shape and not np.isnan(a).any() and a.tobytes() == b.tobytes()


def is_near(ours: Any, theirs: Any, scale: float) -> bool:
    """Tell whether two outcomes agree to the tolerance, relative to the value or to a scale."""
    if isinstance(ours, str) or isinstance(theirs, str):
        return bool(ours == theirs)
    return ours == theirs or abs(ours - theirs) <= TOLERANCE * max(abs(theirs), scale)


def check_warping(record: Record, pair: Pair, number: int, seed: int) -> None:
    """Compare dtw and frechet, their paths and tables."""
    for measure in ("dtw", "frechet"):
        options = pair.options[measure]
        is_exact = options.get("p", 2.0) in (1.0, 2.0, math.inf)
        for suffix in ("", "_path", "_table"):
            name = measure + suffix
            ours = outcome(getattr(cw, name), pair.P, pair.Q, **options)
            theirs = outcome(getattr(reference, name), pair.P, pair.Q, **options)
            if not is_exact:
                if suffix == "" and pair.kind in TAME:
                    near = is_near(ours, theirs, 0.0)
                    record.note(f"{name} (powers)", near, number, seed, (options, ours, theirs))
                continue
            if suffix == "_path" and not isinstance(ours, str):
                same = same_bits(ours.distance, theirs.distance)
                same = same and np.array_equal(ours.path, theirs.path)
            else:
                same = same_bits(ours, theirs)
            record.note(name, bool(same), number, seed, options)


def check_continuous(record: Record, pair: Pair, number: int, seed: int) -> None:
    """Compare the interval, found there by decisions in whole numbers of any size."""
    if len(pair.P) * len(pair.Q) > 36 or (pair.kind in ("raw", "extremes") and number % 8):
        record.skipped["frechet_continuous: the reference would take long"] += 1
        return
    ours = outcome(cw.frechet_continuous, pair.P, pair.Q, bounds=True)
    theirs = outcome(reference.frechet_continuous, pair.P, pair.Q, bounds=True)
    record.note("frechet_continuous", same_bits(ours, theirs), number, seed, (ours, theirs))


def largest_area(P: Array, Q: Array) -> float:
    """Return the square of the extent of both curves."""
    return float(np.ptp(np.concatenate([P, Q]), axis=0).max() ** 2)


def check_planar(record: Record, pair: Pair, number: int, seed: int) -> None:
    """Compare area, pcm and curve_length."""
    P, Q = pair.P, pair.Q
    tame = pair.kind in TAME
    for measure in ("area", "pcm", "curve_length"):
        options = pair.options[measure]
        ours = outcome(getattr(cw, measure), P, Q, **options)
        theirs = outcome(getattr(reference, measure), P, Q, **options)
        if isinstance(ours, str) or isinstance(theirs, str):
            hangs_on_rounding = "to rounding" in f"{ours} {theirs}"
            holds = ours == theirs or (hangs_on_rounding and not tame)
            record.note(f"{measure}, refusals", holds, number, seed, (ours, theirs))
            continue
        record.note(f"{measure} is a number", ours >= 0.0, number, seed, (options, ours))
        if not tame:
            record.skipped[f"{measure} of extremes: a number is all that is asked"] += 1
            continue
        scale = 0.0
        if measure == "area":
            scale = largest_area(P, Q) ** (2 if options["squared"] else 1)
        elif measure == "pcm":
            scaled = cw.normalize(P, Q)
            scale = largest_area(*scaled) * max(len(P), len(Q))
            lengths = [np.hypot(*np.diff(curve, axis=0).T).sum() for curve in scaled]
            if abs(lengths[0] - lengths[1]) < 1e-10 * lengths[0] and lengths[0] != lengths[1]:
                record.skipped["pcm: which curve is shorter hangs on rounding"] += 1
                continue
        else:
            with np.errstate(all="ignore"):
                condition = np.abs(P).max(axis=0) / np.abs(P.mean(axis=0))
            scale = float(condition.max())
            if not scale < 1e4:
                record.skipped["curve_length: the divisor is 0 nearly to rounding"] += 1
                continue
        near = is_near(ours, theirs, scale)
        record.note(measure, near, number, seed, (options, ours, theirs))


def check_pointwise(record: Record, pair: Pair, number: int, seed: int) -> None:
    """Compare what needs no alignment."""
    for name in ("sum_of_squares", "mse", "mae"):
        ours = outcome(getattr(cw, name), pair.P, pair.Q)
        theirs = outcome(getattr(reference, name), pair.P, pair.Q)
        near = is_near(ours, theirs, 0.0) if pair.kind in TAME else True
        near = near and (isinstance(ours, str) == isinstance(theirs, str))
        record.note(name, near, number, seed, (ours, theirs))
    for ours, theirs in zip(
        cw.normalize(pair.P, pair.Q), reference.normalize(pair.P, pair.Q), strict=True
    ):
        record.note("normalize", bool(np.array_equal(ours, theirs)), number, seed)


def check(record: Record, seed: int, number: int) -> None:
    """Draw a pair and compare all measures on it."""
    pair = draw(seed, number)
    check_warping(record, pair, number, seed)
    check_continuous(record, pair, number, seed)
    check_planar(record, pair, number, seed)
    check_pointwise(record, pair, number, seed)


def main() -> int:
    """Run as the module's documentation says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pairs", type=int, default=1000, help="how many, from the first on")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pair", type=int, help="this one alone")
    parser.add_argument("--state", type=Path, help="a file to go on from")
    args = parser.parse_args()
    record = Record()
    if args.state and args.state.exists():
        record.read(args.state)
    if args.pair is not None:
        check(record, args.seed, args.pair)
    written = time.monotonic()
    while args.pair is None and record.next < args.pairs:
        check(record, args.seed, record.next)
        record.next += 1
        if args.state and time.monotonic() - written > 10:
            record.write(args.state)
            written = time.monotonic()
    if args.state:
        record.write(args.state)
    for what, count in sorted(record.compared.items()):
        print(f"{count:10} compared, {record.wrong[what]} wrong  {what}")
    for what, count in sorted(record.skipped.items()):
        print(f"{count:10} skipped  {what}")
    wrong = sum(record.wrong.values())
    level = _core.build_info()["active"]
    compared = sum(record.compared.values())
    print(f"level {level}: {record.next} pairs, {compared} comparisons, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
