"""The runs of a search as vectors: the data that its surrogates interpolate, for all starts."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from ..problem.ledger import Ledger
from ..records.evaluation import Evaluation
from ..surfaces.inner_search import InnerSearch
from ..surfaces.kriged_surface import KrigedSurface, surface_by_sensitivity
from ..surfaces.surfaces import Surface, Surfaces
from .starts import WITHIN

__all__ = ["Noise", "Runs"]

_NEAREST = 30  # runs that make a surrogate, at most; 3 k + 3 where that is more
# Directions around a point are known if in each of them the runs within _AROUND times a reach are
# spread by this much, in squares of the reach.
_AROUND, _SPREAD = 3.0, 0.3
_BEST, _SENSITIVE = 160, 20  # best runs in the surface by sensitivity, and of which it takes that
_NOISY = 1e-3  # of the bounding box: smaller noise counts as 0


class Noise(NamedTuple):
    """The model's own noise, one standard deviation; 0 if the runs show no noise."""

    of_curves: float  # of a coordinate, in side lengths of the test's bounding box
    of_value: float  # of the minimised value


class Runs:
    """Runs that have succeeded, those of earlier searches first: points, vectors and values.

    The inner search defines the vectors and the minimised value.
    """

    def __init__(self, ledger: Ledger, inner: InnerSearch) -> None:
        self._ledger, self.inner = ledger, inner
        self.has_slopes = ledger.has_slopes  # whether the model has a Jacobian
        # Whether a start has continued with the surrogate of the value alone.
        self.is_misled = False
        self.exhausted: list[Array] = []  # places where the global stage has found nothing
        self._rows: dict[tuple[float, ...], int] = {}
        self.points = np.empty((0, ledger.dimensions))
        self.values: list[float] = []
        self._vectors: list[Array] = []
        self._evaluations: list[Evaluation] = []
        self._slopes: dict[int, Array | None] = {}
        for point, run in ledger.earlier_runs:
            self.add(point, run)
        self.earlier = len(self.values)  # runs of earlier searches

    @property
    def best(self) -> int:
        """The number of the run with the smallest value."""
        return int(np.argmin(self.values))

    def number(self, point: Array) -> int | None:
        """Return the index of the run at a point, or None."""
        return self._rows.get(tuple(point))

    def add(self, point: Array, run: Evaluation) -> int | None:
        """Add a run; return its index, or None if the run failed."""
        if run.failed:
            return None
        place = tuple(point)
        if place not in self._rows:
            self._rows[place] = len(self.values)
            vector, value = self.inner.taken(run)
            self.points = np.vstack((self.points, point))
            self._vectors.append(vector)
            self.values.append(value)
            self._evaluations.append(run)
        return self._rows[place]

    def _slopes_of(self, number: int) -> Array | None:
        """Return the derivatives of a run's vector, if the model has a Jacobian."""
        if self.has_slopes and number not in self._slopes:
            by_curve = self._ledger.slopes(self.points[number])
            run = self._evaluations[number]
            known = None if by_curve is None else self.inner.slopes(run, by_curve)
            self.has_slopes &= known is not None
            self._slopes[number] = known
        return self._slopes.get(number)

    def is_exhausted(self, point: Array) -> bool:
        """Return whether restarts from next to a point have found nothing before."""
        return any(np.abs(point - place).max() <= WITHIN for place in self.exhausted)

    def least_known(self, centre: Array, reach: float) -> list[Array]:
        """Return the directions in which the runs around a point are spread too little, if any."""
        offsets = (self.points - centre) / reach
        offsets = offsets[np.abs(offsets).max(axis=1) <= _AROUND]
        spread, directions = np.linalg.eigh(offsets.T @ offsets)
        return list(directions.T[spread < _SPREAD])

    def surrogate(self, number: int, within: float, seen: Rows | None) -> Surface:
        """Return the plane of a run's derivatives, or the surface through the runs around it."""
        slopes = self._slopes_of(number)
        if slopes is not None:
            return Surfaces(self.points[number], self._vectors[number], slopes)
        return self.surface(number, within, seen)

    def surface(self, number: int, within: float, seen: Rows | None = None) -> KrigedSurface:
        """Return the surface through the 2 k + 1 nearest runs seen and those within reach."""
        among = self._among(seen)
        distances = np.abs(self.points[among] - self.points[number]).max(axis=1)
        k = self._ledger.dimensions
        near = np.argsort(distances, kind="stable")[: max(_NEAREST, 3 * k + 3)]
        near = near[: max(2 * k + 1, int(np.sum(distances[near] <= within)))]
        return self._through(number, among[near])

    def surface_through_best(self, number: int, seen: Rows | None) -> KrigedSurface:
        """Return the surface through the best runs seen, centred on one of them.

        If the objective has kinks, its metric is that of the curves' response.
        """
        chosen = self.best_of(_BEST, seen)
        if number not in chosen:
            chosen[-1] = number
        if self.inner.is_smooth:
            return self._through(number, chosen)
        vectors = np.array([self._vectors[i] for i in chosen])
        points, sides = self.points[chosen], self.inner.sides
        return surface_by_sensitivity(
            points, vectors, self.points[number], sides, points[:_SENSITIVE]
        )

    def best_of(self, most: int, seen: Rows | None) -> Rows:
        """Return the numbers of the `most` best runs seen, the best first."""
        among = self._among(seen)
        return among[np.argsort(np.array(self.values)[among], kind="stable")[:most]]

    def noise(self, number: int, reach: float) -> Noise:
        """Return the model's own noise around a run, by the runs within a few reaches."""
        surface = self.surface(number, _AROUND * reach)
        if surface.noise <= _NOISY:
            return Noise(0.0, 0.0)
        is_near = np.abs(self.points - self.points[number]).max(axis=1) <= _AROUND * reach
        smoothed = self.inner.values(surface, self.points[is_near])
        return Noise(surface.noise, float(np.std(np.array(self.values)[is_near] - smoothed)))

    def values_near(self, number: int, most: int) -> tuple[Array, Array]:
        """Return the points and values of the `most` runs that are nearest to one run."""
        distances = np.abs(self.points - self.points[number]).max(axis=1)
        near = np.argsort(distances, kind="stable")[:most]
        return self.points[near], np.array(self.values)[near]

    def _through(self, number: int, chosen: Rows) -> KrigedSurface:
        vectors = np.array([self._vectors[i] for i in chosen])
        return KrigedSurface(self.points[chosen], vectors, self.points[number], self.inner.sides)

    def _among(self, seen: Rows | None) -> Rows:
        return np.arange(len(self.values)) if seen is None else seen
