"""The noise of a test: its residuals from the fitted curve, or a given deviation.

Residuals are taken in the directions of the deviations (`directions`). If the points of both curves
belong together one by one, their differences give the noise of each coordinate. Otherwise it is
fitted to the squares of the residuals by non-negative least squares, first with equal weights and
then with those of the first fit. If that is not clearly more likely, all noise is attributed to the
model's response. Cost: that of a dynamic time warping path for every loop.

C. L. Lawson, R. J. Hanson, "Solving least squares problems", Prentice-Hall (1974), chapter 23.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from .directions import Directions, fitted_tests
from .sensitivity import Optimum

__all__ = ["Noise", "noise_of"]

# The least deviation of a point as a fraction of its test's, and that of a test as a fraction of
# its range of y. A test that is fitted to the last digit does not have any noise to divide by.
_LEAST_OF_TEST, _LEAST_OF_HEIGHT, _LEAST = 0.01, 1e-12, 1e-150
# Least gain of the log-likelihood for noise in another coordinate: the 95 % point of a likelihood
# ratio with one parameter.
_BETTER = 2.0


class Noise(NamedTuple):
    """The fitted curves, and how the measured ones scatter about them.

    Attributes
    ----------
    fitted : sequence of ndarray
        For each test the simulated point that belongs to each measured one.
    directions : sequence of Directions
        For each test the directions of the deviations of the measured points.
    residuals : sequence of ndarray or None
        Distances of the measured points from the simulation in these directions, in units of y;
        None if sigma is given.
    components : sequence of ndarray, shape (d,)
        For each test the standard deviation in each coordinate, in units of y, enlarged for the
        parameters that were fitted.
    heights : sequence of float
        For each test its extent in y.
    freedom : int
        Points of all tests minus parameters.
    is_paired : bool
        Whether the points of both curves belong together one by one.
    """

    fitted: Sequence[Array]
    directions: Sequence[Directions]
    residuals: Sequence[Array] | None
    components: Sequence[Array]
    heights: Sequence[float]
    freedom: int
    is_paired: bool = False

    @property
    def sigma(self) -> Array:
        """The standard deviation of each test, of all its coordinates together."""
        return np.array([_size(one) for one in self.components])

    def to_divide_by(self) -> Noise:
        """Return the noise with a deviation of each test that is not 0."""
        components = []
        for one, direction, height in zip(
            self.components, self.directions, self.heights, strict=True
        ):
            least = max(_LEAST_OF_HEIGHT * height, _LEAST)
            components.append(one if _size(one) > least else least * direction.unit[0])
        return self._replace(components=components)

    def deviations(self, directions: Sequence[Directions]) -> list[Array]:
        """Return for each test the standard deviations of points in directions."""
        found = []
        for at, components in zip(directions, self.components, strict=True):
            sizes = np.sqrt(at.unit**2 @ components**2)
            least = _LEAST_OF_TEST * math.sqrt(float(np.mean(sizes**2)))
            found.append(np.maximum(sizes, max(least, _LEAST)))
        return found

    def moves(self, directions: Sequence[Directions]) -> list[Array]:
        """Return for each test the likeliest moves of points by one deviation in directions.

        Noise in y alone moves a point along y whatever its direction is; noise of equal deviations
        in all coordinates moves it in its direction.
        """
        parts = zip(directions, self.components, self.deviations(directions), strict=True)
        return [c * (c * at.unit / sizes[:, np.newaxis]) * at.scale for at, c, sizes in parts]


def noise_of(optimum: Optimum, sigma: float | Sequence[float] | None) -> Noise:
    """Return the fitted points, and the residuals or the deviation in y that is given."""
    objective = optimum.problem.objective
    tests, curves = objective.experiments, optimum.curves(optimum.unit)
    fitted, directions, residuals, pairs = zip(*fitted_tests(objective, curves), strict=True)
    total = sum(map(len, tests))
    freedom = total - optimum.unit.size
    if freedom < 1:
        raise ValueError(f"the tests have {total} points for {optimum.unit.size} parameters")
    in_y = [np.eye(P.shape[1])[y] for P, y in zip(tests, objective.y_columns, strict=True)]
    heights = [float(e[y]) for e, y in zip(objective.extents, objective.y_columns, strict=True)]
    if sigma is not None:
        given = np.broadcast_to(np.asarray(sigma, dtype=np.float64), len(tests))
        if not (np.isfinite(given).all() and (given >= 0).all()):
            raise ValueError(f"sigma is {sigma}; give a finite deviation, not negative")
        components = [size * axis for size, axis in zip(given, in_y, strict=True)]
        return Noise(fitted, directions, None, components, heights, freedom)
    components, answers = [], _answers(optimum)
    for i, (residual, one) in enumerate(zip(residuals, directions, strict=True)):
        # A single number does not have a usable residual: a hundredth of it by default.
        found = 0.01 * heights[i] * in_y[i]
        if residual.size > 1:
            each = pairs[i]
            found = (
                _components(residual, one, answers[i])
                if each is None
                else np.sqrt(np.mean((each / one.scale) ** 2, axis=0))
            )
            found = math.sqrt(total / freedom) * found
        if known := objective.sigmas[i]:
            found = known * (found / _size(found) if found.any() else in_y[i])
        components.append(found)
    is_paired = all(each is not None for each in pairs)
    return Noise(fitted, directions, residuals, components, heights, freedom, is_paired)


def _answers(optimum: Optimum) -> list[Array]:
    """Return by test the mean square move of the curve in each coordinate of its box."""
    scaled, curves = optimum.scaled_slopes(), optimum.curves(optimum.unit)
    pairs = zip(scaled, curves, strict=True)
    return [(part**2).sum(axis=1).reshape(curve.shape).sum(axis=0) for part, curve in pairs]


def _components(residuals: Array, directions: Directions, answers: Array) -> Array:
    """Return the standard deviation in each coordinate, of residuals in directions.

    Parameters
    ----------
    residuals : ndarray, shape (n,)
    directions : Directions
    answers : ndarray, shape (d,)
        The fraction of the model's response in each coordinate. Noise is divided in the same way,
        unless other fractions are clearly more likely, which is impossible if all directions are
        equal.
    """
    parts, squares = directions.unit**2, residuals**2
    level = float(np.mean(squares))
    answers = answers * parts.any(axis=0)
    shares = answers / answers.sum() if answers.any() else parts.mean(axis=0)
    likeliest: Array = float(np.mean(squares / _floored(parts @ shares))) * shares
    if np.ptp(parts, axis=0).max() > 0.0 and level > 0.0:
        nnls, sizes = required("scipy.optimize").nnls, np.ones(len(squares))
        for _ in range(2):
            others, _ = nnls(parts / sizes[:, np.newaxis], squares / level / sizes)
            sizes = _floored(parts @ others)
        gain = _logarithm(squares, level * sizes) - _logarithm(squares, parts @ likeliest)
        likeliest = level * others if gain > _BETTER else likeliest
    return np.sqrt(likeliest)


def _floored(variances: Array) -> Array:
    return np.maximum(variances, _LEAST_OF_TEST**2 * float(variances.mean()))


def _logarithm(squares: Array, variances: Array) -> float:
    """Return the logarithm of the likelihood of normal deviations, less a constant."""
    variances = _floored(variances)
    return -0.5 * float(np.sum(np.log(variances) + squares / variances))


def _size(components: Array) -> float:
    return math.sqrt(float(components @ components))
