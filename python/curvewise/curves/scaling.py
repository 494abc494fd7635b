"""Scaling by P's bounding box, and by powers of two against overflow.

Squares of numbers beyond 2**512 overflow and those of numbers below 2**-512 lose bits, although the
resulting distances are representable. Curves whose largest magnitude is beyond 2**±500 are
therefore multiplied by a power of two, and the result is multiplied back. This does not change any
bit of a number that stays in range. Time and memory O(n d).
"""

from __future__ import annotations

import math

import numpy as np

from .inputs import Array

__all__ = [
    "box",
    "box_scaled",
    "box_scaled_differences",
    "range_exponent",
    "times_power_of_two",
]

_LARGE = 2.0**500
_SMALL = 2.0**-500


def box(curve: Array) -> tuple[Array, Array]:
    """Return the smallest coordinates of a curve, and what to divide by: its extents, or 1."""
    low = curve.min(axis=0)
    extent = curve.max(axis=0) - low
    return low, np.where(extent == 0, 1.0, extent)


def box_scaled(curve: Array, box_of: Array) -> Array:
    """Return `curve` scaled by the bounding box of `box_of`, both of shape (., d).

    Each coordinate is scaled by its range of the box, so x may be as large as y is small.
    """
    scaled = np.empty(curve.shape)
    for c in range(curve.shape[1]):
        x, low, extent, _ = _in_range_of(curve[:, c], box_of[:, c])
        with np.errstate(over="ignore", under="ignore"):
            scaled[:, c] = (x - low) / extent
    return scaled


def box_scaled_differences(curve: Array, box_of: Array) -> Array:
    """Return the edges of a curve, shape (n - 1, d), scaled by the bounding box of another."""
    edges = np.empty((len(curve) - 1, curve.shape[1]))
    for c in range(curve.shape[1]):
        x, _, extent, exponent = _in_range_of(curve[:, c], box_of[:, c])
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            # First the difference, then the range, in which both may be infinite; the other way
            # round where the difference is.
            plain = np.diff(curve[:, c])
            in_range = np.where(np.isfinite(plain), np.ldexp(plain, -exponent), np.diff(x))
            edges[:, c] = in_range / extent
    return edges


def _in_range_of(x: Array, sides: Array) -> tuple[Array, float, float, int]:
    """Return a coordinate, the box's lower side, and its extent, in the box's range, and that."""
    exponent = range_exponent(sides) if sides.max() > sides.min() else 0
    x, sides = times_power_of_two(x, -exponent), times_power_of_two(sides, -exponent)
    low, extent = box(sides)
    return x, float(low), float(extent), exponent


def range_exponent(*arrays: Array) -> int:
    """Return k such that the arrays times 2**-k are neither too large nor too small to square.

    0, for no change, unless the largest magnitude is above 2**500 or (not 0 and) below 2**-500.
    """
    largest = max(float(np.max(np.abs(array), initial=0.0)) for array in arrays)
    if largest > _LARGE or 0 < largest < _SMALL:
        return math.frexp(largest)[1]
    return 0


def times_power_of_two(array: Array, exponent: int) -> Array:
    """Return array * 2**exponent; beyond the range of a double, inf."""
    if exponent == 0:
        return array
    with np.errstate(over="ignore", under="ignore"):
        return np.asarray(np.ldexp(array, exponent))
