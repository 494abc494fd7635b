"""Universal kriging of curves: a surrogate of each coordinate of each point, through runs.

The model has a linear trend and a Matérn kernel (5/2) whose length is a few times the distance of
the farthest run. Through k + 1 runs it is a plane. Each coordinate is used directly, or as the
inverse hyperbolic sine of its distance from the central run; the likelihood selects one of the two.
Transformed, a run far outside the test's box bends the surface only slightly. The nugget, the
variance of the model's own noise as a fraction of the kernel's, is estimated by restricted maximum
likelihood (REML).

If the phase of curves depends strongly on the parameters, their surrogate by point number misleads.
The value varies more smoothly, and `lowest_value` kriges it instead. Cost: O(n^3 + n^2 m) for n
runs of m coordinates, and O(n m) for a point.

J. Sacks, W. J. Welch, T. J. Mitchell, H. P. Wynn, "Design and analysis of computer experiments",
Statistical Science 4 (1989) 409-423. H. D. Patterson, R. Thompson, "Recovery of inter-block
information when block sizes are unequal", Biometrika 58 (1971) 545-554, for REML.
"""

from __future__ import annotations

import math
from copy import copy

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from .quasi_newton import nonsmooth_descent
from .surfaces import ChainRule

__all__ = ["KrigedSurface", "lowest_value", "surface_by_sensitivity"]

_ROOT = math.sqrt(5.0)
_LENGTH = 4.0  # of the kernel, in distances of the farthest run from the centre
_NUGGETS = 10.0 ** np.arange(-8.0, 0.5, 0.5)
_FEWEST = 4  # degrees of freedom required to estimate noise
_EVIDENCE = 0.5  # and the gain in likelihood, its logarithm by coordinate and degree of freedom
_UNIT = 0.2  # of a side of the box, from which on coordinates count by their logarithm
_LARGEST = 100.0  # a transformed coordinate whose hyperbolic sine is still finite
# The metric of sensitivity: its rounds, the least share of a direction, and the power of shares.
_TIMES, _RIDGE, _POWER = 2, 1e-3, 0.25
_PLACES = 3  # random places from which the minimum of a value is sought


class KrigedSurface:
    """Curves, or residuals, as a function of a point of the unit cube, through runs.

    The runs have points, shape (n, k), and vectors, shape (n, m). The centre is the point of one of
    them, which the surface interpolates if there is no noise. `sides`, shape (m,), has the side of
    the bounding box along each coordinate; without it, coordinates are not transformed.

    `noise` is the standard deviation of the model's noise, in sides of the bounding box, or in the
    units of the coordinates; 0 if the runs show no noise.

    `metric`, a symmetric matrix of shape (k, k), stretches the directions of the cube in which
    distances count more, and shortens the kernel to the distance of the farthest run.
    """

    def __init__(
        self,
        points: Array,
        vectors: Array,
        centre: Array,
        sides: Array | None = None,
        metric: Array | None = None,
    ) -> None:
        count, k = points.shape
        self._centre, self._length = centre, _LENGTH if metric is None else 1.0
        self._metric = np.eye(k) if metric is None else metric
        away = (points - centre) @ self._metric
        self._extent = float(_lengths(away).max()) or 1.0
        self._places = away / self._extent
        kernel, _ = self._kernel(_lengths(self._places[:, np.newaxis] - self._places))
        trend = np.column_stack((np.ones(count), self._places))
        contrasts = _Contrasts(kernel, trend)
        nugget, deviation, likelihood = contrasts.nugget(vectors)
        self.noise, self._unit = deviation, None
        if sides is not None:
            self._base = vectors[int(np.argmin(np.add.reduce(away * away, axis=1)))]
            scaled = (vectors - self._base) / (_UNIT * sides)
            self.noise = deviation / float(sides.mean())
            transformed = np.arcsinh(scaled)
            found = contrasts.nugget(transformed)
            jacobian = -0.5 * float(np.log1p(scaled * scaled).sum()) - count * float(
                np.log(_UNIT * sides).sum()
            )
            if found[2] + jacobian > likelihood:
                vectors, (nugget, deviation, _) = transformed, found
                self._unit, self.noise = _UNIT * sides, _UNIT * deviation
        kernel.ravel()[:: count + 1] += nugget
        if deviation == 0.0:  # gains are counted from the run at the centre
            kernel.ravel()[:: count + 1] -= np.where(self._places.any(axis=1), 0.0, nugget)
        system = np.zeros((count + k + 1, count + k + 1))
        system[:count, :count] = kernel
        system[:count, count:], system[count:, :count] = trend, trend.T
        # The trend's coefficients have a prior, which is nearly uninformative.
        system.ravel()[count * (count + k + 2) :: count + k + 2] = -_NUGGETS[0]
        known = np.zeros((count + k + 1, vectors.shape[1]))
        known[:count] = vectors
        solved = np.linalg.solve(system, known)
        self._weights, self._trend = solved[:count], solved[count:]

    def at(self, point: Array) -> Array:
        """Return the coordinates at a point, shape (m,), or at several, shape (points, m)."""
        place = (point - self._centre) @ self._metric / self._extent
        kernel, _ = self._kernel(_lengths(place[..., np.newaxis, :] - self._places))
        return self._restored(self._transformed(place, kernel))

    def with_slopes(self, point: Array) -> tuple[Array, Array]:
        """Return the coordinates at a point, and their slopes, shape (m, k)."""
        vector, rates, slopes = self._with_slopes(point)
        return vector, (slopes if rates is None else slopes * rates).T @ self._metric / self._extent

    def with_chain_rule(self, point: Array) -> tuple[Array, ChainRule]:
        """Return the coordinates at a point, and what turns a gradient by them into one by it."""
        vector, rates, by_distance, away = self._bent(point)

        def chain_rule(gradient: Array) -> Array:
            by_vector = gradient if rates is None else gradient * rates
            bent: Array = (by_distance * (self._weights @ by_vector)) @ away
            return self._metric @ (self._trend[1:] @ by_vector + bent) / self._extent

        return vector, chain_rule

    def sensitivity(self, points: Array) -> Array:
        """Return how strongly the transformed coordinates respond to each direction, (k, k)."""
        squares = np.zeros_like(self._metric)
        for point in points:
            slopes = self._with_slopes(point)[2]
            squares += slopes @ slopes.T
        return self._metric @ squares @ self._metric

    def of_places(self, places: Rows | None) -> KrigedSurface:
        """Return the surface of some of the coordinates; all if `places` is None."""
        if places is None:
            return self
        some = copy(self)
        some._weights, some._trend = self._weights[:, places], self._trend[:, places]
        if self._unit is not None:
            some._base, some._unit = self._base[places], self._unit[places]
        return some

    def _with_slopes(self, point: Array) -> tuple[Array, Array | None, Array]:
        """Return the coordinates, their slopes by transformed ones, and those of these."""
        vector, rates, by_distance, away = self._bent(point)
        slopes = self._trend[1:] + (by_distance[:, np.newaxis] * away).T @ self._weights
        return vector, rates, slopes

    def _kernel(self, distance: Array) -> tuple[Array, Array]:
        """Return the kernel at distances, and its derivative divided by the distance."""
        scaled = _ROOT / self._length * distance
        decay = np.exp(-scaled)
        linear = 1.0 + scaled
        return (
            (linear + scaled * scaled / 3.0) * decay,
            -5.0 / (3.0 * self._length**2) * linear * decay,
        )

    def _transformed(self, place: Array, kernel: Array) -> Array:
        vector: Array = self._trend[0] + place @ self._trend[1:] + kernel @ self._weights
        return vector if self._unit is None else np.clip(vector, -_LARGEST, _LARGEST)

    def _restored(self, vector: Array) -> Array:
        if self._unit is None:
            return vector
        restored: Array = self._base + self._unit * np.sinh(vector)
        return restored

    def _bent(self, point: Array) -> tuple[Array, Array | None, Array, Array]:
        """Return the coordinates, their slopes by transformed ones, and the kernel's parts."""
        place = (point - self._centre) @ self._metric / self._extent
        away = place - self._places
        kernel, by_distance = self._kernel(_lengths(away))
        vector = self._transformed(place, kernel)
        rates = None if self._unit is None else self._unit * np.cosh(vector)
        return self._restored(vector), rates, by_distance, away


def surface_by_sensitivity(
    points: Array, vectors: Array, centre: Array, sides: Array | None, best: Array
) -> KrigedSurface:
    """Return a surface whose distances follow how far the curves move, at the `best` points.

    Good runs have nearly the same curve. They lie on a thin tube, long in directions to which the
    curves hardly respond. The metric is a power of the mean of J^T J, where J are the slopes.
    """
    surface = KrigedSurface(points, vectors, centre, sides)
    for _ in range(_TIMES):
        squares = surface.sensitivity(best)
        shares, axes = np.linalg.eigh(squares / (np.trace(squares) or 1.0))
        metric = axes * (np.maximum(shares, 0.0) + _RIDGE) ** _POWER @ axes.T
        surface = KrigedSurface(points, vectors, centre, sides, metric)
    return surface


class _Contrasts:
    """Coordinates without their trend, and their restricted likelihood."""

    def __init__(self, kernel: Array, trend: Array) -> None:
        count, columns = trend.shape
        self._free = count - columns
        if self._free >= _FEWEST:
            contrasts = np.linalg.qr(trend, mode="complete")[0][:, columns:]
            variances, axes = np.linalg.eigh(contrasts.T @ kernel @ contrasts)
            self._seen = (contrasts @ axes).T
            self._sums = np.maximum(variances, 0.0) + _NUGGETS[:, np.newaxis]

    def nugget(self, vectors: Array) -> tuple[float, float, float]:
        """Return the nugget by REML, the noise's deviation, and the logarithm of the likelihood."""
        smallest = float(_NUGGETS[0])
        if self._free < _FEWEST:
            return smallest, 0.0, np.inf
        seen = self._seen @ vectors
        squares = np.add.reduce(seen * seen, axis=1)
        count = self._free * vectors.shape[1]
        scale = (squares / self._sums).sum(axis=1) / count
        if not scale.all():
            return smallest, 0.0, np.inf
        likelihoods = -0.5 * (
            vectors.shape[1] * np.log(self._sums).sum(axis=1) + count * np.log(scale)
        )
        best = int(np.argmax(likelihoods))
        if likelihoods[best] - likelihoods[0] < _EVIDENCE * count:
            best = 0
        nugget = float(_NUGGETS[best])
        deviation = math.sqrt(nugget * float(scale[best])) if best > 0 else 0.0
        return nugget, deviation, float(likelihoods[best])


def _lengths(vectors: Array) -> Array:
    """Return the lengths of vectors along the last axis: norm's bits, without its checks."""
    lengths: Array = np.sqrt(np.add.reduce(vectors * vectors, axis=-1))
    return lengths


def lowest_value(
    points: Array,
    values: Array,
    centre: Array,
    low: Array,
    high: Array,
    random: np.random.Generator,
) -> tuple[Array, float]:
    """Return the minimiser in a box of a surface through values, and its gain over the centre.

    The centre is one of the points. Cost: about 100 evaluations of the surface.
    """
    least = np.finfo(float).tiny
    surface = KrigedSurface(points, np.log(np.maximum(values, least))[:, np.newaxis], centre)
    width = np.where(high > low, high - low, 1.0)

    def function(place: Array) -> tuple[float, Array]:
        value, slopes = surface.with_slopes(low + place * width)
        return float(value[0]), slopes[0] * width

    starts = [(centre - low) / width, *random.random((_PLACES, centre.size))]
    found = [nonsmooth_descent(function, start, negligible=0.0, most=50) for start in starts]
    points_found = np.clip(low + np.array(found) * width, low, high)
    predicted = np.exp(surface.at(points_found)[:, 0])
    best = int(np.argmin(predicted))
    return points_found[best], float(np.exp(surface.at(centre)[0]) - predicted[best])
