"""frechet_continuous of closed curves: the reference, all beginnings, promises, closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference
from curvewise.curves.arc_length import points_at

Array = npt.NDArray[np.float64]
SQUARE = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)])
COORDINATES = st.integers(-8, 8).map(lambda k: k / 4)
PARTS = 8  # of an edge, whose ends are exact


def ring(curve: Array) -> Array:
    return curve[:-1] if len(curve) > 1 and np.array_equal(curve[0], curve[-1]) else curve


def distance(P: Any, Q: Any) -> float:
    return curvewise.frechet_continuous(P, Q, closed=True)


def from_place(curve: Array, edge: int, part: int) -> Array:
    """Return the closed curve once around from a place on an edge, with that place at both ends."""
    turned = np.roll(curve, -edge, axis=0)
    after = turned[1 % len(turned)]
    place = turned[:1] + (after - turned[:1]) * (part / PARTS)
    return np.concatenate([place, turned[1:], turned[:1], place])


@st.composite
def pairs(draw: Any) -> tuple[Array, Array]:
    d = draw(st.integers(1, 3))
    points = st.lists(st.tuples(*[COORDINATES] * d), min_size=1 + d // 3, max_size=6)
    return np.array(draw(points)), np.array(draw(points))


@given(pairs())
@settings(derandomize=True, deadline=None, max_examples=40)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_the_reference_and_all_beginnings(pair: tuple[Array, Array]) -> None:
    P, Q = pair
    low, high = curvewise.frechet_continuous(P, Q, bounds=True, closed=True)
    assert distance(P, Q) == high
    assert reference.frechet_continuous(P, Q, bounds=True, closed=True) == (low, high)
    p, q = ring(P), ring(Q)
    once = np.concatenate([p, p[:1]])
    places = [from_place(q, edge, part) for edge in range(len(q)) for part in range(PARTS)]
    values = [curvewise.frechet_continuous(once, place) for place in places]
    assert high <= min(values)
    longest = max(math.dist(a, b) for a, b in zip(q, np.roll(q, -1, axis=0), strict=True))
    assert high >= min(values) - longest / (2 * PARTS) * (1 + 1e-12)


@given(pairs(), st.integers(0, 5), st.integers(0, 5), st.integers(1, 7))
@settings(derandomize=True, deadline=None, max_examples=150)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_what_closed_curves_promise(pair: tuple[Array, Array], i: int, j: int, part: int) -> None:
    P, Q = map(ring, pair)
    value = distance(P, Q)
    assert distance(Q, P) == value
    assert distance(np.roll(P, i, axis=0), np.roll(Q, j, axis=0)) == value
    assert distance(P[::-1], Q[::-1]) == value
    assert distance(np.concatenate([P, P[:1]]), Q) == value
    assert distance(P, from_place(Q, j % len(Q), part)) == value
    assert distance(P, from_place(P, i % len(P), part)) == 0
    assert value <= curvewise.frechet(P, Q, closed=True) * (1 + 1e-15)
    both = [np.concatenate([curve, curve[:1]]) for curve in (P, Q)]
    assert value <= curvewise.frechet_continuous(*both)
    assert value >= curvewise.hausdorff_continuous(*both) * (1 - 1e-14) - 1e-14


@given(pairs())
@settings(derandomize=True, deadline=None, max_examples=80)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_the_path(pair: tuple[Array, Array]) -> None:
    P, Q = pair
    n, m = len(ring(P)), len(ring(Q))
    value = distance(P, Q)
    for package in (curvewise, reference):
        found = package.frechet_continuous_path(P, Q, closed=True)
        assert value <= found.distance <= value * (1 + 1e-13) + 1e-14
        x, y = found.parameters.T
        assert (x[0], x[-1]) == (0, n)
        assert y[-1] == pytest.approx(y[0] + m, rel=1e-15)
        assert 0 <= y[0] < m
        assert (np.diff(found.parameters, axis=0) >= 0).all()
        assert (np.diff(found.parameters, axis=0) <= 1).all()
        once = np.concatenate([ring(P), ring(P)[:1]])
        twice = np.concatenate([ring(Q), ring(Q), ring(Q)[:1]])
        leashes = np.linalg.norm(points_at(once, x) - points_at(twice, y), axis=1)
        assert leashes.max() <= found.distance * (1 + 1e-14) + 1e-15
        if package is curvewise:
            assert found.curves is not None
            assert [curve.tolist() for curve in found.curves] == [once.tolist(), twice.tolist()]


@pytest.mark.parametrize("seed", range(4))
def test_larger_random_curves(seed: int) -> None:
    """The value is attained, and no smaller number is, by the reference's decisions."""
    rng = np.random.default_rng(seed)
    turns = np.sort(rng.uniform(0, 2 * math.pi, 14))
    loop = np.column_stack([np.cos(turns), np.sin((1 + seed % 2) * turns), np.cos(3 * turns)])
    P = loop[:, : 1 + seed % 3] + rng.normal(0, 0.1, (14, 1 + seed % 3))
    Q = np.roll(P, 5, axis=0)[::2] + rng.normal(0, 0.2, (7, 1 + seed % 3))
    value = distance(P, Q)
    assert distance(Q, P) == value
    assert reference.frechet_continuous(P, Q, closed=True) == value


def test_closed_forms() -> None:
    # Begins on an edge of the other square.
    assert distance(SQUARE, [(1, 0), (2, 0), (2, 2), (0, 2), (0, 0)]) == 0
    assert curvewise.frechet(SQUARE, [(1, 0), (2, 0), (2, 2), (0, 2), (0, 0)], closed=True) == 1
    # The other way around, opposite corners meet others.
    assert distance(SQUARE, SQUARE[::-1]) == 2
    assert distance(SQUARE, [(1, 1)]) == distance([(1, 1)], SQUARE) == 2**0.5
    assert distance(SQUARE, SQUARE + np.array([0.25, 0.0])) == 0.25
    assert distance([0.0, 2.0], [0.5, 3.0]) == 1
    assert distance([1.0], [3.0]) == 2
    # The first point that is reached again lies behind the beginning, on the same edge.
    P, Q = [(-0.7, -2.0), (1.6, 1.9), (-1.6, 1.1)], [(-0.3, -0.8), (0.6, 1.7), (1.2, -0.9)]
    assert distance(P, Q) == distance(Q, P) == 2.2785763345474193
    assert reference.frechet_continuous(P, Q, closed=True) == 2.2785763345474193
    # Twice around is not once around.
    twice = np.concatenate([SQUARE, SQUARE])
    assert distance(twice, np.roll(twice, 3, axis=0)) == 0
    assert distance(SQUARE, twice) == 5**0.5


@pytest.mark.parametrize("exponent", [-900, -520, -120, 120, 520, 900])
def test_scales(exponent: int) -> None:
    rng = np.random.default_rng(exponent + 1000)
    P, Q = rng.normal(size=(9, 2)), rng.normal(size=(7, 2))
    expected = np.ldexp(distance(P, Q), exponent)
    assert distance(np.ldexp(P, exponent), np.ldexp(Q, exponent)) == expected


def test_the_ends_of_the_range() -> None:
    large = np.ldexp(SQUARE, 1022)
    assert distance(large, large[::-1]) == 2.0**1023
    assert distance([1.7e308, 1.6e308], [-1.7e308]) == math.inf
    tiny = np.ldexp(SQUARE, -1074)
    assert distance(tiny, tiny[::-1]) == 2 * 2.0**-1074
    far = SQUARE + 2.0**40
    assert distance(far, far + np.array([0.25, 0.0])) == 0.25


def test_layouts_and_many_curves() -> None:
    rng = np.random.default_rng(4)
    curves = [rng.normal(size=(n, 2)) for n in (8, 5, 7)]
    name = "frechet_continuous"
    expected = [[distance(P, Q) for Q in curves] for P in curves]
    assert distance(np.asfortranarray(curves[0]), curves[1].tolist()) == expected[0][1]
    assert distance(np.repeat(curves[0], 2, axis=0)[::2], curves[1]) == expected[0][1]
    assert curvewise.cdist(curves, measure=name, closed=True).tolist() == expected
    condensed = curvewise.pdist(curves, name, closed=True, cutoff=expected[0][1])
    pairs_of = [expected[0][1], expected[0][2], expected[1][2]]
    assert condensed.tolist() == [v if v <= expected[0][1] else math.inf for v in pairs_of]
    options = {name: {"closed": True}}
    compared = curvewise.compare(*curves[:2], preset="raw", measures=[name], options=options)
    assert compared[name] == expected[0][1]
    with pytest.raises(TypeError, match="no option 'bounds'"):
        curvewise.cdist(curves, measure=name, closed=True, bounds=True)


def test_errors_and_a_figure() -> None:
    curvewise.frechet_continuous_path(SQUARE, SQUARE[::-1], closed=True).plot()
    for package in (curvewise, reference):
        for function in (package.frechet_continuous, package.frechet_continuous_path):
            with pytest.raises(ValueError, match=r"^Q\[1, 0\] is nan; curves must be finite$"):
                function(SQUARE, [(0, 0), (np.nan, 0)], closed=True)
            with pytest.raises(ValueError, match=r"^P has shape \(0, 2\); frechet"):
                function(SQUARE[:0], SQUARE, closed=True)
            with pytest.raises(ValueError, match="shape"):
                function(SQUARE, [1.0, 2.0], closed=True)
    with pytest.raises(ValueError, match="workers"):
        curvewise.frechet_continuous(SQUARE, SQUARE, closed=True, workers=0)
