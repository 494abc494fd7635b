"""Surfaces of the curves around an optimum, and how sensitive the loops are to the parameters.

The derivatives come from a surrogate of the runs that a search has made nearby, or from two runs a
parameter if there are too few of these. Their singular values say to which combinations of
parameters the loops are sensitive, and how far an estimate moves. Cost: no runs, or 2 k.

P. R. Bevington, "Data reduction and error analysis for the physical sciences", McGraw-Hill (1969).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...curves.inputs import Array
from ...curves.several_curves import points_of
from ..problem.execution import Execution
from ..problem.problem import Problem
from ..problem.simulator import Simulator
from ..records.evaluation import Evaluation, Run
from ..surfaces.kriged_surface import KrigedSurface
from ..surfaces.surfaces import Responses, Surfaces

__all__ = ["Optimum", "design_runs", "moves_of", "optimum_surfaces", "sensitivity_of", "vectors_at"]

_NEAR = 0.1  # runs further away than this fraction of the bounds' range are not looked at
_STEP = 0.02  # runs nearer than this count alike; the step of fresh runs
_LEAST = 0.15  # the smallest singular value of the places of the runs, in units of their distances


@dataclass(frozen=True)
class Optimum:
    """Surfaces around an optimum.

    Attributes
    ----------
    problem : Problem
        What was searched.
    unit : ndarray, shape (k,)
        The optimum in the unit cube.
    responses, surfaces
        The curves as linear functions of the place in the unit cube.
    execution : Execution
        What runs the model.
    has_slopes : bool
        Whether the surfaces have the model's own derivatives.
    """

    problem: Problem
    unit: Array
    responses: Responses
    surfaces: Surfaces
    execution: Execution = field(default_factory=Execution)
    has_slopes: bool = False

    def curves(self, unit: Array) -> list[Array]:
        """Return the predicted curves at a place."""
        return self.responses.curves(self.surfaces.at(unit))

    @property
    def slopes(self) -> list[list[Array]]:
        """By parameter, the slopes of the curves."""
        return [self.responses.curves(column) for column in self.surfaces.slopes.T]

    def scaled_slopes(self) -> list[Array]:
        """Return the slopes in units of each loop's box, each loop's points weighing 1 together.

        For each loop of shape (coordinates, k): a column's norm is the root mean square distance by
        which the loop moves as the parameter goes through its bounds.
        """
        parts = []
        for extent, *columns in zip(self.problem.objective.extents, *self.slopes, strict=True):
            moves = np.array(columns) / extent
            parts.append(moves.reshape(len(columns), -1).T / np.sqrt(moves.shape[1]))
        return parts

    def loop_sensitivities(self) -> Array:
        """Return the root mean square move of every loop, in units of its box; (loops, k)."""
        return np.array([np.linalg.norm(part, axis=0) for part in self.scaled_slopes()])


def design_runs(
    problem: Problem, unit: Array, simulations: Sequence[Array], runs: Sequence[Run]
) -> int:
    """Return how many runs `optimum_surfaces` will make."""
    if _nearby(unit, runs) is not None:
        return 0
    has_slopes = Responses(simulations).slopes(problem.slopes(unit)) is not None
    return 0 if has_slopes else 2 * len(problem.space.names)


def optimum_surfaces(
    problem: Problem,
    execution: Execution,
    unit: Array,
    simulations: Sequence[Array],
    runs: Sequence[Run],
) -> Optimum:
    """Return the surfaces around an optimum: the model's own slopes, or those of runs."""
    responses = Responses(simulations)
    base = responses.vector(simulations)
    near = _nearby(unit, runs)
    known = responses.slopes(problem.slopes(unit))
    if known is not None:
        slopes = known
    elif near is None:
        slopes = _differences(problem, execution, unit, responses, base)
    else:
        # A plane misses curvature: standard errors of an exponent were half of the right ones.
        points = near[0]
        vectors = np.array([responses.vector(run.simulations or ()) for run in near[1]])
        nearest = points[int(np.argmin(np.abs(points - unit).max(axis=1)))]
        slopes = KrigedSurface(points, vectors, nearest).with_slopes(unit)[1]
    surfaces = Surfaces(unit, base, slopes)
    return Optimum(problem, unit, responses, surfaces, execution, known is not None)


def _nearby(unit: Array, runs: Sequence[Run]) -> tuple[Array, list[Evaluation]] | None:
    """Return the points and runs near a place if they determine slopes there."""
    near = [(point, run) for point, run in runs if run.simulations]
    near = [one for one in near if np.abs(one[0] - unit).max() <= _NEAR]
    if len(near) < unit.size + 2:
        return None
    points = np.array([point for point, _ in near])
    away = points - unit
    directions = away / (np.abs(away).max(axis=1, keepdims=True) + _STEP)
    if np.linalg.svd(directions, compute_uv=False)[-1] < _LEAST:
        return None
    return points, [run for _, run in near]


def _differences(
    problem: Problem, execution: Execution, unit: Array, responses: Responses, base: Array
) -> Array:
    """Return slopes by central differences; to one side at a bound and where a run fails."""
    k = unit.size
    places = np.clip(np.vstack((unit + _STEP * np.eye(k), unit - _STEP * np.eye(k))), 0.0, 1.0)
    with execution.simulator(problem.model) as simulator:
        vectors = vectors_at(problem, responses, simulator, places)
    slopes = np.zeros((base.size, k))
    for i in range(k):
        ends = [(places[j, i], vectors[j] if places[j, i] != unit[i] else base) for j in (i, i + k)]
        known = [(place, vector) for place, vector in ends if vector is not None]
        (a, high), (b, low) = known if len(known) == 2 else [*known, (unit[i], base)][:2]
        if a != b:
            slopes[:, i] = (high - low) / (a - b)
    return slopes


def vectors_at(
    problem: Problem, responses: Responses, simulator: Simulator, places: Iterable[Array]
) -> list[Array | None]:
    """Return the vector of the curves at each place; None where a run fails."""
    space, predicted = problem.space, problem.objective.predicted
    outcomes = dict(simulator.run([space.dictionary(space.point(place)) for place in places]))
    vectors: list[Array | None] = []
    for _, (simulations, message, *_) in sorted(outcomes.items()):
        failed = message or predicted(simulations).failures
        vectors.append(None if failed else responses.vector(points_of(simulations)))
    return vectors


def sensitivity_of(optimum: Optimum) -> tuple[Array, Array]:
    """Return to which combinations of parameters the loops are sensitive.

    Returns
    -------
    singular_values : ndarray, shape (k,)
        Of the scaled slopes, the largest first.
    directions : ndarray, shape (k, k)
        Row i is the direction of value i, in the unit cube.
    """
    slopes = np.concatenate(optimum.scaled_slopes())
    _, values, directions = np.linalg.svd(slopes, full_matrices=False)
    return values, directions


def moves_of(weights: Array, slopes: Array) -> tuple[Array, Array]:
    """Return how far an estimate by weighted least squares moves, and the inverse normal matrix.

    A direction in which nothing moves is as uncertain as the bounds are wide. Time O(n k²).

    Parameters
    ----------
    weights : ndarray, shape (n,)
        The roots of the factors of the squares.
    slopes : ndarray, shape (n, k)
        By the place in the unit cube, of what is squared.

    Returns
    -------
    moves : ndarray, shape (n, k)
        By the deviation of each point.
    inverse : ndarray, shape (k, k)
    """
    left, values, right = np.linalg.svd(weights[:, np.newaxis] * slopes, full_matrices=False)
    noticed = np.maximum(values, float(np.sqrt(np.mean(weights**2))))
    return weights[:, np.newaxis] * (left / noticed) @ right, (right.T / noticed**2) @ right
