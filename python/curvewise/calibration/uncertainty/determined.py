"""The rule that decides which parameters the tests determine.

A parameter is determined if it is not at a bound, and half its interval is at most a quarter of its
value and of its bounds' range. Tests that leave a wider interval have told little more than the
bounds. For a parameter near 0 the limit is a fiftieth of the range instead of a quarter of the
value. The module also gives the part of the verdict that needs no bootstrap. Cost: that of an
estimate.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from ..problem.space import Space
from ..problem.tables import per_cent
from .noise import noise_of
from .sensitivity import Optimum
from .spread import linear_spread

__all__ = ["THE_RULE", "Verdict", "determined", "verdict_on"]

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


class Verdict(NamedTuple):
    """The determined parameters, as far as is known without a bootstrap.

    Attributes
    ----------
    determined : dict of str to bool
    loose : str
        The other parameters that are not at a bound, with half their intervals in per cent. Empty
        if all are determined or at bounds.
    """

    determined: dict[str, bool]
    loose: str


def verdict_on(optimum: Optimum) -> Verdict:
    """Return which parameters are determined, by the intervals of the linear theory."""
    space = optimum.problem.space
    halves = linear_spread(optimum, noise_of(optimum, None), 0.95).halves
    parameters = space.dictionary(space.point(optimum.unit))
    good = determined(space, parameters, halves)
    at_bounds = space.at_bounds(parameters)
    loose = [
        f"{name} ± {_share(space, name, parameters[name], half)}"
        for name, half in zip(space.names, halves, strict=True)
        if not good[name] and name not in at_bounds
    ]
    return Verdict(good, ", ".join(loose))


def _share(space: Space, name: str, value: float, change: float) -> str:
    """Return a change in per cent of the limiting quantity."""
    if change > _OF_VALUE * abs(value) > 0.0:
        return f"{per_cent(change, value)} %"
    low, high = space.bounds[name]
    return f"{per_cent(change, high - low)} % of its range"
