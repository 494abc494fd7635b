"""One start of a search: a trust-region method on a surrogate of the curves.

Each iteration minimises the surrogate within a trust region around the best run and runs the model
at the minimiser. The radius follows the ratio of actual to predicted reduction. If the predicted
reduction is negligible, geometry-improving steps run the model in directions with poor sampling. If
there are none, the global stage proposes other minima. If it proposes none, the start has ended. If
the objective has kinks, which make local minima, it also proposes after three failed steps. A start
is abandoned if it is far above the best run and predicts only a small part of the difference.
If repeated steps do not achieve their predicted reduction, the start continues with a surrogate of
the value (`lowest_value`).

Starts share runs, but an independent one uses those of others in its trust region alone.

Cost: k + 1 runs for the initial design of k parameters, one run for every step and restart, and up
to k runs to sample all directions at the end.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from ..problem.ledger import Finish
from ..records.evaluation import Evaluation
from ..surfaces.kriged_surface import lowest_value
from ..surfaces.steps import GOOD, POOR
from .global_stage import GlobalStage
from .runs import Noise, Runs
from .starts import NOISIEST, WITHIN, End, nothing_beside

__all__ = ["Descent", "Part", "Rules", "simplex_around"]

R = TypeVar("R")
Part: TypeAlias = Generator[Array, list[Evaluation], R]
"""A part of a course, which returns something of its own."""

_FAR = 5.0  # how far the runs may be from which a surrogate is made, in regions of trust
_FAIR, _AFTER_FAIR = 0.3, 0.7  # a ratio of reductions, and the region below it, in step lengths
_AFTER_HOP = 0.15  # the region after a restart next to another minimum
_FEW = 2  # up to this number of parameters, independent starts use their own runs alone
_SHORTER = 0.05  # sides of the region after a run that failed, of some of its axes
_MISLED = 5  # excess of failed over good steps that marks a surrogate of curves as misleading
_IN_VAIN = 3  # steps that fail in a row, after which the global stage has its turn
_HOPS_IN_VAIN = 8  # proposals of the global stage that fail in a row
_OF_VALUE = 2e-3  # the least predicted reduction of a restart, as a fraction of the value
# A start whose value is above the best by a larger part is far above it, and abandoned if it
# predicts less than that part of the difference.
_CLOSE, _LEFT_BEHIND = 0.1, 0.2
# Planes of exact derivatives lead straight into the corners of the bounds, where a model may change
# abruptly. As in interior-point methods, no step covers more of the distance to a bound than this.
_OF_WAY = 0.9


@dataclass(frozen=True)
class Rules:
    """Settings of each start, named like the options of `TrustRegion`."""

    first_radius: float
    diff_step: float
    tol: float
    gain: float
    maxiter: int
    is_abandoned: bool = True  # where it is left behind


def simplex_around(centre: Array, step: float, random: np.random.Generator) -> Array:
    """Return a point next to the centre on every axis, within the bounds."""
    signs = random.choice((-1.0, 1.0), centre.size)
    signs = np.where(centre + signs * step > 1.0, -1.0, signs)
    signs = np.where(centre + signs * step < 0.0, 1.0, signs)
    points: Array = np.clip(centre + np.diag(signs * step), 0.0, 1.0)
    return points


class Descent:
    """The best run of one start, and the region around it in which surrogates are trusted.

    The start is independent if its place does not depend on others. If the objective has kinks, or
    few parameters, its surrogates do not use their runs either, unless all starts are shared.
    """

    def __init__(
        self,
        random: np.random.Generator,
        rules: Rules,
        runs: Runs,
        *,
        is_independent: bool,
        is_shared: bool = False,
    ) -> None:
        self._random, self._rules, self._runs = random, rules, runs
        self._stage = GlobalStage(runs, random)
        self._is_independent = is_independent
        # The runs that it has made, and those of earlier searches; None if it uses all runs.
        k = runs.points.shape[1]
        uses_all = is_shared or (runs.inner.is_smooth and k > _FEW) or not is_independent
        self._own = None if uses_all else set(range(runs.earlier))
        self.made = 0  # runs
        self._best: int | None = None
        self._last = np.inf
        self._sides = np.ones(k)  # of the region, in each direction
        self._tried: set[tuple[float, ...]] = set()
        self._failed = 0  # steps, less those that were good
        self._in_vain = 0  # steps that have failed since the last one that did not
        self._by_value = False
        self._noise = Noise(0.0, 0.0)
        self._reach = rules.diff_step  # radius within which every direction must be sampled
        # differences of the value that are negligible compared with the reduction so far
        self._nothing = 0.0

    @property
    def value(self) -> float:
        """The smallest value so far."""
        return np.inf if self._best is None else self._runs.values[self._best]

    @property
    def centre(self) -> Array:
        """The point of the best run."""
        assert self._best is not None
        point: Array = self._runs.points[self._best]
        return point

    def course(self, start: Array) -> Part[End | None]:
        """Run a start; return its end, or None if all simulations around it fail."""
        radius = self._rules.first_radius
        simplex = simplex_around(start, radius / 2.0, self._random)
        is_known = not self._runs.least_known(start, radius / 2.0)
        is_own = self._own == set() or (self._is_independent and start.size <= _FEW)
        if self._runs.has_slopes or (is_known and not is_own):
            yield from self._run(start[np.newaxis])
        if self._best is None:
            yield from self._run(np.vstack((start, simplex)))
        if self._best is None:
            return None
        number = self._runs.number(start)
        before = self.value if number is None else self._runs.values[number]
        self._nothing = nothing_beside(before)
        finish = yield from self._descended()
        own = (self._is_independent, self._noise.of_value, self._by_value)
        return End(before, self.value, self.centre, finish, *own)

    def _descended(self) -> Part[Finish]:
        rules, inner = self._rules, self._runs.inner
        radius = rules.first_radius
        for _ in range(rules.maxiter):
            candidate, promised = self._lowest(radius)
            least = max(inner.negligible, rules.gain * self.value)
            if self._is_behind(promised):
                return Finish(False, "another start is far ahead")
            if self._in_vain >= _IN_VAIN and not (inner.is_smooth or self._by_value):
                self._in_vain = 0
                if rules.is_abandoned and self._is_far():
                    return Finish(False, "another start is far ahead")
                if (yield from self._hops(least)):
                    radius = max(radius, _AFTER_HOP)
                    continue
            if promised <= least or radius < rules.tol:
                if (yield from self._looks_around()):
                    radius = max(radius, _FAR * self._reach)  # as far as the new runs support
                elif (yield from self._hops(least)):
                    radius = max(radius, _AFTER_HOP)
                else:
                    return self._end(radius, promised, least)
                continue
            radius = yield from self._step(candidate, promised, radius)
        return Finish(False, f"{rules.maxiter} steps")

    def _step(self, candidate: Array, promised: float, radius: float) -> Part[float]:
        """Run a candidate; return the region to trust after it."""
        assert self._best is not None
        length = float(np.abs(candidate - self.centre).max())
        before = self.value
        yield from self._run(candidate[np.newaxis])
        was_whole = float(self._sides.min()) == 1.0
        self._sides = self._drawn_sides()
        if was_whole and not np.isfinite(self._last):
            return radius
        gain = before - self._last
        has_failed = gain < POOR * promised
        self._in_vain = self._in_vain + 1 if has_failed else 0
        if has_failed and np.isfinite(self._last):
            noise = self._runs.noise(self._best, self._reach).of_value
            self._failed += promised > 2.0 * noise
        elif gain >= GOOD * promised:
            self._failed = max(0, self._failed - 1)
        if self._failed == _MISLED and not self._by_value and not self._runs.has_slopes:
            self._by_value = self._runs.is_misled = True
            return self._rules.first_radius / 2.0
        if has_failed:
            return length / 2.0
        if gain < _FAIR * promised:
            return _AFTER_FAIR * length
        return min(1.0, max(radius, 2.0 * length)) if gain >= GOOD * promised else radius

    def _drawn_sides(self) -> Array:
        """Return the sides of the next region: a failed run shortens some, to follow its border."""
        k = self._sides.size
        if np.isfinite(self._last):
            return np.ones(k)
        sides = self._random.choice((_SHORTER, 1.0), k)
        sides[self._random.integers(k)] = 1.0
        return sides

    def _lowest(self, radius: float) -> tuple[Array, float]:
        """Return where the surrogate is lowest within the region, and the gain that it promises."""
        assert self._best is not None
        centre = self.centre
        reach = radius * self._sides
        low, high = np.clip(centre - reach, 0.0, 1.0), np.clip(centre + reach, 0.0, 1.0)
        if self._runs.has_slopes:
            low = np.maximum(low, (1.0 - _OF_WAY) * centre)
            high = np.minimum(high, centre + _OF_WAY * (1.0 - centre))
        if self._by_value:
            most = (centre.size + 1) * (centre.size + 2) // 2
            points, values = self._runs.values_near(self._best, most)
            return lowest_value(points, values, centre, low, high, self._random)
        surrogate = self._runs.surrogate(self._best, _FAR * radius, self._seen(radius))
        inner = self._runs.inner
        point = inner.lowest(surrogate, centre, low, high)
        before, after = inner.values(surrogate, np.array((centre, point)))
        return point, float(before - after)

    def _seen(self, region: float) -> Rows | None:
        """Return the runs for a surrogate: an independent start's own, and those in its region.

        Others draw it to minima that are known already, so that all starts end there.
        """
        if self._own is None:
            return None
        away = np.abs(self._runs.points - self.centre).max(axis=1)
        away[list(self._own)] = 0.0
        return np.flatnonzero(away <= min(region, self._rules.first_radius))

    def _is_behind(self, promised: float) -> bool:
        """Return whether the best run of all starts is too far ahead of the predicted value."""
        above = self.value - min(self._runs.values)
        if self._runs.is_misled:
            return False
        is_far = self._rules.is_abandoned and above > _CLOSE * (self.value - above) + self._nothing
        return is_far and max(promised, 0.0) < _LEFT_BEHIND * above

    def _run(self, points: Array) -> Part[None]:
        """Run points, and move to the best of them if it is better than all before."""
        self._last = np.inf
        self._tried.update(tuple(point) for point in points)
        self.made += len(points)
        for point, run in zip(points, (yield points), strict=True):
            number = self._runs.add(point, run)
            if number is not None:
                if self._own is not None:
                    self._own.add(number)
                self._last = self._runs.values[number]
                if self._last < self.value:
                    self._best = number

    def _looks_around(self) -> Part[bool]:
        """Run what the surrogate would learn most from; return whether there was any such point."""
        assert self._best is not None
        if self._runs.noise(self._best, self._reach).of_curves > 0.0:
            self._reach = _FAR * self._rules.diff_step
        unknown = [] if self._runs.has_slopes else list(self._unknown())
        if unknown:
            yield from self._run(np.array(unknown))
        return bool(unknown)

    def _unknown(self) -> Iterator[Array]:
        """Yield a point for each direction with poor sampling, nearer if runs have failed there."""
        centre, reach = self.centre, self._reach
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

    def _hops(self, least: float) -> Part[bool]:
        """Run proposals of the global stage until so many in a row fail; return whether any gained.

        The stage has no turn if its surrogate misleads, or if another start costs less.
        """
        if self._by_value or (self._runs.has_slopes and self._runs.inner.is_smooth):
            return False
        before, centre, failed = self.value, self.centre, 0
        if self._runs.is_exhausted(centre):
            return False
        while failed < _HOPS_IN_VAIN:
            if self._is_far():
                return before - self.value > least
            assert self._best is not None
            found = self._stage.lowest(self._best, self._seen(_AFTER_HOP))
            if found is None or found[1] <= max(least, _OF_VALUE * self.value):
                break
            value = self.value
            yield from self._run(found[0][np.newaxis])
            self._sides = self._drawn_sides()
            failed = 0 if value - self.value > POOR * found[1] else failed + 1
        if before - self.value > least:
            self._failed = 0  # this surrogate does not mislead
            return True
        self._runs.exhausted.append(centre)
        return False

    def _is_far(self) -> bool:
        """Return whether another start is so far ahead that other minima are left to it."""
        return self.value > (1.0 + _CLOSE) * min(self._runs.values)

    def _end(self, radius: float, promised: float, least: float) -> Finish:
        assert self._best is not None
        self._noise = self._runs.noise(self._best, self._reach)
        own = ""
        if self._noise.of_curves > 0.0:
            own = f"; the model's own noise is about {100.0 * self._noise.of_curves:.2g} %"
        if promised <= least:
            within = "" if radius >= 1.0 else f" within {100.0 * radius:.3g} % of the bounds' range"
            message = f"the surrogate predicts an improvement below {least:.2g}{within}"
            return Finish(True, f"{message}{own}")
        region = f"the region is below {self._rules.tol:g} of the bounds' range"
        noise = min(2.0 * self._noise.of_value, NOISIEST * self.value)
        if promised <= max(WITHIN * self.value, noise):
            return Finish(True, f"{region}{own}")
        return Finish(False, f"{region}, and steps improve less than the surrogate predicts{own}")
