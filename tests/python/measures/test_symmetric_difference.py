"""symmetric_difference against fractions: every second gap between all crossings, exactly."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference

Array = npt.NDArray[np.float64]


def exact(*curves: Array) -> Fraction:
    edges: list[tuple[Fraction, Fraction, Fraction, Fraction]] = []
    for curve in curves:
        points = [tuple(map(Fraction, point)) for point in curve.tolist()]
        for a, b in zip(points, points[1:] + points[:1], strict=True):
            (x0, y0), (x1, y1) = sorted([a, b])
            if x0 < x1:
                edges.append((x0, x1, y0, (y1 - y0) / (x1 - x0)))
    xs = {x for edge in edges for x in edge[:2]}
    for (a0, a1, ay, slope), (b0, b1, by, other) in combinations(edges, 2):
        if slope != other:
            x = (by - other * b0 - ay + slope * a0) / (slope - other)
            if max(a0, b0) < x < min(a1, b1):
                xs.add(x)
    total = Fraction(0)
    for low, high in pairwise(sorted(xs)):
        x = (low + high) / 2
        heights = sorted(y + s * (x - x0) for x0, x1, y, s in edges if x0 < x < x1)
        total += (high - low) * sum(heights[1::2], -sum(heights[::2]))
    return total


COORDINATES = st.integers(-12, 12).map(lambda k: k / 4)
CURVES = st.lists(st.tuples(COORDINATES, COORDINATES), min_size=1, max_size=8).map(np.array)


@given(CURVES, CURVES, st.integers(0, 7))
@settings(derandomize=True, deadline=None)
def test_what_it_promises(P: Array, Q: Array, k: int) -> None:
    value = curvewise.symmetric_difference(P, Q)
    close = pytest.approx(value, rel=1e-13, abs=1e-13)
    assert float(exact(P, Q)) == close
    assert reference.symmetric_difference(P, Q) == close
    assert curvewise.symmetric_difference(Q, P) == close
    assert curvewise.symmetric_difference(np.roll(P, k, axis=0)[::-1], Q) == close
    assert curvewise.symmetric_difference(np.vstack([P, P[:1]]), Q) == close
    assert curvewise.symmetric_difference(P[:, ::-1], Q[:, ::-1]) == close
    assert curvewise.symmetric_difference(P * (2, 4), Q * (2, 4)) == pytest.approx(
        8 * value, rel=1e-13, abs=1e-12
    )
    assert curvewise.symmetric_difference(P, np.roll(P, k, axis=0)) == 0.0


@pytest.mark.parametrize("n", [3, 10, 40])
def test_random_curves_that_cross_themselves(n: int) -> None:
    rng = np.random.default_rng(n)
    for _ in range(5):
        P, Q = rng.normal(size=(n, 2)), rng.normal(size=(n + 2, 2))
        value = curvewise.symmetric_difference(P, Q)
        assert value == pytest.approx(float(exact(P, Q)), rel=1e-12)


def test_closed_forms() -> None:
    square, bow = [(0, 0), (2, 0), (2, 2), (0, 2)], [(0, 0), (2, 2), (2, 0), (0, 2)]
    assert curvewise.symmetric_difference(square, bow) == 2.0
    assert curvewise.symmetric_difference(square, np.add(square, 5)) == 8.0
    assert curvewise.symmetric_difference(square, [(1, 1)]) == 4.0
    twice = [*square, *square]  # twice around is outside
    assert curvewise.symmetric_difference(square, twice) == 4.0
    turns = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    circle = np.column_stack([np.cos(turns), np.sin(turns)])
    assert curvewise.symmetric_difference(circle, 2 * circle) == pytest.approx(3 * np.pi, rel=1e-5)


@pytest.mark.parametrize("exponent", [-1000, -520, 500])
def test_the_ends_of_the_range(exponent: int) -> None:
    rng = np.random.default_rng(1)
    P, Q = rng.normal(size=(9, 2)), rng.normal(size=(7, 2))
    for package in (curvewise, reference):
        with np.errstate(under="ignore"):
            expected = np.ldexp(package.symmetric_difference(P, Q), 2 * exponent)
        value = package.symmetric_difference(np.ldexp(P, exponent), np.ldexp(Q, exponent))
        assert value == pytest.approx(expected, rel=1e-13)


def test_what_is_refused() -> None:
    for package in (curvewise, reference):
        with pytest.raises(ValueError, match="symmetric_difference needs 2 coordinates, x and y"):
            package.symmetric_difference(np.eye(3), np.eye(3))
        with pytest.raises(ValueError, match=r"^Q\[1, 0\] is nan; curves must be finite$"):
            package.symmetric_difference(np.eye(2), [(0, 0), (np.nan, 1)])
        with pytest.raises(ValueError, match=r"needs at least 1 point$"):
            package.symmetric_difference(np.zeros((0, 2)), np.eye(2))
