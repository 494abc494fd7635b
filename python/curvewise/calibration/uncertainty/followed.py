"""Intervals on the nonlinear model, for models with a Jacobian.

Sensitivities assume that the curves are linear in the parameters. With errors as large as those due
to model error they are not. A parameter may change further than its slope at the optimum predicts
before its curves have moved as far, or it may meet a bound. Each interval end is therefore computed
on the nonlinear model. It is the greatest (or least) value of the parameter among all places within
the bounds whose curves are close enough to the fitted ones. Close enough means a weighted sum of
squares of at most that on the linear surfaces at the end of the linear interval. For a linear model
both ends are equal. The result is a profile of the expected deviance, with its height adjusted for
correlated noise.

Each step is exact for the linearised model at its start: the furthest point of an ellipsoid, with
parameters that would leave the bounds fixed there. An end that has not converged after `_MOST` runs
counts as far as it has come. An interval is never narrower than the linear one.

If a parameter has ended at a bound, the others have absorbed its error, and the distances of the
others' ends do not allow for that. Single ends do not count in this case: an interval extends to
the furthest value of its parameter at any of the ends.

Cost: about 3 to 6 runs of the model with derivatives for each end, all ends in parallel; O(n k^2)
for each run.

D. J. Venzon, S. H. Moolgavkar, Applied Statistics 37 (1988) 87-94 (following a profile's ends). R.
E. Chandler, S. Bate, "Inference for clustered data using the independence loglikelihood",
Biometrika 94 (2007) 167-183 (adjusting its height).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...curves.inputs import Array
from ..problem.simulator import Simulator
from ..surfaces.surfaces import Surfaces
from .estimate import Estimate, estimate_of
from .noise import Noise
from .sensitivity import Optimum, vectors_at
from .spread import Spread, spread_of

__all__ = ["IntervalEnd", "followed_spread"]

_MOST = 15  # runs for an end
_FURTHEST, _NEAREST = 0.3, 1e-3  # steps, in parts of the bounds' ranges
_OUTSIDE = 4.0  # times the square of the distance, beyond which a step has gone too far
# An end has converged if the squared distance, and the squared move of the curves by the next step,
# are within these fractions of the target.
_NEAR, _STILL = 0.1, 0.01


def followed_spread(optimum: Optimum, noise: Noise, level: float) -> tuple[Spread, int]:
    """Return the spread by sensitivities with its intervals followed, and the runs it took."""
    estimate, space = estimate_of(optimum, noise), optimum.problem.space
    spread = spread_of(estimate, optimum, level)
    widths = estimate.quantiles(level) * np.sqrt(np.diag(estimate.covariance))
    squares = widths**2 / np.diag(estimate.inverse)
    slopes = _compared_slopes(estimate, optimum)
    ends = [
        IntervalEnd(optimum.unit, slopes, index, way, float(square))
        for index, square in enumerate(squares)
        for way in (-1.0, 1.0)
    ]
    runs = _follow(ends, optimum, estimate)
    places = np.array([space.point(end.furthest) for end in ends])
    own = np.stack((places[::2].diagonal(), places[1::2].diagonal()))
    counted = places if space.at_bounds(space.dictionary(space.point(optimum.unit))) else own
    low, high = np.array(spread.intervals).T
    low, high = np.minimum(low, counted.min(axis=0)), np.maximum(high, counted.max(axis=0))
    intervals = list(zip(low.tolist(), high.tolist(), strict=True))
    return spread._replace(intervals=intervals), runs


def _compared_slopes(estimate: Estimate, optimum: Optimum) -> Array:
    return np.column_stack([estimate.compared(one) for one in optimum.slopes])


def _follow(ends: Sequence[IntervalEnd], optimum: Optimum, estimate: Estimate) -> int:
    """Compute all ends in parallel; return the number of runs, new or stored."""
    fitted = estimate.compared(optimum.curves(optimum.unit))
    with optimum.execution.simulator(optimum.problem.model) as simulator:
        while steps := [(end, place) for end in ends if (place := end.next_place()) is not None]:
            places = [place for _, place in steps]
            for (end, place), there in zip(steps, _run(optimum, simulator, places), strict=True):
                if there is None:
                    end.tell(place, None, None)
                else:
                    moved = estimate.compared(there.curves(there.unit)) - fitted
                    end.tell(place, moved, _compared_slopes(estimate, there))
        return simulator.runs + simulator.looked_up


def _run(optimum: Optimum, simulator: Simulator, places: Sequence[Array]) -> list[Optimum | None]:
    """Return curves and slopes at places; None where a run fails."""
    found: list[Optimum | None] = []
    problem, responses = optimum.problem, optimum.responses
    for place, base in zip(places, vectors_at(problem, responses, simulator, places), strict=True):
        slopes = None if base is None else responses.slopes(problem.slopes(place))
        if base is None or slopes is None:  # of another number of points than the fitted curves
            found.append(None)
        else:
            found.append(replace(optimum, unit=place, surfaces=Surfaces(place, base, slopes)))
    return found


class IntervalEnd:
    """One end of one interval, during its computation.

    Parameters
    ----------
    start : ndarray, shape (k,)
        The optimum in the unit cube.
    slopes : ndarray, shape (n, k)
        The derivatives of the compared quantity there.
    index : int
        The index of the parameter.
    way : float
        1 for the upper end, -1 for the lower one.
    square : float
        The largest squared change of the compared quantity.

    Attributes
    ----------
    furthest : ndarray, shape (k,)
        The place where the parameter has come furthest so far.
    """

    def __init__(self, start: Array, slopes: Array, index: int, way: float, square: float) -> None:
        self._start, self._index, self._way, self._square = start, index, way, square
        self._radius, self._runs = _FURTHEST, 0
        self.furthest = start
        self._stand(start, np.zeros(len(slopes)), slopes)

    def _stand(self, place: Array, moved: Array, slopes: Array) -> None:
        self._place, self._distance = place, float(moved @ moved)
        self._normal, self._gradient = slopes.T @ slopes, slopes.T @ moved

    def next_place(self) -> Array | None:
        """Return the next place to run, or None if the end has converged."""
        if self._runs >= _MOST or self._radius < _NEAREST or not self._normal.any():
            return None  # a model that does not depend on its parameters does not have ends
        at_bound = self._place[self._index] == (self._way > 0.0)
        if at_bound and self._distance <= self._square:
            return None
        step = self._step()
        moves = float(step @ self._normal @ step)
        is_near = abs(self._distance - self._square) <= _NEAR * self._square
        if is_near and moves <= _STILL * self._square:
            return None
        size = float(np.abs(step).max())
        place: Array = np.clip(self._place + step * min(1.0, self._radius / size), 0.0, 1.0)
        return place

    def tell(self, place: Array, moved: Array | None, slopes: Array | None) -> None:
        """Record a run: the change of the compared quantity, and its derivatives."""
        self._runs += 1
        distance = math.inf if moved is None else float(moved @ moved)
        too_far = distance > max(_OUTSIDE * self._square, 0.5 * self._distance)
        if moved is None or slopes is None or too_far:
            self._radius = float(np.abs(place - self._place).max()) / 2.0
            return
        self._radius = min(2.0 * self._radius, _FURTHEST)
        self._stand(place, moved, slopes)
        # Beyond the target distance, the way back is that of a linear model.
        back = math.sqrt(self._square / distance) if distance > self._square else 1.0
        reached = self._start + back * (place - self._start)
        if self._way * (reached - self.furthest)[self._index] > 0.0:
            self.furthest = reached

    def _step(self) -> Array:
        """Return the step to the furthest point of the linear model's ellipsoid in the bounds."""
        count, held = len(self._place), dict[int, float]()
        step = np.zeros(count)
        tiny = 1e-10 * float(np.trace(self._normal)) / count
        while len(held) < count:
            free = [i for i in range(count) if i not in held]
            step = np.zeros(count)
            step[list(held)] = list(held.values())
            pulled = self._gradient + self._normal @ step
            distance = self._distance + float(step @ (self._gradient + pulled))
            inverse = np.linalg.inv(self._normal[np.ix_(free, free)] + tiny * np.eye(len(free)))
            nearest = -inverse @ pulled[free]
            if self._index in free:
                own = inverse[free.index(self._index)]
                left = max(self._square - distance - float(pulled[free] @ nearest), 0.0)
                nearest += self._way * math.sqrt(left / own[free.index(self._index)]) * own
            step[free] = nearest
            outside = np.maximum(self._place + step - 1.0, -(self._place + step))
            outside[list(held)] = 0.0
            worst = int(np.argmax(outside))
            if outside[worst] <= 0.0:
                break
            held[worst] = float(self._place[worst] + step[worst] > 0.5) - float(self._place[worst])
        return step
