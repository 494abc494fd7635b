"""The area between two curves in similaritymeasures' arithmetic, and the quadrilaterals it sums.

This is the paper's Algorithm 1 (Jekel et al. 2018) as that package implements it. The curve with
fewer points gets one more point at a time, in the middle of the segment that is currently the
longest. All lengths are measured again between the rounded points, and ``numpy.interp`` gives a
midpoint's y. Vertical segments are therefore treated oddly: ``numpy.interp`` cannot interpolate
between two equal x, and returns the y of the segment's first point. The new point repeats that
point, the segment stays the longest, and every missing point is added at the same place. This
module reproduces this bitwise; :func:`curvewise.area` bisects such a segment. The areas of the
quadrilaterals between corresponding segments are added. O(n·(n − m)) time for the refinement, in
vectorised steps; O(n) memory.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array, CurveLike
from ._arrays import RealArray, plane_curve, real_array, vector

__all__ = [
    "area_between_two_curves",
    "get_arc_length",
    "is_simple_quad",
    "makeQuad",
    "poly_area",
]

# As given; the first two vertices swapped; the second and third of the original order swapped.
_VERTEX_ORDERS = np.array([[0, 1, 2, 3], [1, 0, 2, 3], [0, 2, 1, 3]])


def area_between_two_curves(exp_data: CurveLike, num_data: CurveLike) -> np.floating[Any]:
    """Compute the area between two curves in the plane.

    Parameters
    ----------
    exp_data, num_data : array_like, shapes (n, 2) and (m, 2)
        The curves. Further columns count towards the segment lengths only, as there. Midpoints
        in an integer curve are truncated, as there: give floats to avoid it.

    Returns
    -------
    area : numpy floating
        Sum of the quadrilaterals' areas, in units of x times units of y; nan where a coordinate
        is not finite.

    Raises
    ------
    ValueError
        If an array is not (n, 2), or one curve has a single point and the other has more.
    TypeError
        If input is complex, text, objects or masked.

    See Also
    --------
    curvewise.area : the same measure with lengths that are not re-measured, O((n − m) log m).

    Notes
    -----
    The paper's Algorithm 1 (Jekel et al. 2018), with the odd refinement of vertical segments that
    that package has: a segment between two equal x is not bisected. Its first point is repeated,
    and once such a segment is the longest, it takes all points that are still missing. Loops with
    vertical segments (two points of equal strain) want :func:`curvewise.area`. O(n·(n − m)) time,
    O(n) memory.

    Examples
    --------
    >>> from curvewise.compat import area_between_two_curves
    >>> float(area_between_two_curves([[0, 0], [1, 0], [2, 0]], [[0.0, 1.0], [2.0, 1.0]]))
    2.0
    """
    longer, shorter = plane_curve(exp_data, "exp_data"), plane_curve(num_data, "num_data")
    shorter_name = "num_data"
    if len(longer) < len(shorter):
        longer, shorter, shorter_name = shorter, longer, "exp_data"
    if len(shorter) == 1 < len(longer):
        raise ValueError(
            f"{shorter_name} has shape {shorter.shape}; a curve to be refined needs at least "
            "2 points"
        )
    with np.errstate(all="ignore"):
        refined = _refined(shorter, len(longer))
        x, y = (
            np.stack(
                [longer[:-1, axis], longer[1:, axis], refined[1:, axis], refined[:-1, axis]], axis=1
            )
            for axis in (0, 1)
        )
        area: np.floating[Any] = np.sum(_quad_areas(x, y))
    return area


def makeQuad(x: CurveLike, y: CurveLike) -> np.floating[Any]:
    """Compute the area of a quadrilateral, reordered if it intersects itself.

    Parameters
    ----------
    x, y : array_like, shape (4,)
        The vertices, one after the other. They are not changed.

    Returns
    -------
    area : numpy floating
        The polygon area of the first simple one of three orders: as given, with the first two
        vertices swapped, with the second and third swapped. If all are complex, the area of the
        last.

    Raises
    ------
    ValueError
        If there are not four vertices.
    TypeError
        If input is complex, text, objects or masked.

    Notes
    -----
    The "rearrange" rule of the paper's Algorithm 1. Constant time.

    Examples
    --------
    The unit square, whose sides cross in the order given:

    >>> from curvewise.compat import makeQuad
    >>> float(makeQuad([0, 1, 0, 1], [0, 1, 1, 0]))
    1.0
    """
    x, y = vector(x, "x"), vector(y, "y")
    if x.shape != (4,) or y.shape != (4,):
        raise ValueError(f"x has shape {x.shape} and y has shape {y.shape}; give four vertices")
    with np.errstate(all="ignore"):
        area: np.floating[Any] = _quad_areas(x[np.newaxis], y[np.newaxis])[0]
    return area


def is_simple_quad(ab: CurveLike, bc: CurveLike, cd: CurveLike, da: CurveLike) -> bool:
    """Return whether a quadrilateral does not intersect itself.

    Parameters
    ----------
    ab, bc, cd, da : array_like, shape (2,)
        Its edges as vectors, in order: from A to B, B to C, C to D, D to A.

    Returns
    -------
    simple : bool
        True if at least three of the four cross products of consecutive edges are >= 0, or at
        least three are <= 0.

    Raises
    ------
    ValueError
        If an edge does not have two coordinates.
    TypeError
        If input is complex, text, objects or masked.

    Notes
    -----
    The paper's Eq. 6, without its misprint. Constant time.

    Examples
    --------
    >>> from curvewise.compat import is_simple_quad
    >>> is_simple_quad([1, 0], [0, 1], [-1, 0], [0, -1])
    True
    >>> is_simple_quad([1, 1], [-1, 0], [1, -1], [-1, 0])
    False
    """
    edges = []
    for values, name in ((ab, "ab"), (bc, "bc"), (cd, "cd"), (da, "da")):
        edge = vector(values, name)
        if edge.shape != (2,):
            raise ValueError(f"{name} has shape {edge.shape}; give one edge as (dx, dy)")
        edges.append(edge)
    with np.errstate(all="ignore"):
        dx, dy = np.stack(edges, axis=1)
        return bool(_turns_one_way(dx, dy))


def poly_area(x: CurveLike, y: CurveLike) -> np.floating[Any]:
    """Compute the area of a polygon that does not intersect itself.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        The vertices, one after the other.

    Returns
    -------
    area : numpy floating
        Its area, >= 0, in units of x times units of y.

    Raises
    ------
    ValueError
        If x and y have different lengths, or are empty.
    TypeError
        If input is complex, text, objects or masked.

    Notes
    -----
    Gauss's (shoelace) formula. O(n) time and memory. It cancels where the polygon is far from the
    origin: move it there first if it is small.

    Examples
    --------
    >>> from curvewise.compat import poly_area
    >>> float(poly_area([0, 2, 0], [0, 0, 3]))
    3.0
    """
    x, y = vector(x, "x"), vector(y, "y")
    if len(x) != len(y):
        raise ValueError(f"x has {len(x)} entries and y has {len(y)}; give one of each per vertex")
    with np.errstate(all="ignore"):
        area: np.floating[Any] = _shoelace_areas(x[np.newaxis], y[np.newaxis])[0]
    return area


def get_arc_length(dataset: CurveLike) -> tuple[np.floating[Any], Array]:
    """Compute the length of a curve, and of each of its segments.

    Parameters
    ----------
    dataset : array_like, shape (n, d)
        The curve, of any number of coordinates.

    Returns
    -------
    arcLength : numpy floating
        The sum of the segments' Euclidean lengths.
    arcLengths : ndarray, shape (n − 1,)
        The lengths; computed in float64 whatever the dtype.

    Raises
    ------
    ValueError
        If an array is not (n, d).
    TypeError
        If input is complex, text, objects or masked.

    Notes
    -----
    O(n·d) time and memory.

    Examples
    --------
    >>> from curvewise.compat import get_arc_length
    >>> total, lengths = get_arc_length([[0, 0], [3, 4], [3, 5]])
    >>> float(total), lengths.tolist()
    (6.0, [5.0, 1.0])
    """
    curve = real_array(dataset, "dataset")
    if curve.ndim != 2:
        raise ValueError(f"dataset has shape {curve.shape}; give shape (n, d)")
    with np.errstate(all="ignore"):
        lengths = _segment_lengths(curve)
        # One after the other, as there: np.sum adds in pairs, which rounds otherwise.
        total: np.floating[Any] = np.cumsum([0.0, *lengths])[-1]
        return total, lengths


def _segment_lengths(points: RealArray) -> Array:
    steps = np.diff(points.astype(np.float64), axis=0)
    lengths: Array = np.sqrt(np.sum(steps * steps, axis=1))
    return lengths


def _refined(curve: RealArray, count: int) -> RealArray:
    """Return the curve with midpoints inserted in its longest segments, up to `count` points."""
    points = np.empty((count, curve.shape[1]), dtype=curve.dtype)
    points[: len(curve)] = curve
    lengths = np.empty(max(count - 1, 0))
    lengths[: len(curve) - 1] = _segment_lengths(curve)
    for n in range(len(curve), count):
        k = int(np.argmax(lengths[: n - 1]))
        x, y = _midpoint(points[k], points[k + 1])
        points[k + 2 : n + 1] = points[k + 1 : n]
        points[k + 1] = x  # also in any further column: that package's np.insert does so
        points[k + 1, 1] = y
        lengths[k + 2 : n] = lengths[k + 1 : n - 1]
        lengths[k : k + 2] = _segment_lengths(points[k : k + 3])
    return points


def _midpoint(start: RealArray, end: RealArray) -> tuple[np.floating[Any], np.floating[Any]]:
    # As there, also for a vertical segment: of two equal x, numpy.interp returns the last one's y,
    # which is that of `start`.
    if not start[0] < end[0]:
        start, end = end, start
    x = (start[0] + end[0]) / 2.0
    return x, np.interp(x, [start[0], end[0]], [start[1], end[1]])


def _quad_areas(x: RealArray, y: RealArray) -> RealArray:
    """Return the areas (k,) of quadrilaterals with vertices x, y of shape (k, 4)."""
    complex_as_given = ~_is_simple(x, y)
    swapped = _VERTEX_ORDERS[1]
    still_complex = complex_as_given & ~_is_simple(x[:, swapped], y[:, swapped])
    order = _VERTEX_ORDERS[complex_as_given.astype(np.intp) + still_complex]
    return _shoelace_areas(np.take_along_axis(x, order, 1), np.take_along_axis(y, order, 1))


def _is_simple(x: RealArray, y: RealArray) -> npt.NDArray[np.bool_]:
    return _turns_one_way(np.roll(x, -1, axis=1) - x, np.roll(y, -1, axis=1) - y)


def _turns_one_way(dx: RealArray, dy: RealArray) -> npt.NDArray[np.bool_]:
    """Tell for edge vectors of shape (..., 4) whether at least three turns have the same sense."""
    cross = dx * np.roll(dy, -1, axis=-1) - dy * np.roll(dx, -1, axis=-1)
    simple: npt.NDArray[np.bool_] = (np.sum(cross >= 0, axis=-1) > 2) | (
        np.sum(cross <= 0, axis=-1) > 2
    )
    return simple


def _shoelace_areas(x: RealArray, y: RealArray) -> RealArray:
    """Return the areas (k,) of polygons with vertices x, y of shape (k, n)."""
    # A product of a row and a column is bitwise identical to numpy's dot product of two vectors. If
    # the formula cancels, another order of summation would give other digits.
    forward = x[:, np.newaxis, :] @ np.roll(y, 1, axis=1)[:, :, np.newaxis]
    backward = y[:, np.newaxis, :] @ np.roll(x, 1, axis=1)[:, :, np.newaxis]
    areas: RealArray = 0.5 * np.abs(forward - backward)[:, 0, 0]
    return areas
