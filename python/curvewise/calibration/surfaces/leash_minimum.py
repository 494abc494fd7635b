"""Where the Fréchet distance of the curves that surfaces predict is smallest.

The Fréchet distance is the largest of many distances, and its gradient that of a single pair of
points, which leads nowhere: at a minimum as many pairs as there are parameters are equally far
apart. With a coupling held, the smallest of the largest distances is a minimax problem, which is
solved as Madsen does it: distances become linear in the parameters, a linear program finds the step
within a region that makes the largest of them smallest, and the region shrinks where the distance,
with its coupling found anew, does not follow. A coupling that is held is an upper bound, so that a
better one can only help. The one that attains the distance says little of pairs that do not decide;
the warping path of squared distances keeps all of them short and comes first, and where it promises
nothing the other has its turn.

A hop into another valley goes by what makes the valleys. Where points of the tests decide
(`objective.sampling`), a population settles in one. Where curves do, it would halt at kinks, and
steps lead down from where the curves have moved by about their distance from the tests, as far in
each of the directions in which they move independently (benchmarks/validation/README.md).

Cost: a path and a linear program of some hundred rows, 2 to 4 ms, for each of 10 to 15 steps.

K. Madsen, "An algorithm for minimax solution of overdetermined systems of non-linear equations",
J. Inst. Maths Applics 16 (1975) 321-328.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ...curves.scaling import box
from ...measures import dtw_path, frechet, frechet_path
from ...measures.results import Alignment
from ..objective.objective import Objective
from ..objective.sampling import is_leash, sampling_of_tests
from .evolution import evolved
from .kriged_surface import KrigedSurface
from .sensed_surface import SensedSurface
from .surface_minimum import SurfaceMinimum, _Predicted
from .surfaces import Responses, Surface, Surfaces

__all__ = ["LeashMinimum", "minimum_on_surfaces"]

_GAIN = 1e-3  # the smallest that counts, of the value
_STEPS, _POLISHING = 25, 6
_DECIDING = 0.5  # of the distance: pairs that are nearer to each other are left out
_SMALL = 1e-4  # of the value: a promise that is less is none
_POOR, _GOOD = 0.25, 0.7  # of what was promised
_SHRUNK, _SMALLEST, _ANEW = 0.4, 1e-3, 0.1  # regions, in sides of the box
_SIMPLEX = 20  # evaluations for each parameter
# Of a hop into another valley: the first standard deviation, as a fraction of the bounds' range,
# the population, and the steps from where it has settled.
_WIDTH, _MEMBERS, _GENERATIONS, _IN_VALLEY = 0.05, 10, 60, 12
# Of one where curves decide: how far curves move in the mean, in distances, from and to; and the
# largest standard deviation along a direction, as a fraction of the bounds' range.
_MOVED, _FARTHEST = (0.5, 3.0), 0.5

Coupling = Callable[[Array, Array], Alignment]
_COUPLINGS: tuple[Coupling, ...] = (partial(dtw_path, metric="sqeuclidean"), frechet_path)


def minimum_on_surfaces(
    objective: Objective,
    responses: Responses,
    random: np.random.Generator,
    show_activity: Callable[[], None],
    gain: float = _GAIN,
) -> SurfaceMinimum:
    """Return what minimises an objective on surfaces; as the class that it returns."""
    kind = LeashMinimum if is_leash(objective) else SurfaceMinimum
    return kind(objective, responses, random, show_activity, gain)


class LeashMinimum(SurfaceMinimum):
    """Minimises Fréchet distances on surfaces, as `SurfaceMinimum` does measures with a gradient.

    Parameters
    ----------
    objective, responses, random, show_activity, gain
        As for that.
    """

    def __init__(
        self,
        objective: Objective,
        responses: Responses,
        random: np.random.Generator,
        show_activity: Callable[[], None],
        gain: float = _GAIN,
    ) -> None:
        super().__init__(objective, responses, random, show_activity, gain)
        for predicted in filter(None, (self._exact, self._thinned)):
            predicted.has_gradient = True  # something leads down

    def valley(self, surface: KrigedSurface | SensedSurface, place: Array, best: Array) -> Array:
        """Return a minimum over the whole cube beside a place, in whichever valley it is.

        Where points decide at the best place that is known, valleys are narrow, and a population
        goes over them; where curves do, it halts at kinks, and steps lead down from a place to
        which the curves have moved.

        Cost: some 600 evaluations of the surface and of the measure, and twelve steps; or 40 steps.
        """
        cube = np.zeros(place.size), np.ones(place.size)
        leashes = _Leashes(self._thinned or self._exact, surface, cube)
        if self._points_decide(surface.at(best)):
            settled = evolved(
                leashes.values,
                place,
                _WIDTH,
                self._random,
                members=_MEMBERS,
                generations=_GENERATIONS,
            )
            return leashes.descended(settled, _IN_VALLEY)
        found = leashes.descended(leashes.moved(place, self._random), _STEPS)
        return _Leashes(self._exact, surface, cube).descended(found, _IN_VALLEY)

    def _points_decide(self, vector: Array) -> bool:
        """Return whether points of the tests decide, and not their curves."""
        objective = self._exact._objective
        distances = objective.predicted(self._exact._responses.curves(vector)).terms
        return any(test.deciding > 0 for test in sampling_of_tests(objective, distances))

    def _minimised(
        self,
        predicted: _Predicted,
        surfaces: Surface,
        region: tuple[Array, Array],
        start: Array,
        thoroughly: bool,
    ) -> Array:
        leashes = _Leashes(predicted, surfaces, region)
        best = leashes.descended(start, _STEPS)
        if not thoroughly:
            return best
        return leashes.descended(self._simplex(leashes.value, best, _SIMPLEX), _STEPS)

    def _polished(self, surfaces: Surface, region: tuple[Array, Array], start: Array) -> Array:
        return _Leashes(self._exact, surfaces, region).descended(start, _POLISHING)


class _Leashes:
    """The Fréchet distances of curves on surfaces, as functions of a place in a box."""

    def __init__(
        self, predicted: _Predicted, surfaces: Surface, region: tuple[Array, Array]
    ) -> None:
        self.value = predicted.on(surfaces, region)
        self._predicted, self._responses = predicted, predicted._responses
        self._seen = surfaces.of_places(predicted._places)
        self._low, high = region
        self._width = high - self._low
        objective = predicted._objective
        self._weights = objective.weights
        condition = objective.condition
        assert condition is not None
        self._tests = []
        for test in objective.experiments:
            low, extent = box(test) if condition.scaled else (np.zeros(1), np.ones(1))
            self._tests.append(((test - low) / extent, low, extent))

    def values(self, places: Array) -> Array:
        """Return the distances at several places, shape (places,)."""
        vectors = self._seen.at(self._low + places * self._width)
        return np.array([self._predicted.value(vector) for vector in vectors])

    def moved(self, place: Array, random: np.random.Generator) -> Array:
        """Return a place at which the curves have moved by about what they are from the tests.

        As far in each of the directions in which they move independently of each other.
        """
        _, slopes = self._slopes_at(place)
        by_place = np.concatenate(
            [
                (of_test / extent[:, np.newaxis]).reshape(-1, place.size)
                for of_test, (_, _, extent) in zip(slopes, self._tests, strict=True)
            ]
        )
        points = sum(len(of_test) for of_test in slopes)
        squares, axes = np.linalg.eigh(by_place.T @ by_place)
        shortest, longest = _MOVED
        size = shortest * (longest / shortest) ** random.random() * self.value(place)
        lengths = size * np.sqrt(points / place.size / np.maximum(squares, 1e-20))
        lengths = np.minimum(lengths, _FARTHEST)
        step = axes @ (lengths * random.standard_normal(place.size))
        moved: Array = np.clip(place + step, 0.0, 1.0)
        return moved

    def descended(self, place: Array, most: int) -> Array:
        """Return where up to so many steps lead from a place, to a distance that is not above."""
        value = self.value(place)
        couplings = list(_COUPLINGS)
        reach = 1.0
        for _ in range(most):
            step, promised = self._step(place, couplings[0], reach)
            gain, trial = -np.inf, np.clip(place + step, 0.0, 1.0)
            if promised > _SMALL * value:
                gain = value - self.value(trial)
                length = float(np.abs(step).max())
                if gain < _POOR * promised:
                    reach = _SHRUNK * length
                elif gain > _GOOD * promised:
                    reach = max(reach, 2.0 * length)
            if gain > 0.0:
                place, value = trial, value - gain
            if gain > _SMALL * value:
                couplings = list(_COUPLINGS)
            elif promised <= _SMALL * value or reach < _SMALLEST:
                del couplings[0]
                reach = max(reach, _ANEW)
                if not couplings:
                    break
        return place

    def _step(self, place: Array, coupling: Coupling, reach: float) -> tuple[Array, float]:
        """Return the step that makes linear distances smallest, and what that promises to gain."""
        vector, slopes = self._slopes_at(place)
        k, count = place.size, len(self._tests)
        rows, distances = [], []
        value = 0.0
        curves = self._responses.curves(vector)
        for t, ((P, low, extent), curve) in enumerate(zip(self._tests, curves, strict=True)):
            Q = (curve - low) / extent
            i, j = np.array(coupling(P, Q).path).T
            apart = Q[j] - P[i]
            lengths = np.linalg.norm(apart, axis=1)
            longest = frechet(P, Q)
            value += self._weights[t] * longest
            decides = lengths > _DECIDING * longest
            towards = apart[decides] / lengths[decides, np.newaxis] / extent
            by_place = np.einsum("lc,lck->lk", towards, slopes[t][j[decides]])
            of_test = np.zeros((len(by_place), count))
            of_test[:, t] = -1.0
            rows.append(np.hstack((by_place, of_test)))
            distances.append(lengths[decides])
        found = required("scipy.optimize").linprog(
            np.concatenate((np.zeros(k), self._weights)),
            A_ub=np.vstack(rows),
            b_ub=-np.concatenate(distances),
            bounds=[
                *zip(np.maximum(-place, -reach), np.minimum(1.0 - place, reach), strict=True),
                *[(0.0, None)] * count,
            ],
            options={"presolve": False},  # which takes a third of the time with so few columns
        )
        if found.x is None:
            return np.zeros(k), 0.0
        return found.x[:k], value - found.fun

    def _slopes_at(self, place: Array) -> tuple[Array, list[Array]]:
        """Return the curves as one vector, and for each its slopes, shape (n, d, k)."""
        point = self._low + place * self._width
        if isinstance(self._seen, (KrigedSurface, SensedSurface)):
            vector, slopes = self._seen.with_slopes(point)
        else:
            assert isinstance(self._seen, Surfaces), "those are all that searches make"
            vector, slopes = self._seen.at(point), self._seen.slopes
        ends = np.cumsum([n * d for n, d in self._responses.shapes])[:-1]
        parts = np.split(slopes * self._width, ends)
        return vector, [
            part.reshape(*shape, -1)
            for part, shape in zip(parts, self._responses.shapes, strict=True)
        ]
