"""Correlated residuals: covariances against dense matrices, the bootstrap-t, and its coverage."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import linalg, special, stats

from curvewise.calibration import Problem, identify
from curvewise.calibration.surfaces.surfaces import Responses, Surfaces
from curvewise.calibration.uncertainty.correlation import (
    Correlation,
    correlation_of,
    given_noise,
)
from curvewise.calibration.uncertainty.estimate import Estimate
from curvewise.calibration.uncertainty.noise import noise_of
from curvewise.calibration.uncertainty.sensitivity import Optimum, moves_of
from curvewise.calibration.uncertainty.spread import linear_spread

X = np.linspace(0.0, 1.0, 40)
DESIGN = np.column_stack((np.ones_like(X), X, X**2))


def noise_in(residuals, slopes):
    """Return the noise that residuals show, of an unweighted fit."""
    moves, _ = moves_of(np.ones(len(slopes)), slopes)
    return correlation_of(residuals, slopes, moves), moves


def left_by(noise, slopes):
    """Return what a fit leaves of noise."""
    basis, _ = np.linalg.qr(slopes)
    return noise - basis @ (basis.T @ noise)


def circulant(noise, of_median=False):
    """Return the covariance of noise whose shifts are equally likely, as a dense matrix."""
    covariances = np.array([noise @ np.roll(noise, lag) for lag in range(len(noise))]) / len(noise)
    if of_median:
        covariances = covariances[0] * np.arcsin(covariances / covariances[0])
    return linalg.circulant(covariances)


@given(st.integers(2, 41), st.integers(1, 30), st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_the_scatter_is_that_of_dense_matrices(first, second, seed):
    random = np.random.default_rng(seed)
    noise = [random.normal(size=first).cumsum(), random.normal(size=second)]
    columns = random.normal(size=(first + second, 3))
    found = Correlation(noise, False).scatter(columns)
    expected = columns.T @ linalg.block_diag(*map(circulant, noise)) @ columns
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)
    white = Correlation(noise, True)
    variance = np.concatenate(noise) @ np.concatenate(noise) / (first + second)
    assert white.scatter(columns) == pytest.approx(variance * columns.T @ columns, rel=1e-9)


@given(st.integers(3, 40), st.integers(0, 2**32 - 1))
@settings(max_examples=20, deadline=None)
def test_the_scatter_of_a_median_is_that_of_signs(count, seed):
    """By arcsines of the autocorrelations; for a matrix that is not a covariance, its positive
    part.
    """
    random = np.random.default_rng(seed)
    noise, columns = random.normal(size=count).cumsum(), random.normal(size=(count, 2))
    values, vectors = np.linalg.eigh(circulant(noise, of_median=True))
    matrix = (vectors * np.maximum(values, 0.0)) @ vectors.T
    found = Correlation([noise], False).scatter(columns, of_median=True)
    assert found == pytest.approx(columns.T @ matrix @ columns, rel=1e-7, abs=1e-9)
    white = Correlation([noise], True).scatter(columns, of_median=True)
    variance = float(noise @ noise) / count
    assert white == pytest.approx(math.pi / 2.0 * variance * columns.T @ columns, rel=1e-9)


def test_fits_of_shifted_noise_leave_as_much_as_the_fit_has_left():
    wave = left_by(np.sin(11.0 * X) + 0.3 * X**4, DESIGN)
    found, _ = noise_in([wave], DESIGN)
    assert not found.is_white
    (enlarged,) = found.noise
    assert enlarged == pytest.approx(enlarged[0] / wave[0] * wave, rel=1e-9)
    shifts = [left_by(np.roll(enlarged, by), DESIGN) for by in range(40)]
    assert np.mean([one @ one for one in shifts]) == pytest.approx(wave @ wave, rel=1e-9)


def test_deviates_are_those_of_refits_in_units_of_their_own_errors():
    """Their quantiles, against refits of every shift by dense matrices."""
    wave = left_by(np.sin(11.0 * X) + 0.3 * X**4, DESIGN)
    found, moves = noise_in([wave], DESIGN)
    (enlarged,) = found.noise
    expected = []
    for one in (enlarged, enlarged[::-1]):
        for by in range(40):
            noise = np.roll(one, by)
            left = left_by(noise, DESIGN)
            basis, _ = np.linalg.qr(DESIGN)
            taken = np.trace(basis.T @ circulant(left) @ basis)
            enlarging = left @ left / (left @ left - taken)
            errors = np.sqrt(enlarging * np.diag(moves.T @ circulant(left) @ moves))
            expected.append(np.abs(noise @ moves) / errors)
    for level in (0.5, 0.8):
        quantiles = np.quantile(found.deviates, level, axis=0)
        assert quantiles == pytest.approx(np.quantile(expected, level, axis=0), rel=0.15)


def test_draws_are_shifts_turned_round_and_over():
    noise = [np.arange(1.0, 8.0), np.arange(20.0, 24.0)]
    random = np.random.default_rng(0)
    drawn = [Correlation(noise, False).draw(random) for _ in range(2000)]
    for i, one in enumerate(noise):
        possible = {
            tuple(sign * np.roll(way, k))
            for sign in (1, -1)
            for way in (one, one[::-1])
            for k in range(len(one))
        }
        assert {tuple(draw[i]) for draw in drawn} == possible
    white = [np.concatenate(Correlation(noise, True).draw(random)) for _ in range(500)]
    assert np.var(white) == pytest.approx(np.mean(np.concatenate(noise) ** 2), rel=0.1)


def test_white_noise_is_white_and_a_wave_is_not():
    noise = [left_by(np.random.default_rng(seed).normal(size=40), DESIGN) for seed in range(60)]
    assert np.mean([noise_in([one], DESIGN)[0].is_white for one in noise]) > 0.9
    assert not noise_in([left_by(np.sin(20.0 * X), DESIGN)], DESIGN)[0].is_white
    found, _ = noise_in([noise[0]], DESIGN)
    assert found.variance == pytest.approx(noise[0] @ noise[0] / 37, rel=1e-9)


def test_a_slow_error_below_the_noise_is_found_by_the_variances():
    """Neighbours barely show it; the estimates move with it."""
    x = np.linspace(0.0, 1.0, 400)
    slopes = np.column_stack((np.ones_like(x), x, x**2))
    found = []
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(size=400) + 0.5 * np.sin(9.0 * x)
        found.append(not noise_in([left_by(noise, slopes)], slopes)[0].is_white)
    assert np.mean(found) > 0.5


def test_residuals_of_nothing_are_white():
    found, _ = noise_in([np.zeros(40)], DESIGN)
    assert found.is_white
    assert found.variance == 0.0


def test_single_numbers_beside_a_curve_have_their_part():
    slopes = np.vstack((DESIGN, [[1.0, 0.0, 0.0]]))
    left = left_by(np.append(np.sin(20.0 * X), 0.3), slopes)
    found, moves = noise_in([left[:40], left[40:]], slopes)
    assert np.isfinite(found.scatter(moves)).all()
    assert len(found.noise[1]) == 1


def test_model_error_that_recurs_in_each_cycle_is_worth_one_cycle():
    """The standard error of a scale does not fall with the number of cycles."""
    errors = {}
    for cycles in (1, 12):
        phase = 2.0 * np.pi * np.tile(np.arange(60) / 60.0, cycles)
        slopes = np.column_stack((np.sin(phase) ** 3, np.cos(phase) ** 5))
        noise = np.random.default_rng(0).normal(0.0, 0.02, phase.size)
        left = left_by(np.sin(phase) + np.cos(3.0 * phase) + noise, slopes)
        found, moves = noise_in([left], slopes)
        assert not found.is_white
        errors[cycles] = np.sqrt(np.diag(found.scatter(moves)))
    assert errors[12] == pytest.approx(errors[1], rel=0.5)


def parabola(p):
    return np.column_stack((X, DESIGN @ [p["a"], p["b"], p["c"]]))


BOUNDS = {"a": (-10.0, 10.0), "b": (-20.0, 20.0), "c": (-20.0, 20.0)}
WIDTHS = np.array([20.0, 40.0, 40.0])
TRUTH = {"a": 1.0, "b": -2.0, "c": 3.0}


def a_test_with_a_wave(seed):
    """Return a test that no parabola is right for, of another wave for every seed."""
    random = np.random.default_rng(seed)
    test = parabola(TRUTH)
    wave = np.sin(random.uniform(9.0, 14.0) * X + random.uniform(0.0, 2.0 * np.pi))
    test[:, 1] += 0.5 * wave + random.normal(0.0, 0.05, 40)
    return test


def test_intervals_of_least_squares_hold_the_truth_where_the_model_is_wrong():
    """Those of white noise hold it in a half to two thirds of the sets."""
    inside, naive = [], []
    for seed in range(100):
        test = a_test_with_a_wave(seed)
        best, *_ = np.linalg.lstsq(DESIGN, test[:, 1], rcond=None)
        problem = Problem.of(test, BOUNDS, measure="sum_of_squares")
        curve = np.column_stack((X, DESIGN @ best))
        slopes = np.stack((np.zeros((40, 3)), DESIGN * WIDTHS), axis=1).reshape(80, 3)
        unit = problem.space.unit(dict(zip(BOUNDS, best, strict=True)))
        surfaces = Surfaces(unit, curve.ravel(), slopes)
        optimum = Optimum(problem, unit, Responses([curve]), surfaces)
        spread = linear_spread(optimum, noise_of(optimum, None), 0.95)
        inside.append(
            [a <= t <= b for t, (a, b) in zip(TRUTH.values(), spread.intervals, strict=True)]
        )
        residuals = test[:, 1] - curve[:, 1]
        errors = np.sqrt(residuals @ residuals / 37 * np.diag(np.linalg.inv(DESIGN.T @ DESIGN)))
        naive.append(np.abs(best - list(TRUTH.values())) <= stats.t(37).ppf(0.975) * errors)
    assert np.mean(naive, axis=0).max() < 0.85
    assert np.mean(inside, axis=0).min() >= 0.88


@pytest.mark.nightly
def test_intervals_of_area_hold_the_truth_where_the_model_is_wrong():
    inside = []
    for seed in range(12):
        test = a_test_with_a_wave(seed)
        found = identify(parabola, test, BOUNDS, start=TRUTH, progress=False)
        intervals = found.uncertainty().intervals
        inside.append([a <= TRUTH[name] <= b for name, (a, b) in intervals.items()])
    assert np.mean(inside) > 0.9


def test_the_freedom_is_that_of_the_frequencies_that_decide():
    """Two of a frequency of a known spectrum; a periodogram's squares are twice the spectrum's."""
    noise = np.random.default_rng(0).normal(size=2000)
    phase = 2.0 * np.pi * np.arange(2000) / 2000.0
    few = np.column_stack([np.cos(3.0 * phase), np.cos(3.0 * phase) + np.cos(40.0 * phase)])
    both = Correlation([np.cos(3.0 * phase) + np.cos(40.0 * phase)], False).freedom(few)
    assert both == pytest.approx([4.0, 8.0])
    impulse = np.eye(2000)[:, :1]
    assert Correlation([noise], False).freedom(impulse) == pytest.approx([2000.0], rel=0.1)
    halves = Correlation([noise[:1000], noise[1000:]], False)
    assert halves.freedom(impulse) == pytest.approx([1000.0], rel=0.1)
    assert halves.freedom(np.zeros((2000, 1))) == [3.0]


def test_quantiles_are_those_of_the_bootstrap_and_of_student():
    deviates = np.linspace(0.0, 4.0, 101)[:, np.newaxis] * [1.0, 0.1, 2.0]
    nothing = np.zeros((40, 3))

    def quantiles(noise, freedom):
        given = (nothing, nothing, X, np.eye(3), noise, freedom)
        return Estimate(*given, np.eye(3), []).quantiles(0.95)

    normal = special.ndtri(0.975)
    correlated = Correlation([X], False, deviates)
    few = stats.t(3.0).ppf(0.975) / normal
    assert quantiles(correlated, 37.0) == pytest.approx(few * np.array([3.8, normal, 7.6]))
    student = stats.t(37.0).ppf(0.975)
    assert quantiles(Correlation([X], True), 37.0) == pytest.approx(np.full(3, student))
    assert quantiles(given_noise([40]), math.inf) == pytest.approx(np.full(3, normal))
