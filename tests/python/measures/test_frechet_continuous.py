"""The continuous Fréchet distance against the reference in whole numbers, and by its properties.

The bits must be those of the real number rounded up, for all curves: points on a grid, points on
one line, repeated points, walks back and forth. benchmarks/speed/frechet_continuous.py does the
same with 20,000 pairs.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import (
    frechet,
    frechet_continuous,
    frechet_continuous_path,
    frechet_within,
    reference,
)

Array = npt.NDArray[np.float64]
# A cell of their diagram can be entered from below and from the left, and left again only from the
# one of them.
ONE_WAY = (
    np.array([[2.0, 0.0], [4.0, 3.0], [0.0, 0.0], [1.0, 3.0]]),
    np.array([[1.0, 2.0], [3.0, 0.0], [4.0, 2.0], [0.0, 3.0]]),
)
STRAIGHT, BACK_AND_FORTH = [(0, 0), (10, 0)], [(0, 0), (7, 0), (3, 0), (10, 0)]


def random_curve(rng: np.random.Generator, kind: str, n: int, d: int) -> Array:
    if kind == "grid":
        return rng.integers(0, 4, (n, d)).astype(float)
    if kind == "line":
        step = rng.integers(-3, 4, d)
        return (np.outer(rng.integers(0, 8, n), step) + rng.integers(-3, 4, d)).astype(float)
    if kind == "repeated":
        points = rng.integers(0, 3, (n, d)).astype(float)
        return np.repeat(points, rng.integers(1, 4, n), axis=0)[:n]
    if kind == "spikes":
        curve = np.zeros((n, d))
        curve[:, 0] = np.arange(n)
        curve[rng.integers(0, n, 1 + n // 3), -1] += rng.integers(-4, 5)
        return curve
    if kind == "decimals":
        return rng.normal(size=(n, d)).round(1)
    if kind == "far away":
        return rng.normal(size=(n, d)) * 1e-3 + 1e8
    return rng.normal(size=(n, d))


KINDS = ["grid", "line", "repeated", "spikes", "decimals", "far away", "normal"]


@pytest.mark.parametrize("kind", KINDS)
def test_the_value_is_the_real_number_rounded_up(kind: str, rounds: Callable[[int], int]) -> None:
    rng = np.random.default_rng(len(kind))
    for _ in range(rounds(150)):
        d = int(rng.integers(1, 5))
        P, Q = (random_curve(rng, kind, int(rng.integers(1, 13)), d) for _ in range(2))
        low, value = frechet_continuous(P, Q, bounds=True)
        assert value == frechet_continuous(P, Q)
        assert reference.frechet_within(P, Q, value)
        below = math.nextafter(value, -math.inf)
        assert value == 0 or not reference.frechet_within(P, Q, below)
        assert low in (value, below)
        assert frechet_within(P, Q, value)
        assert value == 0 or not frechet_within(P, Q, below)
        assert frechet_within(P, Q, low) == (low == value)
        for leash in (value, float(rng.uniform(0, 2 * value + 1)), float(rng.integers(0, 5))):
            for continuous in (True, False):
                ours, theirs = (
                    module.frechet_within(P, Q, leash, continuous=continuous)
                    for module in (curvewise, reference)
                )
                assert ours == theirs


@pytest.mark.parametrize("kind", KINDS)
def test_value_and_bounds_of_the_reference(kind: str, rounds: Callable[[int], int]) -> None:
    rng = np.random.default_rng(7 + len(kind))
    for _ in range(rounds(10)):
        P, Q = (random_curve(rng, kind, int(rng.integers(1, 7)), 2) for _ in range(2))
        expected = reference.frechet_continuous(P, Q, bounds=True)
        assert frechet_continuous(P, Q, bounds=True) == expected
        assert reference.frechet_continuous(P, Q) == expected[1]


def test_pairs_that_others_get_wrong() -> None:
    # traj-dist and traj-dist-rs forget that walks never turn back, and say 0.
    assert frechet_continuous(STRAIGHT, BACK_AND_FORTH, bounds=True) == (2.0, 2.0)
    assert frechet_within(STRAIGHT, BACK_AND_FORTH, 2)
    assert not frechet_within(STRAIGHT, BACK_AND_FORTH, math.nextafter(2, 0))
    # GEOS says 5.099 of the discrete distance of this pair.
    P, Q = [(2, 5), (3, 3), (4, 3), (5, 4), (0, 0), (3, 4)], [(0, 4), (4, 4), (5, 1)]
    assert frechet(P, Q) == 5.0
    assert frechet_continuous(P, Q) == reference.frechet_continuous(P, Q) < 5.0


def test_examples_of_other_packages() -> None:
    # shapely's frechet_distance, which has the discrete distance (70.7) unless points are added.
    assert frechet_continuous([(0, 0), (100, 0)], [(0, 0), (50, 50), (100, 0)]) == 50.0
    # curvesimilarities' fd, which is right to 1e-15 or so.
    assert frechet_continuous([(0, 0), (0.5, 0), (1, 0)], [(0, 1), (1, 1)]) == 1.0
    P = [(0, 0), (2, 2), (4, 2), (4, 4), (2, 1), (5, 1), (7, 2)]
    Q = [(2, 0), (1, 3), (5, 3), (5, 2), (7, 3)]
    low, high = frechet_continuous(P, Q, bounds=True)
    assert low < 2.0155644370746377 == high == math.nextafter(low, 3)


coordinates = st.integers(-64, 64).map(lambda k: k / 8)
curves = st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=10).map(
    lambda points: np.array(points, float)
)


@settings(deadline=None)
@given(curves, curves, st.integers(-900, 900), st.integers(0, 3))
def test_what_changes_nothing(P: Array, Q: Array, exponent: int, halvings: int) -> None:
    value = frechet_continuous(P, Q)
    assert frechet_continuous(Q, P) == value
    assert frechet_continuous(P[::-1], Q[::-1]) == value
    assert frechet_continuous(P[:, ::-1], Q[:, ::-1]) == value
    assert frechet_continuous(np.ldexp(P, exponent), np.ldexp(Q, exponent)) == np.ldexp(
        value, exponent
    )
    assert frechet_continuous(P + 2.0**40, Q + 2.0**40) == value
    divided = P
    for _ in range(halvings):
        middles = (divided[1:] + divided[:-1]) / 2
        divided = np.insert(divided, np.arange(1, len(divided)), middles, axis=0)
    assert frechet_continuous(divided, Q) == value
    assert frechet_continuous(divided, P) == 0.0


@settings(deadline=None)
@given(curves, curves)
def test_between_the_discrete_distance_and_an_edge_less(P: Array, Q: Array) -> None:
    edges = [np.hypot(*np.diff(C, axis=0).T) for C in (P, Q)]
    longest = max((float(lengths.max()) for lengths in edges if len(lengths)), default=0.0)
    value, discrete = frechet_continuous(P, Q), frechet(P, Q)
    assert discrete - longest <= value * (1 + 1e-15) + 1e-15
    assert value <= math.nextafter(discrete, math.inf)


def point_at(curve: Array, parameter: float) -> list[Fraction]:
    i = min(int(parameter), len(curve) - 1)
    t = Fraction(parameter) - i
    following = curve[min(i + 1, len(curve) - 1)]
    return [
        Fraction(a) + t * (Fraction(b) - Fraction(a))
        for a, b in zip(curve[i].tolist(), following.tolist(), strict=True)
    ]


def check_leashes(found: curvewise.Matching, P: Array, Q: Array) -> None:
    """Check that no pair distance is above the distance, as a real number."""
    rows = found.parameters
    assert rows[0].tolist() == [0, 0]
    assert rows[-1].tolist() == [len(P) - 1, len(Q) - 1]
    assert (np.diff(rows, axis=0) >= 0).all()
    assert (rows[1:] <= np.floor(rows[:-1]) + 1).all()  # on one edge
    # On one edge each, the pair distance is largest at an end.
    for x, y in rows.tolist():
        p, q = point_at(P, x), point_at(Q, y)
        square = sum((a - b) ** 2 for a, b in zip(p, q, strict=True))
        assert square <= Fraction(found.distance) ** 2


@pytest.mark.parametrize("module", [curvewise, reference])
def test_matchings(module: object, rounds: Callable[[int], int]) -> None:
    rng = np.random.default_rng(3)
    of_each = rounds(25 if module is curvewise else 3)
    over = 0
    pairs = [
        tuple(random_curve(rng, kind, int(rng.integers(1, 9)), 2) for _ in range(2))
        for kind in KINDS * of_each
    ]
    for P, Q in [ONE_WAY, *pairs]:
        found = module.frechet_continuous_path(P, Q)  # type: ignore[attr-defined]
        value = frechet_continuous(P, Q)
        check_leashes(found, P, Q)
        assert value <= found.distance <= value * (1 + 1e-14) + 1e-12 * np.abs([*P, *Q]).max()
        over += found.distance > value
    assert module is reference or over <= len(KINDS) * of_each / 8


@pytest.mark.parametrize("module", [curvewise, reference])
def test_matchings_of_an_edge_and_a_computed_point_on_it(
    module: object, rounds: Callable[[int], int]
) -> None:
    # The point is off the edge by less than the spacing of two parameters.
    edges = [np.array([(7.9, -48.7), (-36.5, 69.9)])]
    rng = np.random.default_rng(4)
    edges += [rng.uniform(-70, 120, (2, 2)).round(1) for _ in range(rounds(300))]
    for k, P in enumerate(edges[: None if module is curvewise else 20]):
        h = rng.uniform() if k else 0.3
        Q = np.insert(P, 1, P[0] + h * (P[1] - P[0]), axis=0)
        for first, second in ((P, Q), (Q, P)):
            found = module.frechet_continuous_path(first, second)  # type: ignore[attr-defined]
            check_leashes(found, first, second)
            assert found.distance <= frechet_continuous(P, Q) + 8 * np.spacing(np.abs(P).max())


def test_a_matching_keeps_to_where_the_curves_are_close() -> None:
    t = np.linspace(0, 6, 400)
    P, Q = np.column_stack([t, np.sin(t)]), np.column_stack([t, np.sin(t) + 0.01])
    Q[200, 1] += 0.3  # one pair distance must be large, and the others need not
    found = frechet_continuous_path(P, Q)
    lengths = np.array(
        [math.dist(point_at(P, x), point_at(Q, y)) for x, y in found.parameters.tolist()]
    )
    assert lengths.max() == pytest.approx(found.distance)
    assert np.median(lengths) < 0.011


def test_range_of_doubles() -> None:
    tiny = 5e-324
    assert frechet_continuous([0, tiny], [tiny, tiny]) == tiny
    assert frechet_continuous([-1.7e308], [1.7e308], bounds=True) == (
        np.finfo(float).max,
        math.inf,
    )
    assert frechet_continuous([(1e300, 0), (-1e300, 0)], [(1e300, 1e-300), (-1e300, 0)]) == 1e-300
    assert frechet_continuous(np.full((1000, 3), 2.5), [(2.5, 2.5, 0)]) == 2.5
    assert frechet_continuous(np.full(1000, 2.5), np.full(1000, 2.5)) == 0.0
    assert frechet_continuous([0.0, 1.0, 0.25, 2.0], [0.0, 2.0]) == 0.375


def test_a_cutoff_is_a_decision() -> None:
    rng = np.random.default_rng(5)
    X = [np.cumsum(rng.normal(size=(n, 2)), axis=0) for n in (10, 40, 25, 33)]
    whole = curvewise.cdist(X, measure="frechet_continuous")
    for i, j in np.ndindex(4, 4):
        assert whole[i, j] == frechet_continuous(X[i], X[j])
    cutoff = float(whole[0, 1])
    expected = np.where(whole <= cutoff, whole, math.inf)
    for workers in (1, 2):
        cut = curvewise.cdist(X, measure="frechet_continuous", cutoff=cutoff, workers=workers)
        np.testing.assert_array_equal(cut, expected)
    prepared = curvewise.Prepared(X[0], "frechet_continuous")
    assert [prepared(Q) for Q in X] == whole[0].tolist()


def test_compare_has_it_where_it_is_asked_for() -> None:
    P, Q = curvewise.datasets.hysteresis_pair()
    assert "frechet_continuous" not in curvewise.compare(P, Q).values
    found = curvewise.compare(P, Q, preset="raw", measures=["frechet", "frechet_continuous"])
    assert found["frechet_continuous"] == frechet_continuous(P, Q)
    assert found["frechet_continuous"] <= math.nextafter(found["frechet"], math.inf)


@pytest.mark.parametrize("module", [curvewise, reference])
def test_refusals(module: object) -> None:
    within = module.frechet_within  # type: ignore[attr-defined]
    for distance, text in ((-1, "-1"), (-0.25, "-0.25"), (math.nan, "nan"), (None, "None")):
        with pytest.raises(ValueError, match=rf"^distance is {text}; give a number >= 0$"):
            within(STRAIGHT, BACK_AND_FORTH, distance)
    with pytest.raises(ValueError, match=r"^P has shape \(0, 2\); frechet_continuous needs at"):
        within(np.empty((0, 2)), STRAIGHT, 1)
    with pytest.raises(ValueError, match=r"^Q\[0, 1\] is inf; curves must be finite$"):
        module.frechet_continuous(STRAIGHT, [(0, math.inf)])  # type: ignore[attr-defined]
