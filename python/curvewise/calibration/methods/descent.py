"""One search on surfaces, from one start: `trust_region` says how it goes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish, Ledger
from ..records.evaluation import Evaluation
from ..surfaces.nearby_runs import NearbyRuns, Run, narrowest, runs_near
from ..surfaces.surface_minimum import SurfaceMinimum
from ..surfaces.surfaces import Responses, Surfaces
from .side_by_side import Part
from .starts import End, simplex_around

__all__ = ["Descent", "Rules", "SharedResponses"]

# Of what was promised, a step that gains less than _POOR has failed; from _GOOD on the slopes are
# as good as new.
_POOR, _GOOD = 0.1, 0.7
_SHRINKING = 0.5  # of the region, as a fraction of the step that failed
_SMALLEST_STEP = 0.5  # of the differences, as a fraction of the largest
# Before it ends, a search looks for other minima of the surfaces, which costs no runs, and tries so
# many of those that it finds.
_ATTEMPTS = 3
_AFTER_RENEWAL = 0.15  # fresh slopes deserve trust again
# Steps without a new run after which a search ends: slopes of noise lead round in a circle.
_MOST_IDLE = 30
# Earlier runs give the slopes at a point if none is further away than this, as a fraction of the
# bounds' range, and if their spread in every direction is at least this fraction of their reach.
_NEAR, _FLATTEST = 0.25, 0.03


@dataclass(frozen=True)
class Rules:
    """How a search goes on; as the options of `TrustRegion` of the same names."""

    first_radius: float
    diff_step: float
    tol: float
    gain: float
    maxiter: int
    always_fresh: bool


class SharedResponses:
    """What turns curves into vectors, by the first run of all searches that has any."""

    def __init__(self) -> None:
        self.first: Responses | None = None

    def vector(self, run: Evaluation) -> Array:
        """Return the coordinates of the curves of a run."""
        assert run.simulations is not None
        if self.first is None:
            self.first = Responses(run.simulations)
        return self.first.vector(run.simulations)


class Descent:
    """The best run, the surfaces around it, and what they have not seen yet."""

    def __init__(
        self,
        ledger: Ledger,
        random: np.random.Generator,
        rules: Rules,
        responses: SharedResponses,
    ) -> None:
        self._ledger, self._random, self._rules = ledger, random, rules
        self._responses = responses
        self._seen: set[int] = set()  # the numbers of the runs
        self.is_fresh = False
        self.value = np.inf

    def course(self, start: Array, runs: Sequence[Run] = ()) -> Part[End | None]:
        """Go down from a start; return how it ended, or None where simulations fail around it.

        Parameters
        ----------
        start : ndarray, shape (k,)
        runs : sequence of (ndarray, Evaluation)
            Which may give the first slopes, in the place of new ones.
        """
        if not (yield from self.begin(start, runs)):
            return None
        first = self.value
        finish = yield from self.descend()
        return End(first, self.value, self.centre, finish)

    def descend(self) -> Part[Finish]:
        """Go down from where the search is."""
        rules = self._rules
        radius = rules.first_radius
        known, idle = 0, 0
        for _ in range(rules.maxiter):
            idle = idle + 1 if len(self._seen) == known else 0
            if idle == _MOST_IDLE:
                return Finish(False, f"{idle} steps in a row led only to runs that were known")
            known = len(self._seen)
            candidate, promised = self.lowest(radius)
            least = max(self._ledger.negligible, rules.gain * self.value)
            if promised <= least or radius < rules.tol:
                if self.is_fresh:
                    if (yield from self.leaves_valley(rules.first_radius, least)):
                        continue
                    return Finish(True, _ending(radius, least, rules.tol))
                yield from self.renew(radius)
                radius = max(radius, _AFTER_RENEWAL)
                continue
            length = float(np.abs(candidate - self.centre).max())
            was_fresh = self.is_fresh
            ratio = (yield from self.step(candidate)) / promised
            if ratio >= _GOOD:
                radius = min(1.0, max(radius, 2.0 * length))
            elif ratio < _POOR and was_fresh:
                radius = _SHRINKING * length
            if rules.always_fresh or (ratio < _GOOD and not was_fresh):
                yield from self.renew(radius)
        return Finish(False, f"maxiter = {rules.maxiter} steps")

    @property
    def centre(self) -> Array:
        """The best run so far."""
        return self._surfaces.centre

    def begin(self, start: Array, runs: Sequence[Run]) -> Part[bool]:
        """Run a simplex around the start, around the best of its runs if the start fails.

        Return whether any run has succeeded.
        """
        radius = self._rules.first_radius
        near = _determining(start, runs)
        if near is not None or self._ledger.has_slopes:
            (first,) = yield from self._run(start[np.newaxis])
            if not first.failed:
                self._take(start, first)
                if self._takes_exact_slopes():
                    return True
                if near is not None:
                    assert self._responses.first is not None
                    slopes = near.slopes(self._responses.first, self._rules.diff_step)
                    self._surfaces.slopes = slopes
                    return True
        for _ in range(5):
            points = simplex_around(start, radius / 2.0, self._random)
            first, *others = yield from self._run(np.vstack((start, points)))
            if not first.failed:
                self._take(start, first)
                yield from self._fit_simplex(points, others, radius / 2.0)
                return True
            good = [i for i, other in enumerate(others) if not other.failed]
            if not good:
                break
            start = points[min(good, key=lambda i: others[i].value)]
        return False

    def renew(self, radius: float) -> Part[None]:
        """Measure the slopes afresh, over a step no larger than the region, down to a limit."""
        if self._takes_exact_slopes():
            return
        largest = self._rules.diff_step
        step = max(min(largest, radius), _SMALLEST_STEP * largest)
        points = simplex_around(self.centre, step, self._random)
        runs = yield from self._run(points)
        yield from self._fit_simplex(points, runs, step)
        best = min(range(len(runs)), key=lambda i: runs[i].value)
        if not runs[best].failed and runs[best].value < self.value:
            self._recentre(points[best], runs[best])
        self.is_fresh = True

    def _takes_exact_slopes(self) -> bool:
        """Take the slopes that the model knows at the best run, if it does: they cost no run."""
        assert self._responses.first is not None
        slopes = self._responses.first.slopes(self._ledger.slopes(self.centre))
        if slopes is None:
            return False
        self._surfaces.slopes = slopes
        self.is_fresh = True
        return True

    def leaves_valley(self, radius: float, least: float) -> Part[bool]:
        """Try other minima of the surfaces, which promise a gain; return whether one is better.

        The surfaces learn from each that is not, so that the next is another one.
        """
        for _ in range(_ATTEMPTS):
            candidate = self._minimum.elsewhere(self._surfaces, self._region(radius))
            promised = self._promised(candidate)
            if promised <= least:
                return False
            if (yield from self.step(candidate, learns=True)) > 0:
                return True
        return False

    def lowest(self, radius: float) -> tuple[Array, float]:
        """Return where the surfaces are lowest within the region, and the gain they promise."""
        best = self._minimum.lowest(
            self._surfaces, self.centre, self._region(radius), thoroughly=self.is_fresh
        )
        return best, self._promised(best)

    @cached_property
    def _minimum(self) -> SurfaceMinimum:
        assert self._responses.first is not None
        return SurfaceMinimum(
            self._ledger.objective,
            self._responses.first,
            self._random,
            self._ledger.show_activity,
            self._rules.gain,
        )

    def _region(self, radius: float) -> tuple[Array, Array]:
        return np.clip(self.centre - radius, 0.0, 1.0), np.clip(self.centre + radius, 0.0, 1.0)

    def _promised(self, point: Array) -> float:
        return self.value - self._minimum.value(self._surfaces, point)

    def step(self, candidate: Array, *, learns: bool = False) -> Part[float]:
        """Run a candidate, learn from it, move there if it is better; return the gain.

        Slopes that the model knows have nothing to learn, unless they are asked to.
        """
        (run,) = yield from self._run(candidate[np.newaxis])
        is_exact = self._ledger.has_slopes and self.is_fresh and not learns
        self.is_fresh = is_exact
        if run.failed:
            return -np.inf
        gained = self.value - run.value
        if gained > 0 or not is_exact:
            self._surfaces.learn(candidate, self._responses.vector(run), recentre=gained > 0)
        if gained > 0:
            self.value = run.value
            self.is_fresh = self._takes_exact_slopes()
        return gained

    def _take(self, point: Array, run: Evaluation) -> None:
        """Make a run the centre of surfaces that are level."""
        base = self._responses.vector(run)
        self._surfaces = Surfaces(point, base, np.zeros((base.size, point.size)))
        self.value = run.value

    def _recentre(self, point: Array, run: Evaluation) -> None:
        slopes = self._surfaces.slopes
        self._take(point, run)
        self._surfaces.slopes = slopes

    def _fit_simplex(self, points: Array, runs: Sequence[Evaluation], step: float) -> Part[None]:
        """Set the slopes by differences; on the other side, and nearer, where runs fail."""
        for i, (point, first) in enumerate(zip(points, runs, strict=True)):
            run, place = first, point
            for factor in (-1.0, 0.25, -0.25):
                if not run.failed:
                    break
                place = self.centre.copy()
                place[i] += factor * (point[i] - self.centre[i])
                if 0.0 <= place[i] <= 1.0:
                    (run,) = yield from self._run(place[np.newaxis])
            if not run.failed:
                difference = self._responses.vector(run) - self._surfaces.base
                self._surfaces.slopes[:, i] = difference / (place[i] - self.centre[i])

    def _run(self, points: Array) -> Part[list[Evaluation]]:
        runs = yield points
        self._seen.update(run.number for run in runs)
        return runs


def _ending(radius: float, least: float, tol: float) -> str:
    """Say why a search ended where fresh slopes promise too little, or the region is too small."""
    if radius < tol:
        return f"the region is below {tol:g} of the bounds' range"
    within = "" if radius >= 1.0 else f" within {100.0 * radius:.3g} % of the bounds' range"
    return f"fresh slopes promise to gain less than {least:.2g}{within}"


def _determining(unit: Array, runs: Sequence[Run]) -> NearbyRuns | None:
    """Return runs around a point that determine the slopes there, if they do.

    The 2 k + 1 nearest, if they are near and not all in a plane.
    """
    near = runs_near(unit, runs, within=_NEAR, most=2 * unit.size + 1)
    if near is None:
        return None
    offsets = (near.points - near.points.mean(axis=0)) / near.distances.max()
    return near if narrowest(offsets) >= _FLATTEST * np.sqrt(len(offsets)) else None
