"""Runs near a point, and the derivatives of the curves there.

The derivatives are those of a kriging surrogate through the runs. A plane through the same runs
misses their curvature: standard errors of a power law's exponent were half of the right ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from ...curves.inputs import Array
from ..records.evaluation import Evaluation
from .kriged_surface import KrigedSurface
from .surfaces import Responses

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
        The points of the runs.
    distances : ndarray, shape (m,)
        Their distances from the point: the largest of any coordinate.
    runs : list of Evaluation
        With their curves.
    """

    unit: Array
    points: Array
    distances: Array
    runs: list[Evaluation]

    def slopes(self, responses: Responses) -> Array:
        """Return the derivatives of the curves at the point, shape (coordinates, k)."""
        vectors = np.array([responses.vector(run.simulations or ()) for run in self.runs])
        nearest = self.points[int(np.argmin(self.distances))]
        return KrigedSurface(self.points, vectors, nearest).with_slopes(self.unit)[1]


def runs_near(unit: Array, runs: Sequence[Run], *, within: float) -> NearbyRuns | None:
    """Return the runs near a point, or None if there are fewer than k + 2.

    Parameters
    ----------
    unit : ndarray, shape (k,)
    runs : sequence of (ndarray, Evaluation)
    within : float
        The largest distance.
    """
    near = [(float(np.abs(place - unit).max()), place, r) for place, r in runs if r.simulations]
    near = [one for one in near if one[0] <= within]
    if len(near) < unit.size + 2:
        return None
    distances, points, chosen = zip(*near, strict=True)
    return NearbyRuns(unit, np.array(points), np.array(distances), list(chosen))


def narrowest(offsets: Array) -> float:
    """Return how far points are spread in the direction in which they are spread least."""
    return float(np.linalg.svd(offsets, compute_uv=False)[-1])
