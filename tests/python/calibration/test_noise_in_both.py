"""Noise in x, in y and in both: intervals do not depend on which of them the model answers with."""

from __future__ import annotations

import functools
import math
import re

import numpy as np
import pytest

from curvewise.calibration import TrustRegion, identify
from curvewise.calibration.objective.objective import Objective
from curvewise.calibration.uncertainty.directions import directions_of, fitted_tests
from curvewise.calibration.uncertainty.estimate import estimate_of
from curvewise.calibration.uncertainty.noise import noise_of

FORCE = 80.0 * np.interp(np.arange(61) / 20.0, (0, 1, 2, 3), (0, 1, -1, 1))
TRUTH = {"softness": 0.02, "cubic": 2e-6}
BOUNDS = {"softness": (0.0, 0.1), "cubic": (0.0, 1e-5)}
DESIGN = np.column_stack((FORCE, FORCE**3))


def displaced(p):
    """Return the curve of a spring that answers a force with x."""
    return np.column_stack((DESIGN @ [p["softness"], p["cubic"]], FORCE))


def swapped(p):
    return displaced(p)[:, ::-1]


def noisy(curve, x=0.0, y=0.0, seed=0):
    """Return a curve with noise, given in parts of its extent in each coordinate."""
    random = np.random.default_rng(seed)
    return curve + random.normal(size=curve.shape) * (x, y) * np.ptp(curve, axis=0)


def near_truth(model, test, measure, **options):
    method = TrustRegion(starts=1)
    keywords = {"measure": measure, "start": TRUTH, "method": method, "progress": False}
    return identify(model, test, **{"bounds": BOUNDS, **keywords, **options})


def theory_of(found):
    optimum = found.uncertainty().optimum
    noise = noise_of(optimum, None)
    return noise, estimate_of(optimum, noise)


def errors_by_least_squares(found, sigma):
    errors = sigma * np.sqrt(np.diag(np.linalg.inv(DESIGN.T @ DESIGN)))
    return errors / list(found.parameters.values())


def relative_errors(uncertainty):
    return np.array(
        [error / uncertainty.parameters[k] for k, error in uncertainty.standard_errors.items()]
    )


NIGHTLY = [pytest.param(name, marks=pytest.mark.nightly) for name in ("frechet", "curve_length")]


@functools.cache
def found_in_x():
    return near_truth(displaced, noisy(displaced(TRUTH), x=0.004), "dtw")


@pytest.mark.parametrize("measure", ["area", "dtw", *NIGHTLY])
@pytest.mark.filterwarnings("ignore::curvewise.calibration.NoisyTestWarning")
def test_swapped_axes_have_the_same_errors(measure):
    test = noisy(displaced(TRUTH), x=0.004, y=0.004)
    as_x = near_truth(displaced, test, measure).uncertainty()
    as_y = near_truth(swapped, test[:, ::-1], measure).uncertainty()
    assert relative_errors(as_x) == pytest.approx(relative_errors(as_y), rel=0.1)
    heights = np.ptp(test, axis=0)
    assert as_x.sigma / heights[1] == pytest.approx(as_y.sigma / heights[0], rel=0.05)
    assert as_x.determined == as_y.determined == dict.fromkeys(TRUTH, True)


@pytest.mark.parametrize("answers", ["x", "y"])
def test_noise_in_what_the_model_answers_has_the_errors_of_medians(answers):
    """Distances of points, all of the same weight: pi / 2 of the variance of least squares."""
    found = found_in_x()
    if answers == "y":
        found = near_truth(swapped, found.experiments[0][:, ::-1], "dtw")
    noise, estimate = theory_of(found)
    assert estimate.correlation.is_white
    column = "xy".index(answers)
    sigma = noise.components[0][column] * noise.directions[0].scale[column]
    sigma *= math.sqrt(estimate.correlation.variance)
    expected = math.sqrt(math.pi / 2.0) * errors_by_least_squares(found, sigma)
    assert relative_errors(found.uncertainty()) == pytest.approx(expected, rel=0.05)
    assert sigma == pytest.approx(0.004 * np.ptp(displaced(TRUTH)[:, 0]), rel=0.15)


@pytest.mark.parametrize("measure", ["dtw", pytest.param("area", marks=pytest.mark.nightly)])
def test_what_answers_with_x_is_determined_without_noise(measure):
    found = near_truth(displaced, displaced(TRUTH), measure)
    uncertainty = found.uncertainty()
    assert relative_errors(uncertainty).max() < 1e-6
    assert uncertainty.determined == dict.fromkeys(TRUTH, True)
    assert "undetermined" not in str(found)


def spiral(count=400):
    """Return a curve that goes all ways."""
    t = np.linspace(0.0, 12.0, count)
    return np.column_stack((1e-3 * t * np.cos(t), 30.0 * t * np.sin(t)))


@pytest.mark.parametrize(
    ("x", "y"), [(0.003, 0.006), pytest.param(0.004, 0.0, marks=pytest.mark.nightly)]
)
def test_the_noise_of_each_coordinate_is_found(x, y):
    curve = spiral()
    size = {"start": {"size": 1.0}, "bounds": {"size": (0.5, 2.0)}}
    found = near_truth(lambda p: curve * p["size"], noisy(curve, x, y, 1), "area", **size)
    noise, _ = theory_of(found)
    shares = noise.components[0] / np.ptp(curve[:, 1])
    assert shares == pytest.approx((x, y), abs=0.0007)
    assert noise.sigma / np.ptp(curve[:, 1]) == pytest.approx(math.hypot(x, y), rel=0.1)


def test_residuals_are_distances_to_the_nearest_points_with_a_sign():
    def wave(count):
        t = np.linspace(0.0, 3.0, count)
        return np.column_stack((t, 40.0 * np.sin(t)))

    test = noisy(wave(200), 0.01, 0.01)
    ((_, directions, residuals, _),) = fitted_tests(Objective([test], "area"), [wave(200)])
    offsets = (test[:, np.newaxis] - wave(5000)) / directions.scale
    nearest = np.sqrt((offsets**2).sum(axis=2)).min(axis=1)
    inner = slice(5, -5)  # beyond an end the nearest point is the end
    assert np.abs(residuals)[inner] == pytest.approx(nearest[inner], abs=0.02)
    assert (directions.unit[:, 1] >= 0.0).all()
    above = test[:, 1] > np.interp(test[:, 0], *wave(5000).T)
    clear = nearest[inner] > 0.05
    assert ((residuals > 0.0) == above)[inner][clear].all()


def test_repeated_points_have_the_direction_of_the_step_before():
    curve = np.array([[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 1.0]])
    objective = Objective([np.array([[0.0, 0.0], [1.0, 1.0]])], "area")
    unit = directions_of(objective, 0, curve, np.arange(6.0)).unit
    assert unit.tolist() == [[0, 1], [0, 1], [0, 1], [-1, 0], [-1, 0], [-1, 0]]


@pytest.mark.parametrize("case", ["three coordinates", "flat", "a number", "squares"])
def test_other_curves_deviate_in_their_last_coordinate(case):
    t = np.linspace(0.0, 1.0, 30)
    curve = {
        "three coordinates": np.column_stack((t, t**2, np.sin(4.0 * t))),
        "flat": np.column_stack((t, np.ones(30))),
        "a number": np.array([[3.0]]),
        "squares": np.column_stack((t, t**2)),
    }[case]
    measure = "sum_of_squares" if case == "squares" else "area"
    test = curve[0, 0] if case == "a number" else curve
    objective = Objective([test], measure if curve.shape[1] == 2 else "dtw")
    moved = curve + 0.01 * np.cos(np.arange(curve.size)).reshape(curve.shape)
    moved[:, 0] = curve[:, 0] if curve.shape[1] > 1 else moved[:, 0]
    ((points, directions, residuals, _),) = fitted_tests(objective, [moved])
    assert (directions.unit == np.eye(curve.shape[1])[-1]).all()
    if case != "squares":
        assert (points[:, :-1] == objective.experiments[0][:, :-1]).all()
        assert np.abs(points[:, -1] - moved[:, -1]).max() < 1e-9
    assert (residuals == objective.experiments[0][:, -1] - points[:, -1]).all()


def test_squares_are_compared_at_the_measured_x_next_to_other_measures_too():
    x = np.linspace(0.0, 1.0, 23)
    test = np.column_stack((x, np.sin(5.0 * x)))
    finer = np.linspace(0.0, 1.0, 64)
    simulation = np.column_stack((finer, np.cos(4.0 * finer)))
    expected = np.interp(x, finer, simulation[:, 1])
    squares, area = (Objective([test], measure) for measure in ("sum_of_squares", "area"))
    mixed = squares.of_terms([*squares._terms, *area._terms], None)
    for objective, count in ((squares, 1), (mixed, 2)):
        points, _, residuals, _ = next(fitted_tests(objective, [simulation] * count))
        assert points[:, 1] == pytest.approx(expected, abs=1e-12)
        assert residuals == pytest.approx(test[:, 1] - expected, abs=1e-12)


@pytest.mark.parametrize("answers", ["x", "nothing"])
def test_noise_across_a_curve_that_the_model_moves_along(answers):
    """A straight simulation that no parameter moves out of its line: the test has noise still."""
    x = np.linspace(0.0, 1.0, 30)
    test = np.column_stack((x, 1e-3 * np.sin(40.0 * x)))

    def line(p):
        return np.column_stack((x + (p["shift"] if answers == "x" else 0.0), np.zeros(30)))

    size = {"start": {"shift": 0.01}, "bounds": {"shift": (-1.0, 1.0)}}
    noise, estimate = theory_of(near_truth(line, test, "area", **size))
    assert noise.sigma == pytest.approx(np.std(test[:, 1]), rel=0.1)
    assert np.isfinite(estimate.covariance).all()


class Spring:
    """The spring with its derivatives."""

    def __call__(self, p):
        return displaced(p)

    def jacobian(self, p):
        return np.stack([np.column_stack((one, np.zeros(len(FORCE)))) for one in DESIGN.T], axis=2)


def test_intervals_of_a_model_that_answers_with_x_are_followed():
    linear = found_in_x().uncertainty()
    followed = near_truth(Spring(), found_in_x().experiments[0], "dtw").uncertainty()
    assert followed.runs > linear.runs
    for name, ends in followed.intervals.items():
        assert ends == pytest.approx(linear.intervals[name], rel=0.01)


def test_draws_of_the_noise_scatter_as_sensitivities_say():
    drawn = relative_errors(found_in_x().uncertainty(samples=40))
    assert drawn == pytest.approx(relative_errors(found_in_x().uncertainty()), rel=0.35)


def test_what_is_undetermined_has_its_width_beside_it():
    x = np.linspace(0.0, 1.0, 40)

    def line(p):
        return np.column_stack((x, p["height"] + p["slope"] * x))

    bounds = {"height": (0.0, 5.0), "slope": (-1.0, 5.0)}
    test = line({"height": 2.0, "slope": 1.0})
    test[:, 1] += np.random.default_rng(1).normal(0.0, 0.4, 40)
    found = identify(
        line, test, bounds, measure="sum_of_squares", method="trust-region", progress=False
    )
    said = re.search(r"Do not use slope \((\S+) to (\S+)\)", str(found))
    ends = [float(end) for end in said.groups()]
    assert ends == pytest.approx(found.uncertainty().intervals["slope"], rel=0.05)
