"""The inner work of searches on surfaces: gradients, thinned curves, and the descent over kinks."""

from __future__ import annotations

from unittest.mock import MagicMock

import numpy as np
import pytest

from curvewise.calibration import Case, Criterion, Objective, identify
from curvewise.calibration.objective.cases import Cases
from curvewise.calibration.records.evaluation import Evaluation
from curvewise.calibration.surfaces.inner_search import CurveSearch
from curvewise.calibration.surfaces.quasi_newton import nonsmooth_descent
from curvewise.calibration.surfaces.surfaces import Surfaces, thinned_rows

X = np.linspace(0.0, 1.0, 31)
TEST = np.column_stack((X, np.sin(3.0 * X)))
LIKE = np.column_stack((1.03 * X**1.1 - 0.01, 1.1 * np.sin(2.7 * X) + 0.05))  # covers TEST in x


def numerical(function, curve):
    gradient = np.empty_like(curve)
    for place in np.ndindex(curve.shape):
        step = np.zeros_like(curve)
        step[place] = 1e-6
        gradient[place] = (function(curve + step) - function(curve - step)) / 2e-6
    return gradient


@pytest.mark.parametrize("measure", ["area", "dtw", "curve_length", "sum_of_squares"])
def test_gradient_of_an_objective_is_that_of_its_value(measure):
    short = TEST[3:25] * (0.9, 200.0)
    objective = Objective([TEST, short], Criterion(measure, weights=[1.0, 3.0]))
    simulations = [LIKE, LIKE * (1.0, 190.0)]
    assert objective.has_gradient
    value, gradients = objective.value_and_gradient(simulations)
    assert value == pytest.approx(objective(simulations), rel=1e-12)
    first = numerical(lambda c: objective.predicted([c, simulations[1]]).value, LIKE)
    second = numerical(lambda c: objective.predicted([LIKE, c]).value, simulations[1])
    for gradient, expected in zip(gradients, (first, second), strict=True):
        np.testing.assert_allclose(gradient, expected, atol=2e-4 * np.abs(expected).max())


TIMED = np.column_stack((TEST, np.linspace(0.05, 0.9, len(TEST))))
LIKE_TIMED = np.column_stack((LIKE[:20], np.linspace(0.0, 1.0, 20)))
LOOP = np.column_stack((np.sin(6.0 * X), np.cos(5.0 * X)))


@pytest.mark.parametrize(
    ("test", "simulation", "abscissa"),
    [
        (TIMED, LIKE_TIMED, 2),
        (TIMED[::-1], LIKE_TIMED[::-1], 2),
        (LOOP, LOOP + np.column_stack((0.002 * X, 0.1 * X)), "points"),  # x may be off by a little
    ],
)
def test_gradient_of_differences(test, simulation, abscissa):
    objective = Objective(test, "sum_of_squares", abscissa=abscissa)
    _, (gradient,) = objective.value_and_gradient(simulation)
    expected = numerical(lambda c: objective.predicted(c).value, simulation)
    np.testing.assert_allclose(gradient, expected, atol=1e-6 * np.abs(expected).max())


def test_gradient_of_numbers():
    cases = [
        Case("strength", abs, 600.0, sigma=10.0, weight=2.0),
        Case("square", abs, 5.0, measure="sum_of_squares"),
    ]
    objective = Cases(cases).objective()
    value, gradients = objective.value_and_gradient([[[620.0]], [[6.0]]])
    assert value == pytest.approx(2.0 * 2.0 + 0.2**2)
    assert [gradient.item() for gradient in gradients] == pytest.approx([0.2, 2.0 * 0.2 / 5.0])


def test_measures_without_a_useful_gradient():
    assert not Objective(TEST, "pcm").has_gradient
    assert not Objective(TEST, "frechet").has_gradient
    assert not Objective(TEST, "area", spacing="arc_length").has_gradient
    assert not Objective(TEST, lambda P, Q: float(np.abs(P - Q).sum())).has_gradient


def test_a_loop_that_fails_has_its_penalty_and_no_gradient():
    objective = Objective([TEST, TEST], "sum_of_squares")
    value, (first, second) = objective.value_and_gradient([LIKE, LIKE[:9]])
    assert value == pytest.approx(objective.predicted([LIKE, LIKE[:9]]).value)
    assert np.abs(first).max() > 0.0
    assert (second == 0.0).all()


# Thinned curves.


def test_thinned_rows_lie_along_the_curve():
    long = np.column_stack((np.linspace(0.0, 1.0, 5000) ** 4, np.zeros(5000)))  # rests, then runs
    rows = thinned_rows(long, 200)
    assert (rows[0], rows[-1]) == (0, 4999)
    assert 150 <= len(rows) <= 200
    assert np.diff(long[rows, 0]).max() < 0.012
    assert np.diff(rows).max() < 60  # where it rests, too
    np.testing.assert_array_equal(thinned_rows(long[:300], 200), np.arange(300))
    assert len(thinned_rows(np.ones((1000, 2)), 200)) == 200


@pytest.mark.parametrize("measure", ["area", "dtw"])
def test_a_thinned_objective_counts_the_same(measure):
    """The loop of many points keeps its weight relative to the other, sum over points or not."""
    x = np.linspace(0.0, 1.0, 4000)
    dense = np.column_stack((x, np.sin(3.0 * x)))
    objective = Objective([dense, TEST], Criterion(measure, weights=[1.0, 5.0]))
    thinned = objective.thinned(300)
    assert [len(curve) for curve in thinned.experiments] == [300, len(TEST)]
    moved = np.array([0.0, 0.3])
    terms = [
        one.weights * one.terms([simulation + moved, TEST + moved])
        for one, simulation in ((objective, dense), (thinned, dense[thinned_rows(dense, 300)]))
    ]
    np.testing.assert_allclose(terms[1], terms[0], rtol=0.05)
    assert Objective(TEST, measure).thinned(300) is None


def surfaces_of_a_line(noise, count=2000):
    x = np.linspace(0.0, 1.0, count)
    base = np.column_stack((x, np.zeros(count)))
    slopes = [np.column_stack((np.zeros(count), x)), np.column_stack((np.zeros(count), x**0))]
    centre = np.array([0.5, 0.5])
    surfaces = Surfaces(centre, base.ravel(), np.column_stack([s.ravel() for s in slopes]))
    noisy = base + slopes[0] * 0.2 - slopes[1] * 0.1
    noisy[:, 1] += np.random.default_rng(0).normal(0.0, noise, count)
    run = Evaluation(1, (), 0.0, False, 0.0, simulations=(base,))
    return surfaces, run, noisy


def value(search, surface, point):
    return float(search.values(surface, point[np.newaxis])[0])


@pytest.mark.parametrize("measure", ["area", "dtw", "frechet", "pcm", "sum_of_squares"])
def test_the_minimum_on_surfaces_of_thousands_of_points(measure):
    # Noise has a length, which pcm measures: thinned or not.
    surfaces, run, test = surfaces_of_a_line(1e-4 if measure == "pcm" else 0.02)
    calls = []
    search = CurveSearch(Objective(test, measure), 1e-3, lambda: calls.append(1))
    search.taken(run)
    exact = []
    search._exact._show_activity = lambda: exact.append(1)
    best = search.lowest(surfaces, surfaces.centre, np.zeros(2), np.ones(2))
    if measure != "sum_of_squares":  # which costs little, and asks for every point
        assert len(exact) <= 30  # with all points
    assert len(calls) <= 400
    far = 0.05 if measure in ("frechet", "pcm") else 0.01
    np.testing.assert_allclose(best, (0.7, 0.4), atol=far)
    # A box that the optimum is not in: at its side, and never worse than the centre.
    low, high = np.array([0.45, 0.45]), np.array([0.55, 0.55])
    best = search.lowest(surfaces, surfaces.centre, low, high)
    assert ((best >= low) & (best <= high)).all()
    assert value(search, surfaces, best) < value(search, surfaces, surfaces.centre)


def test_where_thinned_curves_mislead_all_points_decide():
    surfaces, run, test = surfaces_of_a_line(0.02)

    def misled(P, Q):  # thinned curves have their minimum on the other side
        return float(abs(Q[-1, 1] - (-0.5 if len(P) < 1000 else 0.9)))

    search = CurveSearch(Objective(test, Criterion(misled, preset="raw")), 1e-3, int)
    search.taken(run)
    best = search.lowest(surfaces, surfaces.centre, np.zeros(2), np.ones(2))
    assert value(search, surfaces, best) < 1e-3


# The descent.


@pytest.mark.parametrize("condition", [1.0, 1e2, 1e4])
def test_descent_of_a_bowl(condition):
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(4, 4)))[0]
    hessian = turn @ np.diag(np.geomspace(1.0, condition, 4)) @ turn.T
    calls = []

    def bowl(point):
        calls.append(point)
        offset = point - 0.4
        return 1.0 + 0.5 * float(offset @ hessian @ offset), hessian @ offset

    best = nonsmooth_descent(bowl, np.full(4, 0.9), negligible=1e-9, most=100)
    assert bowl(best)[0] < 1.0 + 1e-6
    assert len(calls) <= 61


def test_descent_over_kinks_and_along_a_side():
    """A sum of absolute values, whose minimum is a kink, at the side of the cube in one axis."""
    centre = np.array([0.3, -0.2, 0.8])
    factors = np.array([[1.0, 0.2, 0.0], [0.0, 3.0, 0.1], [0.3, 0.0, 10.0]])

    def kinked(point):
        terms = factors @ (point - centre)
        return float(np.abs(terms).sum()), np.sign(terms) @ factors

    best = nonsmooth_descent(kinked, np.full(3, 0.5), negligible=1e-9, most=150)
    grid = np.stack(np.meshgrid(*3 * [np.linspace(0, 1, 41)]), axis=-1).reshape(-1, 3)
    assert best[1] == 0.0
    assert kinked(best)[0] < 1.002 * min(kinked(point)[0] for point in grid)


@pytest.mark.parametrize("count", [2, 3, 5])
def test_descent_leaves_a_start_on_kinks(count):
    """The start has the best value of all coordinates but the first."""
    lowest = np.full(count, 0.5)
    lowest[0] = 0.7
    factors = np.geomspace(1.0, 100.0, count)

    def kinked(point):
        return float(factors @ np.abs(point - lowest)), factors * np.sign(point - lowest + 1e-300)

    best = nonsmooth_descent(kinked, np.full(count, 0.5), negligible=1e-9, most=200)
    assert kinked(best)[0] < 0.002


@pytest.mark.parametrize("most", [1, 2, 7])
def test_descent_keeps_to_its_evaluations(most):
    calls = []

    def slope(point):
        calls.append(point)
        return float(point.sum()), np.ones(2)

    best = nonsmooth_descent(slope, np.array([0.9, 0.8]), negligible=0.0, most=most)
    assert len(calls) <= most
    assert best.sum() == min(point.sum() for point in calls)


# In a search.


def test_progress_moves_between_runs(monkeypatch):
    """On a test of thousands of points, without a run in between."""
    bar = MagicMock()
    bar.return_value.__enter__.return_value = bar
    monkeypatch.setattr("tqdm.tqdm", bar)
    monkeypatch.setattr("curvewise.calibration.problem.evaluations._PAUSE", 0.0)
    x = np.linspace(0.0, 1.0, 1000)

    def line(p):
        return np.column_stack((x, p["a"] * x + p["b"]))

    found = identify(line, line({"a": 2.0, "b": 1.0}), {"a": (0, 10), "b": (-5, 5)})
    refreshed = [c.args[0] for c in bar.set_postfix_str.call_args_list if c.kwargs["refresh"]]
    between = [text for text in refreshed if text.endswith(", choosing the next run")]
    assert len(between) > 3 * found.evaluations
    assert found.value < 1e-4
