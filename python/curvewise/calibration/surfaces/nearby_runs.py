"""Runs near a point, and the slopes of the curves there that they give.

Slopes are those of a plane that is fitted to the runs, the nearest counting most. A search looks
for such runs before it makes any, and so does what is said of its optimum. Cost: no runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from ...curves.inputs import Array
from ..records.evaluation import Evaluation
from .surfaces import Responses, regression

__all__ = ["NearbyRuns", "Run", "narrowest", "runs_near"]

Run: TypeAlias = tuple[Array, Evaluation]
"""A run with its place in the unit cube."""


class NearbyRuns(NamedTuple):
    """Runs near a point of the unit cube.

    Attributes
    ----------
    unit : ndarray, shape (k,)
        The point.
    points : ndarray, shape (m, k)
        Where the runs are.
    distances : ndarray, shape (m,)
        Their distances from the point: the largest of any coordinate.
    runs : list of Evaluation
        With their curves.
    """

    unit: Array
    points: Array
    distances: Array
    runs: list[Evaluation]

    def slopes(self, responses: Responses, alike: float) -> Array:
        """Return the slopes at the point; runs nearer than `alike` count about the same."""
        vectors = np.array([responses.vector(run.simulations or ()) for run in self.runs])
        weights = 1.0 / (self.distances + alike) ** 2
        return regression(self.points, vectors, self.unit, weights).slopes


def runs_near(
    unit: Array, runs: Sequence[Run], *, within: float, most: int | None = None
) -> NearbyRuns | None:
    """Return the runs near a point, or None where they are too few for a plane: less than k + 2.

    Parameters
    ----------
    unit : ndarray, shape (k,)
    runs : sequence of (ndarray, Evaluation)
    within : float
        The largest distance.
    most : int, optional
        Take only so many, the nearest; None is returned too if one of these is further away.
    """
    near = [(float(np.abs(place - unit).max()), place, r) for place, r in runs if r.simulations]
    if most is None:
        near = [one for one in near if one[0] <= within]
    else:
        near = sorted(near, key=lambda one: one[0])[:most]
    if len(near) < unit.size + 2 or max(distance for distance, _, _ in near) > within:
        return None
    distances, points, chosen = zip(*near, strict=True)
    return NearbyRuns(unit, np.array(points), np.array(distances), list(chosen))


def narrowest(offsets: Array) -> float:
    """Return how far points are spread in the direction in which they are spread least."""
    return float(np.linalg.svd(offsets, compute_uv=False)[-1])
