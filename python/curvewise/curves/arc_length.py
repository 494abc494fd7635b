"""Arc length along a polyline, and the point of the polyline at a given arc length.

Lengths are added in point order. A search by bisection finds the segment: O(log n) a point.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .inputs import Array
from .scaling import box_scaled_differences

__all__ = [
    "arc_lengths",
    "box_scaled_arc_lengths",
    "corresponding_positions",
    "interpolate",
    "locate",
    "norms",
    "points_at",
]


def arc_lengths(curve: Array) -> Array:
    """Return the arc length, from the start, of every vertex of a curve of shape (n, 2).

    Beyond the range of a double it is inf, or nan where coordinates are infinite.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        return _summed(np.diff(curve, axis=0))


def box_scaled_arc_lengths(curve: Array, box_of: Array) -> Array:
    """Return those of a curve scaled by the bounding box of another, both of shape (., 2).

    The differences of the raw coordinates are used: far from the box, scaled coordinates have lost
    the bits in which they differ.
    """
    return _summed(box_scaled_differences(curve, box_of))


def _summed(edges: Array) -> Array:
    with np.errstate(over="ignore", invalid="ignore"):
        return np.concatenate([[0.0], np.cumsum(norms(edges))])


def norms(vectors: Array) -> Array:
    """Return sqrt(dx² + dy²) of vectors, shape (..., 2); squares may overflow."""
    dx, dy = np.moveaxis(vectors, -1, 0)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        squares = dx * dx + dy * dy
        in_range = (squares > 2.0**-900) & (squares < 2.0**1000)
        return np.asarray(np.where(in_range, np.sqrt(squares), np.hypot(dx, dy)))


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
    # The end is used if a segment has negligible extent, compared with the length of the curve.
    fraction = (position - lengths[segment]) / np.where(extent > 0, extent, 1.0)
    return segment, np.where(extent > 0, fraction, 1.0)


def interpolate(curve: Array, segment: npt.NDArray[np.intp], fraction: Array) -> Array:
    """Return the points at fractions of segments; of a curve of shape (n, 2) or one coordinate."""
    if curve.ndim == 2:
        fraction = fraction[..., np.newaxis]
    start, end = curve[segment], curve[segment + 1]
    # The exact end instead of start + (end - start): next to a large start a small end is lost.
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        return np.asarray(np.where(fraction == 1.0, end, start + fraction * (end - start)))


def points_at(curve: Array, parameters: Array, of_vertices: Array | None = None) -> Array:
    """Return the points of a curve at parameters, which by default are its vertices' indices."""
    index = np.arange(len(curve)) if of_vertices is None else of_vertices
    columns = curve.reshape(len(curve), -1).T
    return np.column_stack([np.interp(parameters, index, column) for column in columns])


def corresponding_positions(P: Array, Q: Array) -> tuple[npt.NDArray[np.intp], Array]:
    """Return, for every point of P, segment of Q and fraction of it at the same arc length."""
    s, t = _relative_arc_lengths(P), _relative_arc_lengths(Q)
    position = np.minimum(s * (t[-1] / s[-1]), t[-1])
    position[-1] = t[-1]  # whatever the rounding of the quotient
    return locate(t, position)


def _relative_arc_lengths(curve: Array) -> Array:
    largest = np.abs(curve).max(axis=0)
    # The original's divisor for a coordinate that is 0 throughout. It does not have an effect: 0 /
    # 1e-15.
    return arc_lengths(curve / np.where(largest > 0, largest, 1e-15))
