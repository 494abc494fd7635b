"""The global stage of a search: minima of a surrogate beyond the trust region, by basin-hopping.

A local search ends in the nearest local minimum, and measures of curves have many close together. A
surrogate through the best runs predicts them before the model is run. Monotonic basin-hopping
searches it: from the lowest place so far, a random hop, then the local minimum by the inner search.

Cost: ten inner searches, and no run of the model.

D. J. Wales, J. P. K. Doye, "Global optimization by basin-hopping", J. Phys. Chem. A 101 (1997)
5111-5116.
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from ..surfaces.steps import FEW, SMALL
from .runs import Runs

__all__ = ["GlobalStage"]

_SHORTEST, _LONGEST = 0.025, 0.4  # hops along an axis, as fractions of the bounds' range


class GlobalStage:
    """Finds places that a surrogate through the runs of a search promises."""

    def __init__(self, runs: Runs, random: np.random.Generator) -> None:
        self._runs, self._random = runs, random

    def lowest(self, number: int, seen: Rows | None = None) -> tuple[Array, float] | None:
        """Return the lowest place that hops from a run find, and its predicted reduction.

        The surrogate uses the runs `seen`, or all. Return None if a run exists at that place.
        """
        inner, surface = self._runs.inner, self._runs.surface_through_best(number, seen)
        place = self._runs.points[number]
        before = value = float(inner.values(surface, place[np.newaxis])[0])
        for _ in range(FEW):
            hop = _LONGEST * (_SHORTEST / _LONGEST) ** self._random.random()
            start = place + hop * self._random.uniform(-1.0, 1.0, place.size)
            start = np.clip(start, 0.0, 1.0)
            low, high = np.clip(start - hop, 0.0, 1.0), np.clip(start + hop, 0.0, 1.0)
            found = inner.lowest(surface, start, low, high)
            there = float(inner.values(surface, found[np.newaxis])[0])
            if there < value:
                place, value = found, there
        if np.abs(self._runs.points - place).max(axis=1).min() <= SMALL:
            return None
        return place, before - value
