"""Which parameters the tests determine: those that neither noise nor indifference moves far.

A parameter is determined if it may be wrong by less than a tenth of its bounds' range and a fifth
of itself. Cost: that of the singular values (`sensitivity`) and of a fitted curve.
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array
from ..problem.space import Space
from .noise import noise_of
from .sensitivity import Optimum
from .spread import linear_covariance

__all__ = ["determined_by", "is_narrow"]

# Of the bounds' range; of the value; and of the range, for a parameter that is nearly 0.
_OF_RANGE, _OF_VALUE, _SMALL = 0.1, 0.2, 0.02


def determined_by(optimum: Optimum, reach: Array) -> dict[str, bool]:
    """Return which parameters are determined as far as can be said without a bootstrap.

    By how far they go unnoticed, and by twice the standard errors of the linear theory.
    """
    space = optimum.problem.space
    differential = space.differential(optimum.unit)
    noise = noise_of(optimum, None)
    covariance = differential @ linear_covariance(optimum, noise) @ differential.T
    changes = np.maximum(np.abs(differential) @ reach, 2.0 * np.sqrt(np.diag(covariance)))
    point = space.point(optimum.unit)
    return {name: _small(space, i, changes[i], point[i]) for i, name in enumerate(space.names)}


def is_narrow(optimum: Optimum, i: int, interval: tuple[float, float]) -> bool:
    """Return whether an interval of parameter i leaves it determined."""
    space = optimum.problem.space
    low, high = interval
    return _small(space, i, (high - low) / 2.0, space.point(optimum.unit)[i])


def _small(space: Space, i: int, change: float, value: float) -> bool:
    """Return whether a parameter that may be off by a change is still determined."""
    low, high = space.bounds[space.names[i]]
    most = _OF_VALUE * abs(value)
    if not space.is_log[i]:
        most = min(_OF_RANGE * (high - low), max(most, _SMALL * (high - low)))
    return bool(change <= most)
