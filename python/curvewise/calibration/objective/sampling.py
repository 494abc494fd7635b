"""Whether points decide by the discrete Fréchet distance, and not the curves that they stand for.

A simulated point that passes from one end of a test's step to the other is half of it away from
both on its way, so that either side is a valley of its own. Steps of up to a third of the distance
make shallow ones, and searches from different seeds end alike (benchmarks/validation/README.md);
over steps of more than four distances no point passes. Points of a test are as far from steps of
the simulation, which a search keeps below two distances, whatever that does to the curve. A model
that is driven by a test has steps of its own, half again as long: up to two thirds are left to it.
Cost: O(n).

T. Eiter, H. Mannila, "Computing discrete Fréchet distance", CD-TR 94/64, TU Wien (1994): the
discrete distance is up to the longest step of the curves longer than the continuous one.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ...curves.inputs import Array
from ...curves.scaling import box
from ...curves.several_curves import as_points, curve_list
from .objective import Objective

__all__ = ["Sampling", "is_leash", "sampling_of_simulations", "sampling_of_tests"]

_SHORTEST, _LONGEST = 1.0 / 3.0, 4.0  # of steps that decide, in distances
_SIMULATED = 2.0 / 3.0  # the shortest of a simulation
_ROUND = 100  # to which the points are rounded up that would be enough


class Sampling(NamedTuple):
    """How a test, or a simulation, is sampled.

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


def sampling_of_tests(objective: Objective, distances: Array) -> list[Sampling]:
    """Return how the tests of such an objective are sampled, at distances from them."""
    return _samplings(objective, objective.experiments, distances, _SHORTEST)


def sampling_of_simulations(
    objective: Objective, simulations: Any, distances: Array
) -> list[Sampling]:
    """Return how simulations are sampled that have not failed, at distances from the tests."""
    curves = [as_points(simulation, "Q") for simulation in curve_list(simulations)]
    return _samplings(objective, curves, distances, _SIMULATED)


def _samplings(
    objective: Objective, curves: Sequence[Array], distances: Array, shortest: float
) -> list[Sampling]:
    assert objective.condition is not None
    is_scaled = objective.condition.scaled
    return [
        _sampling(curve / box(test)[1] if is_scaled else curve, float(distance), shortest)
        for test, curve, distance in zip(objective.experiments, curves, distances, strict=True)
    ]


def _sampling(curve: Array, distance: float, shortest: float) -> Sampling:
    steps = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    count = int(np.sum((steps > shortest * distance) & (steps <= _LONGEST * distance)))
    if count == 0:
        return Sampling(0, len(curve))
    points = steps.sum() / (_SHORTEST * distance) + 1.0
    return Sampling(count, _ROUND * math.ceil(points / _ROUND))
