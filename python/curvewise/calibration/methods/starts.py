"""Starting points of a multistart search, and its verdict.

The first start is the middle of the bounds. The others are Latin hypercube samples of four points:
each of four consecutive starts lies in a different quarter of every axis. (A low-discrepancy
sequence is not better for a few points in many dimensions, and scipy's takes half a second to
import.)

M. D. McKay, R. J. Beckman, W. J. Conover, "A comparison of three methods for selecting values of
input variables in the analysis of output from a computer code", Technometrics 21 (1979) 239-245.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish
from ..records.search_record import Agreement

__all__ = [
    "NOISIEST",
    "WITHIN",
    "End",
    "are_alike",
    "check_regions",
    "finish_of",
    "has_arrived",
    "is_enough",
    "is_flat",
    "nothing_beside",
    "places",
    "simplex_around",
    "starts_that_agree",
]

_QUARTERS = 4
_DRAWN = (0.1, 0.9)  # where starts are, between the bounds
_FEWEST = 3  # starts that have to agree
WITHIN = 0.01  # ends within this fraction above the best value agree
NOISIEST = 0.05  # and by this one where the model's own noise moves values so far
# Ends also agree if their difference is negligible, or at most the square of that fraction of the
# total reduction. Fits to curves of the model itself need this.
_PERFECT = 1e3
_SAME_PLACE = 0.01  # of the bounds' range
_MAYBE = "the start is a minimum already, or "
_TRY = 'is flat or stepped here; try another method ("global"), measure or start '
_UNFINISHED = (
    "the best start ended before its steps had become small; give closer bounds, or another seed"
)


class End(NamedTuple):
    """The end of one start.

    Attributes
    ----------
    first, value : float
        The first and the last value.
    place : ndarray, shape (k,)
        The point at the end.
    finish : Finish
        Convergence and message of the start.
    is_independent : bool
        Whether its starting point does not depend on other starts.
    noise : float
        Effect of the model's own noise on the value, one standard deviation.
    is_misled : bool
        Whether it continued with the surrogate of the value, because the surrogate of the curves
        misled it.
    """

    first: float
    value: float
    place: Array
    finish: Finish
    is_independent: bool = True
    noise: float = 0.0
    is_misled: bool = False

    @property
    def tells(self) -> bool:
        """Whether it agrees with other starts, or disagrees."""
        return self.is_independent and self.finish.converged


def places(k: int, random: np.random.Generator) -> Iterator[Array]:
    """Yield where to start, one after the other: the middle, then evenly over the box."""
    yield np.full(k, 0.5)
    low, high = _DRAWN
    while True:
        quarters = random.permuted(np.tile(np.arange(_QUARTERS), (k, 1)), axis=1).T
        yield from low + (high - low) * (quarters + random.random((_QUARTERS, k))) / _QUARTERS


def simplex_around(centre: Array, step: float, random: np.random.Generator) -> Array:
    """Return a point next to the centre on every axis, within the bounds."""
    signs = random.choice((-1.0, 1.0), centre.size)
    signs = np.where(centre + signs * step > 1.0, -1.0, signs)
    signs = np.where(centre + signs * step < 0.0, 1.0, signs)
    points: Array = np.clip(centre + np.diag(signs * step), 0.0, 1.0)
    return points


def are_alike(ends: Sequence[End], negligible: float, among: Sequence[End]) -> int:
    """Return how many of some starts have ended as low as the best of all."""
    best = min(ends, key=lambda end: end.value)
    noise = min(2.0 * best.noise, NOISIEST * best.value)
    most = best.value + max(WITHIN * best.value, noise)
    most = max(most, _nothing(ends, negligible))
    return sum(end.value <= most for end in among)


def is_enough(ends: Sequence[End], negligible: float, starts: int) -> bool:
    """Return whether enough independent starts agree, so that no more are needed.

    `starts` of them suffice if all agree. If some have ended higher, one more must agree, and at
    least half of all.
    """
    telling = [end for end in ends if end.tells]
    alike = are_alike(ends, negligible, telling)
    return _agree(ends, negligible, starts) and 2 * alike >= len(telling)


def has_arrived(ends: Sequence[End], negligible: float, starts: int) -> bool:
    """Return whether enough independent starts agree for the best of all that have been made.

    As many as have to agree by default, or `starts` if that is less; one more where some have ended
    higher. A lower minimum that attracts as many of n starts as the k that agree would have been
    missed by all of them with a probability of (1 - k / n)^n < exp(-k): 2 % for k = 4, whatever n
    is.
    """
    return _agree(ends, negligible, min(starts, starts_that_agree(None, ends[0].place.size)))


def _agree(ends: Sequence[End], negligible: float, starts: int) -> bool:
    """Return whether so many independent starts agree, or one more where some ended higher."""
    telling = [end for end in ends if end.tells]
    alike = are_alike(ends, negligible, telling)
    return alike >= starts if alike == len(telling) else alike > starts


def starts_that_agree(starts: int | None, parameters: int) -> int:
    """Return the number of starts that must agree."""
    return max(_FEWEST, math.ceil(parameters / 2)) if starts is None else starts


def check_regions(
    first_radius: float,
    diff_step: float,
    starts: int | None,
    most_starts: int,
    at_once: int | None,
) -> None:
    """Check that regions are fractions and numbers of starts are positive."""
    for name, value in (("initial_range", first_radius), ("diff_step", diff_step)):
        if not 0.0 < value <= 1.0:
            raise ValueError(f"{name} is {value}; give a fraction of the bounds, such as 0.02")
    counts = (("starts", starts), ("most_starts", most_starts), ("starts_at_once", at_once))
    for name, count in counts:
        if count is not None and count < 1:
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


def finish_of(ends: Sequence[End], negligible: float, starts: int) -> Finish:
    """Return what may be said of starts that have ended.

    Parameters
    ----------
    ends : sequence of End
    negligible : float
        Differences of the value below this do not count.
    starts : int
        Number of starts that must agree; 1 if a start was given.
    """
    best = min(ends, key=lambda end: end.value)
    converged, message = best.finish.converged, best.finish.message
    telling = [end for end in ends if end.is_independent]
    agreement = _agreement(ends, negligible)
    if len(ends) > 1:
        others = ""
        if agreement.agree < agreement.starts:
            others = f", others{_above(telling, best.value)}"
        message = (
            f"{agreement.agree} of {agreement.starts} starts within 1 % of the best{others}; "
            f"{message}"
        )
    if obstacle := _obstacle(ends, best, negligible):
        before, reason = obstacle
        return Finish(False, f"{before}({message})", agreement, reason)
    if converged and has_arrived(ends, negligible, starts):
        return Finish(True, message, agreement)
    return Finish(False, message, agreement, _too_few(agreement) if converged else _UNFINISHED)


def _agreement(ends: Sequence[End], negligible: float) -> Agreement:
    """Return how many of the independent starts agree, and within what."""
    best = min(end.value for end in ends)
    alike = [end for end in ends if end.tells and are_alike(ends, negligible, [end])]
    starts = sum(end.is_independent for end in ends)
    if best <= _nothing(ends, negligible) or not alike:
        return Agreement(len(alike), starts, 0.0)
    return Agreement(len(alike), starts, max(end.value for end in alike) / best - 1.0)


def _obstacle(ends: Sequence[End], best: End, negligible: float) -> tuple[str, str] | None:
    """Return why agreement says nothing here, for those who know the method and for others."""
    if is_flat(ends, negligible):
        return (
            f"several parameter sets have the best value: the measure {_TRY}",
            "several parameter sets have the same best value, because the measure does not "
            "distinguish them; use another measure",
        )
    if best.value == best.first and best.value > _nothing(ends, negligible):
        return (
            f"no step gained anything: {_MAYBE}the measure {_TRY}",
            "no start found a better fit than it began with; compare by another measure",
        )
    if any(end.is_misled for end in ends):
        return (
            "the surrogate of curves misleads, and steps went by the value alone ",
            "the model's curves jump from run to run; refine its steps, or search by another "
            "method",
        )
    return None


def _too_few(agreement: Agreement) -> str:
    """Say that too few starts agree."""
    agree, starts, _ = agreement
    if starts == 1:
        return ""
    only = f"only {agree} of {starts} starts agree" if agree > 1 else "no two starts agree"
    return f"{only}; give closer bounds, or another seed"


def nothing_beside(first: float) -> float:
    """Return the negligible difference relative to the first value of a start."""
    return WITHIN**2 * first


def _nothing(ends: Sequence[End], negligible: float) -> float:
    return max(_PERFECT * negligible, nothing_beside(min(end.first for end in ends)))


def _above(ends: Sequence[End], best: float) -> str:
    """Say how far above the best value the highest is."""
    highest = max(end.value for end in ends)
    if highest > 10.0 * best:
        return f" at up to {highest:.3g}"
    return f" up to {100.0 * (highest / best - 1.0):.2g} % above"
