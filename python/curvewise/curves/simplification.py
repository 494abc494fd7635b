"""A curve with fewer of its points, within a tolerance.

The fewest points under the continuous Fréchet distance (Imai & Iri, 1988; Godau, 1991), found in
breadth from the last point backwards. Or the method of Douglas & Peucker (1973), which splits a
section at its farthest point. The compiled library decides exactly.
"""

from __future__ import annotations

from typing import Literal, SupportsFloat, overload

import numpy as np
import numpy.typing as npt

from .._core import simplify as kept_rows
from .._options import check_choice, real_number
from .checks import checked_curve
from .great_circles import warn_of_longitudes
from .inputs import Array, CurveLike
from .named_curve import renamed

__all__ = ["EdgeMeasure", "simplify"]

EdgeMeasure = Literal["frechet", "hausdorff"]
"""The distance between an edge and the section of the curve that it replaces."""


@overload
def simplify(
    curve: CurveLike,
    tolerance: SupportsFloat,
    *,
    measure: EdgeMeasure = "frechet",
    return_rows: Literal[False] = False,
) -> Array: ...


@overload
def simplify(
    curve: CurveLike,
    tolerance: SupportsFloat,
    *,
    measure: EdgeMeasure = "frechet",
    return_rows: Literal[True],
) -> tuple[Array, npt.NDArray[np.int64]]: ...


def simplify(
    curve: CurveLike,
    tolerance: SupportsFloat,
    *,
    measure: EdgeMeasure = "frechet",
    return_rows: bool = False,
) -> Array | tuple[Array, npt.NDArray[np.int64]]:
    """Leave out points of a curve, within a tolerance.

    The first and the last point are kept. Each edge between two kept points replaces the section
    between them, and is within the tolerance of that section.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve. All coordinates have the same unit.
    tolerance : float
        The largest distance between an edge and its section, at least 0, in the unit of the
        coordinates. 0 leaves out only points that change nothing.
    measure : {"frechet", "hausdorff"}, default "frechet"
        The distance. "frechet": continuous Fréchet, with the fewest points for which this is
        possible. The whole result is within the tolerance by `frechet_continuous`. "hausdorff": no
        point left out is farther from its edge (Douglas & Peucker, as in most map programs). This
        is faster, needs more points, and can lose a section that goes back along its edge.
    return_rows : bool, default False
        Whether to return the indices of the kept points, too. They select times of the points.

    Returns
    -------
    points : ndarray, shape (k, d)
        The kept points. Shape (k, 1) for a curve of shape (n,).
    rows : ndarray of int64, shape (k,)
        Their indices, ascending; only with `return_rows`.

    Raises
    ------
    TypeError
        If `curve` does not hold real numbers.
    ValueError
        If `curve` is empty or not finite, `tolerance` is below 0 or nan, or `measure` is unknown.

    Warns
    -----
    UserWarning
        If the coordinates look like longitude and latitude, and the longitude jumps by more than
        180 between neighbours.

    Notes
    -----
    Exact: decisions that rounded arithmetic cannot make use integers. If several choices have the
    fewest points, each point is followed by the last possible one. Imai & Iri, "Polygonal
    approximations of a curve" (1988); Godau, "A natural metric for curves" (1991); Douglas &
    Peucker, "Algorithms for the reduction of the number of points required to represent a digitized
    line" (1973). "frechet" takes about O(n m) time if at most m successive points are within reach
    of an edge, O(n³) at worst; "hausdorff" O(n log n) for most curves, O(n²) at worst. Memory O(n).

    Examples
    --------
    >>> from curvewise.curves import simplify
    >>> track = [(0, 0), (4, 1), (8, -1), (12, 0), (12, 6)]  # metres
    >>> simplify(track, 2)
    array([[ 0.,  0.],
           [12.,  0.],
           [12.,  6.]])
    >>> there_and_back = [(0, 0), (9, 0), (5, 0), (10, 0)]
    >>> simplify(there_and_back, 1, return_rows=True)[1]
    array([0, 1, 2, 3])
    >>> simplify(there_and_back, 1, measure="hausdorff", return_rows=True)[1]
    array([0, 3])
    """
    check_choice("measure", measure, ("frechet", "hausdorff"))
    largest = real_number("tolerance", tolerance, 0.0, "give a number >= 0")
    points = checked_curve(curve, 1)
    warn_of_longitudes(points, "project the track, or shift its longitudes by 360 behind the jump")
    rows = kept_rows(points, largest, measure == "frechet")
    kept = renamed(curve, points[rows])
    return (kept, rows) if return_rows else kept
