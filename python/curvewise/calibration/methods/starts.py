"""Where a search begins, how often, and what it may say of where its starts have ended.

The first start is the middle of the bounds, the others are Latin hypercubes of four points: of four
in a row each has a quarter of every axis to itself. (A sequence of low discrepancy is no better
for so few points in so many dimensions, and scipy's takes half a second to import.) As long as
starts end more than 1 % apart others follow, and every second of these begins where the runs so far
promise most, or beside the best of them, in a smaller region, with a surface of the runs that are
there, which costs one run in the place of k + 1: a hop out of a valley into the next. By dtw,
whose valleys have long floors, these are near the best run; by frechet, which has many valleys
beside each other, `valleys` says where they are if the model knows its slopes, and otherwise
`single_runs` goes on.

M. D. McKay, R. J. Beckman, W. J. Conover, "A comparison of three methods for selecting values of
input variables in the analysis of output from a computer code", Technometrics 21 (1979) 239-245;
D. J. Wales, J. P. K. Doye, "Global optimization by basin-hopping", J. Phys. Chem. A 101 (1997)
5111-5116.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish

__all__ = [
    "HOP",
    "End",
    "are_alike",
    "check_regions",
    "finish_of",
    "hop",
    "is_flat",
    "places",
    "simplex_around",
]

HOP = 0.25  # how far from the best run a hop leads, along each axis, as a fraction of the bounds
_QUARTERS = 4
_DRAWN = (0.1, 0.9)  # where starts are, between the bounds
_ALIKE = 0.01  # ends that are above the best by this fraction at most are alike
# And so are those whose difference is negligible, or next to nothing beside what was gained, that
# fraction squared: fits to curves of the model itself.
_PERFECT = 1e3
_SAME_PLACE = 0.01  # of the bounds' range
_MAYBE = "the start is a minimum already, or "
_TRY = 'is flat or stepped here; try another method ("de"), measure or start ('


class End(NamedTuple):
    """How one start ended: from which value, at which and where, and what is said of it.

    One that stayed near the best run mostly comes back to it, which says nothing of other places.
    """

    first: float
    value: float
    place: Array
    finish: Finish
    stayed_near: bool = False


def places(k: int, random: np.random.Generator) -> Iterator[Array]:
    """Yield where to start, one after the other: the middle, then evenly over the box."""
    yield np.full(k, 0.5)
    low, high = _DRAWN
    while True:
        quarters = random.permuted(np.tile(np.arange(_QUARTERS), (k, 1)), axis=1).T
        yield from low + (high - low) * (quarters + random.random((_QUARTERS, k))) / _QUARTERS


def simplex_around(centre: Array, step: float, random: np.random.Generator) -> Array:
    """Return a point beside the centre for every axis, inwards where a bound is near."""
    signs = random.choice((-1.0, 1.0), centre.size)
    signs = np.where(centre + signs * step > 1.0, -1.0, signs)
    signs = np.where(centre + signs * step < 0.0, 1.0, signs)
    points: Array = np.clip(centre + np.diag(signs * step), 0.0, 1.0)
    return points


def hop(best: Array, random: np.random.Generator) -> Array:
    """Return a place beside the best run."""
    return np.clip(best + random.uniform(-HOP, HOP, best.size), 0.0, 1.0)


def are_alike(
    ends: Sequence[End],
    negligible: float,
    among: Sequence[End] | None = None,
    within: float = _ALIKE,
) -> int:
    """Return how many of some starts, or among a part of them, have ended as low as the best."""
    most = (1.0 + within) * min(end.value for end in ends) + _nothing(ends, negligible, within)
    return sum(end.value <= most for end in (ends if among is None else among))


def check_regions(first_radius: float, diff_step: float, starts: int, most_starts: int) -> None:
    """Refuse regions that are no fractions of the bounds, and fewer starts than one."""
    for name, value in (("initial_range", first_radius), ("diff_step", diff_step)):
        if not 0.0 < value <= 1.0:
            raise ValueError(f"{name} is {value}; give a fraction of the bounds, such as 0.02")
    for name, count in (("starts", starts), ("most_starts", most_starts)):
        if count < 1:
            raise ValueError(f"{name} is {count}; give at least 1")


def is_flat(ends: Sequence[End], negligible: float) -> bool:
    """Return whether the best value is that of several places: of a measure that is flat there.

    One point may decide it, and that point may not depend on the parameters.
    """
    best = min(ends, key=lambda end: end.value)
    if best.value <= _nothing(ends, negligible):
        return False
    same = [end.place for end in ends if end.value == best.value]
    return bool(max(np.abs(place - best.place).max() for place in same) > _SAME_PLACE)


def finish_of(
    ends: Sequence[End], begun: int, negligible: float, *, within: float = _ALIKE
) -> Finish:
    """Return what may be said of starts that have ended, of all that were begun."""
    best = min(ends, key=lambda end: end.value)
    converged, message = best.finish
    alike = are_alike(ends, negligible, within=within)
    if begun > 1:
        others = "" if alike == len(ends) else f", others{_above(ends, best.value)}"
        part = f"{100.0 * within:g} %"
        message = f"{alike} of {begun} starts within {part} of the best{others}; {message}"
    if is_flat(ends, negligible):
        return Finish(False, f"several places have the best value: the measure {_TRY}{message})")
    if best.value == best.first and best.value > _nothing(ends, negligible):
        return Finish(False, f"no step gained anything: {_MAYBE}the measure {_TRY}{message})")
    return Finish(converged and alike == begun, message)


def _nothing(ends: Sequence[End], negligible: float, within: float = _ALIKE) -> float:
    return max(_PERFECT * negligible, within**2 * min(end.first for end in ends))


def _above(ends: Sequence[End], best: float) -> str:
    """Say how far above the best value the highest is."""
    highest = max(end.value for end in ends)
    if highest > 10.0 * best:
        return f" at up to {highest:.3g}"
    return f" up to {100.0 * (highest / best - 1.0):.2g} % above"
