"""Gradients of random walks against differences to both sides, coordinate by coordinate.

Walks of floats and of integers, of unequal lengths, in 1 to 4 dimensions. Integers tie: many pairs
of points are equally far apart. Where the differences to both sides differ the measure has a kink,
and the gradient must lie between them. At a tie of three or more, the gradient may instead be that
of curves nearby (a generalised gradient of Clarke).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import curvewise
from curvewise import value_and_gradient, values_and_gradients

Array = np.ndarray[Any, np.dtype[np.float64]]
Options = dict[str, Any]

CASES: list[tuple[str, Options]] = [
    *[("frechet_continuous", {})] * 5,
    ("frechet", {}),
    ("frechet", {"metric": "chebyshev"}),
    ("frechet", {"metric": "cityblock"}),
    ("frechet", {"metric": "haversine"}),
    ("dtw", {}),
    ("dtw", {"metric": "chebyshev", "window": 0.8}),
    ("dtw", {"metric": "sqeuclidean", "step_pattern": "symmetric2", "normalize": True}),
    ("dtw", {"metric": "minkowski", "p": 3, "open_begin": True, "open_end": True}),
    ("dtw", {"metric": "haversine"}),
    ("soft_dtw", {"gamma": 0.5}),
    ("sum_of_squares", {}),
    ("curve_length", {"scale": "mean"}),
    ("curve_length", {"scale": "range"}),
    ("curve_length", {"scale": "mean_abs"}),
    ("area", {"crossing": "split"}),
    ("area", {"crossing": "rearrange"}),
    ("area", {"crossing": "split", "spacing": "x", "squared": True}),
    ("area", {"spacing": "matched"}),
]
WALKS = 10_000
EARTH = 6_371_008.8


def walks(rng: np.random.Generator, measure: str, options: Options, whole: bool) -> list[Array]:
    """Return P and Q. Points of Q lie between integers, so that no matched points coincide."""
    is_planar = measure in ("area", "curve_length") or options.get("metric") == "haversine"
    d = 2 if is_planar else int(rng.integers(1, 5))
    n, m = rng.integers(2, 41, 2)
    sizes = (n, n) if measure == "sum_of_squares" else (n, m)
    if not whole:
        return [rng.normal(size=(size, d)).cumsum(axis=0) for size in sizes]
    P, Q = (rng.integers(-2, 3, (size, d)).cumsum(axis=0).astype(float) for size in sizes)
    if measure in ("area", "curve_length"):  # an edge of zero length is another kink
        P, Q = (C[np.append(True, np.diff(C, axis=0).any(axis=1))] for C in (P, Q))
    return [P, Q + 0.5]


def is_refused(P: Array, Q: Array, measure: str) -> bool:
    """Return whether a walk has too few points, or no unit for one of its coordinates."""
    if min(len(P), len(Q)) < 2 or measure != "curve_length":
        return min(len(P), len(Q)) < 2
    has_ranges = np.ptp(P, axis=0).all() and np.ptp(Q, axis=0).all()
    return not (has_ranges and np.abs(P.mean(axis=0)).min() > 1e-9)


def gradient_of(P: Array, Q: Array, measure: str, options: Options) -> tuple[float, Array]:
    """Return the value, and its derivatives by P and by Q one behind the other."""
    if measure == "sum_of_squares":
        value, by_Q = value_and_gradient(P, Q, measure)
        return value, np.concatenate([-by_Q, by_Q])
    values, by_P, by_Q = values_and_gradients(P[np.newaxis], Q[np.newaxis], measure, **options)
    return values[0], np.concatenate([by_P[0], by_Q[0]])


def verdict(slope: float, value: float, along: Callable[[float], float], noise: float) -> str:
    """Compare a derivative with differences along one coordinate, by steps of several lengths."""
    for step in (1e-6, 1e-7, 1e-8):
        sides = (value - along(-step)) / step, (along(step) - value) / step
        tolerance = 1e-5 * (np.abs(sides).sum() + abs(slope)) + noise / step
        if min(sides) - tolerance <= slope <= max(sides) + tolerance:
            return "kink" if max(sides) - min(sides) > 3 * tolerance else "smooth"
    return "wrong"


def is_slope_nearby(
    slope: float, measure: Callable[[Array], float], curves: Array, place: tuple[int, ...]
) -> bool:
    """Return whether slopes of curves nearby, along one coordinate, are on both sides of it."""
    rng = np.random.default_rng(1)
    least, most = np.inf, -np.inf
    for _ in range(1000):
        moved = curves + 1e-5 * rng.uniform(-1, 1, curves.shape)
        step = np.zeros(curves.shape)
        step[place] = 1e-8
        found = (measure(moved + step) - measure(moved - step)) / 2e-8
        least, most = min(least, found), max(most, found)
        if least - 1e-3 * (1 + abs(slope)) <= slope <= most + 1e-3 * (1 + abs(slope)):
            return True
    return False


def verdicts(
    rng: np.random.Generator, measure: str, options: Options, whole: bool
) -> tuple[Counter[str], Any]:
    """Compare a gradient in up to twelve places, half of them where it is not 0."""
    P, Q = walks(rng, measure, options, whole)
    while is_refused(P, Q, measure):
        P, Q = walks(rng, measure, options, whole)
    curves, n = np.concatenate([P, Q]), len(P)

    def function(curves: Array) -> float:
        return float(getattr(curvewise, measure)(curves[:n], curves[n:], **options))

    value, gradient = gradient_of(P, Q, measure, options)
    extent = EARTH if "haversine" in options.values() else np.abs(curves).max()
    noise = 8e-15 * (abs(value) + extent)
    moving = np.flatnonzero(gradient)
    some = [rng.permutation(places)[:6] for places in (moving, gradient.size)]
    tally: Counter[str] = Counter()
    for flat in sorted(set(np.concatenate(some).tolist())):
        place = np.unravel_index(flat, gradient.shape)
        slope = float(gradient[place])

        def along(distance: float, place: Any = place) -> float:
            moved = curves.copy()
            moved[place] += distance
            return function(moved)

        found = verdict(slope, value, along, noise)
        if found == "wrong" and whole and is_slope_nearby(slope, function, curves, place):
            found = "nearby"
        tally[found] += 1
        if found == "wrong":
            return tally, (measure, options, place, slope, P.tolist(), Q.tolist())
    return tally, None


@pytest.mark.parametrize("seed", range(25))
@pytest.mark.parametrize("whole", [False, True], ids=["floats", "integers"])
@pytest.mark.nightly("[1-9]")
def test_gradients_of_walks(whole: bool, seed: int) -> None:
    rng = np.random.default_rng([whole, seed])
    tally: Counter[str] = Counter()
    for k in range(WALKS // 50):
        found, pair = verdicts(rng, *CASES[k % len(CASES)], whole)
        assert pair is None, pair
        tally += found
    assert tally["smooth"] > 1000
    # Kinks: 0.1 % of the derivatives by coordinates of floats, 12 % of integers.
    assert tally["kink"] < (0.2 if whole else 0.01) * tally["smooth"]
    assert tally["nearby"] < 0.02 * tally["smooth"]
