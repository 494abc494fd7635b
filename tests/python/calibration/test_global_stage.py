"""The global stage: places that a surrogate promises beyond the region of trust, and CMA-ES."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.methods.global_stage import GlobalStage
from curvewise.calibration.methods.runs import Runs
from curvewise.calibration.surfaces.evolution import evolved
from curvewise.calibration.surfaces.inner_search import CurveSearch
from curvewise.calibration.surfaces.kriged_surface import (
    KrigedSurface,
    lowest_value,
    surface_by_sensitivity,
)

# Two points, too far apart for any other coupling: the longer of two distances counts.
TEST = np.array([[0.0, 0.0], [100.0, 0.0]])


def simulated(p: float) -> np.ndarray:
    """Minima near 0.2 and 0.7, of 0.08 and 0.03, with 0.6 between them."""
    return np.column_stack((TEST[:, 0], [10.0 * (p - 0.2) * (p - 0.7), 0.1 * (1.0 - p)]))


def stage(places: list[float], measure: str = "frechet") -> tuple[Runs, GlobalStage]:
    """Return the stage of a search that has made runs at some places."""
    objective = Objective(TEST, Criterion(measure, preset="raw"))
    runs = [
        SimpleNamespace(failed=False, simulations=(simulated(p),), value=objective([simulated(p)]))
        for p in places
    ]
    ledger: Any = SimpleNamespace(
        dimensions=1,
        has_slopes=False,
        earlier_runs=[(np.array([p]), run) for p, run in zip(places, runs, strict=True)],
    )
    known = Runs(ledger, CurveSearch(objective, 1e-3, lambda: None))
    return known, GlobalStage(known, np.random.default_rng(0))


RUNS = [0.0, 0.15, 0.2, 0.4, 0.8, 1.0]


@pytest.mark.parametrize("measure", ["frechet", "dtw"])
def test_the_lower_minimum_is_found_behind_a_ridge(measure):
    """The model was not run there, nor does the region of trust reach so far."""
    runs, search = stage(RUNS, measure)
    found = search.lowest(runs.number(np.array([0.2])), np.array([0.6]))
    assert found is not None
    np.testing.assert_allclose(found[0], [0.7], atol=0.02)
    assert found[1] == pytest.approx(0.05, abs=0.01)


def test_the_whole_box_is_searched_on_the_surface_of_the_best_runs():
    runs, search = stage([*RUNS, 0.6], "dtw")
    proposals = (search.anywhere(runs.best, None) for _ in range(6))
    found = [place for place in proposals if place is not None]
    assert min(abs(place[0] - 0.7) for place, _ in found) < 0.02


def test_where_a_run_is_already_there_is_no_place():
    runs, search = stage([*RUNS, 0.203, 0.7, 0.703, 0.697])
    found = search.lowest(runs.best, np.array([0.1]))
    assert found is None or found[1] < 0.01


def test_a_value_alone_leads_down():
    random = np.random.default_rng(0)
    points = np.vstack((np.full(2, 0.5), random.random((14, 2))))
    values = 0.1 + ((points - [0.7, 0.4]) ** 2).sum(axis=1)
    found, promised = lowest_value(
        points, values, points[0], np.full(2, 0.2), np.full(2, 0.9), random
    )
    np.testing.assert_allclose(found, [0.7, 0.4], atol=0.03)
    assert promised == pytest.approx(0.05, rel=0.1)


NOISE = 0.02


@pytest.mark.parametrize("seed", range(3))
def test_the_noise_of_a_model_is_estimated_and_smoothed(seed):
    """And a smooth model has no noise, so that the surface passes through its runs."""
    random = np.random.default_rng(seed)
    points, sides = random.random((30, 2)), np.full(40, 5.0)
    smooth = np.sin(points @ random.normal(0.0, 1.0, (2, 40)))
    surface = KrigedSurface(points, smooth, points[0], sides)
    assert surface.noise == 0.0
    np.testing.assert_allclose(surface.at(points), smooth, atol=1e-3)
    noisy = smooth + random.normal(0.0, NOISE * 5.0, smooth.shape)
    surface = KrigedSurface(points, noisy, points[0], sides)
    assert surface.noise == pytest.approx(NOISE, rel=0.25)
    error = np.sqrt(np.mean((surface.at(points) - smooth) ** 2)) / 5.0
    assert error < 0.6 * NOISE


def test_a_surface_of_few_runs_passes_through_each():
    random = np.random.default_rng(0)
    points = random.random((8, 3))
    bent = np.sin(3.0 * points @ random.normal(size=(3, 20)))
    np.testing.assert_allclose(KrigedSurface(points, bent, points[0]).at(points), bent, atol=1e-3)


@pytest.mark.parametrize("seed", range(5))
def test_a_metric_of_sensitivity_predicts_curves_of_one_combination_of_parameters(seed):
    """The curves respond to a single direction askew, and hardly to the others."""
    random = np.random.default_rng(seed)
    direction = np.array([0.6, -0.5, 0.3, -0.4])
    frequencies = random.uniform(2.0, 6.0, 30)

    def curves(points: np.ndarray) -> np.ndarray:
        return np.sin(np.outer(points @ direction, frequencies)) + 1e-3 * points[:, :1]

    points, others = random.random((40, 4)), random.random((50, 4))
    sides, vectors = np.ones(30), curves(points)
    plain = KrigedSurface(points, vectors, points[0], sides)
    metric = surface_by_sensitivity(points, vectors, points[0], sides, points[:20])
    np.testing.assert_allclose(metric.at(points[0]), vectors[0], atol=1e-6)
    errors = [np.abs(surface.at(others) - curves(others)).mean() for surface in (plain, metric)]
    assert errors[1] < 0.5 * errors[0]


def test_slopes_of_a_surface_with_a_metric_are_those_of_its_values():
    random = np.random.default_rng(0)
    points = random.random((40, 3))
    vectors = np.exp(3.0 * points @ random.normal(size=(3, 7)))
    surface = surface_by_sensitivity(points, vectors, points[0], np.ones(7), points[:20])
    place, weights = np.array([0.4, 0.5, 0.6]), random.normal(size=7)
    there, slopes = surface.with_slopes(place)
    np.testing.assert_allclose(there, surface.at(place), rtol=1e-12)
    steps = [surface.at(place + step) - surface.at(place - step) for step in 1e-6 * np.eye(3)]
    np.testing.assert_allclose(slopes, np.array(steps).T / 2e-6, rtol=1e-5, atol=1e-5)
    _, chain_rule = surface.with_chain_rule(place)
    np.testing.assert_allclose(chain_rule(weights), weights @ slopes, rtol=1e-9)


def test_a_run_far_away_bends_the_surface_near_the_centre_little():
    """Curves that grow exponentially, by up to thousand boxes."""
    points = np.linspace(0.0, 1.0, 7)[:, np.newaxis]
    curves = np.exp(9.0 * points) * np.ones(5)
    surface = KrigedSurface(points, curves, points[0], np.ones(5))
    between = np.array([[0.05], [0.25]])
    np.testing.assert_allclose(surface.at(between), np.exp(9.0 * between) * np.ones(5), rtol=0.2)
    _, slopes = surface.with_slopes(between[0])
    steps = surface.at(between[0] + np.array([[1e-6], [-1e-6]]))
    np.testing.assert_allclose(slopes[:, 0], (steps[0] - steps[1]) / 2e-6, rtol=1e-5)
    there, chain_rule = surface.of_places(np.array([3, 0])).with_chain_rule(between[0])
    np.testing.assert_allclose(chain_rule(np.array([2.0, 1.0])), 3.0 * slopes[0], rtol=1e-9)
    assert there.shape == (2,)


@pytest.mark.parametrize("k", [1, 2, 8])
def test_a_population_finds_the_bottom_of_a_narrow_valley(k):
    """Askew, with axes of 1 to 100, its bottom at a bound for one parameter.

    In two thirds of the generations that it takes where the members do not shape its covariance.
    """
    bottom = np.linspace(0.0, 0.7, k)
    turned = np.linalg.qr(np.random.default_rng(1).normal(size=(k, k)))[0]
    scales = np.geomspace(1.0, 100.0, k)

    def function(points: np.ndarray) -> np.ndarray:
        assert points.min() >= 0.0
        assert points.max() <= 1.0
        return np.square((points - bottom) @ turned * scales).sum(axis=1)

    found = evolved(
        function,
        np.full(k, 0.5),
        np.random.default_rng(0),
        width=0.1,
        members=16,
        generations=200,
        settled=1e-4,
    )
    np.testing.assert_allclose(found, bottom, atol=1e-3)


def test_it_never_returns_more_than_the_lowest_of_what_it_has_seen():
    seen: list[float] = []

    def stepped(points: np.ndarray) -> np.ndarray:
        values = np.floor(9.0 * points).sum(axis=1)
        seen.extend(values)
        return values

    found = evolved(
        stepped,
        np.full(3, 0.9),
        np.random.default_rng(0),
        width=0.05,
        members=6,
        generations=20,
        settled=1e-4,
    )
    assert stepped(found[np.newaxis])[0] == min(seen) < 18.0
    assert len(seen) <= 6 * 20 + 1


def test_a_surface_at_several_points_is_that_at_each():
    random = np.random.default_rng(0)
    places, curves = random.random((9, 3)), random.random((9, 5))
    surface = KrigedSurface(places, curves, places[0])
    points = random.random((4, 3))
    each = np.array([surface.at(point) for point in points])
    np.testing.assert_allclose(surface.at(points), each, rtol=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_kinks_of_a_model_are_not_its_noise(seed):
    """Runs of a model with kinks, such as yielding, which no smooth surface fits exactly."""
    random = np.random.default_rng(seed)
    points, sides = random.random((44, 5)), np.ones(60)
    kinked = np.abs((points - 0.5) @ random.standard_normal((5, 60)) + 0.1)
    surface = KrigedSurface(points, kinked, points[0], sides)
    assert surface.noise == 0.0
    np.testing.assert_allclose(surface.at(points[0]), kinked[0], atol=1e-6)
