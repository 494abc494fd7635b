"""The lowest of the small valleys beside a place, by a population in coordinates that curves feel.

Noise, and whatever else a model cannot follow, gives the sum of many absolute values small valleys:
the bottom that gradients find may be some per cent above that of the next one, a standard error of
the parameters away. These valleys lie along directions in which the curves hardly move. So places
are counted in directions in which curves move alike, by the singular vectors of their slopes, over
lengths in which the value rises by some per cent, and CMA-ES goes over those (`evolution`). Cost:
some 2,000 evaluations of the function.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...curves.inputs import Array
from .evolution import evolved

__all__ = ["lowest_beside"]

# By which part of itself the value rises, in the mean, over the first standard deviation; how many
# of those the population may go; its members and generations.
_RISE, _REACH, _MEMBERS, _GENERATIONS = 0.03, 6.0, 24, 80
_SENSED, _LONGEST = 1e-3, 0.3  # of the largest singular value; and the first trial, in the cube
_DRAWS, _TRIALS = 8, 30  # of which the rise is a mean, and for the length


def lowest_beside(
    function: Callable[[Array], float], centre: Array, slopes: Array, random: np.random.Generator
) -> Array:
    """Return the lowest place that was found in the unit cube.

    Parameters
    ----------
    function : callable
        Of a place, shape (k,).
    centre : ndarray, shape (k,)
    slopes : ndarray, shape (m, k)
        Of the curves there, in units in which all coordinates count alike.
    random : numpy.random.Generator
    """
    axes = _axes(function, centre, slopes, random)

    def place(unit: Array) -> Array:
        moved: Array = np.clip(centre + axes @ ((2.0 * unit - 1.0) * _REACH), 0.0, 1.0)
        return moved

    def values(units: Array) -> Array:
        return np.array([function(place(unit)) for unit in units])

    middle = np.full(centre.size, 0.5)
    width = 0.5 / _REACH
    return place(evolved(values, middle, width, random, members=_MEMBERS, generations=_GENERATIONS))


def _axes(
    function: Callable[[Array], float], centre: Array, slopes: Array, random: np.random.Generator
) -> Array:
    """Return directions, as columns, in which curves move alike and the value rises as wanted."""
    missing = max(0, centre.size - len(slopes))  # curves of fewer coordinates than parameters
    slopes = np.pad(slopes, ((0, missing), (0, 0)))
    _, lengths, right = np.linalg.svd(slopes, full_matrices=False)
    if lengths[0] == 0.0:  # nothing moves the curves
        return _LONGEST * np.eye(centre.size)
    axes: Array = right.T / np.maximum(lengths, _SENSED * lengths[0])
    axes *= _LONGEST / np.abs(axes).max()
    allowed = _RISE * function(centre)
    for _ in range(_TRIALS):
        draws = centre + random.standard_normal((_DRAWS, centre.size)) @ axes.T
        values = [function(draw) for draw in np.clip(draws, 0.0, 1.0)]
        rise = float(np.mean(values)) - allowed / _RISE
        if rise <= allowed:
            break
        axes *= np.clip(np.sqrt(allowed / rise), 0.3, 0.9)
    return axes
