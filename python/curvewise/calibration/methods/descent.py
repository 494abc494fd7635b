"""One search on surfaces through runs, from one start: what the squares and the measures share.

The surface through the runs near the best one is lowest somewhere in a region of trust around it;
there the model is run next. The region grows and shrinks with what a step gains of what was
promised. Where the surface promises no more, the directions in which it knows least are run; where
it knows them all, the search has ended. Cost: k + 1 runs to begin with for k parameters, one for
every step, and up to k for every look around.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish
from .shared_runs import SharedRuns
from .side_by_side import Part
from .starts import End, simplex_around

__all__ = ["AFTER_FAILURE", "FAR", "Descent", "Rules"]

FAR = 5.0  # how far the runs may be from which a surface is made, in regions of trust
# Of what was promised, a step that gains less than _POOR has failed; from _GOOD on the region
# grows.
_POOR, _FAIR, _GOOD = 0.1, 0.3, 0.7
# Of the length of a step, the region after one that has failed, and after one that was poor.
AFTER_FAILURE, _AFTER_POOR = 0.5, 0.7
_AFTER_LOOK = 5.0  # a surface that has learnt more deserves trust again, so many times as far
_AFTER_LEAVING = 0.15  # and so does one in another valley, so far


@dataclass(frozen=True)
class Rules:
    """How a search goes on; as the options of `TrustRegion` of the same names."""

    first_radius: float
    diff_step: float
    tol: float
    gain: float
    maxiter: int = 500
    always_fresh: bool = False
    left_behind: float = 0.0  # ends where it promises less, of what it is above the best run


class Descent(ABC):
    """The best run of one start, and the region around it in which surfaces are trusted."""

    looks_at_once: ClassVar[bool]  # in all directions, or in one after the other

    def __init__(
        self,
        random: np.random.Generator,
        rules: Rules,
        runs: SharedRuns,
        after_failure: float = AFTER_FAILURE,
    ) -> None:
        self._random, self._rules, self._runs = random, rules, runs
        self._after_failure = after_failure
        self._best: int | None = None
        self._tried: set[tuple[float, ...]] = set()

    @abstractmethod
    def _lowest(self, radius: float) -> tuple[Array, float]:
        """Return where the surface is lowest within the region, and the gain that it promises."""

    @abstractmethod
    def _end(self, radius: float, promised: float, least: float) -> Finish:
        """Return how the search has ended where nothing more is to be done."""

    def _leaves_valley(self, least: float) -> Part[bool]:
        """Try other minima of the surface; return whether one is better."""
        yield from ()
        return False

    @property
    def value(self) -> float:
        """The smallest value so far."""
        return np.inf if self._best is None else self._runs.values[self._best]

    @property
    def centre(self) -> Array:
        """Where it is."""
        assert self._best is not None
        point: Array = self._runs.points[self._best]
        return point

    def course(self, start: Array) -> Part[End | None]:
        """Go down from a start; return how it ended, or None where simulations fail around it."""
        radius = self._rules.first_radius
        simplex = simplex_around(start, radius / 2.0, self._random)
        if self._runs.has_slopes or not self._runs.least_known(start, radius / 2.0):
            yield from self._run(start[np.newaxis])
        if self._best is None:
            yield from self._run(np.vstack((start, simplex)))
        if self._best is None:
            return None
        number = self._runs.number(start)
        before = self.value if number is None else self._runs.values[number]
        finish = yield from self._descended()
        return End(before, self.value, self.centre, finish)

    def _descended(self) -> Part[Finish]:
        rules = self._rules
        radius = rules.first_radius
        for _ in range(rules.maxiter):
            if rules.always_fresh:
                yield from self._looks_around(radius)
            candidate, promised = self._lowest(radius)
            least = max(self._runs.negligible, rules.gain * self.value)
            if rules.left_behind and self._is_behind(promised):
                return Finish(False, "another start is far ahead")
            if promised <= least or radius < rules.tol:
                if (yield from self._looks_around(radius)):
                    radius = max(radius, _AFTER_LOOK * self._reach(radius))
                elif (yield from self._leaves_valley(least)):
                    radius = max(radius, _AFTER_LEAVING)
                else:
                    return self._end(radius, promised, least)
                continue
            length = float(np.abs(candidate - self.centre).max())
            before = self.value
            yield from self._run(candidate[np.newaxis])
            ratio = (before - self._last) / promised
            if ratio >= _GOOD:
                radius = min(1.0, max(radius, 2.0 * length))
            elif ratio < _POOR:
                radius = self._after_failure * length
            elif ratio < _FAIR:
                radius = max(_AFTER_POOR, self._after_failure) * length
        return Finish(False, f"{rules.maxiter} steps")

    def _is_behind(self, promised: float) -> bool:
        """Return whether the best run of all starts is too far ahead for what is promised."""
        above = self.value - min(self._runs.values)
        return self._rules.left_behind * above > max(promised, 0.0)

    def _run(self, points: Array) -> Part[None]:
        """Run points, and move to the best of them if it is better than all before."""
        self._last = np.inf
        self._tried.update(tuple(point) for point in points)
        for point, run in zip(points, (yield points), strict=True):
            number = self._runs.add(point, run)
            if number is not None:
                self._last = self._runs.values[number]
                if self._last < self.value:
                    self._best = number

    def _reach(self, radius: float) -> float:
        """Return how far around the best run the surface has to be known."""
        return float(np.clip(radius, self._rules.tol, self._rules.diff_step))

    def _looks_around(self, radius: float) -> Part[bool]:
        """Run what the surface would learn most from; return whether there was any such point."""
        if self._runs.has_slopes:
            return False
        unknown = list(self._unknown(radius))
        if unknown:
            yield from self._run(np.array(unknown if self.looks_at_once else unknown[:1]))
        return bool(unknown)

    def _unknown(self, radius: float) -> Iterator[Array]:
        """Yield a point for each direction in which the runs around the best one tell too little.

        That in which they are spread least first. Where runs have failed there, on the other side
        or nearer.
        """
        centre, reach = self.centre, self._reach(radius)
        for direction in self._runs.least_known(centre, reach):
            axis = int(np.argmax(np.abs(direction)))
            along = reach / abs(direction[axis]) * direction
            inwards = np.zeros_like(along)  # where a corner of the bounds leaves no room for it
            inwards[axis] = reach if centre[axis] < 0.5 else -reach
            for step in (along, -along, along / 4.0, -along / 4.0, inwards):
                point = centre + step
                is_inside = (point >= 0.0).all() and (point <= 1.0).all()
                if is_inside and tuple(point) not in self._tried:
                    yield point
                    break
