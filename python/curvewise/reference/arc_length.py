"""Arc length along a polyline, and the point of the polyline at a given arc length.

Lengths are added in point order. A search by bisection finds the segment: O(log n) a point.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .._curves import Array
from .scaling import range_exponent, times_power_of_two

__all__ = ["arc_lengths", "interpolate", "locate", "norms"]


def arc_lengths(curve: Array) -> Array:
    """Return the arc length, from the start, of every vertex of a curve of shape (n, 2).

    Beyond the range of a double it is inf, or nan where coordinates are infinite.
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        return np.concatenate([[0.0], np.cumsum(norms(np.diff(curve, axis=0)))])


def norms(vectors: Array) -> Array:
    """Return sqrt(dx² + dy²) of vectors, shape (..., 2), of which squares may be out of range."""
    exponent = range_exponent(vectors)
    dx, dy = np.moveaxis(times_power_of_two(vectors, -exponent), -1, 0)
    return times_power_of_two(np.sqrt(dx * dx + dy * dy), exponent)


def locate(lengths: Array, position: Array) -> tuple[npt.NDArray[np.intp], Array]:
    """Return on which segment, and at which fraction of it, each position is.

    Parameters
    ----------
    lengths : ndarray, shape (n,)
        Arc lengths of the vertices.
    position : ndarray
        Arc lengths from 0 to the last of `lengths`.
    """
    segment = np.searchsorted(lengths, position, side="right") - 1
    segment = np.clip(segment, 0, len(lengths) - 2)
    extent = lengths[segment + 1] - lengths[segment]
    # Where a point is repeated the segment has no extent, and any fraction is the same point.
    fraction = (position - lengths[segment]) / np.where(extent > 0, extent, 1.0)
    return segment, fraction


def interpolate(curve: Array, segment: npt.NDArray[np.intp], fraction: Array) -> Array:
    """Return the points at fractions of segments; of a curve of shape (n, 2) or one coordinate."""
    if curve.ndim == 2:
        fraction = fraction[..., np.newaxis]
    start, end = curve[segment], curve[segment + 1]
    return np.asarray(start + fraction * (end - start))
