"""Points between those of a track of longitudes and latitudes, along great circles.

A point of a great circle is a combination of the unit vectors of two points with the sines of the
arcs as weights. See K. Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985. Angles
use arctan2, which is accurate for short arcs, long arcs and near the poles. Time and memory O(n).
"""

from __future__ import annotations

import numpy as np

from .arc_length import locate
from .foreign_curves import warn
from .inputs import Array
from .sphere import check_on_sphere, in_space

__all__ = ["checked_track", "points_on_arcs", "warn_of_longitudes"]

# Cosine of half the arc, above which rounding turns the great circle by less than 1e-6.
_LEAST_COSINE = 1e-9


def checked_track(points: Array) -> Array:
    """Return a track with longitudes from -180 to 180, those that are there already unchanged."""
    if points.shape[1] != 2:
        raise ValueError(
            f"curve has shape {points.shape}; metric='haversine' needs 2 coordinates, longitude "
            "and latitude"
        )
    check_on_sphere(points, "curve")
    track = points.copy()
    track[:, 0] -= 360.0 * np.rint(track[:, 0] / 360.0)
    vectors = in_space(track)
    opposite = np.linalg.norm(vectors[1:] + vectors[:-1], axis=1) < _LEAST_COSINE
    if opposite.any():
        i = int(opposite.argmax())
        raise ValueError(
            f"points {i} and {i + 1} are opposite on the sphere, so that no one great circle joins "
            "them; add a point between them"
        )
    return track


def points_on_arcs(track: Array, parameters: Array, of_vertices: Array) -> Array:
    """Return the points of a track at parameters; vertices are unchanged."""
    segment, fraction = locate(of_vertices, parameters)
    start, end = track[segment], track[segment + 1]
    a, b = in_space(start), in_space(end)
    arc = 2.0 * np.arctan2(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
    weights = [np.where(arc > 0.0, np.sin(part * arc), part) for part in (1.0 - fraction, fraction)]
    x, y, z = (weights[0][:, np.newaxis] * a + weights[1][:, np.newaxis] * b).T
    between = np.degrees(np.column_stack([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))]))
    at = fraction[:, np.newaxis]
    return np.where(at == 0.0, start, np.where(at == 1.0, end, between))


def warn_of_longitudes(points: Array, remedy: str) -> None:
    """Warn if two columns look like longitude and latitude and the first jumps."""
    if points.shape[1] != 2 or (np.abs(points) > (360.0, 90.0)).any():
        return
    jumps = np.abs(np.diff(points[:, 0]))
    if jumps.size and jumps.max() > 180.0:
        i = int(jumps.argmax())
        warn(
            f"column 0 looks like a longitude, and jumps by {jumps[i]:.6g} between points {i} and "
            f"{i + 1}; {remedy}"
        )
