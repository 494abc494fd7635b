"""How far the parameters spread with the noise: by sensitivities, at once, or by a bootstrap.

At once: an estimate moves with the noise of every point by what the slopes of the curves there and
the weight that the measure gives to the point say. For a sum of squares that is the linear theory
of least squares, with Student's t. A measure that adds up distances rather than their squares has
the weights of its gradient, and takes, as a median does, pi / 2 of the variance of white noise, and
pi / 2 log 2 of that of noise that goes on alike (the sums over all lags of an autoregression's
correlations, and of their arcsines). The noise may be correlated (`correlation`).

Bootstrap: the tests are made anew many times, as the fitted curves plus noise, and the parameters
are identified from each on the response surfaces around the optimum, which takes no run of the
model; basic intervals. Cost: two evaluations of the residuals a parameter, or `samples`
minimisations of the measure of some 30 k evaluations each.

P. J. Huber, "The behavior of maximum likelihood estimates under nonstandard conditions", Proc. 5th
Berkeley Symp. Math. Stat. Prob. 1 (1967) 221-233; B. Efron, R. J. Tibshirani, "An introduction to
the bootstrap", Chapman & Hall (1993).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..problem.space import Space
from ..surfaces.quasi_newton import quasi_newton
from .correlation import Correlation, branches_of_tests, correlation_of, white
from .noise import Noise, draw_noise
from .sensitivity import Optimum

__all__ = ["ADDED_UP", "Spread", "bootstrapped_spread", "linear_spread", "rise_at"]

ADDED_UP = ("area", "dtw", "sum_of_squares")
"""The measures that add up what is measured at each point; sensitivities are their theory."""

# Of a minimisation on the surfaces: differences, in standard errors, and the gain that is not worth
# another step, in parts of what a standard error costs.
_DIFFERENCE, _ENOUGH = 0.05, 0.002
# Variances of a median in units of a mean's, of white noise and of noise that goes on alike.
_WHITE, _ALIKE = math.pi / 2.0, math.pi / 2.0 * math.log(2.0)
# Where the noise goes on alike, hardly more independent points are left than parameters: the fewest
# degrees of freedom with which Student's t has a variance.
_LEAST_FREEDOM = 3.0
_FLATTEST = 1e-3  # directions that the loops notice less than this, relative to the best, are alike


class Spread(NamedTuple):
    """Of the parameters, in their own units."""

    errors: Array
    bias: Array  # by how much noise alone moves the parameters in the mean
    intervals: list[tuple[float, float]]
    correlations: Array


class Estimate(NamedTuple):
    """How an estimate moves with the noise of the points of all tests, in their deviations.

    Attributes
    ----------
    moves : ndarray, shape (points, k)
        By how much the place in the unit cube moves with the noise of each point.
    slopes : ndarray, shape (points, k)
        Of the curves, at the measured points.
    correlation : Correlation
        Of the noise.
    is_median : bool
        Whether it is that of distances, and not of their squares.
    """

    moves: Array
    slopes: Array
    correlation: Correlation
    is_median: bool

    @property
    def covariance(self) -> Array:
        """Of the place in the unit cube, shape (k, k)."""
        white, alike = (_WHITE, _ALIKE) if self.is_median else (1.0, 1.0)
        return self.correlation.scatter(self.moves, white, alike)


def estimate_of(optimum: Optimum, noise: Noise) -> Estimate:
    """Return how the parameters at an optimum move with the noise."""
    objective = optimum.problem.objective
    branches = branches_of_tests(objective.experiments)
    counts = [len(fitted) for fitted in noise.fitted]
    # A test that is fitted to the last digit has no noise that could be divided by.
    sizes = [
        float(extent[y]) for extent, y in zip(objective.extents, objective.y_columns, strict=True)
    ]
    sigma = np.maximum(noise.sigma, np.maximum(1e-12 * np.array(sizes), 1e-150))
    if objective.is_least_squares:
        factors = np.repeat(objective.residual_factors * sigma, counts)
        slopes, weights = _residual_slopes(optimum) / factors[:, np.newaxis], factors
    else:
        slopes = _point_slopes(optimum, counts) / np.repeat(sigma, counts)[:, np.newaxis]
        weights = np.sqrt(_weights(optimum, sigma, counts))
    if noise.residuals is None:
        correlation = white(branches)
    else:
        residuals = np.concatenate([r / s for r, s in zip(noise.residuals, sigma, strict=True)])
        correlation = correlation_of(residuals, slopes, branches)
    left, values, right = np.linalg.svd(weights[:, np.newaxis] * slopes, full_matrices=False)
    # What no point notices is as uncertain as the bounds are wide, and no more.
    least = float(np.sqrt(np.mean(weights**2)))
    moves = weights[:, np.newaxis] * (left / np.maximum(values, least)) @ right
    return Estimate(moves, slopes, correlation, not objective.is_least_squares)


def _residual_slopes(optimum: Optimum) -> Array:
    """Return the derivatives of the residuals by the place in the unit cube."""
    residuals, step = optimum.problem.objective.residuals, 1e-4
    return np.column_stack(
        [
            residuals(optimum.curves(optimum.unit + step * axis))
            - residuals(optimum.curves(optimum.unit - step * axis))
            for axis in np.eye(optimum.unit.size)
        ]
    ) / (2.0 * step)


def _point_slopes(optimum: Optimum, counts: Sequence[int]) -> Array:
    """Return the slopes of the simulated y at as many points as were measured."""
    ys = optimum.problem.objective.y_columns
    columns = [
        np.concatenate([_at_points(c[:, y], n) for c, y, n in zip(slopes, ys, counts, strict=True)])
        for slopes in optimum.slopes
    ]
    return np.column_stack(columns)


def _at_points(values: Array, count: int) -> Array:
    places = np.linspace(0.0, len(values) - 1.0, count)
    return np.interp(places, np.arange(len(values)), values)


def _weights(optimum: Optimum, sigma: Array, counts: Sequence[int]) -> Array:
    """Return what a deviation at each point costs, where all are alike; 1 in the mean.

    1 everywhere where the measure has no gradient, such as that of the worst point alone.
    """
    objective, curves = optimum.problem.objective, optimum.curves(optimum.unit)
    total = sum(counts)
    if not objective.has_gradient:
        return np.ones(total)
    tests = [curve.copy() for curve in curves]
    for test, deviation, y in zip(tests, sigma, objective.y_columns, strict=True):
        test[:, y] += deviation
    _, gradients = objective.of_other_tests(tests).value_and_gradient(curves)
    parts = [
        _at_points(np.abs(g[:, y]), n) * (s * len(g) / n)
        for g, y, n, s in zip(gradients, objective.y_columns, counts, sigma, strict=True)
    ]
    weights = np.concatenate(parts)
    mean = float(weights.mean())
    return weights / mean if mean > 0.0 else np.ones(total)


def linear_spread(optimum: Optimum, noise: Noise, level: float) -> Spread:
    """Return what the sensitivities give."""
    estimate, space = estimate_of(optimum, noise), optimum.problem.space
    differential = space.differential(optimum.unit)
    covariance = differential @ estimate.covariance @ differential.T
    errors = np.sqrt(np.diag(covariance))
    stats = required("scipy.stats")
    quantile = stats.norm if noise.residuals is None else stats.t(_freedom(estimate, noise))
    width = float(quantile.ppf((1.0 + level) / 2.0)) * errors
    point = np.array(space.point(optimum.unit))
    intervals = _within(space, point - width, point + width)
    return Spread(errors, np.zeros_like(errors), intervals, _correlation(covariance))


def rise_at(optimum: Optimum, noise: Noise, index: int, change: float) -> float:
    """Return by how much the objective rises on the surfaces where one parameter has changed.

    The others follow as least squares would have them, either way; the mean of both.

    Parameters
    ----------
    optimum, noise
        As for `linear_spread`.
    index : int
        Of the parameter.
    change : float
        Of its place in the unit cube.
    """
    moves = estimate_of(optimum, noise).moves
    together = moves.T @ moves
    step = change * together[index] / together[index, index]
    predicted = optimum.problem.objective.predicted
    lowest, *ends = (
        predicted(optimum.curves(optimum.unit + way * step)).value for way in (0.0, 1.0, -1.0)
    )
    return max(float(np.mean(ends)) - lowest, 0.0)


def _freedom(estimate: Estimate, noise: Noise) -> float:
    """Return the degrees of freedom of the deviation: of points that are independent."""
    left: float = estimate.correlation.independent - estimate.slopes.shape[1]
    return min(float(noise.freedom), max(left, _LEAST_FREEDOM))


def _within(space: Space, low: Array, high: Array) -> list[tuple[float, float]]:
    """Return intervals as far as they are within the bounds."""
    ends = zip(low.tolist(), high.tolist(), space.bounds.values(), strict=True)
    return [(max(a, first), min(b, last)) for a, b, (first, last) in ends]


def bootstrapped_spread(
    optimum: Optimum, noise: Noise, level: float, samples: int, seed: int
) -> Spread:
    """Return the spread of the parameters that other noise would have given."""
    random = np.random.default_rng(seed)
    space = optimum.problem.space
    ys = optimum.problem.objective.y_columns
    correlation = estimate_of(optimum, noise).correlation
    steps = _natural_steps(optimum, noise.sigma)
    units = np.empty((samples, optimum.unit.size))
    for i in range(samples):
        tests = [fitted.copy() for fitted in noise.fitted]
        for test, y, drawn in zip(tests, ys, draw_noise(noise, correlation, random), strict=True):
            test[:, y] += drawn
        units[i] = _reminimised(optimum, tests, steps)
    points = np.array([space.point(unit) for unit in units])
    covariance = np.atleast_2d(np.cov(points.T))
    point = np.array(space.point(optimum.unit))
    bias = points.mean(axis=0) - point
    intervals = _within(space, *_basic_interval(units, points, point, 1.0 - level))
    return Spread(np.sqrt(np.diag(covariance)), bias, intervals, _correlation(covariance))


def _basic_interval(
    units: Array, points: Array, point: Array, missed: float
) -> tuple[Array, Array]:
    """Return the mirror image of the percentiles about the optimum, which allows for a bias.

    Doing it all again from the optimum less the bias was tried with curve_length, where it matters:
    the intervals held the truth less often. Where draws end at a bound nobody knows how far they
    would have gone, and their mirror image would be a limit that is made up: there the percentile
    itself is taken if it is further away. The optimum is inside in any case.

    Parameters
    ----------
    units, points : ndarray, shape (samples, k)
        The draws, in the unit cube and in the parameters' own units.
    point : ndarray, shape (k,)
        The optimum.
    missed : float
        The probability that is left out.
    """
    low, high = np.quantile(points, [missed / 2.0, 1.0 - missed / 2.0], axis=0)
    at_low, at_high = ((units == bound).mean(axis=0) > missed / 2.0 for bound in (0.0, 1.0))
    first, last = 2.0 * point - high, 2.0 * point - low
    first = np.minimum(first, np.where(at_high, low, point))
    last = np.maximum(last, np.where(at_low, high, point))
    return first, last


def _correlation(covariance: Array) -> Array:
    errors = np.sqrt(np.diag(covariance))
    errors = np.where(errors > 0, errors, 1.0)
    correlation: Array = covariance / np.outer(errors, errors)
    return correlation


def _reminimised(optimum: Optimum, tests: list[Array], steps: Array) -> Array:
    """Return where on the surfaces the objective of other tests is lowest.

    The search is in coordinates in which all directions count alike: of `steps`.
    """
    objective = optimum.problem.objective.of_other_tests(tests)

    def place(z: Array) -> Array:
        moved: Array = np.clip(optimum.unit + steps @ z, 0.0, 1.0)
        return moved

    start = np.zeros(optimum.unit.size)
    lowest = objective.predicted(optimum.curves(optimum.unit)).value or 1.0
    count = sum(map(len, tests))
    best = quasi_newton(
        lambda z: objective.predicted(optimum.curves(place(z))).value / lowest,
        start,
        count * np.eye(start.size),  # a standard error raises the value by 1 / (2 n) of itself
        difference=_DIFFERENCE,
        enough=_ENOUGH / count,
        maxiter=10 + 5 * start.size,
    )
    return place(best)


def _natural_steps(optimum: Optimum, sigma: Array) -> Array:
    """Return steps, as columns, that the loops notice alike: about one standard error each."""
    slopes = np.concatenate(optimum.scaled_slopes())
    _, values, directions = np.linalg.svd(slopes, full_matrices=False)
    objective = optimum.problem.objective
    columns = zip(objective.extents, objective.y_columns, strict=True)
    heights = np.array([extent[y] for extent, y in columns])
    count = sum(map(len, objective.experiments))
    noise = max(float(np.mean(sigma / heights)), 1e-9) / math.sqrt(count)
    sizes = noise / np.maximum(values, _FLATTEST * values[0])
    steps: Array = directions.T * np.minimum(sizes, 0.25)
    return steps
