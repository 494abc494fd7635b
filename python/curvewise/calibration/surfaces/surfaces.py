"""Response surfaces of curves over the parameters: what they predict, and planes.

Each coordinate of each point has its own surface. The measure is evaluated exactly on predicted
curves. A surface therefore serves every measure and preserves its kinks. Simulations may differ in
their number of points (a solver with adaptive steps). They are then resampled at equal fractions of
their arc length, in units of the first one's bounding box. Cost: O(k) for every coordinate and k
parameters.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Protocol, TypeAlias

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows, thinned_rows
from ..objective.objective import Objective

__all__ = ["ChainRule", "PredictedCurves", "Responses", "Surface", "Surfaces", "regression"]

ChainRule: TypeAlias = Callable[[Array], Array]
"""Of a gradient, shape (coordinates,): by the parameters, shape (k,)."""

_log = logging.getLogger("curvewise.calibration")


class Responses:
    """Turns the simulations of one run into one vector, and such a vector back into curves.

    All simulations are resampled to the numbers of points of the first run's.
    """

    def __init__(self, simulations: Sequence[Array]) -> None:
        self._first = tuple(simulations)
        self.shapes = [curve.shape for curve in simulations]
        ends = np.cumsum([0, *(curve.size for curve in simulations)]).tolist()
        self._parts = [slice(*pair) for pair in pairwise(ends)]
        self._warned = False

    def vector(self, simulations: Sequence[Array]) -> Array:
        """Return the coordinates of all points of all curves."""
        pairs = zip(simulations, self._first, strict=True)
        curves = [q if q.shape == first.shape else self._resampled(q, first) for q, first in pairs]
        return np.concatenate([curve.ravel() for curve in curves])

    def slopes(self, by_curve: Sequence[Array] | None) -> Array | None:
        """Return the derivatives of that vector, (coordinates, k); None if they do not fit it."""
        if by_curve is None or [slopes.shape[:2] for slopes in by_curve] != self.shapes:
            return None
        return np.concatenate([slopes.reshape(-1, slopes.shape[2]) for slopes in by_curve])

    def curves(self, vector: Array) -> list[Array]:
        """Return the curves that a vector encodes, or their slopes, shape (n, d, k), by its own."""
        pairs = zip(self._parts, self.shapes, strict=True)
        return [vector[part].reshape(*shape, *vector.shape[1:]) for part, shape in pairs]

    def thinned_rows(self, most: int) -> list[Rows] | None:
        """Return the points that represent each curve of the first run, or None if all must."""
        rows = [thinned_rows(curve, most) for curve in self._first]
        fewer = any(len(kept) < len(curve) for kept, curve in zip(rows, self._first, strict=True))
        return rows if fewer else None

    def of_rows(self, rows: Sequence[Rows]) -> tuple[Responses, Rows]:
        """Return the responses of some points alone, and their coordinates' places in a vector."""
        numbers = self.curves(np.arange(self._parts[-1].stop, dtype=float))
        places = [of_curve[kept].ravel() for of_curve, kept in zip(numbers, rows, strict=True)]
        curves = [curve[kept] for curve, kept in zip(self._first, rows, strict=True)]
        return Responses(curves), np.concatenate(places).astype(np.intp)

    def _resampled(self, curve: Array, first: Array) -> Array:
        if not self._warned:
            _log.warning(
                "simulations have different numbers of points (%d and %d); they are resampled by "
                "arc length for the response surfaces, which is less exact: let the model return "
                "a fixed number of points",
                len(curve),
                len(first),
            )
            self._warned = True
        extent = np.ptp(first, axis=0)
        steps = np.diff(curve, axis=0) / np.where(extent > 0, extent, 1.0)
        length = np.concatenate(([0.0], np.cumsum(np.linalg.norm(steps, axis=1))))
        wanted = np.linspace(0.0, length[-1], len(first))
        return np.column_stack([np.interp(wanted, length, column) for column in curve.T])


class Surface(Protocol):
    """Curves, each as one vector, as a function of a point of the unit cube."""

    noise: float  # of the model, one standard deviation, in sides of the box

    def at(self, point: Array) -> Array:
        """Return the response at a point, shape (coordinates,), or at several, one a row."""

    def with_slopes(self, point: Array) -> tuple[Array, Array]:
        """Return it, and its derivatives, shape (coordinates, k)."""

    def with_chain_rule(self, point: Array) -> tuple[Array, ChainRule]:
        """Return it, and what turns a gradient by the coordinates into one by the point."""

    def of_places(self, places: Rows | None) -> Surface:
        """Return the surface of some of the coordinates, or of all if places is None."""


class PredictedCurves:
    """An objective as a function of the curves on a surface, of all their points or of `rows`.

    `show_activity` is called before every evaluation. Cost: that of the surface and of the measure.
    """

    def __init__(
        self,
        objective: Objective,
        responses: Responses,
        rows: list[Rows] | None,
        show_activity: Callable[[], None],
    ) -> None:
        self.objective, self._show_activity = objective, show_activity
        self.responses = responses
        self._places: Rows | None = None
        if rows is not None:
            self.responses, self._places = responses.of_rows(rows)

    def seen(self, surface: Surface) -> Surface:
        """Return the surface of the points that take part."""
        return surface.of_places(self._places)

    def value(self, vector: Array) -> float:
        """Return the objective of curves as one vector."""
        self._show_activity()
        return self.objective.predicted(self.responses.curves(vector)).value

    def values(self, seen: Surface, points: Array) -> Array:
        """Return the objective at several points, shape (points,), on a surface of `seen`."""
        return np.array([self.value(vector) for vector in seen.at(points)])

    def value_and_gradient(self, seen: Surface, point: Array) -> tuple[float, Array]:
        """Return the objective at a point, and its gradient, on a surface of `seen`."""
        self._show_activity()
        vector, chain_rule = seen.with_chain_rule(point)
        value, gradients = self.objective.value_and_gradient(self.responses.curves(vector))
        return value, chain_rule(np.concatenate([gradient.ravel() for gradient in gradients]))


class Surfaces:
    """Curves as linear functions of a point, which equal `base` at `centre`."""

    noise = 0.0

    def __init__(self, centre: Array, base: Array, slopes: Array) -> None:
        self.centre, self.base, self.slopes = centre, base, slopes

    def at(self, point: Array) -> Array:
        """Return the response at a point, or at several."""
        response: Array = self.base + (point - self.centre) @ self.slopes.T
        return response

    def with_slopes(self, point: Array) -> tuple[Array, Array]:
        """Return it, and its derivatives."""
        return self.at(point), self.slopes

    def with_chain_rule(self, point: Array) -> tuple[Array, ChainRule]:
        """Return it, and its chain rule."""
        return self.at(point), lambda gradient: gradient @ self.slopes

    def of_places(self, places: Rows | None) -> Surfaces:
        """Return the surfaces of some of the coordinates, or of all."""
        if places is None:
            return self
        return Surfaces(self.centre, self.base[places], self.slopes[places])


def regression(points: Array, responses: Array, centre: Array) -> Surfaces:
    """Return the planes that fit runs best, by least squares with a free intercept.

    `points` has the shape (m, k), `responses` (m, coordinates).
    """
    # Centred and scaled: runs may be 1e-3 apart.
    width = np.ptp(points, axis=0)
    width = np.where(width > 0, width, 1.0)
    design = np.column_stack((np.ones(len(points)), (points - centre) / width))
    coefficients = np.linalg.lstsq(design, responses, rcond=None)[0]
    return Surfaces(centre, coefficients[0], coefficients[1:].T / width)
