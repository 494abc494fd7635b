"""A search for expensive models: the measure is minimised on surfaces of the curves, run by run.

Linear surfaces of the simulated curves (`surfaces`) come from a simplex of k + 1 runs. The
parameters at which the curves that they predict are nearest to the tests, within a region of
trust around the best run, are run next, and the surfaces learn from every run (Broyden's update).
Where a step gains clearly less than they promised, k runs nearby measure the slopes afresh; where
fresh slopes have promised it too, the region shrinks. The search ends when fresh slopes promise
nothing more, nearby or in another minimum that the measure has on these surfaces. With
slopes="fresh" they are measured before every step: for a sum of squares that is Gauss and Newton's
method, and here the exact measure, whichever it is, stands in the place of the squares.

A region that shrank around slopes grown stale was the way this search used to fail: on seven
parameters with noise it halted high up in a valley from 3 of 10 starts that nothing was tuned on,
and from none where slopes are renewed first and other minima of the surfaces are looked at before
the end (benchmarks/validation/README.md). Differences are taken over hundredths of the bounds'
range, not 1e-6 of it: a solver prints seven digits. Cost: k + 1 runs to begin with, k for every
renewal, one for every step; 10 to 130 in what we have run. Local: another `start`, or another seed,
is another chance.

C. G. Broyden, "A class of methods for solving nonlinear simultaneous equations", Math. Comp. 19
(1965) 577-593; A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple, get_args

import numpy as np

from ...curves.inputs import Array
from ..problem.evaluations import Evaluations, Finish
from ..records.evaluation import Evaluation
from ..surfaces.surface_minimum import SurfaceMinimum
from ..surfaces.surfaces import Responses, Surfaces, regression

__all__ = ["trust_region"]

# Of what was promised, a step that gains less than _POOR has failed; from _GOOD on the slopes are
# as good as new.
_POOR, _GOOD = 0.1, 0.7
_SHRINKING = 0.5  # of the region, as a fraction of the step that failed
_SMALLEST_STEP = 0.5  # of the differences, as a fraction of the largest
_PERFECT = 1e3  # values below this multiple of what is negligible are alike: perfect fits
_DRAWN = (0.1, 0.9)  # where starts are drawn, between the bounds
# Before it ends, a search looks for other minima of the surfaces, which costs no runs, and tries so
# many of those that it finds.
_ATTEMPTS = 3
_AFTER_RENEWAL = 0.15  # fresh slopes deserve trust again


Slopes = Literal["broyden", "fresh"]


class _Rules(NamedTuple):
    """Options of a descent, as `trust_region` has them."""

    initial_range: float
    diff_step: float
    tol: float
    gain: float
    maxiter: int
    slopes: Slopes


def trust_region(
    evaluations: Evaluations,
    start: Array | None,
    seed: int,
    *,
    starts: int = 3,
    initial_range: float = 0.5,
    diff_step: float = 0.02,
    tol: float = 1e-3,
    gain: float = 1e-3,
    maxiter: int = 200,
    slopes: Slopes = "broyden",
) -> Finish:
    """Minimise on surfaces of the curves in a region of trust.

    Parameters
    ----------
    evaluations : Evaluations
        The objective.
    start : ndarray or None
        Where to begin; the middle of the bounds if not given, and then elsewhere.
    seed : int
        Of the other starts, and of the search on the surfaces.
    starts : int
        How many searches to make where no start is given.
    initial_range : float
        Half the size of the first region of trust, as a fraction of the bounds' range; the first
        differences are over half of that.
    diff_step : float
        The largest difference over which slopes are renewed, as a fraction of the bounds' range.
    tol : float
        The search ends where the region is smaller than this.
    gain : float
        And where fresh slopes promise to gain no more than this fraction of the value.
    maxiter : int
        The most steps, of each start.
    slopes : {"broyden", "fresh"}
        "broyden": of the runs that are made anyway, and measured only where these mislead.
        "fresh": measured before every step, by k runs, which can be made at the same time.
    """
    if slopes not in get_args(Slopes):
        raise ValueError(f"slopes is {slopes!r}; choose from {', '.join(get_args(Slopes))}")
    for name, fraction in (("initial_range", initial_range), ("diff_step", diff_step)):
        if not 0.0 < fraction <= 1.0:
            raise ValueError(f"{name} is {fraction}; give a fraction of the bounds, such as 0.02")
    rules = _Rules(initial_range, diff_step, tol, gain, maxiter, slopes)
    random = np.random.default_rng(seed)
    places = _places(evaluations.dimensions, start, starts, random)
    ends: list[tuple[float, Finish]] = []
    failure: RuntimeError | None = None
    responses: Responses | None = None
    for place in places:
        search = _Search(evaluations, random, rules, responses)
        try:
            search.begin(place, initial_range)
        except RuntimeError as error:
            failure = failure or error
            continue
        finish = _descend(search, evaluations, rules)
        ends.append((search.value, finish))
        responses = search.responses
    if not ends:
        assert failure is not None
        raise failure
    best, finish = min(ends, key=lambda end: end[0])
    if len(places) == 1:
        return finish
    alike = sum(value <= 1.01 * best + _PERFECT * evaluations.negligible for value, _ in ends)
    return Finish(
        finish.converged,
        f"{alike} of {len(places)} starts within 1 % of the best; {finish.message}",
    )


def _places(k: int, start: Array | None, count: int, random: np.random.Generator) -> list[Array]:
    """Return where to start: where it is said, or in the middle of the bounds and elsewhere."""
    if count < 1:
        raise ValueError(f"starts is {count}; give at least 1")
    if start is not None:
        return [np.asarray(start)]
    return [np.full(k, 0.5), *(random.uniform(*_DRAWN, k) for _ in range(count - 1))]


def _descend(search: _Search, evaluations: Evaluations, rules: _Rules) -> Finish:
    """Go down from one start."""
    radius = rules.initial_range
    for _ in range(rules.maxiter):
        candidate, promised = search.lowest(radius)
        least = max(evaluations.negligible, rules.gain * search.value)
        if promised <= least or radius < rules.tol:
            if search.is_fresh:
                if search.leaves_valley(rules.initial_range, least):
                    continue
                return Finish(True, _ending(radius, least, rules.tol))
            search.renew(radius)
            radius = max(radius, _AFTER_RENEWAL)
            continue
        length = float(np.abs(candidate - search.centre).max())
        was_fresh = search.is_fresh
        ratio = search.step(candidate) / promised
        if ratio >= _GOOD:
            radius = min(1.0, max(radius, 2.0 * length))
        elif ratio < _POOR and was_fresh:
            radius = _SHRINKING * length
        if rules.slopes == "fresh" or (ratio < _GOOD and not was_fresh):
            search.renew(radius)
    return Finish(False, f"maxiter = {rules.maxiter} steps")


def _ending(radius: float, least: float, tol: float) -> str:
    """Say why a search ended where fresh slopes promise too little, or the region is too small."""
    if radius < tol:
        return f"the region is below {tol:g} of the bounds' range"
    within = "" if radius >= 1.0 else f" within {100.0 * radius:.3g} % of the bounds' range"
    return f"fresh slopes promise to gain less than {least:.2g}{within}"


class _Search:
    """The best run, the surfaces around it, and what they have not seen yet."""

    def __init__(
        self,
        evaluations: Evaluations,
        random: np.random.Generator,
        rules: _Rules,
        responses: Responses | None,
    ) -> None:
        self._evaluations, self._random = evaluations, random
        self._diff_step, self._gain = rules.diff_step, rules.gain
        self.responses = responses
        self._minimum: SurfaceMinimum | None = None
        self.is_fresh = False
        self.value = np.inf

    @property
    def centre(self) -> Array:
        """The best run so far."""
        return self._surfaces.centre

    def begin(self, start: Array, radius: float) -> None:
        """Run a simplex around the start, around the best of its runs if the start fails."""
        known = self._evaluations.known_near(start)
        if known is not None:
            (first,) = self._run(start[np.newaxis])
            if not first.failed:
                self._take(start, first)
                points, runs = known
                self._surfaces.slopes = self._fitted(points, runs, start)
                return
        for _ in range(5):
            points = _simplex(start, radius / 2.0, self._random)
            first, *others = self._run(np.vstack((start, points)))
            if not first.failed:
                self._take(start, first)
                self._fit_simplex(points, others, radius / 2.0)
                return
            good = [i for i, other in enumerate(others) if not other.failed]
            if not good:
                break
            start = points[min(good, key=lambda i: others[i].value)]
        raise RuntimeError(
            "simulations fail all around the start; give identify another start=, or closer bounds"
        )

    def renew(self, radius: float) -> None:
        """Measure the slopes afresh, over a step no larger than the region, down to a limit."""
        step = max(min(self._diff_step, radius), _SMALLEST_STEP * self._diff_step)
        points = _simplex(self.centre, step, self._random)
        runs = self._run(points)
        self._fit_simplex(points, runs, step)
        best = min(range(len(runs)), key=lambda i: runs[i].value)
        if not runs[best].failed and runs[best].value < self.value:
            self._recentre(points[best], runs[best])
        self.is_fresh = True

    def leaves_valley(self, radius: float, least: float) -> bool:
        """Try other minima of the surfaces, which promise a gain; return whether one is better.

        The surfaces learn from each that is not, so that the next is another one.
        """
        for _ in range(_ATTEMPTS):
            candidate = self._minimum_on_surfaces().elsewhere(self._surfaces, self._region(radius))
            promised = self._promised(candidate)
            if promised <= least:
                return False
            if self.step(candidate) > 0:
                return True
        return False

    def lowest(self, radius: float) -> tuple[Array, float]:
        """Return where the surfaces are lowest within the region, and the gain they promise."""
        best = self._minimum_on_surfaces().lowest(
            self._surfaces, self.centre, self._region(radius), thoroughly=self.is_fresh
        )
        return best, self._promised(best)

    def _minimum_on_surfaces(self) -> SurfaceMinimum:
        assert self.responses is not None
        if self._minimum is None:
            self._minimum = SurfaceMinimum(
                self._evaluations.objective,
                self.responses,
                self._random,
                self._evaluations.negligible,
                self._evaluations.thinking,
                self._gain,
            )
        return self._minimum

    def _region(self, radius: float) -> tuple[Array, Array]:
        return np.clip(self.centre - radius, 0.0, 1.0), np.clip(self.centre + radius, 0.0, 1.0)

    def _promised(self, point: Array) -> float:
        return self.value - self._minimum_on_surfaces().value(self._surfaces, point)

    def step(self, candidate: Array) -> float:
        """Run a candidate, learn from it, move there if it is better; return the gain."""
        (run,) = self._run(candidate[np.newaxis])
        self.is_fresh = False
        if run.failed:
            return -np.inf
        gained = self.value - run.value
        self._surfaces.learn(candidate, self._vector(run), recentre=gained > 0)
        if gained > 0:
            self.value = run.value
        return gained

    def _take(self, point: Array, run: Evaluation) -> None:
        """Make a run the centre of surfaces that are level."""
        base = self._vector(run)
        self._surfaces = Surfaces(point, base, np.zeros((base.size, point.size)))
        self.value = run.value

    def _recentre(self, point: Array, run: Evaluation) -> None:
        slopes = self._surfaces.slopes
        self._take(point, run)
        self._surfaces.slopes = slopes

    def _fit_simplex(self, points: Array, runs: Sequence[Evaluation], step: float) -> None:
        """Set the slopes by differences; on the other side, and nearer, where runs fail."""
        for i, (point, first) in enumerate(zip(points, runs, strict=True)):
            run, place = first, point
            for factor in (-1.0, 0.25, -0.25):
                if not run.failed:
                    break
                place = self.centre.copy()
                place[i] += factor * (point[i] - self.centre[i])
                if 0.0 <= place[i] <= 1.0:
                    (run,) = self._run(place[np.newaxis])
            if not run.failed:
                difference = self._vector(run) - self._surfaces.base
                self._surfaces.slopes[:, i] = difference / (place[i] - self.centre[i])

    def _fitted(self, points: Array, runs: Sequence[Evaluation], centre: Array) -> Array:
        responses = np.array([self._vector(run) for run in runs])
        distances = np.abs(points - centre).max(axis=1)
        weights = 1.0 / (distances + self._diff_step) ** 2
        return regression(points, responses, centre, weights)

    def _run(self, points: Array) -> list[Evaluation]:
        return self._evaluations.evaluated(points, keep_simulations=True)

    def _vector(self, run: Evaluation) -> Array:
        assert run.simulations is not None
        if self.responses is None:
            self.responses = Responses(run.simulations)
        return self.responses.vector(run.simulations)


def _simplex(centre: Array, step: float, random: np.random.Generator) -> Array:
    """Return a point beside the centre for every axis, inwards where a bound is near."""
    signs = random.choice((-1.0, 1.0), centre.size)
    signs = np.where(centre + signs * step > 1.0, -1.0, signs)
    signs = np.where(centre + signs * step < 0.0, 1.0, signs)
    points: Array = np.clip(centre + np.diag(signs * step), 0.0, 1.0)
    return points
