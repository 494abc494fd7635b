"""Which parameters the tests determine: the rule, and what is known without a bootstrap.

A parameter is determined if it is at no bound, and may be wrong by at most a quarter of its value
and a quarter of its bounds' range: tests that leave more than that open have hardly told more than
the bounds. Of a parameter that is nearly 0 a fiftieth of the range takes the place of the quarter
of the value. By how much it may be wrong is half its interval or twice its error, and by how much
it may change unnoticed. Cost: that of the singular values (`sensitivity`) and of a fitted curve.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from ..problem.space import Space
from .noise import noise_of
from .sensitivity import Optimum, sensitivity_of
from .spread import linear_spread

__all__ = ["THE_RULE", "determined", "determined_by"]

_OF_VALUE, _OF_RANGE, _SMALL = 0.25, 0.25, 0.02

THE_RULE = (
    "A parameter is not determined if it is at a bound, or if half its interval, or the change "
    f"that raises the value by 1 %, is more than {100 * _OF_VALUE:g} % of the parameter or "
    f"{100 * _OF_RANGE:g} % of the range between its bounds"
)
"""The rule in words, for a page."""


def determined(
    space: Space, parameters: Mapping[str, float], changes: Iterable[float]
) -> dict[str, bool]:
    """Return which parameters are determined, where each of them may be wrong by a change."""
    at_bounds = space.at_bounds(parameters)
    return {
        name: name not in at_bounds and change <= _most(space, name, abs(parameters[name]))
        for name, change in zip(space.names, changes, strict=True)
    }


def _most(space: Space, name: str, size: float) -> float:
    """Return by how much a parameter of a size may be wrong and still be determined."""
    if space.is_log[space.names.index(name)]:  # decades of bounds say nothing of a value
        return _OF_VALUE * size
    low, high = space.bounds[name]
    return min(max(_OF_VALUE * size, _SMALL * (high - low)), _OF_RANGE * (high - low))


def determined_by(optimum: Optimum) -> dict[str, bool]:
    """Return which parameters are determined as far as can be said without a bootstrap.

    By how far they go unnoticed, and by twice the standard errors of the linear theory.
    """
    space = optimum.problem.space
    errors = linear_spread(optimum, noise_of(optimum, None), 0.95).errors
    unnoticed = np.abs(space.differential(optimum.unit)) @ sensitivity_of(optimum).reach
    changes = np.maximum(unnoticed, 2.0 * errors)
    parameters = space.dictionary(space.point(optimum.unit))
    return determined(space, parameters, changes.tolist())
