"""How alike the residuals of neighbouring points are, by restricted likelihood.

A model that is wrong leaves residuals that go on alike from point to point, with the noise of the
load cell upon them. Both together are taken for an autoregression of the first order, which begins
anew at every turning point, plus white noise. How far the autoregression reaches and what share of
the variance is white are known from the residuals only roughly, and a fit takes from them most of
what reaches furthest; so no best pair is taken, a grid of pairs is, each with the probability that
the residuals give it. Restricted likelihood allows exactly for the parameters that were fitted.
It goes by the differences of neighbours above all, which are many. The error of a model is no
autoregression, and what of it goes on longest, which an estimate takes over, may be larger than
these say; then the squares of the residuals add up to more than is expected (`excess`). Cost: O(n
k) for each model that is tried, since the inverse of an autoregression's covariance has three
diagonals.

Where branches repeat (`repeats`), a model that is wrong is wrong alike in each of them, and many
cycles say hardly more than one. There a share of the autoregression is common to all like branches,
and this share is a third number of the grid. Cost: O(n m (k + m)) a model, of m places, by
Woodbury's identity.

H. D. Patterson, R. Thompson, "Recovery of inter-block information when block sizes are unequal",
Biometrika 58 (1971) 545-554; D. A. Harville, "Bayesian inference for variance components using only
error contrasts", Biometrika 61 (1974) 383-385 (that it is the likelihood without the parameters);
M. A. Woodbury, "Inverting modified matrices", Princeton, Statist. Research Group, report 42 (1950).
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from .repeats import PARTS, Branches

__all__ = ["Correlation", "correlation_of", "white"]

# How far an autoregression reaches, in parts of its branch, the share of white noise, and of the
# rest the share that like branches have in common.
_REACHES = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0)
_SHARES = (0.003, 0.03, 0.2)
_COMMON = (0.0, 0.25, 0.5, 0.75)
_WHITE = (0.0, 1.0, 0.0)
_IMPOSSIBLE = 1e-4  # models of a smaller probability are left out
# White noise alone is believed where no model is more likely by exp(4), as for 1 in 50 draws of
# white noise (a likelihood ratio of two parameters): its errors are then those of least squares.
_BETTER = 4.0


class Model(NamedTuple):
    """One model of the noise.

    Attributes
    ----------
    probability : float
    reach : float
        Of the autoregression, in parts of a branch.
    share : float
        Of white noise in the variance.
    common : float
        Which share of the autoregression like branches have in common.
    variance : float
    """

    probability: float
    reach: float
    share: float
    common: float
    variance: float


class Correlation(NamedTuple):
    """The noise of all points of all tests, each in units of its test's deviation.

    Attributes
    ----------
    models : list of Model
        Whose probabilities add up to 1.
    branches : Branches
    excess : float
        The sum of squares of the residuals, in parts of what the models expect.
    """

    models: list[Model]
    branches: Branches
    excess: float = 1.0

    @property
    def is_white(self) -> bool:
        """Whether white noise alone is believed."""
        return all(model.share == 1.0 for model in self.models)

    @property
    def variance(self) -> float:
        """In the mean of the models."""
        return sum(model.probability * model.variance for model in self.models)

    def scatter(self, columns: Array, white: float = 1.0, alike: float = 1.0) -> Array:
        """Return columns' V columns for the covariance V of the noise, in the mean of the models.

        Parameters
        ----------
        columns : ndarray, shape (points, k)
        white, alike : float
            What white noise and the autoregression are multiplied with.
        """
        square = columns.T @ columns
        total = np.zeros_like(square)
        for model in self.models:
            one = white * model.share * square
            if model.share < 1.0:
                one += alike * (1.0 - model.share) * self._along(columns, model)
            total += model.probability * model.variance * one
        return total

    def _along(self, columns: Array, model: Model) -> Array:
        """Return columns' R columns for the covariance R of the autoregressions."""
        total = np.zeros((columns.shape[1], columns.shape[1]))
        for branch in self.branches.slices:
            part = columns[branch]
            total += part.T @ _correlated(part, _neighbours(model.reach, len(part)))
        if model.common > 0.0:
            total *= 1.0 - model.common
            rho = _neighbours(model.reach, PARTS)
            for sums in self.branches.gathered(columns):
                total += model.common * (sums.T @ _correlated(sums, rho))
        return total

    def draw(self, random: np.random.Generator) -> Array:
        """Return noise drawn anew, of one of the models."""
        chances = [model.probability for model in self.models]
        model = self.models[random.choice(len(chances), p=chances)]
        count = self.branches.slices[-1].stop
        noise: Array = math.sqrt(model.share) * random.normal(size=count)
        if model.share < 1.0:
            own = math.sqrt((1.0 - model.share) * (1.0 - model.common))
            for branch in self.branches.slices:
                size = branch.stop - branch.start
                rho = _neighbours(model.reach, size)
                noise[branch] += own * _autoregression(random.normal(size=size), rho)
        if model.common > 0.0:
            factor = _shared_factor(model.reach, model.share, model.common, self.branches)
            noise += factor @ random.normal(size=factor.shape[1])
        return math.sqrt(model.variance) * noise

    @property
    def independent(self) -> float:
        """How many independent points would say as much: points by the sum of correlations."""
        return self._independent(1)

    @property
    def independent_squares(self) -> float:
        """How many independent squares would say as much: by the sum of squared correlations."""
        return self._independent(2)

    def _independent(self, power: int) -> float:
        """Return the points by the mean of the models' sums of correlations to a power.

        Powers of an autoregression's correlations are the correlations of a shorter one.
        """
        branches = self.branches
        count = branches.slices[-1].stop
        alike = 0.0
        for model in self.models:
            together, part = float(count), (1.0 - model.share) ** power
            if part > 0.0:
                reach, common = model.reach / power, model.common**power
                whole = sum(_all_pairs(reach, one.stop - one.start) for one in branches.slices)
                if common > 0.0:
                    whole *= 1.0 - common
                    for sums in branches.gathered(np.ones((count, 1))):
                        shared = sums.T @ _correlated(sums, _neighbours(reach, PARTS))
                        whole += common * float(shared[0, 0])
                together += part * (whole - together)
            alike += model.probability * together
        return float(count) ** 2 / alike


def white(branches: Branches, variance: float = 1.0) -> Correlation:
    """Return noise without correlation."""
    return Correlation([Model(1.0, *_WHITE, variance)], branches)


def correlation_of(residuals: Array, slopes: Array, branches: Branches) -> Correlation:
    """Return what the residuals of a fit say of the noise.

    Parameters
    ----------
    residuals : ndarray, shape (points,)
        Of all tests, each in units of its test's deviation.
    slopes : ndarray, shape (points, k)
        Of the fitted values, in the same units: what the fit has taken from the residuals.
    branches : Branches
    """
    basis, values, _ = np.linalg.svd(slopes, full_matrices=False)
    basis = basis[:, values > 1e-9 * values[0]]
    left = residuals - basis @ (basis.T @ residuals)
    square = float(left @ left)
    if not square > 0.0:  # fitted to the last digit
        return white(branches)
    common = _COMMON if branches.ways else (0.0,)
    tried = [_WHITE, *itertools.product(_REACHES, _SHARES, common)]
    found = [_likelihood(left / math.sqrt(square), basis, branches, *model) for model in tried]
    logarithms = np.array([logarithm for logarithm, _ in found])
    if logarithms.max() < logarithms[0] + _BETTER:
        return white(branches, square * found[0][1])
    chances = np.exp(logarithms - logarithms.max())
    chances[chances < _IMPOSSIBLE * chances.sum()] = 0.0
    chances /= chances.sum()
    models = [
        Model(float(chance), *model, square * variance)
        for chance, model, (_, variance) in zip(chances, tried, found, strict=True)
        if chance > 0.0
    ]
    return Correlation(models, branches, square / _expected_square(models, basis, branches))


def _expected_square(models: list[Model], basis: Array, branches: Branches) -> float:
    """Return the sum of squares that fitted residuals are expected to have.

    The trace of (I - B B') V for an orthonormal basis B and the covariance V.
    """
    count = len(basis)
    repeated = 0 if branches.places is None else int(np.sum(branches.places >= 0))
    whole = 0.0
    for model in models:
        alike = (1.0 - model.common) * count + model.common * repeated
        one = model.share * count + (1.0 - model.share) * alike
        whole += model.probability * model.variance * one
    return whole - float(np.trace(Correlation(models, branches).scatter(basis)))


def _likelihood(
    residuals: Array, basis: Array, branches: Branches, reach: float, share: float, common: float
) -> tuple[float, float]:
    """Return the logarithm of the restricted likelihood of a model, and its variance."""
    freedom = len(residuals) - basis.shape[1]
    if share == 1.0:
        square = float(residuals @ residuals)
        return -0.5 * freedom * math.log(square), square / freedom
    linalg = required("scipy.linalg")
    diagonal, beside = np.ones(len(residuals)), np.zeros(len(residuals))
    logarithm = 0.0
    for branch in branches.slices:  # T, the inverse of the autoregression's covariance R
        count = branch.stop - branch.start
        if count < 2:
            continue
        rho = _neighbours(reach, count)
        new = 1.0 - rho**2
        diagonal[branch] = (1.0 + rho**2) / new
        diagonal[[branch.start, branch.stop - 1]] = 1.0 / new
        beside[branch.start + 1 : branch.stop] = -rho / new
        logarithm += (count - 1) * math.log(new)
    # A = a R + b I has the inverse (a I + b T)^-1 T.
    shared_factor = _shared_factor(reach, share, common, branches)
    columns = np.column_stack((residuals, basis, shared_factor))
    right = diagonal[:, np.newaxis] * columns
    right[1:] += beside[1:, np.newaxis] * columns[:-1]
    right[:-1] += beside[1:, np.newaxis] * columns[1:]
    factor = linalg.cholesky_banded(
        np.vstack((share * beside, (1.0 - share) * (1.0 - common) + share * diagonal)),
        check_finite=False,
    )
    solved = linalg.cho_solve_banded((factor, False), right, check_finite=False)
    logarithm += 2.0 * float(np.log(factor[1]).sum())
    count = 1 + basis.shape[1]
    products = columns[:, :count].T @ solved[:, :count]
    if common > 0.0:  # V = A + F F', of the factor F
        beside_factor = shared_factor.T @ solved
        inner = np.eye(shared_factor.shape[1]) + beside_factor[:, count:]
        seen = beside_factor[:, :count]
        products -= seen.T @ np.linalg.solve(inner, seen)
        logarithm += float(np.linalg.slogdet(inner)[1])
    of_basis, shared = products[1:, 1:], products[1:, 0]
    square = float(products[0, 0] - shared @ np.linalg.solve(of_basis, shared))
    logarithm += float(np.linalg.slogdet(of_basis)[1])
    return -0.5 * (freedom * math.log(square) + logarithm), square / freedom


def _shared_factor(reach: float, share: float, common: float, branches: Branches) -> Array:
    """Return F, whose F F' is the covariance of what like branches have in common."""
    if common == 0.0:
        return np.empty((branches.slices[-1].stop, 0))
    powers = _neighbours(reach, PARTS) ** np.abs(np.subtract.outer(range(PARTS), range(PARTS)))
    one_way = math.sqrt((1.0 - share) * common) * np.linalg.cholesky(powers)
    return branches.spread(np.kron(np.eye(branches.ways), one_way))


def _neighbours(reach: float, count: int) -> float:
    """Return the correlation of neighbours, of a reach in parts of a branch of so many points."""
    return math.exp(-1.0 / (reach * count)) if reach > 0.0 else 0.0


def _all_pairs(reach: float, count: int) -> float:
    """Return the sum of the correlations of all pairs of points of a branch, a series summed."""
    rho = _neighbours(reach, count)
    ends = (1.0 - rho**count) / (1.0 - rho)
    return count + 2.0 * rho / (1.0 - rho) * (count - ends)


def _autoregression(white_noise: Array, rho: float) -> Array:
    """Return an autoregression of the deviation 1, of independent draws of the deviation 1."""
    changes = math.sqrt(1.0 - rho**2) * white_noise
    changes[0] = white_noise[0]
    return _carried_on(changes, rho)


def _correlated(columns: Array, rho: float) -> Array:
    """Return R @ columns with R[i, j] = rho ** |i - j|, by a walk there and a walk back."""
    correlated: Array = _carried_on(columns, rho) + _carried_on(columns[::-1], rho)[::-1] - columns
    return correlated


def _carried_on(columns: Array, rho: float) -> Array:
    """Return y with y[i] = columns[i] + rho y[i - 1], as scipy.signal's lfilter does.

    To rounding, without the second that the import of scipy.signal takes.
    """
    bands = np.array([[1.0], [-rho]]).repeat(len(columns), axis=1)
    found: Array = required("scipy.linalg").solve_banded((1, 0), bands, columns, check_finite=False)
    return found
