"""One search for the smallest measure, from one start: `trust_region` says how it goes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from ...curves.inputs import Array
from ...curves.scaling import box
from ..objective.sampling import is_leash
from ..problem.ledger import Finish, Ledger
from ..records.evaluation import Evaluation
from ..surfaces.leash_minimum import minimum_on_surfaces
from ..surfaces.sensed_surface import SensedSurface
from ..surfaces.surface_minimum import SurfaceMinimum
from ..surfaces.surfaces import Responses, Surface, Surfaces
from .descent import AFTER_FAILURE, FAR, Descent, Rules
from .shared_runs import NEAREST, SharedRuns
from .side_by_side import Part
from .starts import End

__all__ = ["CurveDescent", "CurveRuns", "promising_place"]

# By frechet the region shrinks less after a step that has failed. The largest of many distances is
# off as far as the worst of them is, which the surface learns from the run, and of the many valleys
# beside each other a small region has one alone.
_AFTER_FAILURE_OF_LEASH = 0.8
# Before it ends, a search looks for other minima of the surface, which costs no runs, and tries so
# many of those that it finds, over this much of the bounds' range to each side.
_ATTEMPTS, _ELSEWHERE = 3, 0.5
# And so many small valleys beside the best run before, on a surface through so many runs, which
# bends as the valleys' floor does.
_SMALL_VALLEYS, _RUNS_OF_VALLEYS = 6, 100
# And its surfaces go through so many of the nearest runs, in the place of some thirty: in what they
# are off by is another valley. Beside its linear programs that costs little.
_RUNS_OF_LEASH = 100
# Where there are so many runs, surfaces by frechet go by what the curves feel, through the best.
_FEWEST_SENSED, _MOST_SENSED = 30, 160
# Of the runs, and of the places from which it goes down, in the search for another start.
_MOST_RUNS, _PLACES = 500, 10


class CurveRuns(SharedRuns):
    """Runs with the coordinates of their curves."""

    def __init__(self, ledger: Ledger) -> None:
        self._responses: Responses | None = None
        self._is_leash = is_leash(ledger.objective)
        self._most = _RUNS_OF_LEASH if self._is_leash else NEAREST
        super().__init__(ledger)

    @property
    def negligible(self) -> float:
        """Differences of the measure below this do not count."""
        return self._ledger.negligible

    @property
    def responses(self) -> Responses:
        """What turns curves into vectors, by the first run that has any."""
        assert self._responses is not None
        return self._responses

    def _taken(self, run: Evaluation) -> tuple[Array, float]:
        assert run.simulations is not None
        if self._responses is None:
            self._responses = Responses(run.simulations)
        return self._responses.vector(run.simulations), run.value

    def _known_slopes(self, number: int, by_curve: list[Array]) -> Array | None:
        return self.responses.slopes(by_curve)

    def surface(self, number: int, within: float) -> Surface:
        """Return the surface through the runs nearest to one, or the plane of its slopes."""
        centre, slopes = self.points[number], self.slopes(number)
        if slopes is None:
            if self._is_leash and len(self.values) >= _FEWEST_SENSED:
                return self.sensed(number)
            return self.through_nearest(centre, within, reduced=False, most=self._most)
        return Surfaces(centre, self._vectors[number], slopes)

    def sensed(self, number: int) -> SensedSurface:
        """Return the surface through the best runs, and through one of them exactly."""
        chosen = np.argsort(self.values, kind="stable")[:_MOST_SENSED]
        if number not in chosen:
            chosen[-1] = number
        vectors = np.array([self._vectors[i] for i in chosen])
        centre = int(np.flatnonzero(chosen == number)[0])
        return SensedSurface(self.points[chosen], vectors, centre, self.sides)

    @cached_property
    def sides(self) -> Array:
        """The sides of the tests' boxes, for every coordinate of a vector."""
        tests, shapes = self._ledger.objective.experiments, self.responses.shapes
        sides = [np.tile(box(test)[1], n) for test, (n, _) in zip(tests, shapes, strict=True)]
        return np.concatenate(sides)


def promising_place(
    ledger: Ledger,
    random: np.random.Generator,
    runs: CurveRuns,
    ends: Sequence[End],
    reach: float,
) -> Array | None:
    """Return where on the surface through all runs the measure is lowest, away from all ends.

    Within a reach of the best run, along each axis. None where it has no minimum there.
    """
    best = ledger.best_unit
    surface = runs.through_nearest(best, np.inf, reduced=False, most=_MOST_RUNS)
    minimum = minimum_on_surfaces(ledger.objective, runs.responses, random, ledger.show_activity)
    box = np.clip(best - reach, 0.0, 1.0), np.clip(best + reach, 0.0, 1.0)
    return minimum.elsewhere(surface, box, places=_PLACES, avoid=[end.place for end in ends])


class CurveDescent(Descent):
    """A search whose inner work is the exact measure of the curves that the surface predicts."""

    looks_at_once = True
    _runs: CurveRuns

    def __init__(
        self, ledger: Ledger, random: np.random.Generator, rules: Rules, runs: CurveRuns
    ) -> None:
        after_failure = _AFTER_FAILURE_OF_LEASH if is_leash(ledger.objective) else AFTER_FAILURE
        super().__init__(random, rules, runs, after_failure)
        self._ledger = ledger

    @cached_property
    def _minimum(self) -> SurfaceMinimum:
        return minimum_on_surfaces(
            self._ledger.objective,
            self._runs.responses,
            self._random,
            self._ledger.show_activity,
            self._rules.gain,
        )

    def from_best(self) -> Part[Finish]:
        """Go down from the best run of all starts; return how that ended."""
        self._best = int(np.argmin(self._runs.values))
        return self._descended()

    def _region(self, radius: float) -> tuple[Array, Array]:
        return np.clip(self.centre - radius, 0.0, 1.0), np.clip(self.centre + radius, 0.0, 1.0)

    def _lowest(self, radius: float) -> tuple[Array, float]:
        assert self._best is not None
        surface = self._runs.surface(self._best, FAR * radius)
        point = self._minimum.lowest(surface, self.centre, self._region(radius))
        return point, self.value - self._minimum.value(surface, point)

    def _leaves_valley(self, least: float) -> Part[bool]:
        """Try other minima of the surface, which promise a gain; return whether one is better.

        The surface learns from each that is not, so that the next is another one. A start that is
        not the best so far is left where it is: another start costs less.
        """
        assert self._best is not None
        objective = self._ledger.objective
        has_small_valleys = objective.has_gradient and not objective.is_least_squares
        if has_small_valleys and (yield from self._leaves_small_valley(least)):
            return True
        for _ in range(_ATTEMPTS):
            if self.value > min(self._runs.values):
                return False
            surface = self._runs.surface(self._best, np.inf)
            candidate = self._minimum.elsewhere(surface, self._region(_ELSEWHERE))
            assert candidate is not None
            if self.value - self._minimum.value(surface, candidate) <= least:
                return False
            before = self.value
            yield from self._run(candidate[np.newaxis])
            if self.value < before:
                return True
        return False

    def _leaves_small_valley(self, least: float) -> Part[bool]:
        """Try those beside the best run, on a surface that bends; return whether one is better."""
        for _ in range(_SMALL_VALLEYS):
            if self.value > min(self._runs.values):
                return False
            surface = self._runs.through_nearest(
                self.centre, np.inf, reduced=False, most=_RUNS_OF_VALLEYS
            )
            _, slopes = surface.with_slopes(self.centre)
            scaled = slopes / self._runs.sides[:, np.newaxis]
            candidate = self._minimum.beside(surface, self.centre, scaled)
            promised = self.value - self._minimum.value(surface, candidate)
            if promised <= least or tuple(candidate) in self._tried:
                return False
            before = self.value
            yield from self._run(candidate[np.newaxis])
            if before - self.value > least:
                return True
        return False

    def _end(self, radius: float, promised: float, least: float) -> Finish:
        if radius < self._rules.tol:
            return Finish(True, f"the region is below {self._rules.tol:g} of the bounds' range")
        within = "" if radius >= 1.0 else f" within {100.0 * radius:.3g} % of the bounds' range"
        return Finish(True, f"the surface promises to gain less than {least:.2g}{within}")
