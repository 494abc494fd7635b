"""Interval ends computed on the model: closed forms, bounds, failures, and counts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from curvewise.calibration import identify, profile
from curvewise.calibration.uncertainty.estimate import estimate_of
from curvewise.calibration.uncertainty.followed import IntervalEnd
from curvewise.calibration.uncertainty.noise import noise_of
from curvewise.calibration.uncertainty.spread import linear_spread

X = np.linspace(0.0, 1.0, 30)
DESIGN = np.column_stack((np.ones_like(X), X))


def arrived(end, curve, slopes, start):
    """Let an end arrive on a function of the unit cube, and return where."""
    while (place := end.next_place()) is not None:
        end.tell(place, curve(place) - curve(start), slopes(place))
    return end.furthest


@given(
    st.integers(0, 2**32 - 1), st.integers(0, 2), st.sampled_from((-1.0, 1.0)), st.floats(0.01, 1.0)
)
@settings(max_examples=30, deadline=None)
def test_of_a_linear_function_the_end_is_that_of_the_ellipsoid(seed, index, way, size):
    """By as much as size / sqrt of what a parameter is noticed alone, and in one step."""
    slopes = np.random.default_rng(seed).normal(size=(20, 3))
    inverse = np.linalg.inv(slopes.T @ slopes)
    start = np.full(3, 0.5)
    square = (0.2 * size) ** 2 / inverse.diagonal().max()
    end = IntervalEnd(start, slopes, index, way, square)
    place = arrived(end, lambda p: slopes @ p, lambda p: slopes, start)
    expected = way * math.sqrt(square * inverse[index, index])
    assert place[index] - 0.5 == pytest.approx(expected, rel=1e-6)
    moved = slopes @ (place - start)
    assert moved @ moved == pytest.approx(square, rel=1e-6)


def test_of_a_curved_function_the_end_is_where_the_function_has_moved_as_far():
    """exp(3 p) moves by s at log(exp(3 p0) + s) / 3; the slope at p0 alone ends elsewhere."""

    def function(p):
        return np.exp(3.0 * p)

    start, square = np.array([0.4]), 1.0
    slopes = (3.0 * function(start)).reshape(1, 1)
    ends = [
        arrived(
            IntervalEnd(start, slopes, 0, way, square),
            function,
            lambda p: (3.0 * function(p)).reshape(1, 1),
            start,
        )
        for way in (-1.0, 1.0)
    ]
    for way, end in zip((-1.0, 1.0), ends, strict=True):
        exact = math.log(math.exp(1.2) + way) / 3.0
        linear = 0.4 + way / float(slopes[0, 0])
        assert end[0] == pytest.approx(exact, abs=0.01)
        assert abs(end[0] - exact) < 0.5 * abs(linear - exact)


def test_a_parameter_is_held_at_its_bound_and_the_other_goes_on():
    """Both move the same two points; beyond the bound of one, the other has to pay alone."""
    slopes = np.array([[1.0, 0.9], [0.0, 0.2]])
    start, square = np.array([0.2, 0.1]), 0.09
    place = arrived(
        IntervalEnd(start, slopes, 0, 1.0, square), lambda p: slopes @ p, lambda p: slopes, start
    )
    assert place[1] == 0.0
    root = math.sqrt(square - (0.2 * 0.1) ** 2)
    assert place[0] == pytest.approx(0.2 + 0.9 * 0.1 + root, rel=1e-6)
    free = IntervalEnd(start, 0.01 * slopes, 0, 1.0, square)
    assert arrived(free, lambda p: 0.01 * slopes @ p, lambda p: 0.01 * slopes, start)[0] == 1.0


def test_a_run_that_fails_halves_the_step():
    slopes = np.eye(1)
    start = np.array([0.5])
    end = IntervalEnd(start, slopes, 0, 1.0, 0.04)
    first = end.next_place()
    assert first == pytest.approx(0.7)
    end.tell(first, None, None)
    second = end.next_place()
    assert second == pytest.approx(0.6)
    end.tell(second, second - start, slopes)
    assert end.furthest == pytest.approx(0.6)
    for _ in range(20):
        if (place := end.next_place()) is not None:
            end.tell(place, None, None)
    assert end.next_place() is None
    assert end.furthest == pytest.approx(0.6)


@dataclass
class Power:
    """K x ** n, with its slopes or without, which counts its runs."""

    runs: int = 0

    def __call__(self, p):
        self.runs += 1
        return np.column_stack((X, p["K"] * X ** p["n"]))


class WithSlopes(Power):
    def jacobian(self, p):
        with np.errstate(divide="ignore"):
            by_n = np.where(X > 0.0, p["K"] * X ** p["n"] * np.log(np.maximum(X, 1e-300)), 0.0)
        slopes = np.column_stack((X ** p["n"], by_n))
        return np.stack((np.zeros_like(slopes), slopes), axis=1)


BOUNDS = {"K": (0.1, 5.0), "n": (0.05, 4.0)}


def found_by(model, measure, sigma=0.25):
    test = np.column_stack((X, 2.0 * X**0.5))
    test[:, 1] += np.random.default_rng(3).normal(0.0, sigma, X.size)
    return identify(
        model, test, BOUNDS, measure=measure, start={"K": 2.0, "n": 0.5}, progress=False
    )


@pytest.mark.parametrize("measure", ["sum_of_squares", "area"])
def test_intervals_hold_the_linear_ones_and_are_not_symmetric(measure):
    model = WithSlopes()
    found = found_by(model, measure)
    before = model.runs
    uncertainty = found.uncertainty()
    assert uncertainty.runs == model.runs - before
    assert 0 < uncertainty.runs <= 4 * 15
    linear = linear_spread(uncertainty.optimum, noise_of(uncertainty.optimum, None), 0.95)
    for (low, high), (first, last) in zip(
        uncertainty.intervals.values(), linear.intervals, strict=True
    ):
        assert isinstance(low, float)
        assert low <= first < last <= high
    # An exponent that grows is noticed less and less: there its interval goes further.
    best, (low, high) = uncertainty.parameters["n"], uncertainty.intervals["n"]
    assert high - best > 1.05 * (best - low)
    assert list(uncertainty.standard_errors.values()) == pytest.approx(linear.errors)


def test_a_model_without_slopes_has_the_linear_intervals_and_no_runs():
    uncertainty = found_by(Power(), "sum_of_squares").uncertainty()
    linear = linear_spread(uncertainty.optimum, noise_of(uncertainty.optimum, None), 0.95)
    assert list(uncertainty.intervals.values()) == linear.intervals


def test_with_little_noise_the_intervals_are_the_linear_ones():
    uncertainty = found_by(WithSlopes(), "sum_of_squares", sigma=1e-4).uncertainty()
    linear = linear_spread(uncertainty.optimum, noise_of(uncertainty.optimum, None), 0.95)
    for found, expected in zip(uncertainty.intervals.values(), linear.intervals, strict=True):
        assert found == pytest.approx(expected, abs=1e-3 * np.ptp(expected))


def test_a_profile_starts_from_the_linear_interval():
    found = found_by(WithSlopes(), "sum_of_squares")
    optimum = found.uncertainty().optimum
    linear = linear_spread(optimum, noise_of(optimum, None), 0.95).intervals[1]
    assert profile(found, "n", points=5).by_sensitivities == linear


class Growth:
    """Return exp(a) x: the less a is, the less the curve notices of it."""

    def __call__(self, p):
        return np.column_stack((X, np.exp(p["a"]) * X))

    def jacobian(self, p):
        slopes = np.exp(p["a"]) * X[:, np.newaxis]
        return np.stack((np.zeros_like(slopes), slopes), axis=1)


def test_the_lower_end_goes_further_where_the_curve_notices_less():
    test = np.column_stack((X, X))
    found = identify(
        Growth(),
        test,
        {"a": (-3.0, 3.0)},
        measure="sum_of_squares",
        start={"a": 0.0},
        progress=False,
    )
    uncertainty = found.uncertainty(sigma=0.8)
    low, high = uncertainty.intervals["a"]
    half = 1.959964 * 0.8 / math.sqrt(float(X @ X))
    assert high == pytest.approx(half, rel=0.01)  # exp bends up: the linear end is further
    assert low == pytest.approx(math.log(1.0 - half), rel=0.05)


class Parabola:
    """a + b x + c x ** 2, with its slopes."""

    columns = np.column_stack((np.ones_like(X), X, X**2))

    def __call__(self, p):
        return np.column_stack((X, self.columns @ [p["a"], p["b"], p["c"]]))

    def jacobian(self, p):
        return np.stack((np.zeros_like(self.columns), self.columns), axis=1)


@pytest.mark.parametrize("at_bound", [True, False])
def test_where_a_parameter_is_at_its_bound_no_end_counts_for_its_parameter_alone(at_bound):
    """Correlated residuals: ends then differ in height, and one holds what another needs."""
    test = Parabola()({"a": 0.0, "b": 0.0, "c": 0.0})
    test[:, 1] += np.exp(-8.0 * X) + 0.5 * X**2
    bounds = {"a": (-9.0, 9.0), "b": (-30.0, 30.0), "c": (8.0 if at_bound else -30.0, 30.0)}
    found = identify(Parabola(), test, bounds, measure="sum_of_squares", progress=False)
    uncertainty = found.uncertainty()
    assert bool(uncertainty.at_bounds) is at_bound
    optimum = uncertainty.optimum
    estimate = estimate_of(optimum, noise_of(optimum, None))
    squares = estimate.quantiles(0.95) ** 2 * np.diag(estimate.covariance)
    heights = squares / np.diag(estimate.inverse)
    slopes = estimate.factors[:, np.newaxis] * Parabola.columns * np.ptp(list(bounds.values()), 1)
    ends = [
        IntervalEnd(optimum.unit, slopes, i, way, square)
        for i, square in enumerate(heights)
        for way in (-1.0, 1.0)
    ]
    places = np.array(
        [arrived(end, lambda p: slopes @ p, lambda p: slopes, optimum.unit) for end in ends]
    )
    low, high = np.array(list(bounds.values())).T
    places = low + places * (high - low)
    linear = np.array(linear_spread(optimum, noise_of(optimum, None), 0.95).intervals)
    own = np.column_stack((places[::2].diagonal(), places[1::2].diagonal()))
    own = np.column_stack(
        (np.minimum(own, linear).min(axis=1), np.maximum(own, linear).max(axis=1))
    )
    everything = np.vstack((places, linear.T))
    all_ends = np.column_stack((everything.min(axis=0), everything.max(axis=0)))
    assert np.ptp(all_ends - own) > 0.005 * np.ptp(own)
    assert np.array(list(uncertainty.intervals.values())) == pytest.approx(
        all_ends if at_bound else own, rel=1e-6
    )


def test_an_end_at_a_bound_is_open_and_said_to_be():
    """Growth with so much noise that any smaller value is possible too, down to the bound."""
    test = np.column_stack((X, X))
    found = identify(
        Growth(), test, {"a": (-3.0, 3.0)}, measure="sum_of_squares", progress=False, start={"a": 0}
    )
    uncertainty = found.uncertainty(sigma=3.0)
    assert uncertainty.intervals["a"][0] == -3.0
    assert uncertainty.open_ends == {"a": (True, False)}
    shown = str(uncertainty)
    assert "<-3 " in shown
    assert "the interval ends at a bound" in shown
    narrow = found.uncertainty(sigma=0.8)
    assert narrow.open_ends == {"a": (False, False)}
    assert "ends at a bound" not in str(narrow)
