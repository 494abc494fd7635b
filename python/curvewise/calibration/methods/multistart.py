"""Several starts of one search, until enough independent ones agree.

Starts run one after the other with one worker, and three in parallel with several. The first starts
are the middle of the bounds and points spread evenly over them. Afterwards every second start
begins where the surrogate through the best runs is lowest (`global_stage`). Such a start takes few
runs, but it depends on the other starts, so it does not count as agreeing with them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish, Ledger
from .descent import Descent, Rules
from .global_stage import GlobalStage
from .runs import Runs
from .side_by_side import Part, side_by_side
from .starts import End, finish_of, is_enough, is_flat, places

__all__ = ["searched"]

_SMALLER = 0.25  # largest first radius of a start next to the best run


def searched(
    ledger: Ledger,
    runs: Runs,
    rules: Rules,
    *,
    start: Array | None,
    seed: int,
    starts: int,
    most_starts: int,
    at_once: int,
) -> Part[Finish]:
    """Search from one start or from several; return the joint ending.

    Parameters
    ----------
    ledger, runs, rules
        The data of the search.
    start : ndarray, shape (k,), or None
        The only one, where it is given.
    seed : int
        Seed of all random numbers.
    starts, most_starts : int
        The number of starts that must agree, and the maximum number. After a single start, the
        search ends.
    at_once : int
        Number of starts that run in parallel.

    Raises
    ------
    RuntimeError
        If all simulations around the starts fail.
    """
    multistart = _Multistart(ledger, runs, rules, seed, (starts, most_starts, at_once))
    first = multistart.first(start)
    more: Callable[[], Sequence[Part[None]]] = multistart.more
    if start is not None or starts == 1:
        more = list
    yield from side_by_side(first, more, ledger.expect)
    if not multistart.ends:
        raise RuntimeError(
            "simulations fail all around the start; give identify another start=, or closer bounds"
        )
    return finish_of(multistart.ends, runs.inner.negligible, starts if start is None else 1)


class _Multistart:
    """Begins starts, and more of them where too few agree."""

    def __init__(
        self, ledger: Ledger, runs: Runs, rules: Rules, seed: int, counts: tuple[int, int, int]
    ) -> None:
        self._ledger, self._runs, self._rules, self._seed = ledger, runs, rules, seed
        self._starts, self._most, self._at_once = counts
        random = np.random.default_rng(seed)
        self._places = places(ledger.dimensions, random)
        self._stage = GlobalStage(runs, random)
        self._begun = self._running = 0
        self.ends: list[End] = []

    def first(self, start: Array | None) -> list[Part[None]]:
        """Return the starts with which a search begins."""
        if start is not None:
            return [self._descent(start, replace(self._rules, is_abandoned=False))]
        return [self._next() for _ in range(min(self._at_once, self._starts))]

    def more(self) -> list[Part[None]]:
        """Return those to begin after some have ended."""
        negligible = self._runs.inner.negligible
        enough = bool(self.ends) and is_enough(self.ends, negligible, self._starts)
        if enough and not is_flat(self.ends, negligible):
            return []
        count = min(self._at_once - self._running, self._most - self._begun)
        return [self._next() for _ in range(count)]

    def _next(self) -> Part[None]:
        """Begin the next start: every second of the later ones where the surrogate promises."""
        if self._begun >= self._starts and (self._begun - self._starts) % 2 and self._runs.values:
            found = self._stage.wide()
            if found is not None:
                rules = replace(self._rules, first_radius=min(_SMALLER, self._rules.first_radius))
                return self._descent(found[0], rules, is_independent=False)
        rules = self._rules
        if self._begun:
            rules = replace(rules, first_radius=min(_SMALLER, rules.first_radius))
        return self._descent(next(self._places), rules)

    def _descent(self, place: Array, rules: Rules, *, is_independent: bool = True) -> Part[None]:
        random = np.random.default_rng((self._seed, self._begun))
        self._begun += 1
        self._running += 1
        descent = Descent(random, rules, self._runs, is_independent=is_independent)
        return self._ended(descent.course(place))

    def _ended(self, course: Part[End | None]) -> Part[None]:
        end = yield from course
        self._running -= 1
        if end is not None:
            self.ends.append(end)
