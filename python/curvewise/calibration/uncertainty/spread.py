"""How far the parameters spread with the noise: by linear theory, or by a bootstrap.

For a sum of squares the slopes of the residuals say it (the linear theory of least squares, with
Student's t). For every other measure the tests are made anew many times, as the fitted curves plus
noise, and the parameters are identified from each on the response surfaces around the optimum,
which takes no run of the model: a bootstrap, with its basic interval. Cost: two evaluations of the
residuals a parameter, or `samples` minimisations of the measure of some 30 k evaluations each.

B. Efron, R. J. Tibshirani, "An introduction to the bootstrap", Chapman & Hall (1993).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..surfaces.quasi_newton import quasi_newton
from .noise import Noise, autocorrelation, block_length, draw_noise
from .sensitivity import Optimum

__all__ = ["Spread", "bootstrapped_spread", "linear_covariance", "linear_spread"]

# Of a minimisation on the surfaces: differences, in standard errors, and the gain that is not worth
# another step, in parts of what a standard error costs.
_DIFFERENCE, _ENOUGH = 0.05, 0.002
_FLATTEST = 1e-3  # directions that the loops notice less than this, relative to the best, are alike


class Spread(NamedTuple):
    """Of the parameters, in their own units."""

    errors: Array
    bias: Array  # by how much noise alone moves the parameters in the mean
    intervals: list[tuple[float, float]]
    correlations: Array


def linear_spread(optimum: Optimum, noise: Noise, level: float, differential: Array) -> Spread:
    """Return what the linear theory of least squares gives."""
    objective = optimum.problem.objective
    residuals = objective.residuals(optimum.curves(optimum.unit))
    step = 1e-4
    jacobian = np.column_stack(
        [
            objective.residuals(optimum.curves(optimum.unit + step * axis))
            - objective.residuals(optimum.curves(optimum.unit - step * axis))
            for axis in np.eye(optimum.unit.size)
        ]
    ) / (2.0 * step)
    # With a given sigma in units of y; else of the residuals themselves, one deviation a loop.
    counts = objective.residual_counts
    inflation = residuals.size / max(1, residuals.size - optimum.unit.size)
    if noise.residuals is None:
        scale = objective.residual_factors * noise.sigma
    else:
        parts = np.split(residuals, np.cumsum(counts)[:-1])
        scale = np.sqrt([inflation * float(np.mean(part**2)) for part in parts])
    spread = np.repeat(scale, counts)
    inverse = np.linalg.pinv(jacobian)
    covariance = (inverse * spread**2) @ inverse.T
    covariance = differential @ covariance @ differential.T
    errors = np.sqrt(np.diag(covariance))
    stats = required("scipy.stats")
    quantile = stats.norm if noise.residuals is None else stats.t(noise.freedom)
    width = float(quantile.ppf((1.0 + level) / 2.0)) * errors
    point = optimum.problem.space.point(optimum.unit)
    intervals = [(p - w, p + w) for p, w in zip(point, width.tolist(), strict=True)]
    return Spread(errors, np.zeros_like(errors), intervals, _correlation(covariance))


def linear_covariance(optimum: Optimum, noise: Noise) -> Array:
    """Return the covariance of least squares on the points themselves, in the unit cube.

    Whatever the measure: an estimate that takes no bootstrap. Noise whose neighbours are alike is
    that of an autoregression of the first order, so that fewer points than there are count.
    """
    k = optimum.unit.size
    information, scatter = np.zeros((k, k)), np.zeros((k, k))
    columns = optimum.slopes
    for i, sigma in enumerate(noise.sigma):
        y = optimum.problem.objective.y_columns[i]
        count = len(noise.fitted[i])
        places = np.linspace(0.0, len(columns[0][i]) - 1.0, count)
        at = np.arange(len(columns[0][i]))
        slopes = np.column_stack([np.interp(places, at, column[i][:, y]) for column in columns])
        # A test that is fitted to the last digit has no noise that could be divided by.
        slopes /= max(sigma, 1e-12 * float(np.abs(slopes).max()), 1e-150)
        rho = 0.0 if noise.residuals is None else autocorrelation(noise.residuals[i])
        information += slopes.T @ slopes
        scatter += slopes.T @ _correlated(slopes, rho)
    # What no point notices is as uncertain as the bounds are wide, and no more.
    inverse = np.linalg.inv(information + np.eye(k))
    covariance: Array = inverse @ (scatter + np.eye(k)) @ inverse
    return covariance


def _correlated(columns: Array, rho: float) -> Array:
    """Return R @ columns with R[i, j] = rho ** |i - j|, by a walk there and a walk back."""
    if rho == 0.0:
        return columns
    lfilter = required("scipy.signal").lfilter
    there = lfilter([1.0], [1.0, -rho], columns, axis=0)
    back = lfilter([1.0], [1.0, -rho], columns[::-1], axis=0)[::-1]
    correlated: Array = there + back - columns
    return correlated


def bootstrapped_spread(
    optimum: Optimum, noise: Noise, level: float, samples: int, seed: int
) -> Spread:
    """Return the spread of the parameters that other noise would have given."""
    random = np.random.default_rng(seed)
    space = optimum.problem.space
    ys = optimum.problem.objective.y_columns
    lengths = [block_length(residuals) for residuals in noise.residuals or ()]
    steps = _natural_steps(optimum, noise.sigma)
    units = np.empty((samples, optimum.unit.size))
    for i in range(samples):
        tests = []
        for loop, fitted in enumerate(noise.fitted):
            test = fitted.copy()
            test[:, ys[loop]] += draw_noise(noise, loop, lengths, random)
            tests.append(test)
        units[i] = _reminimised(optimum, tests, steps)
    points = np.array([space.point(unit) for unit in units])
    covariance = np.atleast_2d(np.cov(points.T))
    point = np.array(space.point(optimum.unit))
    bias = points.mean(axis=0) - point
    limits = _basic_interval(units, points, point, 1.0 - level)
    ends = zip(*(limit.tolist() for limit in limits), space.bounds.values(), strict=True)
    intervals = [(max(a, first), min(b, last)) for a, b, (first, last) in ends]
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
