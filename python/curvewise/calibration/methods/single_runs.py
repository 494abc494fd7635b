"""Runs one by one by frechet, each where the surface through the best runs is lowest.

A start that goes down with a region of trust takes 20 to 40 runs, most of them to find out again
what a surface through the best runs tells (`surfaces.sensed_surface`). So by frechet the first
starts take few steps, and then single runs are made, each where hops over the whole cube find the
surface lowest, which is made anew after each: what it promises too much it learns from the run,
where a start would stay for some more. Once it promises little more than the best run, a region of
trust leads to the bottom of that valley. Then a new start elsewhere takes a few steps and hops from
its own best run. The surface shows valleys that are far from all runs too high, since what is off
in a curve makes its largest distance longer, and so it learns of them.

Cost: for every run a surface and one or two hops, some 0.1 s.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Ledger
from ..surfaces.leash_minimum import LeashMinimum
from .curve_descent import CurveRuns
from .side_by_side import Part

__all__ = ["SingleRuns"]

# The least that counts of what is promised, as a fraction of the value: beside the best run before
# the bottom of its valley is known, to which going down leads as well, and otherwise.
_LEAST, _LEAST_ELSEWHERE = 0.03, 2e-3
# So many runs in a row may gain less than a part of what they were promised: before the bottom is
# known, and otherwise.
_FAILURES, _FAILURES_ELSEWHERE, _POOR = 6, 3, 0.2
_LEAST_OF_START, _FAILURES_OF_START = 3e-3, 4  # both from the best run of a new start
_HOPS, _HOPS_ELSEWHERE = 2, 8
_GOOD_RUNS = 20  # from one of which every second hop begins
_SAME = 1e-4  # places that are nearer to each other, along each axis, are the same


class SingleRuns:
    """Makes single runs where the surface through the best runs is lowest.

    Parameters
    ----------
    ledger, random, runs
        Of the search.
    """

    def __init__(self, ledger: Ledger, random: np.random.Generator, runs: CurveRuns) -> None:
        self._ledger, self._random, self._runs = ledger, random, runs

    def from_best(self, bottom: float) -> Part[bool]:
        """Run as long as much is promised; return whether nothing more is.

        Parameters
        ----------
        bottom : float
            The lowest value of a valley to whose bottom the search has gone.
        """
        failures = 0
        while True:
            best, value = self._ledger.best_unit, self._ledger.best.value
            is_at_bottom = value >= bottom
            least = _LEAST_ELSEWHERE if is_at_bottom else _LEAST
            origins = self._origins(_HOPS_ELSEWHERE if is_at_bottom else _HOPS)
            promised, place = self._lowest(best, origins)
            if promised >= (1.0 - least) * value or value <= self._ledger.negligible:
                return True
            if failures == (_FAILURES_ELSEWHERE if is_at_bottom else _FAILURES):
                return False
            gained = value - (yield from self._run(place))
            failures = 0 if gained > _POOR * (value - promised) else failures + 1

    def from_own(self, own: Array, value: float, left_behind: float) -> Part[tuple[Array, float]]:
        """Run hops from a start's best place as long as they promise more; return where they end.

        Not where they promise less than a part of what the start is above the best run.
        """
        failures = 0
        while failures < _FAILURES_OF_START:
            promised, place = self._lowest(own, (own,))
            gain = value - promised
            above = value - self._ledger.best.value
            if gain <= max(_LEAST_OF_START * value, left_behind * above, self._ledger.negligible):
                break
            found = yield from self._run(place)
            failures = 0 if value - found > _POOR * gain else failures + 1
            if found < value:
                own, value = place, found
        return own, value

    def _origins(self, count: int) -> list[Array]:
        """Return where hops begin: at the best run, and every second at another good one."""
        good = np.argsort(self._runs.values, kind="stable")[:_GOOD_RUNS]
        others = [self._runs.points[i] for i in self._random.choice(good, count // 2)]
        return [self._ledger.best_unit] * (count - len(others)) + others

    def _lowest(self, centre: Array, origins: Iterable[Array]) -> tuple[float, Array]:
        """Return the least that hops find, and where; infinity where all of that is known."""
        number = self._runs.number(centre)
        assert number is not None
        surface = self._runs.sensed(number)
        minimum = LeashMinimum(
            self._ledger.objective, self._runs.responses, self._random, self._ledger.show_activity
        )
        least, lowest = np.inf, centre
        for origin in origins:
            place = minimum.valley(surface, origin, self._ledger.best_unit)
            is_new = np.abs(self._runs.points - place).max(axis=1).min() > _SAME
            promised = minimum.value(surface, place)
            if is_new and promised < least:
                least, lowest = promised, place
        return least, lowest

    def _run(self, place: Array) -> Part[float]:
        """Run a place; return its value, infinity where the simulation fails."""
        (run,) = yield place[np.newaxis]
        number = self._runs.add(place, run)
        return np.inf if number is None else self._runs.values[number]
