"""Spread of the parameters due to noise, by sensitivities or by a bootstrap.

Sensitivities use the response of an estimate to the noise of every point (`estimate`), with
Student's t.

The bootstrap draws tests as the fitted curves plus noise and identifies the parameters from each.
It uses the response surfaces around the optimum and takes no run of the model; intervals are basic.
Cost: that of an estimate, or `samples` minimisations of the measure with about 30 k evaluations
each.

B. Efron, R. J. Tibshirani, "An introduction to the bootstrap", Chapman & Hall (1993).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from ..problem.space import Space
from ..surfaces import largest_distances
from ..surfaces.quasi_newton import quasi_newton
from ..surfaces.surfaces import PredictedCurves
from .estimate import Estimate, estimate_of
from .noise import Noise
from .sensitivity import Optimum

__all__ = ["ADDED_UP", "Spread", "bootstrapped_spread", "linear_spread", "rise_at", "spread_of"]

ADDED_UP = ("area", "dtw", "sum_of_squares")
"""The measures that add up what is measured at each point; sensitivities are their theory."""

# Settings of a minimisation on the surfaces: finite differences, in standard errors, and the
# negligible gain, as a fraction of the cost of a standard error.
_DIFFERENCE, _ENOUGH = 0.05, 0.002
_LONGEST = 0.25  # greatest standard error, as a fraction of the bounds' ranges
# The same for a largest distance, whose spread is several standard errors of the theory of sums:
# half of the searched box in these errors, and the greatest number of evaluations with a gradient.
_REACH, _EVALUATIONS = 30.0, 60


class Spread(NamedTuple):
    """The standard errors of the parameters, in their units."""

    errors: Array
    bias: Array  # the mean change of the parameters due to noise alone
    intervals: list[tuple[float, float]]
    correlations: Array

    @property
    def halves(self) -> list[float]:
        """Half the width of each interval."""
        halves: list[float] = (np.ptp(self.intervals, axis=1) / 2.0).tolist()
        return halves


def linear_spread(optimum: Optimum, noise: Noise, level: float) -> Spread:
    """Return what the sensitivities give."""
    return spread_of(estimate_of(optimum, noise), optimum, level)


def spread_of(estimate: Estimate, optimum: Optimum, level: float) -> Spread:
    """Return the spread of an estimate."""
    space = optimum.problem.space
    differential = space.differential(optimum.unit)
    covariance = differential @ estimate.covariance @ differential.T
    errors = np.sqrt(np.diag(covariance))
    width = estimate.quantiles(level) * errors
    point = np.array(space.point(optimum.unit))
    intervals = _within(space, point - width, point + width)
    return Spread(errors, np.zeros_like(errors), intervals, _correlation(covariance))


def rise_at(optimum: Optimum, noise: Noise, index: int, change: float) -> float:
    """Return the rise of the objective on the surfaces as one place changes.

    The other parameters adapt as in least squares. The result is the mean of both directions.
    """
    moves = estimate_of(optimum, noise).moves
    together = moves.T @ moves
    step = change * together[index] / together[index, index]
    predicted = optimum.problem.objective.predicted
    lowest, *ends = (
        predicted(optimum.curves(optimum.unit + way * step)).value for way in (0.0, 1.0, -1.0)
    )
    return max(float(np.mean(ends)) - lowest, 0.0)


def _within(space: Space, low: Array, high: Array) -> list[tuple[float, float]]:
    """Return intervals, clipped to the bounds."""
    ends = zip(low.tolist(), high.tolist(), space.bounds.values(), strict=True)
    return [(max(a, first), min(b, last)) for a, b, (first, last) in ends]


def bootstrapped_spread(
    optimum: Optimum, noise: Noise, level: float, samples: int, seed: int
) -> Spread:
    """Return the spread of the parameters that other noise would have given."""
    random = np.random.default_rng(seed)
    space = optimum.problem.space
    estimate, moves = estimate_of(optimum, noise), noise.moves(noise.directions)
    _, sizes, directions = np.linalg.svd(estimate.moves, full_matrices=False)
    steps = directions.T * np.minimum(sizes, _LONGEST)
    units = np.empty((samples, optimum.unit.size))
    for i in range(samples):
        drawn = zip(noise.fitted, estimate.correlation.draw(random), moves, strict=True)
        tests = [fitted + part[:, np.newaxis] * move for fitted, part, move in drawn]
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
    """Return the percentiles mirrored at the optimum, which allows for a bias.

    At a bound, draws are cut off and the mirrored interval is not meaningful. The percentile itself
    is used there if it is further away. The optimum is always inside.
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

    The search uses `steps` as coordinates: one standard error each, for white noise. A largest
    distance has kinks at its minimum, where a search for smooth functions ends too early.
    """
    objective = optimum.problem.objective.of_other_tests(tests)
    if objective.is_largest_distance:
        reach = _REACH * np.linalg.norm(steps, axis=1)
        low, high = (np.clip(optimum.unit + way * reach, 0.0, 1.0) for way in (-1.0, 1.0))
        predicted = PredictedCurves(objective, optimum.responses, None, lambda: None)
        return largest_distances.minimised(
            predicted, optimum.surfaces, optimum.unit, low, high, _EVALUATIONS
        )

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
