"""Fréchet distances on surfaces, against Chebyshev's best lines, whose errors are known."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.records.evaluation import Evaluation
from curvewise.calibration.surfaces.inner_search import CurveSearch
from curvewise.calibration.surfaces.kriged_surface import KrigedSurface
from curvewise.calibration.surfaces.surfaces import Surfaces

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


class Search(CurveSearch):
    """The inner search of an objective that has seen the tests as a run."""

    def __init__(self, tests: Sequence[np.ndarray], criterion: Criterion) -> None:
        super().__init__(Objective(list(tests), criterion), 1e-3, lambda: None)
        self.taken(Evaluation(1, (), 0.0, False, 0.0, simulations=tuple(tests)))

    def value(self, surface: Surfaces | KrigedSurface, point: np.ndarray) -> float:
        return float(self.values(surface, point[np.newaxis])[0])


def plane(tests: Sequence[np.ndarray]) -> Surfaces:
    base, slopes = lines(tests)
    return Surfaces(np.zeros(slopes.shape[1]), base, slopes)


@pytest.mark.parametrize("points", [21, 2001])  # the second is thinned
@pytest.mark.parametrize("preset", ["raw", "scaled"])
def test_the_best_line_through_a_parabola_is_chebyshevs(points, preset):
    # Half of the height to each side, whatever the box of the test scales.
    tests = [parabola(points)]
    leash = Search(tests, Criterion("frechet", preset=preset))
    surface = plane(tests)
    found = leash.lowest(surface, np.array([0.9, 0.1]), *CUBE)
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
    leash = Search([test], Criterion("frechet", preset="raw"))
    found = leash.lowest(surface, np.full(8, 0.7), np.zeros(8), np.ones(8))
    assert leash.value(surface, found) == pytest.approx(2.0**-7, rel=0.01)


def test_a_bound_stops_it():
    tests = [parabola(21)]
    leash, surface = Search(tests, Criterion("frechet", preset="raw")), plane(tests)
    low, high = np.zeros(2), np.array([0.4, 1.0])
    found = leash.lowest(surface, np.array([0.1, 0.9]), low, high)
    assert leash.value(surface, found) == pytest.approx(0.6, rel=1e-3)
    assert (found >= low).all()
    assert (found <= high).all()


def test_weighted_distances_of_several_tests_add_up():
    tests = [parabola(21), parabola(31, height=0.4)]
    leash = Search(tests, Criterion("frechet", preset="raw", weights=[1.0, 3.0]))
    surface = plane(tests)
    found = leash.lowest(surface, np.full(4, 0.8), np.zeros(4), np.ones(4))
    assert leash.value(surface, found) == pytest.approx(0.5 + 3.0 * 0.2, rel=1e-3)


def test_a_surface_through_runs_serves_as_well():
    tests = [parabola(21)]
    leash = Search(tests, Criterion("frechet", preset="raw"))
    base, slopes = lines(tests)
    runs = np.random.default_rng(1).random((7, 2))
    surface = KrigedSurface(runs, base + runs @ slopes.T, runs[0])
    found = leash.lowest(surface, runs[0], *CUBE)
    assert leash.value(surface, found) == pytest.approx(0.5, rel=1e-3)


@pytest.mark.parametrize(
    ("criterion", "is_largest"),
    [
        (Criterion("frechet"), True),
        (Criterion("dtw"), False),
        (Criterion("frechet", metric="cityblock"), False),
    ],
    ids=str,
)
def test_which_objectives_are_largest_distances(criterion, is_largest):
    assert Objective([parabola(21)], criterion).is_largest_distance == is_largest
