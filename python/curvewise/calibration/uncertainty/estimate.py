"""Effect of the noise of every point on an estimate: the sandwich estimator.

To first order, the effect of a point's noise is a product. One factor is the derivatives of the
curves there, in the direction of the point's deviation (`directions`). The other is the measure's
weight of the point. For a sum of squares this is the linear theory of least squares. A measure that
adds up distances has the weights of its gradient and the covariance of medians. That is pi / 2 of
the variance of white noise; for correlated noise it uses the arcsines of the autocorrelations. For
white noise, the area over sections is a median of these (`medians`). Cost: two evaluations of
the residuals for each parameter, or one gradient; in addition the cost of `correlation_of`.

P. J. Huber, "The behavior of maximum likelihood estimates under nonstandard conditions", Proc. 5th
Berkeley Symp. Math. Stat. Prob. 1 (1967) 221-233.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from .correlation import Correlation, correlation_of, given_noise
from .directions import Directions, at_places, directions_along
from .medians import NoisyCurve, area_scatter, paired_scatter
from .noise import Noise
from .sensitivity import Optimum, moves_of

__all__ = ["Estimate", "estimate_of"]


class Estimate(NamedTuple):
    """An estimate's response to the noise of all points, in their deviations.

    Attributes
    ----------
    moves : ndarray, shape (points, k)
        The change of the place in the unit cube for the noise of each point.
    slopes : ndarray, shape (points, k)
        The derivatives of the curves in these directions, at the measured points.
    factors : ndarray, shape (points,)
        The factor of each point's deviation in the sum of squares.
    inverse : ndarray, shape (k, k)
        The inverse of the normal matrix: the covariance of the estimate for white noise in these
        squares.
    correlation : Correlation
        The correlation of the noise.
    freedom : float
        The degrees of freedom of its deviation, that is, the number of independent points; infinite
        if the deviation is given.
    covariance : ndarray, shape (k, k)
        The covariance of the place in the unit cube.
    directions : list of Directions
        For each test, the directions of its points' deviations.
    """

    moves: Array
    slopes: Array
    factors: Array
    inverse: Array
    correlation: Correlation
    freedom: float
    covariance: Array
    directions: list[Directions]

    def compared(self, curves: Sequence[Array]) -> Array:
        """Return the compared quantity: distances of points, times factors."""
        sizes: Array = self.factors * _points(curves, self.directions)
        return sizes

    def quantiles(self, level: float) -> Array:
        """Return how many standard errors half an interval of each parameter has, shape (k,)."""
        special, upper = required("scipy.special"), (1.0 + level) / 2.0
        normal = float(special.ndtri(upper))
        if self.correlation.deviates is None:
            is_given = math.isinf(self.freedom)
            one = normal if is_given else float(special.stdtrit(self.freedom, upper))
            return np.full(len(self.covariance), one)
        by_bootstrap = np.quantile(self.correlation.deviates, level, axis=0)
        student = special.stdtrit(self.correlation.freedom(self.moves), upper) / normal
        quantiles: Array = np.maximum(by_bootstrap, normal) * student
        return quantiles


def estimate_of(optimum: Optimum, noise: Noise) -> Estimate:
    """Return how the parameters at an optimum move with the noise."""
    objective, noise = optimum.problem.objective, noise.to_divide_by()
    counts = [len(fitted) for fitted in noise.fitted]
    curves = optimum.curves(optimum.unit)
    directions = directions_along(objective, curves, counts)
    deviations = np.concatenate(noise.deviations(directions))
    if objective.is_least_squares:
        weights = np.repeat(objective.residual_factors, counts) * deviations
        slopes = _residual_slopes(optimum) / weights[:, np.newaxis]
    else:
        weights = np.sqrt(_weights(optimum, noise, counts))
        by_parameter = [_points(one, directions) for one in optimum.slopes]
        slopes = np.column_stack(by_parameter) / deviations[:, np.newaxis]
    moves, inverse = moves_of(weights, slopes)
    if noise.residuals is None:
        correlation, freedom = given_noise(counts), math.inf
    else:
        sizes = noise.deviations(noise.directions)
        residuals = [r / s for r, s in zip(noise.residuals, sizes, strict=True)]
        correlation, freedom = correlation_of(residuals, slopes, moves), float(noise.freedom)
    covariance = None
    if objective.is_area_of_pieces and correlation.is_white:
        ends = np.cumsum(counts)[:-1]
        by_place, costs = np.split(slopes, ends), np.split(weights**2, ends)
        parts = zip(
            objective.experiments, curves, noise.moves(directions), by_place, costs, strict=True
        )
        of_pieces = area_scatter(
            NoisyCurve(test, _at_points(curve, len(move)), move, slope, float(cost.sum()))
            for test, curve, move, slope, cost in parts
        )
        covariance = None if of_pieces is None else correlation.variance * of_pieces
    elif objective.is_sum_of_distances and noise.is_paired and correlation.is_white:
        by_curve = [
            np.stack(columns, axis=2) / one.scale[:, np.newaxis]
            for one, columns in zip(directions, zip(*optimum.slopes, strict=True), strict=True)
        ]
        costs_of_distances = (objective.weights / noise.heights).tolist()
        tests = zip(by_curve, noise.components, costs_of_distances, strict=True)
        covariance = paired_scatter(tests)
    if covariance is None:
        covariance = correlation.scatter(moves, of_median=not objective.is_least_squares)
    factors = weights / deviations
    return Estimate(moves, slopes, factors, inverse, correlation, freedom, covariance, directions)


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


def _points(curves: Sequence[Array], directions: Sequence[Directions]) -> Array:
    """Return how far curves, or their slopes, go in directions at as many points."""
    pairs = zip(curves, directions, strict=True)
    return np.concatenate([one.across(_at_points(curve, len(one.unit))) for curve, one in pairs])


def _at_points(curve: Array, count: int) -> Array:
    return at_places(curve, np.linspace(0.0, len(curve) - 1.0, count))


def _weights(optimum: Optimum, noise: Noise, counts: Sequence[int]) -> Array:
    """Return the cost of equal deviations at each point; the mean is 1.

    All are 1 if the measure has a useless gradient, such as that of the worst point alone.
    """
    objective, curves = optimum.problem.objective, optimum.curves(optimum.unit)
    total = sum(counts)
    if not objective.has_gradient:
        return np.ones(total)
    moves = noise.moves(directions_along(objective, curves, list(map(len, curves))))
    tests = [curve + move for curve, move in zip(curves, moves, strict=True)]
    _, gradients = objective.of_other_tests(tests).value_and_gradient(curves)
    costs = [
        _at_points(np.abs((g * move).sum(axis=1, keepdims=True)), n) * (len(g) / n)
        for g, move, n in zip(gradients, moves, counts, strict=True)
    ]
    weights = np.concatenate(costs)[:, 0]
    mean = float(weights.mean())
    return weights / mean if mean > 0.0 else np.ones(total)
