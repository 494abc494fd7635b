"""CMA-ES: minimum of a cheap function near a point of the unit cube.

Generations of points are drawn from a normal distribution. Its mean moves to the better half of
them, its covariance learns their directions, and its width follows the length of successive steps.
Small generations converge quickly to one local minimum, which need not be the one at the start.
Cost: members times generations evaluations, and about 0.1 ms for each generation.

N. Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...curves.inputs import Array

__all__ = ["evolved"]


def evolved(
    function: Callable[[Array], Array],
    start: Array,
    random: np.random.Generator,
    *,
    width: float = 0.3,
    members: int = 12,
    generations: int = 30,
    settled: float = 5e-3,
) -> Array:
    """Return the lowest of all points that are drawn, shape (k,).

    `function` takes points of the unit cube, shape (members, k), and returns their values. `start`
    and `width` are the first mean, and the first standard deviation along every axis. The search
    ends after so many generations, or if the width of the cloud is below `settled`.
    """
    k = start.size
    weights = np.log(members / 2 + 0.5) - np.log(np.arange(1.0, members // 2 + 1.0))
    weights /= weights.sum()
    strength = 1.0 / float(weights @ weights)
    # The rates at which the paths and the covariance forget, as the tutorial has them (table 1).
    for_width = (strength + 2.0) / (k + strength + 5.0)
    for_path = (4.0 + strength / k) / (k + 4.0 + 2.0 * strength / k)
    of_path = 2.0 / ((k + 1.3) ** 2 + strength)
    of_members = 2.0 * (strength - 2.0 + 1.0 / strength) / ((k + 2.0) ** 2 + strength)
    damping = 1.0 + for_width + 2.0 * max(0.0, math.sqrt((strength - 1.0) / (k + 1.0)) - 1.0)
    usual = math.sqrt(k) * (1.0 - 1.0 / (4.0 * k) + 1.0 / (21.0 * k**2))

    mean, covariance = start, np.eye(k)
    path, path_of_width = np.zeros(k), np.zeros(k)
    lowest, best = np.inf, start
    for _ in range(generations):
        squares, axes = np.linalg.eigh(covariance)
        lengths = np.sqrt(np.maximum(squares, 1e-20))
        drawn = random.standard_normal((members, k)) * lengths @ axes.T
        points = np.clip(mean + width * drawn, 0.0, 1.0)
        values = function(points)
        order = np.argsort(values, kind="stable")[: members // 2]
        if values[order[0]] < lowest:
            lowest, best = float(values[order[0]]), points[order[0]]
        steps = (points[order] - mean) / width
        step = weights @ steps
        mean = mean + width * step
        whitened = axes @ (axes.T @ step / lengths)
        path_of_width = _followed(path_of_width, whitened, for_width, strength)
        travelled = float(np.linalg.norm(path_of_width)) / usual
        path = _followed(path, step if travelled < 2.0 else np.zeros(k), for_path, strength)
        covariance = (
            (1.0 - of_path - of_members) * covariance
            + of_path * np.outer(path, path)
            + of_members * (steps.T * weights) @ steps
        )
        width *= math.exp(for_width / damping * (travelled - 1.0))
        if width * math.sqrt(covariance.diagonal().max()) < settled:
            break
    return best


def _followed(path: Array, step: Array, rate: float, strength: float) -> Array:
    """Return an evolution path with one more step; part of the old path decays."""
    followed: Array = (1.0 - rate) * path + math.sqrt(rate * (2.0 - rate) * strength) * step
    return followed
