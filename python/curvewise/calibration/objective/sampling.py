"""Whether points decide by the discrete Fréchet distance, and not the curves that they stand for.

A simulated point that passes from one end of a test's step to the other is half of it away from
both on its way, so that either side is a valley of its own. Steps of up to a third of the distance
make shallow ones, and searches from different seeds end alike (benchmarks/validation/README.md);
over steps of more than four distances no point passes. Points of a test are as far from steps of
the simulation; what that does shows with points between its own. Cost: O(n), and of simulations
that of a Fréchet distance of up to twelve times as many points, once.

T. Eiter, H. Mannila, "Computing discrete Fréchet distance", CD-TR 94/64, TU Wien (1994): the
discrete distance is up to the longest step of the curves longer than the continuous one.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...curves.inputs import Array
from ...curves.scaling import box
from ...curves.several_curves import as_points, curve_list
from .objective import Objective

__all__ = ["FinerSimulations", "Sampling", "finer_simulations", "is_leash", "sampling_of_tests"]

_SHORTEST, _LONGEST = 1.0 / 3.0, 4.0  # of steps that decide, in distances
_ROUND = 100  # to which the points are rounded up that would be enough


class Sampling(NamedTuple):
    """How a test is sampled.

    Attributes
    ----------
    deciding : int
        How many of its steps decide.
    enough : int
        Of how many even points none would; those that it has, where none does.
    """

    deciding: int
    enough: int


def is_leash(objective: Objective) -> bool:
    """Return whether an objective is a Fréchet distance, or a mean of several."""
    condition = objective.condition
    return condition is not None and objective.measure == "frechet" and not condition.options


class FinerSimulations(NamedTuple):
    """What points between those of the simulations would do.

    Attributes
    ----------
    gain : float
        By how much the value would be lower, as a share of it; below 0 where it would be higher.
    enough : list of int
        Of how many even points each would have no step above a third of its new distance.
    """

    gain: float
    enough: list[int]


def sampling_of_tests(objective: Objective, distances: Array) -> list[Sampling]:
    """Return how the tests of such an objective are sampled, at distances from them."""
    return [
        _sampling(_lengths(test, sides), float(distance))
        for test, sides, distance in zip(
            objective.experiments, _sides(objective), distances, strict=True
        )
    ]


def finer_simulations(objective: Objective, simulations: Any, distances: Array) -> FinerSimulations:
    """Return what points between those of simulations do that are at distances from the tests."""
    curves = [as_points(simulation, "Q") for simulation in curve_list(simulations)]
    steps = [_lengths(curve, one) for curve, one in zip(curves, _sides(objective), strict=True)]
    of_all = zip(curves, steps, distances, strict=True)
    finer = objective.predicted([_refined(*of_one) for of_one in of_all])
    value = float(objective.weights @ distances)
    gain = 1.0 - finer.value / value if value > 0.0 else 0.0
    pairs = zip(steps, finer.terms, strict=True)
    return FinerSimulations(gain, [_enough(of_one, float(d)) for of_one, d in pairs])


def _sides(objective: Objective) -> list[Array]:
    """Return the lengths that count as 1 along each axis, for each test."""
    assert objective.condition is not None
    is_scaled = objective.condition.scaled
    return [box(test)[1] if is_scaled else np.ones(1) for test in objective.experiments]


def _lengths(curve: Array, sides: Array) -> Array:
    steps: Array = np.linalg.norm(np.diff(curve / sides, axis=0), axis=1)
    return steps


def _deciding(steps: Array, distance: float) -> NDArray[np.bool_]:
    return (steps > _SHORTEST * distance) & (steps <= _LONGEST * distance)


def _sampling(steps: Array, distance: float) -> Sampling:
    count = int(np.sum(_deciding(steps, distance)))
    return Sampling(count, _enough(steps, distance) if count > 0 else len(steps) + 1)


def _enough(steps: Array, distance: float) -> int:
    longest = _SHORTEST * distance
    if longest == 0.0 or steps.max(initial=0.0) <= longest:
        return len(steps) + 1
    points = float(steps.sum()) / longest + 1.0
    return _ROUND * math.ceil(points / _ROUND)


def _refined(curve: Array, steps: Array, distance: float) -> Array:
    """Return a curve with points between the ends of the steps that decide."""
    decides = _deciding(steps, distance)
    parts = np.ones(len(steps), dtype=int)
    parts[decides] = np.ceil(steps[decides] / (_SHORTEST * distance))
    first = np.cumsum(parts) - parts
    along = (np.arange(parts.sum()) - np.repeat(first, parts)) / np.repeat(parts, parts)
    places = np.append(np.repeat(np.arange(len(steps)), parts) + along, len(steps))
    rows = np.arange(len(curve))
    return np.column_stack([np.interp(places, rows, column) for column in curve.T])
