"""Linear response surfaces of curves over the parameters.

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

__all__ = ["ChainRule", "Responses", "Surface", "Surfaces", "regression"]

ChainRule: TypeAlias = Callable[[Array], Array]
"""Of a gradient, shape (coordinates,): by the parameters, shape (k,)."""

_log = logging.getLogger("curvewise.calibration")


class Responses:
    """Turns the simulations of one run into one vector, and such a vector back into curves.

    Parameters
    ----------
    simulations : sequence of ndarray, shape (n, d)
        The simulations of a reference run; the others are resampled to its numbers of points.
    """

    def __init__(self, simulations: Sequence[Array]) -> None:
        self._first = tuple(simulations)
        self.shapes = [curve.shape for curve in simulations]
        self._extents = [np.ptp(curve, axis=0) for curve in simulations]
        ends = np.cumsum([0, *(curve.size for curve in simulations)]).tolist()
        self._parts = [slice(*pair) for pair in pairwise(ends)]
        self._warned = False

    def vector(self, simulations: Sequence[Array]) -> Array:
        """Return the coordinates of all points of all curves."""
        curves = [
            curve if curve.shape == shape else self._resampled(curve, shape[0], extent)
            for curve, shape, extent in zip(simulations, self.shapes, self._extents, strict=True)
        ]
        return np.concatenate([curve.ravel() for curve in curves])

    def slopes(self, by_curve: Sequence[Array] | None) -> Array | None:
        """Return the derivatives of that vector, shape (coordinates, k).

        The argument holds derivatives of the curves' points, shape (n, d, k). Return None if it is
        None, or if the numbers of points differ.
        """
        if by_curve is None or [slopes.shape[:2] for slopes in by_curve] != self.shapes:
            return None
        return np.concatenate([slopes.reshape(-1, slopes.shape[2]) for slopes in by_curve])

    def curves(self, vector: Array) -> list[Array]:
        """Return the curves that a vector encodes."""
        pairs = zip(self._parts, self.shapes, strict=True)
        return [vector[part].reshape(shape) for part, shape in pairs]

    def thinned_rows(self, most: int) -> list[Rows] | None:
        """Return the points that represent each curve, or None if all must.

        The curves of the first run decide; see `thinned_rows`.
        """
        rows = [thinned_rows(curve, most) for curve in self._first]
        fewer = any(len(kept) < len(curve) for kept, curve in zip(rows, self._first, strict=True))
        return rows if fewer else None

    def of_rows(self, rows: Sequence[Rows]) -> Responses:
        """Return the same for curves of some of the points alone."""
        return Responses([curve[kept] for curve, kept in zip(self._first, rows, strict=True)])

    def places_of_rows(self, rows: Sequence[Rows]) -> Rows:
        """Return where in a vector the coordinates of some of the points are."""
        numbers = self.curves(np.arange(sum(curve.size for curve in self._first), dtype=float))
        places = [of_curve[kept].ravel() for of_curve, kept in zip(numbers, rows, strict=True)]
        return np.concatenate(places).astype(np.intp)

    def _resampled(self, curve: Array, count: int, extent: Array) -> Array:
        if not self._warned:
            _log.warning(
                "simulations have different numbers of points (%d and %d); they are resampled by "
                "arc length for the response surfaces, which is less exact: let the model return "
                "a fixed number of points",
                len(curve),
                count,
            )
            self._warned = True
        return resampled(curve, count, extent)


def resampled(curve: Array, count: int, extent: Array) -> Array:
    """Return points at equal fractions of the arc length, in units of an extent.

    Parameters
    ----------
    curve : ndarray, shape (n, d)
    count : int
        Number of points to return.
    extent : ndarray, shape (d,)
        The divisors of the coordinates for the length; 0 counts as 1.
    """
    steps = np.diff(curve, axis=0) / np.where(extent > 0, extent, 1.0)
    length = np.concatenate(([0.0], np.cumsum(np.linalg.norm(steps, axis=1))))
    wanted = np.linspace(0.0, length[-1], count)
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


class Surfaces:
    """Curves as linear functions of a point of the unit cube.

    Attributes
    ----------
    centre : ndarray, shape (k,)
        The point at which the surfaces equal `base`.
    base : ndarray, shape (coordinates,)
        The response there.
    slopes : ndarray, shape (coordinates, k)
        Its derivatives.
    """

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
        """Return it, and what turns a gradient by the coordinates into one by the point."""
        return self.at(point), lambda gradient: gradient @ self.slopes

    def of_places(self, places: Rows | None) -> Surfaces:
        """Return the surfaces of some of the coordinates, or of all."""
        if places is None:
            return self
        return Surfaces(self.centre, self.base[places], self.slopes[places])


def regression(points: Array, responses: Array, centre: Array, weights: Array) -> Surfaces:
    """Return the surfaces that fit runs best, by weighted least squares with a free intercept.

    Parameters
    ----------
    points : ndarray, shape (m, k)
    responses : ndarray, shape (m, coordinates)
    centre : ndarray, shape (k,)
    weights : ndarray, shape (m,)
    """
    # Centred and scaled: runs may be 1e-3 apart.
    width = np.ptp(points, axis=0)
    width = np.where(width > 0, width, 1.0)
    root = np.sqrt(weights)[:, np.newaxis]
    design = root * np.column_stack((np.ones(len(points)), (points - centre) / width))
    coefficients = np.linalg.lstsq(design, root * responses, rcond=None)[0]
    return Surfaces(centre, coefficients[0], coefficients[1:].T / width)
