"""Small valleys: a function that has them, the area of noisy curves, and a search among them."""

from __future__ import annotations

import numpy as np
import pytest

from curvewise.calibration import Objective, TrustRegion, identify
from curvewise.calibration.methods import curve_descent
from curvewise.calibration.surfaces.small_valleys import lowest_beside
from curvewise.calibration.surfaces.surface_minimum import SurfaceMinimum
from curvewise.calibration.surfaces.surfaces import Responses, Surfaces

CUBE = np.zeros(6), np.ones(6)
CENTRE = np.full(6, 0.5)


@pytest.mark.parametrize("seed", range(4))
def test_the_lowest_of_many_valleys_is_found_where_directions_differ_a_thousandfold(seed):
    random = np.random.default_rng(seed)
    turn = np.linalg.qr(random.normal(size=(4, 4)))[0]
    slopes = np.diag([1000.0, 100.0, 10.0, 1.0]) @ turn
    lowest = np.full(4, 0.5) + np.linalg.solve(slopes, [0.3, -0.4, 0.2, 0.1])

    def function(place):
        felt = slopes @ (place - lowest)
        return 5.0 + float(felt @ felt + 0.05 * np.sum(1.0 - np.cos(20.0 * felt)))

    found = lowest_beside(function, np.full(4, 0.5), slopes, random)
    assert function(found) == pytest.approx(5.0, abs=2e-3)


def test_where_nothing_moves_the_curves_a_place_of_the_cube_comes_back():
    found = lowest_beside(lambda place: 2.0, CENTRE, np.zeros((9, 6)), np.random.default_rng(0))
    assert found.shape == (6,)
    assert (found >= 0.0).all()
    assert (found <= 1.0).all()


def test_curves_may_have_fewer_coordinates_than_there_are_parameters():
    slopes = np.eye(6)[:2]
    random = np.random.default_rng(0)
    found = lowest_beside(lambda place: 1.0 + abs(place[0] - 0.6), CENTRE, slopes, random)
    assert 0.5 < found[0] <= 0.6


def noisy(seed: int, points: int) -> tuple[np.ndarray, Surfaces]:
    """A loop with white noise, and surfaces of six waves on the loop."""
    t = np.linspace(0.0, 1.0, points)
    loop = np.column_stack((np.cos(5.0 * t), np.sin(7.0 * t) + t))
    waves = np.column_stack([np.cos(2.0 * k * t) for k in range(6)])
    slopes = np.zeros((points, 2, 6))
    slopes[:, 1] = waves
    test = loop.copy()
    test[:, 1] += np.random.default_rng(seed).normal(0.0, 0.03, points)
    return test, Surfaces(CENTRE, loop.ravel(), slopes.reshape(2 * points, 6))


def test_gradients_halt_in_valleys_of_noise_and_a_population_does_not():
    gains, points = [], 120
    for seed in range(6):
        test, surface = noisy(seed, points)
        random = np.random.default_rng(seed)
        minimum = SurfaceMinimum(Objective([test]), Responses([test]), random, lambda: None)
        first = minimum.lowest(surface, CENTRE, CUBE)
        slopes = surface.slopes / np.tile(np.ptp(test, axis=0), points)[:, np.newaxis]
        beside = minimum.beside(surface, first, slopes)
        gains.append(1.0 - minimum.value(surface, beside) / minimum.value(surface, first))
    assert min(gains) > -2e-3
    assert max(gains) > 5e-3


def test_thinned_curves_lead_to_a_place_of_the_cube():
    points = 1000
    test, surface = noisy(0, points)
    objective, random = Objective([test]), np.random.default_rng(0)
    minimum = SurfaceMinimum(objective, Responses([test]), random, lambda: None)
    slopes = surface.slopes / np.tile(np.ptp(test, axis=0), points)[:, np.newaxis]
    beside = minimum.beside(surface, CENTRE, slopes)
    assert (beside >= 0.0).all()
    assert (beside <= 1.0).all()
    # Noise moves it by some per cent of the value, in either direction.
    assert minimum.value(surface, beside) < 1.15 * minimum.value(surface, CENTRE)


def test_a_search_leaves_small_valleys_before_it_ends(monkeypatch):
    names = [f"p{i}" for i in range(6)]

    def end(seed):
        test, surface = noisy(seed, 120)

        def model(parameters):
            return surface.at(np.array([parameters[name] for name in names])).reshape(test.shape)

        return identify(
            model,
            test,
            dict.fromkeys(names, (0.0, 1.0)),
            method=TrustRegion(starts=1, initial_range=0.1),
            start=dict.fromkeys(names, 0.5),
            progress=False,
        ).value

    left = [end(seed) for seed in range(4)]
    monkeypatch.setattr(curve_descent, "_SMALL_VALLEYS", 0)
    stayed = [end(seed) for seed in range(4)]
    # The model is linear, and gradients come to within a thousandth.
    assert sum(left) < 0.9998 * sum(stayed)
