"""Assumed bounds, widened if a fit ends at one.

Bounds derived from tests are wide, but still an assumption. If a parameter ends at one, the search
continues from there with that bound ten times as wide, until no parameter is at a bound. Then
everything is searched again in the wider bounds. The gain shows whether the first bound mattered.
If it is negligible, the parameter tends to infinity, because the tests do not determine it
(hardening along a line does not saturate). Cost: that of a search, and about ten to sixty runs for
each widening, if a parameter is at a bound. A limit of runs applies to all of these searches
together.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from typing import Any

from .._bounds import Below, Bounds, Log, on_its_scale
from ..calibration import Identification
from ..calibration.answers.joined_searches import joined

__all__ = ["Beyond", "search_within"]

_FURTHER = 10.0
_WORTH = 0.01  # of the value: with less gained beyond it a bound decides nothing
_ALIKE = 1e-3  # of the value
_MOST_WIDENINGS = 4


@dataclass(frozen=True)
class Beyond:
    """Result of widening the bounds at which a fit ended first.

    Attributes
    ----------
    sides : dict of str to str
        "lower" or "upper", for each parameter at a bound that is not a limit.
    gain : float
        The relative reduction of the value in wider bounds.
    still : dict of str to str
        The same as `sides`, at the end. It is empty, unless bounds that are 10,000 times as wide
        are too narrow, or the limit of runs was reached.
    runs : int
        The number of model runs in all these searches.
    """

    sides: dict[str, str]
    gain: float
    still: dict[str, str]
    runs: int

    @property
    def matters(self) -> bool:
        """Whether more than a hundredth is gained there."""
        return self.gain >= _WORTH

    def __str__(self) -> str:
        return f"{self._found}; {self.runs} runs in all"

    @property
    def _found(self) -> str:
        if self.still:
            return f"{_said(self.still)} still: give others (fit_material: bounds=)"
        begin = f"{_said(self.sides)} first, which was assumed; in wider bounds the value falls by"
        if self.matters:
            return f"{begin} {100.0 * self.gain:.2g} %"
        return f"not determined by these tests: {begin} less than {100.0 * _WORTH:g} %"


def search_within(
    search: Callable[..., Identification],
    bounds: Bounds,
    most_runs: int | None,
    *,
    kept: Collection[str] = (),
) -> tuple[Identification, Beyond | None]:
    """Search within assumed bounds, and within wider ones where that ends at one.

    Parameters
    ----------
    search : callable
        `identify` with all but the bounds, `max_runs`, and `start` if it is to begin there.
    bounds : mapping
        As read off the tests.
    most_runs : int, optional
        Maximum number of model runs in all searches.
    kept : collection of str
        Parameters whose bounds are not assumed, and stay.

    Returns
    -------
    Identification
        The chosen search, with the evaluations of all.
    Beyond or None
        The result of wider bounds; None if no bound was widened.
    """
    first = search(bounds, max_runs=most_runs)
    sides = _assumed(first, kept)
    if not sides:
        return first, None
    searches = [first]

    def search_on(start: dict[str, float] | None) -> Identification | None:
        """Search with the runs that are left, if any are."""
        left = None if most_runs is None else most_runs - _runs(searches)
        if left == 0:
            return None
        searches.append(search(bounds, start=start, max_runs=left))
        return searches[-1]

    end = first
    for _ in range(_MOST_WIDENINGS):
        at = _assumed(end, kept)
        if not at:
            break
        bounds = {**bounds, **{name: _further(bounds[name], side) for name, side in at.items()}}
        start = {name: end.parameters[name] for name in end.problem.space.names}
        end = search_on(start) or end
    whole = search_on(None) or end
    is_good = whole.value <= (1.0 + _ALIKE) * end.value
    found = whole if is_good and len(_assumed(whole, kept)) <= len(_assumed(end, kept)) else end
    gain = 1.0 - found.value / first.value if first.value else 0.0
    beyond = Beyond(sides, max(gain, 0.0), _assumed(found, kept), _runs(searches))
    return joined(searches, found), beyond


def _runs(searches: list[Identification]) -> int:
    return sum(one.evaluations for one in searches)


def _said(sides: dict[str, str]) -> str:
    """Return which parameters are at which bounds."""
    return ", ".join(f"{name} at its {side} bound" for name, side in sides.items())


def _assumed(found: Identification, kept: Collection[str]) -> dict[str, str]:
    """Return the parameters at an assumed bound, not a limit, with the side."""
    space = found.problem.space
    limits = space.at_limits(found.parameters)
    at_bounds = space.at_bounds(found.parameters)
    return {n: side for n, side in at_bounds.items() if n not in limits and n not in kept}


def _further(given: Any, side: str) -> Any:
    """Return bounds with one side ten times as wide."""
    is_plain = not isinstance(given, (Log, Below))
    low, high = given if is_plain else (given.low, given.high)
    if side == "upper":
        high *= _FURTHER
    else:
        low = low / _FURTHER if low > 0.0 else low * _FURTHER
    if not is_plain:
        return replace(given, low=low, high=high)
    return on_its_scale(low, high) if low > 0.0 else (low, high)
