"""Bounds that were assumed: moved where a fit ends at one.

Bounds read off tests are wide, and still an assumption. Where a parameter ends at one, the search
goes on from there with that bound ten times as wide, and so on until no parameter is at one; then
all is searched once more in the wider bounds. What is gained says whether the first bound decided
anything: where it is next to nothing, the parameter runs to infinity, since the tests do not
determine it (what hardens along a line has no saturation). Cost: of a search, and some ten to sixty
runs a widening, where a parameter is at a bound.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from .._bounds import Below, Bounds, Log, on_its_scale
from ..calibration import Identification

__all__ = ["Beyond", "search_within"]

_FURTHER = 10.0
_WORTH = 0.01  # of the value: with less gained beyond it a bound decides nothing
_ALIKE = 1e-3  # of the value
_MOST_WIDENINGS = 4


@dataclass(frozen=True)
class Beyond:
    """What lies beyond the bounds at which a fit had ended first.

    Attributes
    ----------
    sides : dict of str to str
        "lower" or "upper", for each parameter at a bound that is no limit.
    gain : float
        The share by which the value has fallen in wider bounds.
    still : dict of str to str
        The same as `sides`, at the end: empty, unless bounds that are 10,000 times as wide are too
        narrow.
    """

    sides: dict[str, str]
    gain: float
    still: dict[str, str]

    @property
    def matters(self) -> bool:
        """Whether more than a hundredth is gained there."""
        return self.gain >= _WORTH

    def __str__(self) -> str:
        if self.still:
            return f"{_said(self.still)} still; give others (fit_material: bounds=)"
        begin = f"{_said(self.sides)} first, which was assumed; in wider bounds the value falls by"
        if self.matters:
            return f"{begin} {100.0 * self.gain:.2g} %"
        return f"not determined by these tests: {begin} less than {100.0 * _WORTH:g} %"


def search_within(
    search: Callable[..., Identification], bounds: Bounds
) -> tuple[Identification, Beyond | None]:
    """Search within assumed bounds, and within wider ones where that ends at one.

    Parameters
    ----------
    search : callable
        `identify` with all but the bounds, and `start` if it is to begin there.
    bounds : mapping
        As read off the tests.
    """
    first = search(bounds)
    sides = _assumed(first)
    if not sides:
        return first, None
    end = first
    for _ in range(_MOST_WIDENINGS):
        at = _assumed(end)
        if not at:
            break
        bounds = {**bounds, **{name: _further(bounds[name], side) for name, side in at.items()}}
        start = {name: end.parameters[name] for name in end.problem.space.names}
        end = search(bounds, start=start)
    whole = search(bounds)
    is_good = whole.value <= (1.0 + _ALIKE) * end.value
    found = whole if is_good and len(_assumed(whole)) <= len(_assumed(end)) else end
    gain = 1.0 - found.value / first.value if first.value else 0.0
    return found, Beyond(sides, max(gain, 0.0), _assumed(found))


def _said(sides: dict[str, str]) -> str:
    """Return which parameters are at which bounds."""
    return ", ".join(f"{name} at its {side} bound" for name, side in sides.items())


def _assumed(found: Identification) -> dict[str, str]:
    """Return the parameters at a bound that is no limit, with the side."""
    space = found.problem.space
    limits = space.at_limits(found.parameters)
    at_bounds = space.at_bounds(found.parameters)
    return {name: side for name, side in at_bounds.items() if name not in limits}


def _further(given: Any, side: str) -> Any:
    """Return bounds of which one is ten times as wide."""
    is_plain = not isinstance(given, (Log, Below))
    low, high = given if is_plain else (given.low, given.high)
    if side == "upper":
        high *= _FURTHER
    else:
        low = low / _FURTHER if low > 0.0 else low * _FURTHER
    if not is_plain:
        return replace(given, low=low, high=high)
    return on_its_scale(low, high) if low > 0.0 else (low, high)
