"""Whether the points of tests decide by the discrete Fréchet distance, and not their curves.

A simulated point that passes from one end of a test's step to the other is half of it away from
both on its way, so that either side is a valley of its own. Steps of up to a third of the distance
make shallow ones, and searches from different seeds end alike (benchmarks/validation/README.md);
over steps of more than four distances no point passes. Cost: O(n).

T. Eiter, H. Mannila, "Computing discrete Fréchet distance", CD-TR 94/64, TU Wien (1994): the
discrete distance is up to the longest step of the curves longer than the continuous one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from ...curves.scaling import box
from .objective import Objective

__all__ = ["Sampling", "is_leash", "sampling_of_tests"]

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


def sampling_of_tests(objective: Objective, distances: Array) -> list[Sampling]:
    """Return how the tests of such an objective are sampled, at distances from them."""
    assert objective.condition is not None
    is_scaled = objective.condition.scaled
    return [
        _sampling(test / box(test)[1] if is_scaled else test, float(distance))
        for test, distance in zip(objective.experiments, distances, strict=True)
    ]


def _sampling(test: Array, distance: float) -> Sampling:
    steps = np.linalg.norm(np.diff(test, axis=0), axis=1)
    shortest = _SHORTEST * distance
    count = int(np.sum((steps > shortest) & (steps <= _LONGEST * distance)))
    if count == 0:
        return Sampling(0, len(test))
    return Sampling(count, _ROUND * math.ceil((steps.sum() / shortest + 1.0) / _ROUND))
