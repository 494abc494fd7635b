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
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from ...curves.inputs import Array
from ..problem.evaluations import Evaluations, Finish
from ..records.evaluation import Evaluation
from ..surfaces.nearby_runs import NearbyRuns, Run, narrowest, runs_near
from ..surfaces.surface_minimum import SurfaceMinimum
from ..surfaces.surfaces import Responses, Surfaces
from .method import Method, with_other_defaults

__all__ = ["TrustRegion"]

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
# Steps without a new run after which a search ends: slopes of noise lead round in a circle.
_MOST_IDLE = 30
# Earlier runs give the slopes at a point if none is further away than this, as a fraction of the
# bounds' range, and if their spread in every direction is at least this fraction of their reach.
_NEAR, _FLATTEST = 0.25, 0.03


Slopes = Literal["broyden", "fresh"]


@dataclass(frozen=True, kw_only=True, repr=False)
class TrustRegion(Method, name="trust-region", keeps_curves=True, needs_squares=False):
    """The measure on linear surfaces of the curves, minimised within a region of trust.

    Local, for expensive models and any measure: 10 to 30 runs a start for 3 parameters, 45 to 95
    for 7. It begins with k + 1 runs for k parameters, and takes one for every step.

    Parameters
    ----------
    starts : int, default 3
        How many searches to make, one after the other, where no start is given: from the middle of
        the bounds, and from places that are drawn.
    initial_range : float, optional
        Half the size of the first region of trust, as a fraction of the bounds' range; the first
        differences are over half of that. By default 0.5, and 0.1 where :func:`identify_each`
        begins near the end of another search.
    diff_step : float, default 0.02
        The largest difference over which slopes are renewed, as a fraction of the bounds' range.
    tol : float, default 1e-3
        The search ends where the region is smaller than this.
    gain : float, default 1e-3
        And where fresh slopes promise to gain no more than this fraction of the value.
    maxiter : int, default 200
        The most steps, of each start.
    slopes : {"broyden", "fresh"}
        "broyden": of the runs that are made anyway, and renewed by k runs where these mislead.
        "fresh": measured before every step, by k runs, which k workers make at the same time: Gauss
        and Newton's method, for any measure.

    Raises
    ------
    ValueError
        An option that cannot be.

    Notes
    -----
    A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000).

    Examples
    --------
    >>> from curvewise.calibration import TrustRegion
    >>> TrustRegion(starts=5)
    TrustRegion(starts=5)
    """

    starts: int = 3
    initial_range: float | None = None
    diff_step: float = 0.02
    tol: float = 1e-3
    gain: float = 1e-3
    maxiter: int = 200
    slopes: Slopes = "broyden"

    def __post_init__(self) -> None:
        if self.slopes not in get_args(Slopes):
            raise ValueError(
                f"slopes is {self.slopes!r}; choose from {', '.join(get_args(Slopes))}"
            )
        for name, value in (("initial_range", self.first_radius), ("diff_step", self.diff_step)):
            if not 0.0 < value <= 1.0:
                raise ValueError(f"{name} is {value}; give a fraction of the bounds, such as 0.02")
        if self.starts < 1:
            raise ValueError(f"starts is {self.starts}; give at least 1")

    @property
    def first_radius(self) -> float:
        """Half the size of the first region."""
        return 0.5 if self.initial_range is None else self.initial_range

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the first simplex, of one step and of the slopes at the end."""
        return (1 if has_start else self.starts) * (2 * parameters + 2)

    def near_optimum(self) -> TrustRegion:
        """Return the same with a small first region."""
        return with_other_defaults(self, initial_range=0.1)

    def closer(self) -> TrustRegion:
        """Return the same for less, in a wider region, to leave a valley of other measures."""
        return with_other_defaults(self, initial_range=0.3, gain=2e-5, tol=1e-4)

    def minimise(self, evaluations: Evaluations, start: Array | None, seed: int) -> Finish:
        """Minimise on surfaces of the curves, from every start."""
        random = np.random.default_rng(seed)
        places = _places(evaluations.dimensions, start, self.starts, random)
        ends: list[tuple[float, Finish]] = []
        failure: RuntimeError | None = None
        responses: Responses | None = None
        for place in places:
            search = _Search(evaluations, random, self, responses)
            try:
                search.begin(place, self.first_radius)
            except RuntimeError as error:
                failure = failure or error
                continue
            finish = _descend(search, evaluations, self)
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
    if start is not None:
        return [np.asarray(start)]
    return [np.full(k, 0.5), *(random.uniform(*_DRAWN, k) for _ in range(count - 1))]


def _descend(search: _Search, evaluations: Evaluations, rules: TrustRegion) -> Finish:
    """Go down from one start."""
    radius = rules.first_radius
    known, idle = 0, 0
    for _ in range(rules.maxiter):
        idle = idle + 1 if len(evaluations.done) == known else 0
        if idle == _MOST_IDLE:
            return Finish(False, f"{idle} steps in a row led only to runs that were known")
        known = len(evaluations.done)
        candidate, promised = search.lowest(radius)
        least = max(evaluations.negligible, rules.gain * search.value)
        if promised <= least or radius < rules.tol:
            if search.is_fresh:
                if search.leaves_valley(rules.first_radius, least):
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
        rules: TrustRegion,
        responses: Responses | None,
    ) -> None:
        self._evaluations, self._random = evaluations, random
        self._diff_step, self._gain = rules.diff_step, rules.gain
        self.responses = responses
        self.is_fresh = False
        self.value = np.inf

    @property
    def centre(self) -> Array:
        """The best run so far."""
        return self._surfaces.centre

    def begin(self, start: Array, radius: float) -> None:
        """Run a simplex around the start, around the best of its runs if the start fails."""
        near = _earlier_runs_near(start, self._evaluations.earlier_runs)
        if near is not None:
            (first,) = self._run(start[np.newaxis])
            if not first.failed:
                self._take(start, first)
                assert self.responses is not None
                self._surfaces.slopes = near.slopes(self.responses, self._diff_step)
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
            candidate = self._minimum.elsewhere(self._surfaces, self._region(radius))
            promised = self._promised(candidate)
            if promised <= least:
                return False
            if self.step(candidate) > 0:
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
        assert self.responses is not None
        return SurfaceMinimum(
            self._evaluations.objective,
            self.responses,
            self._random,
            self._evaluations.show_activity,
            self._gain,
        )

    def _region(self, radius: float) -> tuple[Array, Array]:
        return np.clip(self.centre - radius, 0.0, 1.0), np.clip(self.centre + radius, 0.0, 1.0)

    def _promised(self, point: Array) -> float:
        return self.value - self._minimum.value(self._surfaces, point)

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

    def _run(self, points: Array) -> list[Evaluation]:
        return self._evaluations.evaluated(points)

    def _vector(self, run: Evaluation) -> Array:
        assert run.simulations is not None
        if self.responses is None:
            self.responses = Responses(run.simulations)
        return self.responses.vector(run.simulations)


def _earlier_runs_near(unit: Array, runs: Sequence[Run]) -> NearbyRuns | None:
    """Return earlier runs around a point that determine the slopes there, if they do.

    The 2 k + 1 nearest, if they are near and not all in a plane.
    """
    near = runs_near(unit, runs, within=_NEAR, most=2 * unit.size + 1)
    if near is None:
        return None
    offsets = (near.points - near.points.mean(axis=0)) / near.distances.max()
    return near if narrowest(offsets) >= _FLATTEST * np.sqrt(len(offsets)) else None


def _simplex(centre: Array, step: float, random: np.random.Generator) -> Array:
    """Return a point beside the centre for every axis, inwards where a bound is near."""
    signs = random.choice((-1.0, 1.0), centre.size)
    signs = np.where(centre + signs * step > 1.0, -1.0, signs)
    signs = np.where(centre + signs * step < 0.0, 1.0, signs)
    points: Array = np.clip(centre + np.diag(signs * step), 0.0, 1.0)
    return points
