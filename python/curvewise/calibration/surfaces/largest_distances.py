"""Minimax search: minimises the largest distance from predicted curves.

The Fréchet distance is the largest of many distances. Its gradient is that of a single pair of
points and does not lead to the minimum, where as many pairs as there are parameters are equally far
apart. For a fixed coupling, this is a minimax problem, solved by Madsen's method: a linear program
minimises the largest of the linearised distances within a trust region.

The coupling that attains the distance determines little about the pairs that do not decide. The
warping path of squared distances keeps all pairs short and is used first. If it predicts no
reduction, the attaining coupling is used.

Cost: a path and a linear program of about a hundred rows, 2 to 4 ms, for each of up to 15 steps.

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
from .steps import GOOD, SHRUNK, SMALL
from .surfaces import PredictedCurves, Surface

__all__ = ["minimised"]

_STEPS_OF = 3  # evaluations with a gradient take the time of a step
_DECIDING = 0.5  # of the distance: pairs that are nearer to each other are left out
_POOR = 0.25  # of the predicted reduction: a step that gains less has failed
_SMALLEST, _ANEW = 1e-3, 0.1  # regions, in sides of the box

Coupling = Callable[[Array, Array], Alignment]
_COUPLINGS: tuple[Coupling, ...] = (partial(dtw_path, metric="sqeuclidean"), frechet_path)


def minimised(
    predicted: PredictedCurves, surface: Surface, start: Array, low: Array, high: Array, most: int
) -> Array:
    """Return a local minimum in a box, in the time of so many evaluations with a gradient."""
    width = np.where(high > low, high - low, 1.0)
    distances = _LargestDistances(predicted, surface, low, width)
    place = distances.descended((start - low) / width, max(2, most // _STEPS_OF))
    point: Array = np.clip(low + place * width, low, high)
    return point


class _LargestDistances:
    """The Fréchet distances of curves on a surface, as functions of a place in a box."""

    def __init__(
        self, predicted: PredictedCurves, surface: Surface, low: Array, width: Array
    ) -> None:
        self._predicted, self._seen = predicted, predicted.seen(surface)
        self._low, self._width = low, width
        objective = predicted.objective
        self._weights = objective.weights
        condition = objective.condition
        assert condition is not None, "see Objective.is_largest_distance"
        self._tests = []
        for test in objective.experiments:
            low, extent = box(test) if condition.scaled else (np.zeros(1), np.ones(1))
            self._tests.append(((test - low) / extent, low, extent))

    def value(self, place: Array) -> float:
        """Return the distance at a place."""
        return self._predicted.value(self._seen.at(self._low + place * self._width))

    def descended(self, place: Array, most: int) -> Array:
        """Return the end of at most `most` steps; the distance never increases."""
        value = self.value(place)
        couplings = list(_COUPLINGS)
        reach = 1.0
        for _ in range(most):
            step, promised = self._step(place, couplings[0], reach)
            gain, trial = -np.inf, np.clip(place + step, 0.0, 1.0)
            if promised > SMALL * value:
                gain = value - self.value(trial)
                length = float(np.abs(step).max())
                if gain < _POOR * promised:
                    reach = SHRUNK * length
                elif gain > GOOD * promised:
                    reach = max(reach, 2.0 * length)
            if gain > 0.0:
                place, value = trial, value - gain
            if gain > SMALL * value:
                couplings = list(_COUPLINGS)
            elif promised <= SMALL * value or reach < _SMALLEST:
                del couplings[0]
                reach = max(reach, _ANEW)
                if not couplings:
                    break
        return place

    def _step(self, place: Array, coupling: Coupling, reach: float) -> tuple[Array, float]:
        """Return the step that minimises linear distances; predicted reduction."""
        vector, slopes = self._seen.with_slopes(self._low + place * self._width)
        responses = self._predicted.responses
        curves, moves = responses.curves(vector), responses.curves(slopes * self._width)
        k, count = place.size, len(self._tests)
        rows, distances, value = [], [], 0.0
        for t, (P, low, extent) in enumerate(self._tests):
            Q = (curves[t] - low) / extent
            i, j = np.array(coupling(P, Q).path).T
            apart = Q[j] - P[i]
            lengths = np.linalg.norm(apart, axis=1)
            longest = frechet(P, Q)
            value += self._weights[t] * longest
            decides = lengths > _DECIDING * longest
            towards = apart[decides] / lengths[decides, np.newaxis] / extent
            by_place = np.einsum("lc,lck->lk", towards, moves[t][j[decides]])
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
