"""The verdict on the ends of a multistart search: how many agree, and what may be said of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
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
    "finish_of",
    "is_enough",
    "is_flat",
    "nothing_beside",
    "starts_that_agree",
]

_FEWEST = 3  # starts that have to agree
# Ends within this fraction above the best value agree, and places this near along each axis, as a
# fraction of the bounds' range, are the same.
WITHIN = 0.01
NOISIEST = 0.05  # and by this one where the model's own noise moves values so far
# Ends also agree if their difference is negligible, or at most the square of that fraction of the
# total reduction. Fits to curves of the model itself need this.
_PERFECT = 1e3
_TRY = 'is flat or stepped here; try another method ("global"), measure or start '


class End(NamedTuple):
    """The end of one start: its first and last value, and the point of the last.

    `noise` is the effect of the model's own noise on the value, one standard deviation.
    """

    first: float
    value: float
    place: Array
    finish: Finish
    is_independent: bool = True  # whether its starting point does not depend on other starts
    noise: float = 0.0
    is_misled: bool = False  # whether it continued with the surrogate of the value

    @property
    def tells(self) -> bool:
        """Whether it agrees with other starts, or disagrees."""
        return self.is_independent and self.finish.converged


def starts_that_agree(starts: int | None, parameters: int) -> int:
    """Return the number of starts that must agree."""
    return max(_FEWEST, math.ceil(parameters / 2)) if starts is None else starts


def nothing_beside(first: float) -> float:
    """Return the negligible difference relative to the first value of a start."""
    return WITHIN**2 * first


def are_alike(ends: Sequence[End], negligible: float, among: Sequence[End]) -> int:
    """Return how many of some starts have ended as low as the best of all."""
    best = _best(ends)
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


def _agree(ends: Sequence[End], negligible: float, starts: int) -> bool:
    telling = [end for end in ends if end.tells]
    alike = are_alike(ends, negligible, telling)
    return alike >= starts if alike == len(telling) else alike > starts


def is_flat(ends: Sequence[End], negligible: float) -> bool:
    """Return whether the best value is that of several places: of a measure that is flat there.

    One point may decide it, and that point may not depend on the parameters.
    """
    best = _best(ends)
    if best.value <= _nothing(ends, negligible):
        return False
    same = [end.place for end in ends if end.value == best.value]
    return bool(max(np.abs(place - best.place).max() for place in same) > WITHIN)


def finish_of(ends: Sequence[End], negligible: float, starts: int) -> Finish:
    """Return the ending of a search whose starts have ended.

    The search has converged if as many starts agree as have to by default, or `starts` if that is
    less; one more where some have ended higher. A lower minimum that attracts as many of n starts
    as the k that agree would have been missed by all of them with a probability of
    (1 - k / n)^n < exp(-k): 2 % for k = 4, whatever n is.
    """
    best = _best(ends)
    converged, message = best.finish.converged, best.finish.message
    agreement = _agreement(ends, negligible)
    agree, count, _ = agreement
    if len(ends) > 1:
        others = _above(ends, best.value) if agree < count else ""
        message = f"{agree} of {count} starts within 1 % of the best{others}; {message}"
    if obstacle := _obstacle(ends, best, negligible):
        before, reason = obstacle
        return Finish(False, f"{before}({message})", agreement, reason)
    enough = min(starts, starts_that_agree(None, best.place.size))
    if converged and _agree(ends, negligible, enough):
        return Finish(True, message, agreement)
    doubt = f"only {agree} of {count} starts agree" if agree > 1 else "no two starts agree"
    if not converged:
        doubt = "the best start ended before its steps had become small"
    elif count == 1:
        return Finish(False, message, agreement)
    return Finish(False, message, agreement, f"{doubt}; give closer bounds, or another seed")


def _agreement(ends: Sequence[End], negligible: float) -> Agreement:
    """Return how many of the independent starts agree, and within what."""
    best = _best(ends).value
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
    alike = [end for end in ends if are_alike(ends, negligible, [end])]
    if all(end.value == end.first for end in alike) and best.value > _nothing(ends, negligible):
        return (
            f"no step gained anything: the start is a minimum already, or the measure {_TRY}",
            "no start found a better fit than it began with; compare by another measure",
        )
    if any(end.is_misled for end in ends):
        return (
            "the surrogate of curves misleads, and steps went by the value alone ",
            "the model's curves jump from run to run; refine its steps, or search by another "
            "method",
        )
    return None


def _best(ends: Sequence[End]) -> End:
    return min(ends, key=lambda end: end.value)


def _nothing(ends: Sequence[End], negligible: float) -> float:
    return max(_PERFECT * negligible, nothing_beside(min(end.first for end in ends)))


def _above(ends: Sequence[End], best: float) -> str:
    """Say how far above the best value the highest independent end is."""
    highest = max(end.value for end in ends if end.is_independent)
    if highest > 10.0 * best:
        return f", others at up to {highest:.3g}"
    return f", others up to {100.0 * (highest / best - 1.0):.2g} % above"
