"""Several starts of one search, until enough independent ones agree.

Starts run one after the other with one worker, and three in parallel with several. The first start
is the middle of the bounds. The others are Latin hypercube samples of four points. After the first
starts, every second one begins where the surrogate through the best runs is lowest
(`global_stage`). It takes few runs, but depends on the others, so its agreement does not count.
If starts take so many runs that too few of them fit into `_RUNS`, later ones use all runs. The
limit of the search does not decide, so that a search can be continued with a larger one.

M. D. McKay, R. J. Beckman, W. J. Conover, "A comparison of three methods for selecting values of
input variables in the analysis of output from a computer code", Technometrics 21 (1979) 239-245.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish, Ledger
from ..records.evaluation import Evaluation
from .descent import Descent, Part, Rules
from .global_stage import GlobalStage
from .runs import Runs
from .starts import End, finish_of, is_enough, is_flat

__all__ = ["Multistart", "places", "side_by_side"]

R = TypeVar("R")

_QUARTERS, _MARGIN = 4, 0.1  # of the bounds' range, in which no start is drawn
_RUNS = 300  # in which starts that do not share runs should agree


def places(k: int, random: np.random.Generator) -> Iterator[Array]:
    """Yield where to start, one after the other: the middle, then evenly over the box."""
    yield np.full(k, 0.5)
    while True:
        quarters = random.permuted(np.tile(np.arange(_QUARTERS), (k, 1)), axis=1).T
        yield from (
            _MARGIN + (1.0 - 2.0 * _MARGIN) * (quarters + random.random((_QUARTERS, k))) / _QUARTERS
        )


class Multistart:
    """Begins starts, until `starts` agree or there are `most`; `at_once` run in parallel."""

    def __init__(
        self,
        ledger: Ledger,
        runs: Runs,
        rules: Rules,
        *,
        seed: int,
        starts: int,
        most: int,
        at_once: int,
    ) -> None:
        self._ledger, self._runs, self._rules, self._seed = ledger, runs, rules, seed
        self._starts, self._most, self._at_once = starts, most, at_once
        random = np.random.default_rng(seed)
        self._places = places(ledger.dimensions, random)
        self._stage = GlobalStage(runs, random)
        self._begun = self._running = 0
        self._is_shared = False
        self._ends: list[End] = []

    def course(self, start: Array | None) -> Part[Finish]:
        """Search from a given start alone, or from several; return the joint ending."""
        if start is not None:
            first = [self._descent(start, replace(self._rules, is_abandoned=False))]
        else:
            first = [self._next() for _ in range(min(self._at_once, self._starts))]
        is_alone = start is not None or self._starts == 1
        yield from side_by_side(first, list if is_alone else self._more, self._ledger.expect)
        if not self._ends:
            raise RuntimeError(
                "simulations fail all around the start; give identify another start=, or closer "
                "bounds"
            )
        starts = self._starts if start is None else 1
        return finish_of(self._ends, self._runs.inner.negligible, starts)

    def _more(self) -> list[Part[None]]:
        """Return the starts to begin after some have ended."""
        negligible = self._runs.inner.negligible
        enough = bool(self._ends) and is_enough(self._ends, negligible, self._starts)
        if enough and not is_flat(self._ends, negligible):
            return []
        count = min(self._at_once - self._running, self._most - self._begun)
        return [self._next() for _ in range(count)]

    def _next(self) -> Part[None]:
        """Begin the next start: every second of the later ones where the surrogate promises."""
        rules = self._rules
        if self._begun:
            rules = replace(rules, first_radius=min(1.0 / _QUARTERS, rules.first_radius))
        if self._begun >= self._starts and (self._begun - self._starts) % 2 and self._runs.values:
            found = self._stage.lowest(self._runs.best)
            if found is not None:
                return self._descent(found[0], rules, is_independent=False)
        return self._descent(next(self._places), rules)

    def _descent(self, place: Array, rules: Rules, *, is_independent: bool = True) -> Part[None]:
        random = np.random.default_rng((self._seed, self._begun))
        self._begun += 1
        self._running += 1
        descent = Descent(
            random, rules, self._runs, is_independent=is_independent, is_shared=self._is_shared
        )
        return self._ended(descent, place)

    def _ended(self, descent: Descent, place: Array) -> Part[None]:
        end = yield from descent.course(place)
        self._running -= 1
        if end is not None:
            self._ends.append(end)
            needed = 2 * self._starts * descent.made  # every second start is independent
            self._is_shared |= needed > _RUNS


def side_by_side(
    first: Sequence[Part[R]],
    more: Callable[[], Sequence[Part[R]]],
    expect: Callable[[Array], object],
) -> Part[list[R]]:
    """Drive courses in turns, each to its end; return their results in order.

    After a round in which a course has ended, `more` returns the courses to begin. The points that
    a course requests are announced to `expect` at once, to run during the turns of others. The
    result depends on the order of turns alone, not on the number of parallel runs. All first points
    are one batch, because a search ends if all of its first batch fails.
    """
    courses: list[Part[R]] = []
    ended: dict[int, R] = {}
    asked: dict[int, Array] = {}

    def go_on(i: int, answer: list[Evaluation] | None) -> None:
        try:
            asked[i] = next(courses[i]) if answer is None else courses[i].send(answer)
        except StopIteration as end:
            asked.pop(i, None)
            ended[i] = end.value
        else:
            expect(asked[i])

    def begin(new: Sequence[Part[R]]) -> None:
        while new:
            before = len(ended)
            courses.extend(new)
            for i in range(len(courses) - len(new), len(courses)):
                go_on(i, None)
            new = more() if len(ended) > before else ()

    begin(first)
    if asked:
        yield np.vstack(list(asked.values()))
    while asked:
        before = len(ended)
        for i, units in list(asked.items()):
            go_on(i, (yield units))
        if len(ended) > before:
            begin(more())
    return [ended[i] for i in range(len(courses))]
