"""Checks whether sampling decides the discrete Fréchet distance of a test.

If a simulated point moves from one end of a test's step to the other, it is half the step away from
both on its way. Each end therefore has its own local minimum. Steps of up to a third of the
distance cause shallow minima, and searches from different seeds agree
(benchmarks/validation/README.md). If a step is longer than four distances, no point moves across
it. If the distance is that of the test's noise, no step decides. Cost: O(n).

T. Eiter, H. Mannila, "Computing discrete Fréchet distance", CD-TR 94/64, TU Wien (1994). The
discrete distance exceeds the continuous one by at most the longest step of the curves.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...curves.inputs import Array
from ...curves.scaling import box
from .noisy_tests import estimated_noise
from .objective import Objective

__all__ = ["Advice", "Sampling", "sampling_advice", "sampling_of_tests"]

_SHORTEST, _LONGEST = 1.0 / 3.0, 4.0  # of steps that decide, in distances
_OF_NOISE = 4.0  # standard deviations: the largest of about a hundred points
_ROUND = 100  # to which the points are rounded up that would be enough


class Sampling(NamedTuple):
    """The sampling of a test.

    Attributes
    ----------
    deciding : int
        Number of steps that decide the distance.
    enough : int
        Number of evenly spaced points with which no step would decide; the actual number if no step
        decides now.
    """

    deciding: int
    enough: int


class Advice(NamedTuple):
    """What may be said where sampling decides the value: of the search, and to its user."""

    message: str
    reason: str


def sampling_advice(objective: Objective, simulations: Any) -> Advice | None:
    """Return what to do where sampling decides the value of simulations, or None."""
    if simulations is None or not objective.is_largest_distance:
        return None
    tests = sampling_of_tests(objective, objective.predicted(simulations).terms)
    count = sum(test.deciding for test in tests)
    if count == 0:
        return None
    steps, verb = ("1 step", "is") if count == 1 else (f"{count} steps", "are")
    name, them = ("test", "it") if len(tests) == 1 else ("tests", "them")
    points = " and ".join(str(test.enough) for test in tests)
    return Advice(
        f"{steps} of the {name} {verb} longer than a third of the distance, so that points decide "
        f"which minimum is lowest: resample {them} evenly to {points} points "
        "(curvewise.curves.resample), and let the model return as many",
        "the points of the test are so far apart that they decide which fit is best; "
        f"compare by another measure, or resample the test evenly to {points} points",
    )


def sampling_of_tests(objective: Objective, distances: Array) -> list[Sampling]:
    """Return how the tests of such an objective are sampled, at distances from them.

    If the distance of a test is that of its noise, no step decides: more points would not help.
    """
    assert objective.condition is not None
    of_all = zip(objective.experiments, objective.y_columns, distances, strict=True)
    found = []
    for test, y, distance in of_all:
        sides = box(test)[1] if objective.condition.scaled else np.ones(test.shape[1])
        noise = estimated_noise(test, y) / sides[y]
        steps = np.linalg.norm(np.diff(test / sides, axis=0), axis=1)
        is_of_noise = distance <= _OF_NOISE * noise
        found.append(Sampling(0, len(test)) if is_of_noise else _sampling(steps, float(distance)))
    return found


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
