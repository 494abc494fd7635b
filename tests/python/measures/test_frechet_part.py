"""frechet_continuous_part against the reference, the distance of its section, and closed forms."""

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

Array = npt.NDArray[np.float64]
COORDINATES = st.integers(-6, 6).map(lambda k: k / 2)


def points_at(curve: Array, parameters: Array) -> Array:
    first = np.minimum(parameters.astype(int), max(len(curve) - 2, 0))
    second = np.minimum(first + 1, len(curve) - 1)
    t = (parameters - first)[:, np.newaxis]
    return np.asarray((1 - t) * curve[first] + t * curve[second])


def section(curve: Array, start: float, stop: float) -> Array:
    between = np.arange(math.floor(start) + 1, math.ceil(stop))
    return points_at(curve, np.array([start, *between, stop]))


@st.composite
def pairs(draw: Any) -> tuple[Array, Array]:
    d = draw(st.integers(1, 3))
    points = st.lists(st.tuples(*[COORDINATES] * d), min_size=d, max_size=6)
    return np.array(draw(points)), np.array(draw(points))


@given(pairs())
@settings(derandomize=True, deadline=None, max_examples=40)
def test_the_reference_and_the_section(pair: tuple[Array, Array]) -> None:
    P, Q = pair
    found = curvewise.frechet_continuous_part(P, Q)
    close = pytest.approx(found.distance, rel=1e-13, abs=1e-14)
    assert reference.frechet_continuous_part(P, Q).distance == close
    x, y = found.parameters.T
    assert x[0] == 0
    assert x[-1] == len(P) - 1
    assert (np.diff(found.parameters, axis=0) >= 0).all()
    assert 0 <= y[0] <= y[-1] <= len(Q) - 1
    leashes = np.linalg.norm(points_at(P, x) - points_at(Q, y), axis=1)
    assert leashes.max() <= found.distance * (1 + 1e-14) + 1e-15
    assert curvewise.frechet_continuous(P, section(Q, y[0], y[-1])) == close
    # Nothing is nearer; the other direction gives the same value.
    assert found.distance <= curvewise.frechet_continuous(P, Q) * (1 + 1e-14) + 1e-14
    assert curvewise.frechet_continuous_part(P[::-1], Q[::-1]).distance == close
    assert found.distance >= curvewise.hausdorff_continuous(P, Q, directed=True) * (1 - 1e-14)
    ends = np.linspace(0, len(Q) - 1, 7)
    for i, start in enumerate(ends):
        for stop in ends[i:]:
            distance = curvewise.frechet_continuous(P, section(Q, start, stop))
            assert found.distance <= distance * (1 + 1e-13) + 1e-14


@pytest.mark.parametrize("seed", range(6))
def test_a_section_is_found_again(seed: int) -> None:
    random = np.random.default_rng(seed)
    d = 1 + seed % 3
    road = np.cumsum(random.normal(size=(3000, d)), axis=0)
    start, stop = 700.25, 760.5
    track = section(road, start, stop)
    found = curvewise.frechet_continuous_part(track, road)
    assert found.distance < 1e-12
    if d > 1:
        assert found.parameters[[0, -1], 1] == pytest.approx([start, stop], abs=1e-9)
    noisy = track + random.uniform(-0.1, 0.1, track.shape)
    assert curvewise.frechet_continuous_part(noisy, road).distance <= 0.1 * d**0.5 + 1e-12


def test_closed_forms() -> None:
    road = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)])
    found = curvewise.frechet_continuous_part([(2.5, 3), (5, 3)], road)
    assert found.distance == 3
    assert found.parameters[-1, 1] == pytest.approx(0.5, abs=1e-6)
    point = curvewise.frechet_continuous_part([(7.5, 1.0)], road)
    assert (point.distance, point.parameters[0, 1]) == (1.0, 0.75)
    assert curvewise.frechet_continuous_part(road, [(10.0, 0.0)]).distance == 10
    # Against the direction of the road: half of the way.
    assert curvewise.frechet_continuous_part([4.0, 2.0], [0.0, 8.0]).distance == 1
    large = curvewise.frechet_continuous_part(np.ldexp(road[:2], 600), np.ldexp(road, 600))
    assert large.distance == 0


def test_a_figure_and_errors() -> None:
    road = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)])
    curvewise.frechet_continuous_part(road[:2] / 2, road).plot()
    with pytest.raises(ValueError, match=r"Q\[1, 0\] is nan; curves must be finite"):
        curvewise.frechet_continuous_part(road, [(0, 0), (np.nan, 0)])
