"""How far area, pcm and curve_length are from the exact values, in units in the last place.

Random pairs of some twenty points, of kinds that are easy and kinds that are not: loops, lattices
with their ties, curves far from the origin, near the largest and the smallest doubles, with
subnormal and with negative zero coordinates, nearly equal, and a Q far larger than P's box. The
exact values are those of exact_measures.py. (dtw and frechet are exact by another measure: they
equal the reference to the last bit.)

    python benchmarks/validation/accuracy.py [--pairs 20] [--markdown]
"""

from __future__ import annotations

import argparse
from collections.abc import Callable

import exact_measures
import numpy as np
from mpmath import mpf

import curvewise

Pair = tuple[np.ndarray, np.ndarray]
Rng = np.random.Generator

PROMISED = 1e-12 * 2.0**52  # relative, in units in the last place


def loops(rng: Rng) -> Pair:
    """Hysteresis loops, whose sizes differ by some per cent."""
    t = np.linspace(0, 2 * np.pi, 25)
    shape = np.column_stack((np.cos(t), np.tanh(2 * np.sin(t)) * 300.0))
    Q = shape[: rng.integers(15, 25)] * rng.uniform(0.9, 1.1, 2) + rng.normal(size=2) * 0.01
    return shape + rng.normal(size=shape.shape) * (1e-3, 1.0), Q


def walks(rng: Rng) -> Pair:
    n, m = rng.integers(2, 25, 2)
    return rng.normal(size=(n, 2)).cumsum(axis=0), rng.normal(size=(m, 2)).cumsum(axis=0)


def lattices(rng: Rng) -> Pair:
    P, Q = (np.vstack(((0, 0), rng.integers(0, 4, (n, 2)), (3, 3))) for n in rng.integers(1, 15, 2))
    signs = np.where(rng.integers(0, 2, P.shape) == 0, -0.0, 0.0)
    return np.where(P == 0, signs, P), Q.astype(float)


def times(factor: float) -> Callable[[Rng], Pair]:
    def pair(rng: Rng) -> Pair:
        P, Q = walks(rng)
        largest = max(np.abs(P).max(), np.abs(Q).max())
        return P / largest * factor, Q / largest * factor

    return pair


def unlike_axes(rng: Rng) -> Pair:
    P, Q = walks(rng)
    return P * (1e-4, 1e6), Q * (1e-4, 1e6)


def far(rng: Rng) -> Pair:
    P, Q = walks(rng)
    return P + 1e6, Q + 1e6


def nearly_equal(rng: Rng) -> Pair:
    P, _ = walks(rng)
    return P, P * (1 + 1e-9 * rng.normal(size=P.shape))


def beyond_the_box(rng: Rng) -> Pair:
    P, Q = walks(rng)
    return P, Q * 1e6


KINDS: dict[str, Callable[[Rng], Pair]] = {
    "loops": loops,
    "walks": walks,
    "lattices, ties, -0.0": lattices,
    "x 1e-4, y 1e6": unlike_axes,
    "largest 1e308": times(1e308),
    "largest 1e153": times(1e153),
    "largest 1e-150": times(1e-150),
    "largest 1e-156": times(1e-156),
    "subnormal, 1e-310": times(1e-310),
    "1e6 from the origin": far,
    "equal but for 1e-9": nearly_equal,
    "Q 1e6 times P": beyond_the_box,
}

MEASURES: dict[str, tuple[Callable[..., float], Callable[..., mpf]]] = {
    "area": (
        lambda P, Q: curvewise.area(P, Q),
        lambda P, Q: exact_measures.area(P, Q, "distance"),
    ),
    "area, x": (
        lambda P, Q: curvewise.area(P, Q, spacing="x"),
        lambda P, Q: exact_measures.area(P, Q, "x"),
    ),
    "area, arc_length": (
        lambda P, Q: curvewise.area(P, Q, spacing="arc_length"),
        lambda P, Q: exact_measures.area(P, Q, "arc_length"),
    ),
    "area, matched": (
        lambda P, Q: curvewise.area(P, Q, spacing="matched"),
        lambda P, Q: exact_measures.area(P, Q, "matched"),
    ),
    "pcm, 20 offsets": (
        lambda P, Q: curvewise.pcm(P, Q, offsets=20),
        lambda P, Q: exact_measures.pcm(P, Q, 20),
    ),
    "curve_length": (
        lambda P, Q: curvewise.curve_length(P, Q, scale="range"),
        exact_measures.curve_length,
    ),
}


def errors_of(kind: str, measure: str, pairs: int) -> list[float]:
    """Return the errors in units in the last place of the exact value, of which inf is one."""
    rng = np.random.default_rng(7)
    compute, compute_exactly = MEASURES[measure]
    errors = []
    for _ in range(pairs):
        P, Q = KINDS[kind](rng)
        try:
            found = compute(P, Q)
        except ValueError:  # no length, or no range, to divide by
            continue
        expected = compute_exactly(exact_measures.exact(P), exact_measures.exact(Q))
        if np.isinf(found):
            errors.append(0.0 if expected > mpf(2) ** 1023 else np.inf)
            continue
        ulp = max(abs(expected) / mpf(2) ** 52, mpf(2) ** -1074)
        errors.append(float(abs(found - expected) / ulp))
    return errors


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pairs", type=int, default=20)
    parser.add_argument("--markdown", action="store_true")
    arguments = parser.parse_args()
    row = "| {} | {} |" if arguments.markdown else "{:<22}{}"
    between = " | " if arguments.markdown else ""
    print("Units in the last place: median, largest (and the relative error where beyond 1e-12)")
    print(row.format("curves", between.join(f"{name:>22}" for name in MEASURES)))
    if arguments.markdown:
        print("|---" * (1 + len(MEASURES)) + "|")
    for kind in KINDS:
        cells = []
        for measure in MEASURES:
            errors = errors_of(kind, measure, arguments.pairs)
            if not errors:
                cells.append(f"{'refused':>22}")
                continue
            cell = f"{np.median(errors):.2g}, {max(errors):.2g}"
            if max(errors) > PROMISED:
                cell += f" ({max(errors) / 2.0**52:.0e})"
            cells.append(f"{cell:>22}")
        print(row.format(kind, between.join(cells)), flush=True)


if __name__ == "__main__":
    main()
