"""The rule that decides which parameters the tests determine.

A parameter is determined if it is not at a bound, and half its interval is at most a quarter of its
value and of its bounds' range. Tests that leave a wider interval have told little more than the
bounds. For a parameter near 0 the limit is a fiftieth of the range instead of a quarter of the
value. The module also gives the part of the verdict that needs no bootstrap. Cost: that of an
estimate.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..problem.space import Space
from .noise import noise_of
from .sensitivity import Optimum
from .spread import linear_spread

__all__ = ["THE_RULE", "determined", "determined_by_linear_theory"]

_OF_VALUE, _OF_RANGE, _SMALL = 0.25, 0.25, 0.02

THE_RULE = (
    "A parameter is not determined if it is at a bound, or if half its interval is more than "
    f"{100 * _OF_VALUE:g} % of the parameter or {100 * _OF_RANGE:g} % of the range between its "
    "bounds"
)
"""The rule in words, for a page."""


def determined(
    space: Space, parameters: Mapping[str, float], halves: Iterable[float]
) -> dict[str, bool]:
    """Return which parameters are determined, by half their intervals."""
    at_bounds = space.at_bounds(parameters)
    return {
        name: name not in at_bounds and half <= _most(space, name, abs(parameters[name]))
        for name, half in zip(space.names, halves, strict=True)
    }


def _most(space: Space, name: str, size: float) -> float:
    """Return the largest error with which a parameter counts as determined."""
    if space.is_log[space.names.index(name)]:  # decades of bounds say nothing of a value
        return _OF_VALUE * size
    low, high = space.bounds[name]
    return min(max(_OF_VALUE * size, _SMALL * (high - low)), _OF_RANGE * (high - low))


def determined_by_linear_theory(optimum: Optimum) -> dict[str, bool]:
    """Return which parameters are determined, by the intervals of the linear theory."""
    space = optimum.problem.space
    halves = linear_spread(optimum, noise_of(optimum, None), 0.95).halves
    return determined(space, space.dictionary(space.point(optimum.unit)), halves)
