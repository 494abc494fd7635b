"""Surfaces that measure how far places are apart by what the curves feel of it."""

from __future__ import annotations

import numpy as np
import pytest

from curvewise.calibration.surfaces.kriged_surface import KrigedSurface
from curvewise.calibration.surfaces.sensed_surface import SensedSurface

K, SIDES = 6, np.full(20, 2.0)
FELT = np.array([1.0, -1.0, 0.5, 0.0, 0.0, 0.0])  # the direction in which curves move much
T = np.linspace(0.0, 1.0, SIDES.size)


def curves(points: np.ndarray) -> np.ndarray:
    """Waves that one direction moves much, and another one little."""
    return np.sin(1.5 * points @ FELT[:, np.newaxis] + 2.0 * T) + 0.01 * points[:, 3:4] * T


def runs(count: int) -> np.ndarray:
    return np.random.default_rng(0).random((count, K))


def surface(count: int = 40, centre: int = 7) -> SensedSurface:
    points = runs(count)
    return SensedSurface(points, curves(points), centre, SIDES)


def test_it_passes_through_the_runs_and_through_that_at_the_centre_exactly():
    points = runs(40)
    np.testing.assert_allclose(surface().at(points), curves(points), atol=1e-5)
    np.testing.assert_allclose(surface().at(points[7]), curves(points)[7], rtol=0, atol=1e-13)


def test_slopes_are_those_of_differences():
    place, step = runs(41)[-1], 1e-6
    vector, slopes = surface().with_slopes(place)
    np.testing.assert_array_equal(vector, surface().at(place))
    ahead, behind = (surface().at(place + sign * step * np.eye(K)) for sign in (1.0, -1.0))
    np.testing.assert_allclose(slopes, (ahead - behind).T / (2.0 * step), atol=1e-7)


def test_its_chain_rule_is_that_of_its_slopes():
    place, gradient = runs(41)[-1], np.cos(5.0 * T)
    vector, slopes = surface().with_slopes(place)
    same, chain_rule = surface().with_chain_rule(place)
    np.testing.assert_array_equal(same, vector)
    np.testing.assert_allclose(chain_rule(gradient), gradient @ slopes, rtol=1e-10)


def test_of_some_coordinates_it_is_a_part():
    place, some = runs(41)[-1], np.array([3, 0, 11])
    part = surface().of_places(some)
    np.testing.assert_allclose(part.at(place), surface().at(place)[some], rtol=1e-12)
    np.testing.assert_allclose(
        part.with_slopes(place)[1], surface().with_slopes(place)[1][some], rtol=1e-10
    )
    assert part.of_places(None) is part


def test_where_a_direction_that_is_no_axis_decides_it_is_off_by_much_less():
    points, others = runs(40), np.random.default_rng(1).random((50, K))
    plain = KrigedSurface(points, curves(points), points[7], reduced=False)
    off, off_plain = (np.median(np.abs(s.at(others) - curves(others))) for s in (surface(), plain))
    assert off < 0.5 * off_plain


@pytest.mark.parametrize("count", [2, 40])
def test_curves_that_nothing_moves_stay_as_they_are(count):
    points = runs(count)
    still = SensedSurface(points, np.tile(T, (count, 1)), 0, SIDES)
    np.testing.assert_allclose(still.at(runs(41)[-1]), T, atol=1e-12)
    np.testing.assert_allclose(still.with_slopes(points[0])[1], 0.0, atol=1e-12)
