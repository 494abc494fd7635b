"""Fréchet distances on surfaces, against Chebyshev's best lines, whose errors are known."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.surfaces import leash_minimum
from curvewise.calibration.surfaces.kriged_surface import KrigedSurface
from curvewise.calibration.surfaces.leash_minimum import _Leashes, minimum_on_surfaces
from curvewise.calibration.surfaces.surface_minimum import SurfaceMinimum
from curvewise.calibration.surfaces.surfaces import Responses, Surfaces

CUBE = np.zeros(2), np.ones(2)


def parabola(points: int, height: float = 1.0) -> np.ndarray:
    """Points so far apart in x that only those of equal number can be matched."""
    t = np.linspace(-1.0, 1.0, points)
    return np.column_stack((100.0 * np.arange(points), height * t**2))


def lines(tests: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Lines p[2 i] + (p[2 i + 1] - 0.3) t for every test, at p = 0, and their slopes by p."""
    bases, slopes = [], []
    for i, test in enumerate(tests):
        t = np.linspace(-1.0, 1.0, len(test))
        base = np.column_stack((test[:, 0], -0.3 * t))
        by_p = np.zeros((*test.shape, 2 * len(tests)))
        by_p[:, 1, 2 * i], by_p[:, 1, 2 * i + 1] = 1.0, t
        bases.append(base.ravel())
        slopes.append(by_p.reshape(test.size, -1))
    return np.concatenate(bases), np.concatenate(slopes)


def minimum(tests: Sequence[np.ndarray], criterion: Criterion) -> SurfaceMinimum:
    objective = Objective(list(tests), criterion)
    return minimum_on_surfaces(objective, Responses(tests), np.random.default_rng(0), lambda: None)


def plane(tests: Sequence[np.ndarray]) -> Surfaces:
    base, slopes = lines(tests)
    return Surfaces(np.zeros(slopes.shape[1]), base, slopes)


@pytest.mark.parametrize("points", [21, 2001])  # the second is thinned
@pytest.mark.parametrize("preset", ["raw", "scaled"])
def test_the_best_line_through_a_parabola_is_chebyshevs(points, preset):
    # Half of the height to each side, whatever the box of the test scales.
    tests = [parabola(points)]
    leash = minimum(tests, Criterion("frechet", preset=preset))
    surface = plane(tests)
    found = leash.lowest(surface, np.array([0.9, 0.1]), CUBE)
    np.testing.assert_allclose(found, [0.5, 0.3], atol=2e-3)
    assert leash.value(surface, found) == pytest.approx(0.5, rel=1e-3)


def test_eight_parameters_have_nine_pairs_that_are_equally_far_apart():
    # Of polynomials of degree 7 the nearest to t^8 is 2^-7 away (Chebyshev). A simplex halts above.
    t = np.linspace(-1.0, 1.0, 201)
    test = np.column_stack((100.0 * np.arange(t.size), t**8))
    by_p = np.zeros((*test.shape, 8))
    by_p[:, 1] = np.polynomial.chebyshev.chebvander(t, 7)
    base = np.column_stack((test[:, 0], -0.5 * by_p[:, 1].sum(axis=1)))
    surface = Surfaces(np.zeros(8), base.ravel(), by_p.reshape(test.size, 8))
    leash = minimum([test], Criterion("frechet", preset="raw"))
    found = leash.lowest(surface, np.full(8, 0.7), (np.zeros(8), np.ones(8)))
    assert leash.value(surface, found) == pytest.approx(2.0**-7, rel=0.01)


def test_a_bound_stops_it():
    tests = [parabola(21)]
    leash, surface = minimum(tests, Criterion("frechet", preset="raw")), plane(tests)
    low, high = np.zeros(2), np.array([0.4, 1.0])
    found = leash.lowest(surface, np.array([0.1, 0.9]), (low, high))
    assert leash.value(surface, found) == pytest.approx(0.6, rel=1e-3)
    assert (found >= low).all()
    assert (found <= high).all()


def test_weighted_distances_of_several_tests_add_up():
    tests = [parabola(21), parabola(31, height=0.4)]
    leash = minimum(tests, Criterion("frechet", preset="raw", weights=[1.0, 3.0]))
    surface = plane(tests)
    found = leash.lowest(surface, np.full(4, 0.8), (np.zeros(4), np.ones(4)))
    assert leash.value(surface, found) == pytest.approx(0.5 + 3.0 * 0.2, rel=1e-3)


def test_a_surface_through_runs_serves_as_well():
    tests = [parabola(21)]
    leash = minimum(tests, Criterion("frechet", preset="raw"))
    base, slopes = lines(tests)
    runs = np.random.default_rng(1).random((7, 2))
    surface = KrigedSurface(runs, base + runs @ slopes.T, runs[0], reduced=False)
    found = leash.lowest(surface, runs[0], CUBE)
    assert leash.value(surface, found) == pytest.approx(0.5, rel=1e-3)


def spaced(test: np.ndarray, step: float) -> np.ndarray:
    return np.column_stack((step * np.arange(len(test)), test[:, 1]))


def through_runs(test: np.ndarray) -> KrigedSurface:
    base, slopes = lines([test])
    runs = np.random.default_rng(1).random((7, 2))
    return KrigedSurface(runs, base + runs @ slopes.T, runs[0], reduced=False)


@pytest.mark.parametrize("points", [21, 2001])  # the second is thinned
def test_where_curves_decide_a_hop_leads_down_without_a_population(points, monkeypatch):
    monkeypatch.setattr(leash_minimum, "evolved", None)
    test = parabola(points)
    leash, surface = minimum([test], Criterion("frechet", preset="raw")), through_runs(test)
    place = np.array([0.9, 0.1])
    found = leash.valley(surface, place, place)
    assert leash.value(surface, found) == pytest.approx(0.5, rel=1e-3)


@pytest.mark.parametrize("step", [0.25, 1.9])  # longer than a third of 0.5, up to four times
def test_where_points_decide_at_the_best_run_a_population_hops(step, monkeypatch):
    begun = []

    def settled(values, start, width, random, *, members, generations):
        begun.append(start)
        return start

    monkeypatch.setattr(leash_minimum, "evolved", settled)
    test = spaced(parabola(21), step)
    leash, surface = minimum([test], Criterion("frechet", preset="raw")), through_runs(test)
    place, best = np.array([0.9, 0.1]), np.array([0.5, 0.3])
    leash.valley(surface, place, best)
    np.testing.assert_array_equal(begun, [place])


def test_a_hop_moves_curves_by_half_to_three_times_their_distance():
    """In the mean of squares by 2.44, of half to three on a scale of logarithms."""
    test = parabola(21, height=0.01) + np.array((0.0, 0.5))
    leash, surface = minimum([test], Criterion("frechet", preset="raw")), through_runs(test)
    leashes = _Leashes(leash._exact, surface, CUBE)
    place, random = np.array([0.5, 0.3]), np.random.default_rng(0)
    curve, value = surface.at(place), leashes.value(place)
    moved = [surface.at(leashes.moved(place, random)) - curve for _ in range(4000)]
    squares = np.square(moved).sum(axis=1) / len(test)
    assert squares.mean() / value**2 == pytest.approx(2.44, rel=0.1)


def test_where_nothing_moves_the_curves_a_hop_goes_anywhere():
    test = parabola(21)
    leash = minimum([test], Criterion("frechet", preset="raw"))
    surface = Surfaces(np.zeros(2), test.ravel() + 1.0, np.zeros((test.size, 2)))
    moved = _Leashes(leash._exact, surface, CUBE).moved(np.full(2, 0.5), np.random.default_rng(0))
    assert (np.abs(moved - 0.5) > 0.01).all()


def test_elsewhere_it_finds_the_same():
    tests = [parabola(21)]
    leash, surface = minimum(tests, Criterion("frechet", preset="raw")), plane(tests)
    found = leash.elsewhere(surface, CUBE)
    assert found is not None
    assert leash.value(surface, found) == pytest.approx(0.5, rel=1e-3)
    assert leash.elsewhere(surface, CUBE, avoid=[found]) is None


@pytest.mark.parametrize(
    "criterion", [Criterion("dtw"), Criterion("frechet", metric="cityblock")], ids=str
)
def test_others_are_minimised_as_before(criterion):
    assert type(minimum([parabola(21)], criterion)) is SurfaceMinimum
