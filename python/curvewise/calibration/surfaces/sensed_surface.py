"""A surface of curves that measures how far places are apart by what the curves feel of it.

Good runs have nearly the same curve: they lie on a thin tube through the unit cube, long in
directions that hardly move the curves and short in others, and these directions are not the axes. A
kernel of the plain distance cannot say that. So places are turned and stretched by the fourth root
of J^T J in parts of its trace, where J are the slopes of the curves at the best runs: those of a
plain surface first, and then those of the surface that comes of it. A ridge keeps directions in
which nothing moves. And curves enter as the inverse hyperbolic sine of how far they are from the
curve at the centre, in fifths of the tests' boxes, so that what is far from all tests does not bend
the surface where it is near them. The median error of predicted Fréchet distances is 0.17 to 0.44
times that of a plain surface (benchmarks/validation/README.md).

Cost: three surfaces and forty times their slopes, some 10 ms for 160 runs of 300 points.
"""

from __future__ import annotations

from copy import copy

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from .kriged_surface import KrigedSurface
from .surfaces import ChainRule

__all__ = ["SensedSurface"]

_FIFTHS = 5.0
_SENSED, _TIMES = 20, 2  # best runs whose slopes count, and how often these are found
_RIDGE, _POWER = 1e-3, 0.25
_LENGTH = 1.0  # of the kernel, in distances of the farthest run from the centre


class SensedSurface:
    """Curves, each as one vector, as a function of a point of the unit cube, through runs.

    Parameters
    ----------
    points : ndarray, shape (n, k)
        Where the runs are, the best first.
    vectors : ndarray, shape (n, m)
        Their curves.
    centre : int
        The number of the run through which the surface passes exactly.
    sides : ndarray, shape (m,)
        Of the test's box, for each coordinate.
    """

    def __init__(self, points: Array, vectors: Array, centre: int, sides: Array) -> None:
        self._centre, self._middle = points[centre], vectors[centre]
        self._unit = sides / _FIFTHS
        bent = np.arcsinh((vectors - self._middle) / self._unit)
        away = points - self._centre
        origin = np.zeros(points.shape[1])
        self._turn = np.eye(origin.size)
        self._surface = KrigedSurface(away, bent, origin, reduced=False)
        for _ in range(_TIMES):
            self._turn = self._sensed(away[:_SENSED])
            turned = away @ self._turn
            self._surface = KrigedSurface(turned, bent, origin, reduced=False, length=_LENGTH)

    def at(self, point: Array) -> Array:
        """Return the response at a point, shape (m,), or at several, shape (points, m)."""
        return self._unbent(self._surface.at(self._turned(point)))

    def with_slopes(self, point: Array) -> tuple[Array, Array]:
        """Return the response at a point, and its slopes, shape (m, k)."""
        bent, slopes = self._surface.with_slopes(self._turned(point))
        stretch = self._unit * np.cosh(bent)
        return self._unbent(bent), stretch[:, np.newaxis] * (slopes @ self._turn)

    def with_chain_rule(self, point: Array) -> tuple[Array, ChainRule]:
        """Return the response at a point, and what turns a gradient by it into one by the point."""
        bent, chain_rule = self._surface.with_chain_rule(self._turned(point))
        stretch = self._unit * np.cosh(bent)
        return self._unbent(bent), lambda gradient: self._turn @ chain_rule(gradient * stretch)

    def of_places(self, places: Rows | None) -> SensedSurface:
        """Return the surface of some of the coordinates, or of all where `places` is None."""
        if places is None:
            return self
        some = copy(self)
        some._surface = self._surface.of_places(places)
        some._middle, some._unit = self._middle[places], self._unit[places]
        return some

    def _turned(self, point: Array) -> Array:
        turned: Array = (point - self._centre) @ self._turn
        return turned

    def _unbent(self, bent: Array) -> Array:
        response: Array = self._middle + self._unit * np.sinh(bent)
        return response

    def _sensed(self, away: Array) -> Array:
        """Return what turns and stretches places by what the bent curves feel of it, symmetric."""
        squares = np.zeros_like(self._turn)
        for place in away:
            _, slopes = self._surface.with_slopes(place @ self._turn)
            by_place = slopes @ self._turn
            squares += by_place.T @ by_place
        trace = float(np.trace(squares))
        if trace == 0.0:
            return self._turn
        lengths, axes = np.linalg.eigh(squares / trace)
        turn: Array = (axes * (np.maximum(lengths, 0.0) + _RIDGE) ** _POWER) @ axes.T
        return turn
