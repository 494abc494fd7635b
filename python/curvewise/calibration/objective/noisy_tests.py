"""Noise in the tests, and warnings about measures that do not average it out.

The noise of a test is estimated from its curve alone. The estimate is the median deviation of y of
each point from the cubic through its two neighbours on either side. The cubic is a function of the
other columns or of the point number, whichever fits better. The median ignores corners. Noise that
the logger has filtered is not detected either. Cost: O(n) for a test of n points.

T. Gasser, L. Sroka, C. Jennen-Steinmetz, "Residual variance and residual pattern in nonlinear
regression", Biometrika 73 (1986) 625-633. Their estimate is used with cubics instead of straight
lines, and with the median of F. R. Hampel, J. Am. Stat. Assoc. 69 (1974) 383-393.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import NamedTuple

import numpy as np

from ...curves.foreign_curves import warn
from ...curves.inputs import Array
from .objective import Objective

__all__ = ["NoisyTestWarning", "advice_against_noise", "estimated_noise", "warn_of_noise"]

# The effect of noise on the measures that do not average it out.
_EFFECTS = {
    "curve_length": "noise increases the lengths that curve_length compares",
    "pcm": "noise increases the lengths that pcm compares",
    "frechet": "frechet is decided by the one point that noise moves most",
}
_BY_LENGTH = ("curve_length", "pcm")
# Noise below this fraction of the test's extent, or that lengthens the curve by less than this
# fraction, changes parameters by at most about 1 %.
_HARMLESS = 1e-3
_FEWEST = 9  # points required to estimate noise
_OTHERS = (0, 1, 3, 4)  # of five points in a row, all but the one in the middle
_DEVIATION_OF_MEDIAN = 0.6745  # of the absolute values of normal noise, in standard deviations


class NoisyTestWarning(UserWarning):
    """A test has noise that the measure does not average out.

    The noise changes the identified parameters.

    :func:`identify`, :func:`identify_each` and :func:`cross_validate` warn once, before the first
    run of the model, for "curve_length", "pcm" and "frechet".

    Examples
    --------
    >>> import warnings
    >>> from curvewise.calibration import NoisyTestWarning
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", NoisyTestWarning)  # and identify(...) here
    """


def advice_against_noise(measures: Iterable[object]) -> str:
    """Return what noise does to these measures, and what to do; nothing where it averages out."""
    given = list(measures)  # names, and functions that may have no hash
    effects = [effect for measure, effect in _EFFECTS.items() if measure in given]
    if not effects:
        return ""
    remedy = "filter the test (curvewise.curves.smooth), or take another measure"
    return f"{' and '.join(effects)}: {remedy}"


def warn_of_noise(objectives: Collection[Objective]) -> None:
    """Warn once of tests whose noise moves the parameters that a search will find."""
    noisy = [one for objective in objectives for one in _noisy_tests(objective)]
    if not noisy:
        return
    worst = max(noisy, key=lambda one: one.share)
    count = len({one.title for one in noisy})
    which = f"{count} tests have noise, {worst.title}" if count > 1 else f"{worst.title} has noise"
    warn(
        NoisyTestWarning(
            f"{which} of about {worst.sigma:.2g} in {worst.axis} ({100.0 * worst.share:.2g} % of "
            f"its extent), and {advice_against_noise(one.measure for one in noisy)}"
        )
    )


class _NoisyTest(NamedTuple):
    title: str
    axis: str
    measure: str
    sigma: float
    share: float  # of the extent


def _noisy_tests(objective: Objective) -> Iterator[_NoisyTest]:
    """Yield the tests of an objective whose noise is not averaged out, and is not harmless."""
    titles, axes = objective.titles, objective.axes()
    if objective.criterion is not None and len(titles) == 1:
        titles = ["the test"]
    for i, (P, y) in enumerate(zip(objective.experiments, objective.y_columns, strict=True)):
        measure = objective.measures[i]
        if not isinstance(measure, str) or measure not in _EFFECTS:
            continue
        sigma = estimated_noise(P, y)
        share = sigma / (float(np.ptp(P[:, y])) or 1.0)
        if (_added_length(P, y, sigma) if measure in _BY_LENGTH else share) > _HARMLESS:
            yield _NoisyTest(titles[i], axes[i][y], measure, sigma, share)


def estimated_noise(curve: Array, y: int) -> float:
    """Return the standard deviation of the noise in a column of a curve; 0 for a few points."""
    if len(curve) < _FEWEST:
        return 0.0
    places = [np.arange(float(len(curve))), *np.delete(curve, y, axis=1).T]
    with np.errstate(all="ignore"):  # nan does not count as noise: nearly coincident neighbours
        return min(_scatter(t, curve[:, y]) for t in places)


def _scatter(t: Array, y: Array) -> float:
    """Return how far points are from cubics through their neighbours; inf where t turns often."""
    windows = np.lib.stride_tricks.sliding_window_view(t, 5)
    steps = np.diff(windows)
    is_monotonic = (steps > 0).all(axis=1) | (steps < 0).all(axis=1)
    if np.count_nonzero(is_monotonic) < len(t) / 2:
        return np.inf
    from_middle = (windows - windows[:, 2:3])[is_monotonic].T
    # Lagrange's weights of the four neighbours at the middle.
    weights = np.ones((len(_OTHERS), from_middle.shape[1]))
    for weight, j in zip(weights, _OTHERS, strict=True):
        for m in set(_OTHERS) - {j}:
            weight *= from_middle[m] / (from_middle[m] - from_middle[j])
    values = np.lib.stride_tricks.sliding_window_view(y, 5)[is_monotonic].T
    differences = values[2] - (weights * values[list(_OTHERS)]).sum(axis=0)
    scaled = np.abs(differences) / np.sqrt(1.0 + (weights**2).sum(axis=0))
    return float(np.median(scaled)) / _DEVIATION_OF_MEDIAN


def _added_length(curve: Array, y: int, sigma: float) -> float:
    """Return which fraction of a curve's length, in units of its box, is that of noise in y.

    Noise adds twice its variance to the square of each step.
    """
    extent = np.ptp(curve, axis=0)
    extent = np.where(extent > 0, extent, 1.0)
    squares = (np.diff(curve, axis=0) / extent) ** 2
    measured = squares.sum(axis=1)
    least = measured - squares[:, y]
    without = np.maximum(measured - 2.0 * (sigma / extent[y]) ** 2, least)
    return 1.0 - float(np.sqrt(without).sum() / (np.sqrt(measured).sum() or 1.0))
