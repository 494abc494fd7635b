"""How an estimate moves with the noise of every point: slopes, weights, and their sandwich.

To the first order an estimate moves with the noise of a point by what the slopes of the curves
there and the weight that the measure gives to the point say. For a sum of squares that is the
linear theory of least squares. A measure that adds up distances rather than their squares has the
weights of its gradient, and takes, as a median does, pi / 2 of the variance of white noise, and
pi / 2 log 2 of that of noise that goes on alike (the sums over all lags of an autoregression's
correlations, and of their arcsines); the area of pieces is a median of these, where the noise is
white (`area_pieces`). Where the residuals' squares add up to more than the likely correlation
expects, their sum says how large the error is, with Satterthwaite's degrees of freedom, if that
makes an interval wider. Cost: two evaluations of the residuals a parameter, or one gradient; and
that of `correlation_of`.

P. J. Huber, "The behavior of maximum likelihood estimates under nonstandard conditions", Proc. 5th
Berkeley Symp. Math. Stat. Prob. 1 (1967) 221-233; F. E. Satterthwaite, "An approximate distribution
of estimates of variance components", Biometrics Bull. 2 (1946) 110-114.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from .area_pieces import NoisyCurve, area_scatter
from .correlation import Correlation, correlation_of, white
from .moves import moves_of
from .noise import Noise
from .repeats import branches_of_tests
from .sensitivity import Optimum

__all__ = ["Estimate", "estimate_of", "point_slopes", "points_of_tests"]

# Variances of a median in units of a mean's, of white noise and of noise that goes on alike.
_WHITE, _ALIKE = math.pi / 2.0, math.pi / 2.0 * math.log(2.0)
# Where the noise goes on alike, hardly more independent points are left than parameters: the fewest
# degrees of freedom with which Student's t has a variance.
_LEAST_FREEDOM = 3.0
# Of the independent squares. The variance and the reach of an autoregression are both estimated,
# each with a relative variance of 2 by their number, and the error of what goes on longest is
# proportional to both.
_OF_SQUARES = 0.5


class Estimate(NamedTuple):
    """How an estimate moves with the noise of the points of all tests, in their deviations.

    Attributes
    ----------
    moves : ndarray, shape (points, k)
        By how much the place in the unit cube moves with the noise of each point.
    slopes : ndarray, shape (points, k)
        Of the curves, at the measured points.
    factors : ndarray, shape (points,)
        By what a difference in y at each point is multiplied in the squares that are added up.
    inverse : ndarray, shape (k, k)
        Of the normal matrix: how far the estimate moves with white noise of those squares.
    correlation : Correlation
        Of the noise.
    freedom : float
        The degrees of freedom of its deviation: of points that are independent; infinite where it
        is given.
    freedom_of_squares : float
        Those of the sum of squares of the residuals, where these go on alike.
    covariance : ndarray, shape (k, k)
        Of the place in the unit cube.
    """

    moves: Array
    slopes: Array
    factors: Array
    inverse: Array
    correlation: Correlation
    freedom: float
    freedom_of_squares: float
    covariance: Array

    def quantile(self, level: float) -> float:
        """Return how many standard errors half an interval has.

        By the likelihood's deviation, or by that of the sum of squares: whichever says more.
        """
        special, upper = required("scipy.special"), (1.0 + level) / 2.0
        if math.isinf(self.freedom):
            return float(special.ndtri(upper))
        by_likelihood = float(special.stdtrit(self.freedom, upper))
        if self.correlation.excess <= 1.0:
            return by_likelihood
        by_squares = float(special.stdtrit(self.freedom_of_squares, upper))
        return max(by_likelihood, math.sqrt(self.correlation.excess) * by_squares)


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
    deviations = np.repeat(sigma, counts)
    if objective.is_least_squares:
        weights = np.repeat(objective.residual_factors, counts) * deviations
        slopes = _residual_slopes(optimum) / weights[:, np.newaxis]
    else:
        weights = np.sqrt(_weights(optimum, sigma, counts))
        slopes = point_slopes(optimum, counts) / deviations[:, np.newaxis]
    if noise.residuals is None:
        correlation = white(branches)
        freedom = freedom_of_squares = math.inf
    else:
        residuals = np.concatenate([r / s for r, s in zip(noise.residuals, sigma, strict=True)])
        correlation = correlation_of(residuals, slopes, branches)
        over = correlation.independent - slopes.shape[1]
        freedom = min(float(noise.freedom), max(over, _LEAST_FREEDOM))
        squares = _OF_SQUARES * correlation.independent_squares
        freedom_of_squares = min(float(noise.freedom), max(squares, _LEAST_FREEDOM))
    moves, inverse = moves_of(weights, slopes)
    covariance = None
    if objective.is_least_squares:
        covariance = correlation.scatter(moves)
    elif objective.is_area_of_pieces and correlation.is_white:
        of_pieces = area_scatter(_noisy_curves(optimum, slopes, weights**2, counts))
        covariance = None if of_pieces is None else correlation.variance * of_pieces
    if covariance is None:
        covariance = correlation.scatter(moves, _WHITE, _ALIKE)
    factors = weights / deviations
    return Estimate(
        moves, slopes, factors, inverse, correlation, freedom, freedom_of_squares, covariance
    )


def _noisy_curves(
    optimum: Optimum, slopes: Array, costs: Array, counts: Sequence[int]
) -> Iterator[NoisyCurve]:
    """Yield each test with what is fitted to it, at as many points as were measured."""
    objective = optimum.problem.objective
    ends = np.cumsum(counts)[:-1]
    parts = zip(
        objective.experiments,
        optimum.curves(optimum.unit),
        objective.y_columns,
        np.split(slopes, ends),
        np.split(costs, ends),
        strict=True,
    )
    for test, curve, y, by_place, cost in parts:
        fitted = np.column_stack([_at_points(column, len(cost)) for column in curve.T])
        yield NoisyCurve(test, fitted, y, by_place, float(cost.sum()))


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


def points_of_tests(optimum: Optimum, curves: Sequence[Array], counts: Sequence[int]) -> Array:
    """Return y of curves, or of their slopes, at as many points as were measured of each test."""
    ys = optimum.problem.objective.y_columns
    parts = [_at_points(curve[:, y], n) for curve, y, n in zip(curves, ys, counts, strict=True)]
    return np.concatenate(parts)


def point_slopes(optimum: Optimum, counts: Sequence[int]) -> Array:
    """Return the slopes of the simulated y at these points."""
    return np.column_stack([points_of_tests(optimum, one, counts) for one in optimum.slopes])


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
