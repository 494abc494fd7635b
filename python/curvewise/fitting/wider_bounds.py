"""Bounds that were assumed: moved where a fit ends at one, or shown not to matter.

Bounds read off tests are wide, and still an assumption. Where a parameter ends at one, the search
goes on from there with that bound ten times as wide. If this gains anything, all is searched once
more in the wider bounds; if not, the bound decides nothing, and what is known is how little it
does: such a parameter runs to infinity, since the tests do not determine it (what hardens along a
line has no saturation). Cost: some ten to sixty runs where a parameter is at a bound.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from .._bounds import Below, Bounds, Log, on_its_scale
from ..calibration import Identification

__all__ = ["Beyond", "search_within"]

_FURTHER = 10.0
_WORTH = 1e-3  # of the value: with less gained beyond it a bound decides nothing
_MOST_WIDENINGS = 2


@dataclass(frozen=True)
class Beyond:
    """What lies beyond the bounds at which a fit has ended.

    Attributes
    ----------
    sides : dict of str to str
        "lower" or "upper", for each parameter at a bound that is no limit.
    gain : float
        The share by which the value falls with these bounds ten times as wide.
    """

    sides: dict[str, str]
    gain: float

    @property
    def matters(self) -> bool:
        """Whether more than a thousandth is gained there."""
        return self.gain >= _WORTH

    def __str__(self) -> str:
        ends = ", ".join(f"{name} at its {side} bound" for name, side in self.sides.items())
        wider = f"{ends}; with bounds ten times as wide the value falls by"
        if self.matters:
            return f"{wider} {100.0 * self.gain:.2g} %: give such (fit_material: bounds=)"
        return f"not determined by these tests: {wider} less than {100.0 * _WORTH:g} %"


def search_within(
    search: Callable[..., Identification], bounds: Bounds
) -> tuple[Identification, Beyond | None]:
    """Search within assumed bounds; widen those at which the search ends, as long as that gains.

    Parameters
    ----------
    search : callable
        `identify` with all but the bounds, and `start` if it is to begin there.
    bounds : mapping
        As read off the tests.
    """
    widenings = 0
    while True:
        found = search(bounds)
        sides = _assumed(found)
        if not sides:
            return found, None
        wider = {**bounds, **{name: _further(bounds[name], side) for name, side in sides.items()}}
        start = {name: found.parameters[name] for name in found.problem.space.names}
        gain = 1.0 - search(wider, start=start).value / found.value if found.value else 0.0
        beyond = Beyond(sides, max(gain, 0.0))
        if not beyond.matters or widenings == _MOST_WIDENINGS:
            return found, beyond
        bounds, widenings = wider, widenings + 1


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
