"""Least squares on surfaces of residuals: its parts against scipy, and the whole of it."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares, lsq_linear

from curvewise.calibration import LeastSquares, Log, Problem, Tied, TrustRegion, identify
from curvewise.calibration.methods import method_of
from curvewise.calibration.models.pool import Outcome
from curvewise.calibration.objective.objective import Objective
from curvewise.calibration.problem.ledger import Ledger
from curvewise.calibration.surfaces.kriged_surface import KrigedSurface
from curvewise.calibration.surfaces.sums_of_squares import (
    Loss,
    bend_of,
    linear_minimum,
    squares_minimum,
)
from curvewise.materials import ChabocheVoce

X = np.linspace(0.0, 4.0, 40)
NOISE = np.random.default_rng(5).normal(0.0, 0.03, X.size)
BOUNDS = {"height": (0.0, 5.0), "rate": (0.1, 4.0), "level": (-1.0, 1.0)}
TRUE = {"height": 2.0, "rate": 1.3, "level": 0.3}
SQUARES = {"measure": "sum_of_squares", "progress": False}
LOSSES = [loss for loss in get_args(Loss) if loss != "linear"]


def decay(p):
    return np.column_stack((X, p["height"] * np.exp(-p["rate"] * X) + p["level"]))


TEST = decay(TRUE) + np.column_stack((np.zeros_like(X), NOISE))


def scipys(test=TEST, bounds=BOUNDS, **options):
    """What scipy finds with its own differences, from the middle of the bounds."""
    low, high = np.array(list(bounds.values())).T
    height = np.ptp(test[:, 1])

    def residuals(place):
        return (decay(dict(zip(bounds, place, strict=True))) - test)[:, 1] / height

    tight = {"xtol": 1e-14, "ftol": 1e-14, "gtol": 1e-14}
    return least_squares(residuals, (low + high) / 2.0, bounds=(low, high), **tight, **options)


def places(found):
    return np.array(list(found.parameters.values()))


@given(st.integers(0, 10**6), st.integers(1, 9), st.integers(0, 3))
@settings(max_examples=60, deadline=None)
def test_a_linear_problem_in_a_box_is_solved_as_scipy_does(seed, k, closed):
    """With columns of any size, and sides of the box of no length."""
    random = np.random.default_rng(seed)
    slopes = random.normal(size=(12, k)) * 10.0 ** random.uniform(-2, 2, k)
    residuals = random.normal(size=12)
    low, high = -random.uniform(0, 0.3, k), random.uniform(0, 0.3, k)
    low[: min(closed, k)] = 0.0
    step = linear_minimum(residuals, slopes, low, high)
    assert (step >= low).all()
    assert (step <= high).all()
    expected = lsq_linear(slopes, -residuals, (low - 1e-15, high + 1e-15), method="bvls")
    value = 0.5 * np.sum((residuals + slopes @ step) ** 2)
    assert value <= expected.cost * (1.0 + 1e-9)


def test_a_surface_is_the_plane_of_linear_residuals_and_passes_through_runs():
    random = np.random.default_rng(2)
    slopes, middle = random.normal(size=(25, 3)), np.full(3, 0.4)
    points = np.vstack((middle, random.uniform(size=(6, 3))))
    plane = KrigedSurface(points, points @ slopes.T, middle)
    residuals, found = plane.with_slopes(np.array([0.1, 0.9, 0.5]))
    np.testing.assert_allclose(residuals, slopes @ [0.1, 0.9, 0.5], atol=1e-6)
    np.testing.assert_allclose(found, slopes, atol=1e-6)

    bent = np.sin(3.0 * points @ slopes.T)
    surface = KrigedSurface(points, bent, middle)
    np.testing.assert_allclose(surface.at(middle), bent[0], rtol=1e-9)
    for point, there in zip(points, bent, strict=True):
        np.testing.assert_allclose(surface.at(point), there, atol=1e-3)
    place, step = np.array([0.3, 0.6, 0.5]), 1e-6
    differences = [
        (surface.at(place + step * axis) - surface.at(place - step * axis)) / (2.0 * step)
        for axis in np.eye(3)
    ]
    there, slopes = surface.with_slopes(place)
    np.testing.assert_allclose(slopes.T, differences, rtol=1e-5, atol=1e-5)
    some, chain_rule = surface.of_places(np.array([3, 0, 7])).with_chain_rule(place)
    np.testing.assert_allclose(some, there[[3, 0, 7]])
    gradient = np.array([1.0, -2.0, 0.5])
    np.testing.assert_allclose(chain_rule(gradient), gradient @ slopes[[3, 0, 7]])


def test_gauss_newton_steps_in_a_box():
    def rosenbrock(place):
        x, y = place
        return np.array([10.0 * (y - x * x), 1.0 - x]), np.array([[-20.0 * x, 10.0], [-1.0, 0.0]])

    start, low = np.array([0.4, 0.5]), np.full(2, -2.0)
    lowest, least = squares_minimum(rosenbrock, start, low, np.full(2, 2.0))
    np.testing.assert_allclose(lowest, 1.0)
    np.testing.assert_allclose(least, 0.0, atol=1e-20)
    at_bound, least = squares_minimum(rosenbrock, start, low, np.array([0.5, 2.0]))
    np.testing.assert_allclose(at_bound, [0.5, 0.25], atol=1e-6)
    np.testing.assert_allclose(least, 0.25)


@pytest.mark.parametrize("loss", LOSSES)
def test_bent_residuals_add_up_to_scipys_robust_sum(loss):
    bend = bend_of(loss, 0.02)
    assert bend is not None
    residuals = np.array([-0.3, -0.02, -1e-9, 0.0, 1e-4, 0.01, 0.05, 2.0])
    bent, slopes = bend(residuals)
    scipys_sum = least_squares(lambda _: residuals, [0.0], loss=loss, f_scale=0.02, max_nfev=1).cost
    assert bent @ bent == pytest.approx(2.0 * scipys_sum, rel=1e-12)
    assert (np.sign(bent) == np.sign(residuals)).all()
    step = 1e-7 * np.maximum(np.abs(residuals), 1e-3)
    differences = (bend(residuals + step)[0] - bend(residuals - step)[0]) / (2.0 * step)
    np.testing.assert_allclose(
        slopes[residuals != -0.02], differences[residuals != -0.02], rtol=1e-5
    )
    assert bend_of("linear", 1.0) is None


@pytest.mark.parametrize(
    "bounds",
    [
        BOUNDS,
        {**BOUNDS, "rate": (0.1, 1.0)},
        {**BOUNDS, "rate": (2.0, 4.0), "level": (0.5, 1.0)},
    ],
    ids=["inside", "one at a bound", "two at bounds"],
)
def test_the_minimum_is_scipys(bounds):
    found = identify(decay, TEST, bounds, method="least-squares", **SQUARES)
    expected = scipys(bounds=bounds)
    assert found.converged == (bounds is BOUNDS)  # an active bound is reported
    assert found.value == pytest.approx(2.0 * expected.cost, rel=5e-5)
    assert found.evaluations < 60
    widths = np.ptp(list(bounds.values()), axis=1)
    np.testing.assert_allclose(places(found) / widths, expected.x / widths, atol=3e-3)


@pytest.mark.parametrize("loss", LOSSES)
def test_the_robust_minimum_is_scipys(loss):
    """Also where the search is cut short, the answer is the best by the loss."""
    outliers = TEST.copy()
    outliers[[3, 20, 30], 1] += (1.0, -1.5, 2.0)
    found = identify(
        decay, outliers, BOUNDS, method=LeastSquares(loss=loss, f_scale=0.02), **SQUARES
    )
    expected = scipys(outliers, loss=loss, f_scale=0.02)
    np.testing.assert_allclose(places(found), expected.x, atol=0.03)
    plain = identify(decay, outliers, BOUNDS, method=LeastSquares(), **SQUARES)
    assert plain.value < found.value
    assert abs(found.parameters["level"] - 0.3) < abs(plain.parameters["level"] - 0.3)


def test_a_search_that_is_cut_short_answers_by_its_loss():
    outliers = TEST.copy()
    outliers[20, 1] += 3.0
    method = LeastSquares(loss="cauchy", f_scale=0.02)
    found = identify(decay, outliers, BOUNDS, method=method, max_runs=12, **SQUARES)
    bend = bend_of("cauchy", 0.02)
    assert bend is not None
    height = np.ptp(outliers[:, 1])
    sums = []
    for p in found.history[list(BOUNDS)]:
        curve = decay(dict(zip(BOUNDS, p.tolist(), strict=True)))
        bent, _ = bend((curve - outliers)[:, 1] / height)
        sums.append(bent @ bent)
    best = found.history[int(np.argmin(sums))]
    assert places(found).tolist() == [best[name] for name in BOUNDS]
    assert not found.converged


def test_runs_that_fail_are_gone_round():
    def failing(p):
        if p["rate"] > 2.0 or p["height"] > 3.2:
            raise ValueError("no equilibrium")
        return decay(p)

    start = {"height": 2.8, "rate": 1.9, "level": 0.0}
    found = identify(failing, TEST, BOUNDS, method="least-squares", start=start, **SQUARES)
    assert found.failures
    assert found.value == pytest.approx(2.0 * scipys().cost, rel=1e-4)


def test_a_start_around_which_all_fail_is_an_error():
    def failing(p):
        if p["height"] > 1.0:
            raise ValueError("no equilibrium")
        return decay(p)

    start = {"height": 4.0, "rate": 1.0, "level": 0.0}
    with pytest.raises(RuntimeError, match="no simulation succeeded, of 4 that the search begins"):
        identify(failing, TEST, BOUNDS, method="least-squares", start=start, **SQUARES)


@pytest.mark.parametrize("digits", [7, 5])
def test_a_solver_that_prints_few_digits(digits):
    def printed(p):
        return np.array([[float(f"{v:.{digits - 1}e}") for v in row] for row in decay(p)])

    found = identify(printed, TEST, BOUNDS, method="least-squares", **SQUARES)
    assert found.converged
    assert found.value == pytest.approx(2.0 * scipys().cost, rel=1e-3)


def test_steps_that_gain_nothing_of_what_is_promised_are_no_end():
    """Residuals that jump from run to run: no surrogate predicts them, and a message states it."""

    def jumping(p):
        curve = decay(p)
        curve[:, 1] += 0.2 * np.sin(1e5 * sum(p.values()) * (1.0 + X))
        return curve

    found = identify(jumping, TEST, BOUNDS, method=LeastSquares(starts=1), **SQUARES)
    assert not found.converged
    assert "steps improve less than the surrogate predicts" in found.message


def test_auto_takes_it_for_sums_of_squares_alone():
    chosen = {
        measure: method_of("auto").chosen_for(Objective(TEST, measure))
        for measure in ("sum_of_squares", "curve_length", "area")
    }
    assert chosen == {
        "sum_of_squares": LeastSquares(),
        "curve_length": TrustRegion(),
        "area": TrustRegion(),
    }
    assert identify(decay, TEST, BOUNDS, max_runs=3, **SQUARES).method == "least-squares"


def test_runs_of_another_measure_are_taken_up():
    """Where they lie around the start, no simplex is run."""
    noisy = [TEST, TEST + np.column_stack((np.zeros_like(X), np.roll(NOISE, 3)))]
    problems = [Problem.of(test, BOUNDS, measure="sum_of_squares") for test in noisy]
    first = Ledger(problems[0], limit=None)
    drive(LeastSquares(starts=1).staged(first, None, 0), first)
    second = Ledger(problems[1], limit=None, earlier_runs=first.runs_with_curves)
    drive(LeastSquares(starts=1).staged(second, first.best_unit, 0), second)
    expected = scipys(noisy[1])
    assert second.best.value == pytest.approx(2.0 * expected.cost, rel=1e-4)
    assert len(second.done) <= len(BOUNDS)


class WithSlopes:
    """The decay with its derivatives, by the unscaled parameters."""

    def __init__(self, wrong=None):
        self.wrong = wrong

    def __call__(self, p):
        return decay({"level": 0.0, **p})

    def jacobian(self, p):
        if self.wrong is not None:
            return self.wrong
        fall = np.exp(-p["rate"] * X)
        by_name = {"height": fall, "rate": -p["height"] * X * fall, "level": np.ones_like(X)}
        zeros = np.zeros((len(X), len(p)))
        return [np.stack((zeros, np.column_stack([by_name[name] for name in p])), axis=1)]


def test_slopes_that_the_model_knows_take_the_place_of_runs():
    """In another order than the model's, on a logarithmic scale, with one that is tied."""
    bounds = {
        "rate": Log(0.1, 4.0),
        "height": (0.0, 5.0),
        "level": Tied(lambda p: 0.15 * p["height"]),
    }
    method = LeastSquares(starts=1)
    found = identify(WithSlopes(), TEST, bounds, method=method, **SQUARES)
    by_runs = identify(lambda p: decay(p), TEST, bounds, method=method, **SQUARES)
    assert found.converged
    assert found.value == pytest.approx(by_runs.value, rel=5e-5)
    assert found.evaluations <= 5
    assert found.evaluations < by_runs.evaluations
    free = identify(WithSlopes(), TEST, BOUNDS, method=method, **SQUARES)
    assert free.value == pytest.approx(2.0 * scipys().cost, rel=5e-5)
    robust = LeastSquares(starts=1, loss="soft_l1", f_scale=0.02)
    expected = scipys(loss="soft_l1", f_scale=0.02)
    bent = identify(WithSlopes(), TEST, BOUNDS, method=robust, **SQUARES)
    np.testing.assert_allclose(places(bent), expected.x, atol=0.01)


def test_a_start_that_fails_is_gone_round_with_slopes_too():
    class Failing(WithSlopes):
        def __call__(self, p):
            if p["rate"] > 2.0:
                raise ValueError("no equilibrium")
            return super().__call__(p)

    keywords = {"start": {"height": 2.8, "rate": 1.9, "level": 0.0}, **SQUARES}
    found = identify(Failing(), TEST, BOUNDS, method="least-squares", **keywords)
    assert found.value == pytest.approx(2.0 * scipys().cost, rel=5e-5)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (np.zeros((40, 2, 2)), r"shapes \[\(40, 2, 2\)\]; return an array for each of 1 curves"),
        ([np.zeros((40, 2, 3))] * 2, r"\(points, coordinates, 3\): derivatives by the parameters"),
        (np.full((40, 2, 3), np.nan), "returned derivatives that are not finite"),
    ],
)
def test_wrong_slopes_are_an_error(wrong, message):
    with pytest.raises(ValueError, match=message):
        identify(WithSlopes(wrong), TEST, BOUNDS, method="least-squares", **SQUARES)


def test_the_slopes_of_a_driven_material_are_used():
    """Far fewer runs than without; the slopes are those of its curves in the order of the dict."""
    strain = np.concatenate((np.linspace(0, 0.02, 30), np.linspace(0.02, -0.02, 50)))
    point = ChabocheVoce(backstresses=1)
    true = {"E": 200e3, "yield": 300.0, "Q": 50.0, "b": 8.0, "C1": 40e3, "gamma1": 300.0}
    model = point.driven_by(np.column_stack((strain, strain)))
    test = model(true)[0]
    low, high = (model({**true, "yield": 300.0 + d})[0][:, 1] for d in (-1e-3, 1e-3))
    (slopes,) = model.jacobian(dict(reversed(true.items())))
    np.testing.assert_allclose(slopes[:, 1, 4], (high - low) / 2e-3, atol=1e-5)
    bounds = {
        "E": (150e3, 250e3),
        "C1": (10e3, 100e3),
        "yield": (100.0, 500.0),
        "gamma1": (50.0, 600.0),
        "Q": (0.0, 200.0),
        "b": (1.0, 30.0),
    }
    keywords = {"abscissa": "points", "method": LeastSquares(starts=1), **SQUARES}
    exact = identify(model, test, bounds, **keywords)
    by_runs = identify(lambda p: model(p), test, bounds, **keywords)
    assert exact.evaluations < 0.5 * by_runs.evaluations
    for name, value in true.items():
        assert exact.parameters[name] == pytest.approx(value, rel=0.02)


def drive(course, ledger):
    units = next(course)
    try:
        while True:
            batch = [
                (ledger.judged(i, point, Outcome(curve, "", 0.0)), curve)
                for i, point in enumerate(ledger.missing(units))
                for curve in [decay(ledger.space.dictionary(point))]
            ]
            if batch:
                ledger.add(batch)
            units = course.send(ledger.known(units))
    except StopIteration as end:
        return end.value
