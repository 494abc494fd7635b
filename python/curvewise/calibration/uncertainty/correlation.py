"""Noise as the residuals of a fit show it: white, or correlated from point to point.

Model error leaves correlated residuals: they continue along a test and recur in every cycle. Their
covariance comes from the residuals themselves. Circular shifts, reversal and change of sign are
taken to be equally likely. The covariance of a test is then the circulant matrix of its sample
autocovariances, whose spectrum is the periodogram. A fit takes part of the noise. So the residuals
are enlarged until fits of shifted residuals leave as much as the observed fit. Intervals are those
of a bootstrap-t. The pivot is the move of each refit, on the linearised model, in units of the
standard error that its residuals give. Student's t allows for the few frequencies that decide an
error. White noise is assumed unless one of two Monte Carlo tests rejects it, compared with 99 % of
draws of white noise. Either neighbours differ less, or a variance from the autocovariances is
larger. The first statistic is Durbin and Watson's. Cost: O(n log n + n k) for each of 600 draws of
n points and k parameters.

B. Efron, R. J. Tibshirani, "An introduction to the bootstrap", Chapman & Hall (1993), section 12.5.
D. N. Politis, J. P. Romano, "A circular block-resampling procedure for stationary data", in
"Exploring the limits of bootstrap", Wiley (1992). R. B. Blackman, J. W. Tukey, "The measurement of
power spectra", Dover (1958), B.6 (equivalent degrees of freedom). J. Durbin, G. S. Watson,
Biometrika 37 (1950) 409-428. G. A. Barnard, J. R. Stat. Soc. B 25 (1963) 294 (Monte Carlo tests).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array

__all__ = ["Correlation", "correlation_of", "given_noise"]

_DRAWS = 300  # of the bootstrap, and of white noise for the test
_BELIEVED = 0.99  # share of draws of white noise that pass each test
_LEAST = 1e-3  # share of the noise that a fit leaves
_LEAST_FREEDOM = 3.0  # the fewest with which Student's t has a variance
_AT_ONCE = 4_000_000  # coordinates of draws in memory


class Correlation(NamedTuple):
    """The noise of all points of all tests, each in units of its test's deviation.

    Attributes
    ----------
    noise : list of ndarray
        For each test the residuals, enlarged by what the fit has taken. For white noise only the
        mean of their squares counts.
    is_white : bool
        Whether the noise is taken for white.
    deviates : ndarray, shape (draws, k), or None
        Absolute values of the bootstrap-t; None for white noise.
    """

    noise: list[Array]
    is_white: bool
    deviates: Array | None = None

    @property
    def variance(self) -> float:
        """Mean square of the noise."""
        squares = np.concatenate(self.noise) ** 2
        return float(squares.mean())

    def scatter(self, columns: Array, *, of_median: bool = False) -> Array:
        """Return columns' V columns for the covariance V of the noise.

        Parameters
        ----------
        columns : ndarray, shape (points, k)
        of_median : bool
            Take the covariance of signs, in units in which that of a median follows.
        """
        if self.is_white:
            scale = self.variance * (math.pi / 2.0 if of_median else 1.0)
            return scale * (columns.T @ columns)
        total = np.zeros((columns.shape[1], columns.shape[1]))
        for noise, part in self._parts(columns):
            spectrum = np.abs(np.fft.rfft(noise)) ** 2 / len(noise)
            if of_median:
                spectrum = _of_signs(spectrum, len(noise))
            waves = np.fft.rfft(part, axis=0)
            weights = _both_halves(len(noise)) * spectrum
            total += np.real(waves.conj().T @ (weights[:, np.newaxis] * waves)) / len(noise)
        return total

    def freedom(self, columns: Array) -> Array:
        """Return the equivalent degrees of freedom of the variances of correlated noise, (k,).

        The degrees of freedom of a weighted mean of the periodogram, whose squares are on average
        twice those of the spectrum.
        """
        shares = [
            _power(part) * np.abs(np.fft.rfft(noise))[:, np.newaxis] ** 2
            for noise, part in self._parts(columns)
        ]
        whole = np.concatenate(shares)
        squares = (whole**2).sum(axis=0)
        freedom = 4.0 * whole.sum(axis=0) ** 2 / np.where(squares > 0.0, squares, np.inf)
        at_least: Array = np.maximum(freedom, _LEAST_FREEDOM)
        return at_least

    def _parts(self, columns: Array) -> Iterator[tuple[Array, Array]]:
        """Yield the noise of each test, and the rows of columns that belong to it."""
        ends = np.cumsum([len(noise) for noise in self.noise])[:-1]
        return zip(self.noise, np.split(columns, ends), strict=True)

    def draw(self, random: np.random.Generator) -> list[Array]:
        """Return noise drawn again, of each test."""
        if self.is_white:
            deviation = math.sqrt(self.variance)
            return [deviation * random.normal(size=len(noise)) for noise in self.noise]
        return [_shifted(noise, random) for noise in self.noise]


def given_noise(counts: Sequence[int]) -> Correlation:
    """Return white noise of one deviation, of tests of these numbers of points."""
    return Correlation([np.ones(count) for count in counts], True)


def correlation_of(residuals: Sequence[Array], slopes: Array, moves: Array) -> Correlation:
    """Return the correlation of the noise, as the residuals of a fit show it.

    Parameters
    ----------
    residuals : sequence of ndarray
        The residuals of each test, in units of its deviation.
    slopes : ndarray, shape (points, k)
        The derivatives of the fitted values, in the same units; they determine the part of the
        noise that the fit removed.
    moves : ndarray, shape (points, k)
        The change of the estimates for the noise of each point.
    """
    basis, values, _ = np.linalg.svd(slopes, full_matrices=False)
    basis = basis[:, values > 1e-9 * values[0]]
    counts = [len(one) for one in residuals]
    # Components that the fit could still remove would look like long-range noise.
    left = np.concatenate(residuals)
    left = left - basis @ (basis.T @ left)
    count, freedom = len(left), len(left) - basis.shape[1]
    parts = np.split(left, np.cumsum(counts)[:-1])
    if not left.any():  # fitted to the last digit
        return Correlation(parts, True)
    squares, random = _Squares(basis, moves, counts), np.random.default_rng(0)
    seen = squares.of(left[np.newaxis])
    _, by_chance = squares.of_draws(lambda: random.normal(size=count))
    if _pass_for_white(seen, by_chance, moves):
        return Correlation([math.sqrt(count / freedom) * part for part in parts], True)
    enlarging = float(seen.enlarging[0])
    enlarged = [math.sqrt(enlarging) * part for part in parts]
    moved, after = squares.of_draws(
        lambda: np.concatenate([_shifted(part, random) for part in enlarged])
    )
    errors = np.sqrt(after.variances * after.enlarging[:, np.newaxis])
    return Correlation(enlarged, False, np.abs(moved) / np.where(errors > 0.0, errors, np.inf))


def _pass_for_white(seen: _Sums, by_chance: _Sums, moves: Array) -> bool:
    """Return whether residuals pass for white noise, given draws of white noise."""
    by_white = (moves**2).sum(axis=0)
    noticed = by_white > 0.0

    def excess(sums: _Sums) -> Array:
        ratios = sums.variances[:, noticed] / by_white[noticed]
        found: Array = ratios.max(axis=1, initial=0.0) / sums.whole
        return found

    same = np.quantile(by_chance.steps / by_chance.whole, 1.0 - _BELIEVED)
    most = np.quantile(excess(by_chance), _BELIEVED)
    return bool(seen.steps / seen.whole >= same and excess(seen) <= most)


class _Sums(NamedTuple):
    """Sums of squares of the residuals of draws, and of what their shifts would do.

    Attributes
    ----------
    whole, steps, taken : ndarray, shape (draws,)
        Statistics of the residuals, of the differences of neighbours, and of the part that a fit
        takes from shifts.
    variances : ndarray, shape (draws, k)
        The variances of the estimates, with shifts.
    """

    whole: Array
    steps: Array
    taken: Array
    variances: Array

    @property
    def enlarging(self) -> Array:
        """The factor of the squares with which fits of shifts leave as much."""
        enlarging: Array = self.whole / np.maximum(self.whole - self.taken, _LEAST * self.whole)
        return enlarging


class _Squares:
    """The input of `_Sums`: spectra of a fit's part and of the moves.

    Parameters
    ----------
    basis : ndarray, shape (points, r)
        Orthonormal: what a fit takes.
    moves : ndarray, shape (points, k)
    counts : sequence of int
        Points of each test.
    """

    def __init__(self, basis: Array, moves: Array, counts: Sequence[int]) -> None:
        self._basis, self._moves = basis, moves
        self._ends = np.cumsum(counts)[:-1]
        parts = zip(np.split(basis, self._ends), np.split(moves, self._ends), strict=True)
        self._powers = [np.column_stack((_power(b).sum(axis=1), _power(m))) for b, m in parts]

    def of(self, residuals: Array) -> _Sums:
        """Return the sums of residuals, shape (draws, points)."""
        total = np.zeros((len(residuals), self._powers[0].shape[1]))
        steps = np.zeros(len(residuals))
        for part, power in zip(np.split(residuals, self._ends, axis=1), self._powers, strict=True):
            total += np.abs(np.fft.rfft(part, axis=1)) ** 2 @ power
            steps += (np.diff(part, axis=1) ** 2).sum(axis=1)
        return _Sums((residuals**2).sum(axis=1), steps, total[:, 0], total[:, 1:])

    def of_draws(self, one: Callable[[], Array]) -> tuple[Array, _Sums]:
        """Return the moves of the estimates for draws of noise, and their residuals."""
        moved, sums = [], []
        step = max(1, _AT_ONCE // len(self._basis))
        for first in range(0, _DRAWS, step):
            noise = np.array([one() for _ in range(min(step, _DRAWS - first))])
            moved.append(noise @ self._moves)
            sums.append(self.of(noise - (noise @ self._basis) @ self._basis.T))
        return np.concatenate(moved), _Sums(*map(np.concatenate, zip(*sums, strict=True)))


def _power(columns: Array) -> Array:
    """Return by what the squares of a spectrum are weighted in the mean square of a product."""
    count = len(columns)
    weights = _both_halves(count)[:, np.newaxis]
    power: Array = weights * np.abs(np.fft.rfft(columns, axis=0)) ** 2 / float(count) ** 2
    return power


def _both_halves(count: int) -> Array:
    """Return how often each frequency of a real spectrum occurs in the whole one."""
    times = np.full(count // 2 + 1, 2.0)
    times[0] = 1.0
    if count % 2 == 0:
        times[-1] = 1.0
    return times


def _of_signs(spectrum: Array, count: int) -> Array:
    """Return the spectrum of arcsines of autocorrelations: of signs of normal variables."""
    covariances = np.fft.irfft(spectrum, count)
    if not covariances[0] > 0.0:
        return spectrum
    arcsines = covariances[0] * np.arcsin(np.clip(covariances / covariances[0], -1.0, 1.0))
    of_signs: Array = np.maximum(np.fft.rfft(arcsines).real, 0.0)
    return of_signs


def _shifted(noise: Array, random: np.random.Generator) -> Array:
    """Return noise shifted along its test, and at random reversed and with the other sign."""
    shifted = np.roll(noise, random.integers(len(noise)))
    if random.random() < 0.5:
        shifted = shifted[::-1]
    signed: Array = shifted if random.random() < 0.5 else -shifted
    return signed
