"""The runs of all starts of a search, each as one vector: what their surfaces go through.

Starts share them, so that one that comes to where another has been takes few runs of its own. Cost:
O(n k) for the nearest of n runs in k parameters.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Ledger
from ..records.evaluation import Evaluation
from ..surfaces.kriged_surface import KrigedSurface

__all__ = ["NEAREST", "SharedRuns"]

NEAREST = 30  # runs that make a surface, at most; 3 k + 3 where that is more
# Directions around a point are known if in each of them the runs within _AROUND times a reach are
# spread by this much, in squares of the reach.
_AROUND, _SPREAD = 3.0, 0.3


class SharedRuns(ABC):
    """Runs that have succeeded: where they are, their vectors and values.

    Parameters
    ----------
    ledger : Ledger
        Whose earlier runs are the first.

    Attributes
    ----------
    points : ndarray, shape (n, k)
        In the unit cube.
    values : list of float
        What is minimised.
    """

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger
        self.has_slopes = ledger.has_slopes
        self._rows: dict[tuple[float, ...], int] = {}
        self.points = np.empty((0, ledger.dimensions))
        self.values: list[float] = []
        self._vectors: list[Array] = []
        self._slopes: dict[int, Array | None] = {}
        for point, run in ledger.earlier_runs:
            self.add(point, run)

    @property
    @abstractmethod
    def negligible(self) -> float:
        """Differences of the value below this do not count."""

    @abstractmethod
    def _taken(self, run: Evaluation) -> tuple[Array, float]:
        """Return the vector and the value of a run."""

    @abstractmethod
    def _known_slopes(self, number: int, by_curve: list[Array]) -> Array | None:
        """Return the slopes of a run's vector, shape (m, k), by those of its curves."""

    def number(self, point: Array) -> int | None:
        """Return the number here of the run at a point; None where there is none."""
        return self._rows.get(tuple(point))

    def add(self, point: Array, run: Evaluation) -> int | None:
        """Take a run in; return its number here, or None of one that has failed."""
        if run.failed:
            return None
        place = tuple(point)
        if place not in self._rows:
            self._rows[place] = len(self.values)
            vector, value = self._taken(run)
            self.points = np.vstack((self.points, point))
            self._vectors.append(vector)
            self.values.append(value)
        return self._rows[place]

    def slopes(self, number: int) -> Array | None:
        """Return the slopes of a run's vector where the model knows those of its curves."""
        if number not in self._slopes:
            by_curve = self._ledger.slopes(self.points[number])
            known = None if by_curve is None else self._known_slopes(number, by_curve)
            self._slopes[number] = known
            self.has_slopes &= known is not None
        return self._slopes[number]

    def least_known(self, centre: Array, reach: float) -> list[Array]:
        """Return the directions in which the runs around a point are spread too little, if any.

        As unit vectors, that in which they are spread least first.
        """
        offsets = (self.points - centre) / reach
        offsets = offsets[np.abs(offsets).max(axis=1) <= _AROUND]
        spread, directions = np.linalg.eigh(offsets.T @ offsets)
        return list(directions.T[spread < _SPREAD])

    def through_nearest(
        self, centre: Array, within: float, *, reduced: bool, most: int = NEAREST
    ) -> KrigedSurface:
        """Return the surface through the runs nearest to a point.

        Through the 2 k + 1 nearest, and through more as long as they are within a distance.
        """
        distances = np.abs(self.points - centre).max(axis=1)
        k = centre.size
        near = np.argsort(distances, kind="stable")[: max(most, 3 * k + 3)]
        near = near[: max(2 * k + 1, int(np.sum(distances[near] <= within)))]
        vectors = np.array([self._vectors[i] for i in near])
        return KrigedSurface(self.points[near], vectors, centre, reduced=reduced)
