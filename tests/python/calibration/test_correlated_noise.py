"""Residuals that go on alike: the likelihood against dense matrices, and intervals that hold."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import signal, special, stats

from curvewise.calibration import Problem, identify
from curvewise.calibration.surfaces.surfaces import Responses, Surfaces
from curvewise.calibration.uncertainty.correlation import (
    Correlation,
    Model,
    _carried_on,
    _expected_square,
    _likelihood,
    correlation_of,
    white,
)
from curvewise.calibration.uncertainty.estimate import Estimate
from curvewise.calibration.uncertainty.noise import noise_of
from curvewise.calibration.uncertainty.repeats import PARTS, Branches, branches_of_tests
from curvewise.calibration.uncertainty.sensitivity import Optimum
from curvewise.calibration.uncertainty.spread import linear_spread

SLICES = [slice(0, 1), slice(1, 14), slice(14, 40)]
BRANCHES = Branches(SLICES)
# The last branch goes against the second one, at twice as many points.
PLACES = np.concatenate(([-1], np.arange(13), np.arange(26) // 2))
SIGNS = np.concatenate((np.ones(14), -np.ones(26)))
REPEATED = Branches(SLICES, PLACES, SIGNS, 1)
X = np.linspace(0.0, 1.0, 40)
DESIGN = np.column_stack((np.ones_like(X), X, X**2))


def dense(branches, reach, share, common=0.0):
    """Return the covariance matrix of a model, of the variance 1."""
    count = branches.slices[-1].stop
    matrix = np.zeros((count, count))
    for branch in branches.slices:
        size = branch.stop - branch.start
        lags = np.abs(np.subtract.outer(np.arange(size), np.arange(size)))
        matrix[branch, branch] = (1.0 - common) * np.exp(-lags / (reach * size))
    if common:
        lags = np.abs(np.subtract.outer(PLACES[1:], PLACES[1:]))
        signs = np.outer(SIGNS[1:], SIGNS[1:])
        matrix[1:, 1:] += common * signs * np.exp(-lags / (reach * PARTS))
    return (1.0 - share) * matrix + share * np.eye(count)


MODELS = st.tuples(
    st.floats(0.01, 1.0),
    st.floats(0.003, 0.9),
    st.sampled_from([0.0, 0.5, 0.9]),
    st.integers(0, 2**32 - 1),
)


@given(MODELS)
@settings(max_examples=20, deadline=None)
def test_the_restricted_likelihood_is_that_of_dense_matrices(model):
    """Of the differences that no parameter can make, whose covariance is K' V K."""
    reach, share, common, seed = model
    residuals = np.random.default_rng(seed).normal(size=40)
    basis, _ = np.linalg.qr(DESIGN)
    outside = np.linalg.svd(basis, full_matrices=True)[0][:, 3:]
    left = residuals - basis @ (basis.T @ residuals)
    found, variance = _likelihood(left, basis, REPEATED, reach, share, common)
    covariance = outside.T @ dense(REPEATED, reach, share, common) @ outside
    seen = outside.T @ residuals
    square = seen @ np.linalg.solve(covariance, seen)
    expected = -0.5 * (37 * math.log(square) + np.linalg.slogdet(covariance)[1])
    assert found == pytest.approx(expected, rel=1e-9)
    assert variance == pytest.approx(square / 37, rel=1e-9)


@given(MODELS)
@settings(max_examples=20, deadline=None)
def test_the_scatter_is_that_of_dense_matrices(model):
    reach, share, common, seed = model
    columns = np.random.default_rng(seed).normal(size=(40, 2))
    correlation = Correlation(
        [Model(0.25, reach, share, common, 4.0), Model(0.75, 0.0, 1.0, 0.0, 9.0)], REPEATED
    )
    alike = dense(REPEATED, reach, share, common) - share * np.eye(40)
    expected = 0.25 * 4.0 * (3.0 * share * columns.T @ columns + 2.0 * columns.T @ alike @ columns)
    expected += 0.75 * 9.0 * 3.0 * columns.T @ columns
    assert correlation.scatter(columns, 3.0, 2.0) == pytest.approx(expected, rel=1e-9)
    ones = 0.25 * dense(REPEATED, reach, share, common).sum() + 0.75 * 40
    assert correlation.independent == pytest.approx(40**2 / ones, rel=1e-9)


@given(MODELS)
@settings(max_examples=20, deadline=None)
def test_the_expected_sum_of_squares_is_that_of_dense_matrices(model):
    reach, share, common, _ = model
    models = [Model(0.25, reach, share, common, 4.0), Model(0.75, 0.0, 1.0, 0.0, 9.0)]
    basis, _ = np.linalg.qr(DESIGN)
    covariance = dense(REPEATED, reach, share, common) + 6.75 * np.eye(40)
    expected = np.trace((np.eye(40) - basis @ basis.T) @ covariance)
    assert _expected_square(models, basis, REPEATED) == pytest.approx(expected, rel=1e-9)


@given(MODELS)
@settings(max_examples=20, deadline=None)
def test_independent_squares_are_counted_by_squared_correlations(model):
    reach, share, _, _ = model
    alike = Correlation([Model(1.0, reach, share, 0.0, 4.0)], BRANCHES)
    squares = np.sum(dense(BRANCHES, reach, share) ** 2)
    assert alike.independent_squares == pytest.approx(40**2 / squares, rel=1e-9)
    assert alike.independent <= alike.independent_squares <= 40.0 + 1e-9


def test_squares_exceed_what_is_expected_where_an_error_goes_on_longer_than_neighbours_say():
    """Half a wave under a rough autoregression that says little of it."""
    branches = Branches([slice(0, 200)])
    random, x = np.random.default_rng(1), np.linspace(0.0, 1.0, 200)
    slopes = np.ones((200, 1))
    noise = Correlation([Model(1.0, 0.02, 0.03, 0.0, 1.0)], branches)
    rough = [noise.draw(random) for _ in range(40)]
    alone = [correlation_of(one, slopes, branches).excess for one in rough]
    assert np.mean(alone) == pytest.approx(1.0, abs=0.2)
    wave = 8.0 * np.cos(np.pi * x)
    waved = [correlation_of(one + wave, slopes, branches).excess for one in rough]
    assert np.median(waved) > 2.0


@pytest.mark.parametrize("common", [0.0, 0.9])
def test_draws_have_the_covariance_of_their_model(common):
    correlation = Correlation([Model(1.0, 0.3, 0.2, common, 4.0)], REPEATED)
    random = np.random.default_rng(0)
    drawn = np.array([correlation.draw(random) for _ in range(4000)])
    assert np.cov(drawn.T) == pytest.approx(4.0 * dense(REPEATED, 0.3, 0.2, common), abs=0.45)


def test_white_noise_is_white_and_a_wave_is_not():
    slopes, branches = DESIGN, Branches([slice(0, 40)])
    noise = [np.random.default_rng(seed).normal(size=40) for seed in range(60)]
    told = [correlation_of(one, slopes, branches).models[0].share == 1.0 for one in noise]
    assert np.mean(told) > 0.9
    wave = correlation_of(np.sin(20.0 * X), slopes, branches)
    assert all(model.share < 1.0 for model in wave.models)
    assert sum(model.probability for model in wave.models) == pytest.approx(1.0)
    assert wave.independent < 12.0
    assert {correlation_of(one, slopes, branches).excess for one in noise[:20]} == {1.0}
    assert white(branches).independent == pytest.approx(40.0)


def test_residuals_of_nothing_are_white():
    assert correlation_of(np.zeros(40), DESIGN, BRANCHES).models == [Model(1.0, 0.0, 1.0, 0.0, 1.0)]


def test_branches_end_where_the_strain_turns():
    strain = np.concatenate([np.linspace(0, 1, 10), np.linspace(1, -1, 20)[1:]])
    loop = np.column_stack((strain, strain))
    found = branches_of_tests([loop, np.ones((1, 1))])
    assert found == Branches([slice(0, 9), slice(9, 29), slice(29, 30)])


def cycles_of(turns, each=30):
    """Return strain that turns at given places, and a wave of its place in the branch."""
    parts = [np.linspace(a, b, each, endpoint=False) for a, b in itertools.pairwise(turns)]
    way = np.tile(np.linspace(0.0, 1.0, each, endpoint=False), len(parts))
    signs = np.repeat(np.sign(np.diff(turns)), each)
    return np.concatenate(parts), signs * np.sin(9.0 * way)


def test_cycles_share_places_whichever_way_they_go():
    strain, _ = cycles_of([0.0, 1.0, -1.0, 1.02, -0.98, 1.0, -1.0])
    found = branches_of_tests([np.column_stack((strain, strain))])
    assert found.ways == 1
    assert (found.places[:30] == -1).all()
    for branch in found.slices[1:]:
        places = found.places[branch]
        assert places[0] == 0
        assert places[-1] == PARTS - 1
        assert (np.diff(places) >= 0).all()
    signs = [found.signs[branch].tolist() for branch in found.slices[1:]]
    assert all(set(one) == {way} for one, way in zip(signs, [1, -1, 1, -1, 1], strict=True))


@pytest.mark.parametrize(
    "turns", [[0.0, 1.0, -1.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 1.0, -1.5, 2.0, -2.5, 3.0, -3.5]]
)
def test_single_cycles_and_growing_ones_have_no_places(turns):
    strain, _ = cycles_of(turns)
    assert branches_of_tests([np.column_stack((strain, strain))]).places is None


def test_an_error_that_comes_back_in_each_cycle_is_worth_one_cycle():
    """The mean error along the way spreads as that of one branch does, and not of twelve."""
    random, turns = np.random.default_rng(0), [(-1.0) ** i for i in range(13)]
    strain, wave = cycles_of(turns)
    branches = branches_of_tests([np.column_stack((strain, strain))])
    along = np.column_stack((strain, strain**3))
    own = np.concatenate(
        [
            np.sign(b - a) * np.sin(9.0 * random.random() + 9.0 * X[:30])
            for a, b in itertools.pairwise(turns)
        ]
    )
    noise = random.normal(0.0, 0.1, len(strain))
    repeated = correlation_of(0.9 * wave + 0.1 * own + noise, along, branches)
    other = correlation_of(own + noise, along, branches)
    assert sum(model.probability * model.common for model in repeated.models) > 0.5
    assert sum(model.probability * model.common for model in other.models) < 0.2


def parabola(p):
    return np.column_stack((X, DESIGN @ [p["a"], p["b"], p["c"]]))


BOUNDS = {"a": (-10.0, 10.0), "b": (-20.0, 20.0), "c": (-20.0, 20.0)}
WIDTHS = np.array([20.0, 40.0, 40.0])
TRUTH = {"a": 1.0, "b": -2.0, "c": 3.0}


def test_with_a_wave(seed):
    """Return a test that no parabola is right for, of another wave for every seed."""
    random = np.random.default_rng(seed)
    test = parabola(TRUTH)
    wave = np.sin(random.uniform(9.0, 14.0) * X + random.uniform(0.0, 2.0 * np.pi))
    test[:, 1] += 0.5 * wave + random.normal(0.0, 0.05, 40)
    return test


test_with_a_wave.__test__ = False


def test_intervals_of_least_squares_hold_the_truth_where_the_model_is_wrong():
    """Those of white noise hold it in a half to two thirds of the sets."""
    inside, naive = [], []
    for seed in range(100):
        test = test_with_a_wave(seed)
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
        test = test_with_a_wave(seed)
        found = identify(parabola, test, BOUNDS, start=TRUTH, progress=False)
        intervals = found.uncertainty().intervals
        inside.append([a <= TRUTH[name] <= b for name, (a, b) in intervals.items()])
    assert np.mean(inside) > 0.9


@pytest.mark.parametrize("rho", [0.0, 0.37, 0.9999])
@pytest.mark.parametrize("shape", [(1,), (300,), (1, 3), (2, 3), (300, 8)])
def test_what_is_carried_on_is_that_of_a_filter(shape, rho) -> None:
    """To rounding: with some processors' kernels of linear algebra multiply-adds are fused."""
    columns = np.random.default_rng(3).normal(size=shape)
    filtered = signal.lfilter([1.0], [1.0, -rho], columns, axis=0)
    most = 1e-14 * len(columns) * np.abs(filtered).max()
    np.testing.assert_allclose(_carried_on(columns, rho), filtered, rtol=0, atol=most)


def test_an_interval_is_as_wide_as_the_likelihood_or_the_squares_say():
    """Whichever says more, each with its own degrees of freedom."""
    nothing, branches = np.zeros((40, 3)), Branches([slice(0, 40)])

    def quantile(excess, freedom=3.0, of_squares=8.0):
        noise = white(branches)._replace(excess=excess)
        given = (nothing, nothing, X, np.eye(3), noise, freedom, of_squares)
        return Estimate(*given, covariance=np.eye(3)).quantile(0.95)

    assert quantile(1.0, 37.0, 20.0) == special.stdtrit(37.0, 0.975)
    assert quantile(1.5) == special.stdtrit(3.0, 0.975)
    assert quantile(4.0) == pytest.approx(2.0 * stats.t(8.0).ppf(0.975), rel=1e-12)
    assert quantile(4.0, math.inf, math.inf) == special.ndtri(0.975)
