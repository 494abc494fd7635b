"""A surface of curves, or of residuals, through runs: linear, and bent as the runs ask for.

Universal kriging, all coordinates at once: a linear trend, and a Matérn kernel (5/2) whose length
is a few times the bounds' range, so that the surface is the least bent of those that pass through
the runs: of k + 1 the plane, of more one with the curvature that a plane cannot have. Residuals may
enter as their coordinates in the span of the runs, n numbers in the place of m, so that what a
surface costs at a point does not grow with the number of residuals. Cost: O(n^3 + n^2 m) for n
runs of m coordinates, O(n m) for a point, and O(n^2) of reduced residuals.

J. Sacks, W. J. Welch, T. J. Mitchell, H. P. Wynn, "Design and analysis of computer experiments",
Statistical Science 4 (1989) 409-423; for interpolation in a region of trust S. M. Wild, R. G.
Regis, C. A. Shoemaker, "ORBIT: optimization by radial basis function interpolation in
trust-regions", SIAM J. Sci. Comput. 30 (2008) 3197-3219.
"""

from __future__ import annotations

import math
from copy import copy

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from .surfaces import ChainRule

__all__ = ["KrigedSurface"]

_ROOT = math.sqrt(5.0)
_LENGTH = 4.0  # of the kernel, in distances of the farthest run from the centre
_NUGGET = 1e-8  # of the kernel: what a solver that prints few digits may be off
_LEVEL = 1e-8  # the inverse of the variance of the trend's coefficients: none are unlikely


class KrigedSurface:
    """Residuals as a function of a point of the unit cube, through runs.

    Parameters
    ----------
    points : ndarray, shape (n, k)
        Where the runs are.
    residuals : ndarray, shape (n, m)
    centre : ndarray, shape (k,)
        About which the trend is written.
    reduced : bool
        Whether to return residuals as coordinates that keep lengths and angles alone, in the place
        of the residuals themselves.
    length : float, optional
        Of the kernel, in distances of the farthest run from the centre.
    """

    def __init__(
        self,
        points: Array,
        residuals: Array,
        centre: Array,
        *,
        reduced: bool,
        length: float = _LENGTH,
    ) -> None:
        count, k = points.shape
        if reduced and count < residuals.shape[1]:
            residuals = np.asarray(np.linalg.qr(residuals.T, mode="r")).T
        away = points - centre
        self._centre, self._length = centre, length
        self._extent = float(_lengths(away).max()) or 1.0
        self._places = away / self._extent
        kernel, _ = _kernel(_lengths(self._places[:, np.newaxis] - self._places), length)
        # The surface passes through the run at the centre exactly: gains are counted from it.
        kernel.ravel()[:: count + 1] += np.where(self._places.any(axis=1), _NUGGET, 0.0)
        system = np.zeros((count + k + 1, count + k + 1))
        system[:count, :count] = kernel
        system[:count, count] = system[count, :count] = 1.0
        system[:count, count + 1 :] = self._places
        system[count + 1 :, :count] = self._places.T
        system.ravel()[count * (count + k + 2) :: count + k + 2] = -_LEVEL
        known = np.zeros((count + k + 1, residuals.shape[1]))
        known[:count] = residuals
        solved = np.linalg.solve(system, known)
        self._weights, self._level, self._slopes = (
            solved[:count],
            solved[count : count + 1],
            solved[count + 1 :],
        )

    def at(self, point: Array) -> Array:
        """Return the residuals at a point, shape (m,), or at several, shape (points, m)."""
        place = (point - self._centre) / self._extent
        kernel, _ = _kernel(_lengths(place[..., np.newaxis, :] - self._places), self._length)
        return self._residuals(place, kernel)

    def with_slopes(self, point: Array) -> tuple[Array, Array]:
        """Return the residuals at a point, and their slopes, shape (m, k)."""
        place = (point - self._centre) / self._extent
        away = place - self._places
        kernel, by_distance = _kernel(_lengths(away), self._length)
        slopes = self._slopes + (by_distance[:, np.newaxis] * away).T @ self._weights
        return self._residuals(place, kernel), slopes.T / self._extent

    def with_chain_rule(self, point: Array) -> tuple[Array, ChainRule]:
        """Return the residuals at a point, and what turns a gradient by them into one by it."""
        place = (point - self._centre) / self._extent
        away = place - self._places
        kernel, by_distance = _kernel(_lengths(away), self._length)

        def chain_rule(gradient: Array) -> Array:
            bent: Array = (by_distance * (self._weights @ gradient)) @ away
            return (self._slopes @ gradient + bent) / self._extent

        return self._residuals(place, kernel), chain_rule

    def of_places(self, places: Rows | None) -> KrigedSurface:
        """Return the surface of some of the residuals, or of all where `places` is None."""
        if places is None:
            return self
        some = copy(self)
        some._weights, some._level, some._slopes = (
            part[:, places] for part in (self._weights, self._level, self._slopes)
        )
        return some

    def _residuals(self, place: Array, kernel: Array) -> Array:
        residuals: Array = self._level[0] + place @ self._slopes + kernel @ self._weights
        return residuals


def _lengths(vectors: Array) -> Array:
    """Return the lengths of vectors along the last axis: norm's bits, without its checks."""
    lengths: Array = np.sqrt(np.add.reduce(vectors * vectors, axis=-1))
    return lengths


def _kernel(distance: Array, length: float) -> tuple[Array, Array]:
    """Return the kernel at distances, and its derivative divided by the distance."""
    scaled = _ROOT / length * distance
    decay = np.exp(-scaled)
    linear = 1.0 + scaled
    return (linear + scaled * scaled / 3.0) * decay, -5.0 / (3.0 * length**2) * linear * decay
