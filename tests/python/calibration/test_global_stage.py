"""The global stage: places that a surrogate promises beyond the region of trust."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.methods.global_stage import GlobalStage
from curvewise.calibration.methods.runs import Runs
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
    proposals = (search.lowest(runs.number(np.array([0.2]))) for _ in range(6))
    place, promised = max(filter(None, proposals), key=lambda found: found[1])
    np.testing.assert_allclose(place, [0.7], atol=0.02)
    assert promised == pytest.approx(0.05, abs=0.01)


def test_hops_begin_at_a_run_and_use_the_runs_that_are_seen():
    """Without the runs beyond the ridge, the surrogate rises there."""
    runs, search = stage(RUNS)
    seen = np.flatnonzero(runs.points[:, 0] < 0.45)
    for _ in range(10):
        found = search.lowest(runs.number(np.array([0.2])), seen)
        assert found is None or found[1] < 0.02


def test_where_a_run_is_already_there_is_no_place():
    runs, search = stage([*RUNS, 0.203, 0.7, 0.703, 0.697])
    found = search.lowest(runs.best)
    assert found is None or found[1] < 0.01


@pytest.mark.parametrize("k", [1, 3, 8])
def test_hops_go_down_from_minimum_to_minimum(k):
    """Of a bowl with 20 ripples along each axis; the inner search finds the nearest minimum."""
    bottom = np.linspace(0.3, 0.7, k)

    def values(surface: Any, points: np.ndarray) -> np.ndarray:
        away = points - bottom
        return np.sum(away**2 + 0.01 * (1.0 - np.cos(40.0 * np.pi * away)), axis=1)

    def lowest(surface: Any, start: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        assert np.all((low >= 0.0) & (low <= start) & (start <= high) & (high <= 1.0))
        return np.clip(bottom + np.round(20.0 * (start - bottom)) / 20.0, low, high)

    runs: Any = SimpleNamespace(
        inner=SimpleNamespace(values=values, lowest=lowest),
        points=np.full((1, k), 0.05),
        surface_through_best=lambda number, seen: None,
    )
    search = GlobalStage(runs, np.random.default_rng(0))
    before = first = values(None, runs.points)[0]
    for _ in range(30):
        found = search.lowest(0)
        if found is None:
            continue
        there = values(None, found[0][np.newaxis])[0]
        assert found[1] == pytest.approx(before - there)
        assert found[1] > 0.0
        before, runs.points = there, np.vstack((found[0], runs.points))
    assert before < 0.02 * first


@pytest.mark.parametrize("measure", ["frechet", "dtw"])
def test_the_surface_of_the_best_runs_passes_through_the_run_that_hops_begin_at(
    measure, monkeypatch
):
    """Which may be higher than so many others."""
    monkeypatch.setattr("curvewise.calibration.methods.runs._BEST", 5)
    runs, _ = stage(RUNS, measure)
    worst = int(np.argmax(runs.values))
    place = runs.points[worst]
    surface = runs.surface_through_best(worst, None)
    np.testing.assert_allclose(surface.at(place), simulated(place[0]).ravel(), atol=1e-5)


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
