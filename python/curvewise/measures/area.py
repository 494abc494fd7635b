"""The area between two curves in the plane, and the quadrilaterals that it is the sum of.

Algorithm 1 of the paper. Time O(n + m + abs(n - m) log m), memory O(n + m).
"""

from __future__ import annotations

from .._core import area as compiled_area
from .._core import area_quads as compiled_area_quads
from .._options import Crossing, Missing, Spacing
from ..curves.inputs import CurveLike, as_curves
from ..curves.missing import skip_in_pair
from .results import AreaQuads

__all__ = ["area", "area_quads"]


# Shared text: missing
def area(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = "distance",
    crossing: Crossing = "rearrange",
    squared: bool = False,
    closed: bool = False,
    missing: Missing = "refuse",
) -> float:
    """Compute the area between two curves in the plane.

    By default, this is the paper's Algorithm 1. The longest segments of the curve with fewer points
    are bisected until both curves have the same number of points. The value is the sum of the areas
    of the quadrilaterals between corresponding segments. It depends on the sampling of the curves.
    ``spacing="matched"`` does not: choose it to compare a test with a simulation that has other
    increments. ``preset="scaled"``, `Objective` and `identify` use it. ``spacing="function"`` is
    the area between two functions of x: choose it for curves whose x never reverses.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves, each of at least 2 points.
    spacing : {"distance", "x", "arc_length", "matched", "function"}
        The definition of a segment's length for the refinement, or another method. With "distance"
        it is sqrt(dx² + dy²), as in the paper's text. With "x" it is abs(dx), which reproduces the
        paper's Table 4 within 1.4 %. On raw stress and strain "distance" gives 174 instead of the
        table's 45.1, because stress dominates the length: use "matched" or "x" for raw
        stress–strain loops, or scale the curves by :func:`normalize`. With "x" and evenly spaced x,
        rounding decides which segment is the longest. The option "arc_length" gives each curve a
        vertex wherever the other has one, by relative arc length after scaling by P's bounding box.
        The value then does not depend on the sampling of either curve, as long as they do not
        cross. It is not symmetric, because P's box scales. "matched" replaces the refinement and is
        robust to noise too: see Notes. "function" is the exact integral of abs(f - g) over the x
        that both curves span. Here f and g interpolate P and Q linearly. The x of each curve must
        only rise or only fall. A curve with several points at one x jumps there.
    crossing : {"rearrange", "split", "polygon"}
        The treatment of a quadrilateral that intersects itself; without effect on
        ``spacing="matched"`` and "function". "rearrange" (the paper) swaps two vertices until it is
        simple: the value jumps when a quadrilateral becomes complex. "split" uses the two triangles
        at the crossing point and does not jump there, which suits optimisers. With either,
        "distance" and "x" jump when another segment becomes the longest, and "arc_length" when P's
        box becomes flat. "polygon" needs ``closed=True``, and replaces quadrilaterals: the value is
        the exact area that exactly one of the two closed curves encloses. See Notes.
    squared : bool
        Whether to sum the squares of the areas instead (the paper's section 4, the analogue of
        sum-of-squares); with "matched", those of the sections. With "function" the value is the
        integral of (f - g)². Not with "polygon".
    closed : bool, default False
        Whether both curves are closed. An edge then leads from the last point to the first one; a
        last point that equals the first one only closes a curve. The value is the smallest over
        the points at which Q may begin. Not with "function".
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        The area, in units of x times units of y (squared: the square of that; with "function", x
        times y squared). Symmetric to rounding, except with "arc_length" and "matched", and if
        ``closed=True`` only with "polygon".

    Raises
    ------
    ValueError
        If a curve is not finite, has fewer than 2 points or other than 2 coordinates. If an option
        is unknown, or does not fit the others. With "function", if the x of a curve reverses, or
        the curves do not share a span of x.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Algorithm 1 of the paper; the cross product CD of its Eq. 6 is misprinted. Time
    O(n + m + abs(n - m) log m), memory O(n + m).

    "matched": coordinates are scaled by P's bounding box. Let T be the number of widths and heights
    of the box that P travels, without reversals of less than a third of it: 5 for a
    tension–compression–tension loop. Each curve is sampled at 50 T equal fractions of its arc
    length. The samples are matched by the warping path of :func:`dtw` with ``metric="cityblock"``.
    If T is above 280, the path has a window of 2e6 / T, which limits its time. The path is cut into
    10 T equal sections. Between the ends of a section, the two unscaled curves enclose a polygon.
    The value is the sum of the absolute values of these areas by Gauss's formula. Areas of
    different sign within a section, a tenth of the box long, cancel, as those due to noise do. The
    table compares seven tension–compression loops with themselves, in per cent of the value for a
    shift by 5 % of their range of y (`benchmarks/validation/area_sampling.py`):

    ==================  =======  =========  ============
    second curve        default  "matched"  moved up too
    ==================  =======  =========  ============
    every second point   36–244      0–2.6        99–100
    60 increments        41–320      1–6         100–102
    noise of 2 % in y        32      4–17         98–101
    1 % in x and y       20–326     10–28         97–107
    ==================  =======  =========  ============

    The last column is "matched" for curves that are both changed and shifted: 100 would be perfect.
    The values of thinned curves are the area that they really omit. Limits: outliers by a third of
    the range of y, at 1 % of the points and all to one side, add up to 30. If noise is above a
    tenth of the range of y, an objective has several minima along a line. A curve that changes
    sides within a tenth of the box is not detected. Further vertices on the segments do not change
    the value. Time O(n + m + (50 T)²), memory O(n + m).

    ``closed=True``: with "distance" and "x", every pairing of points in order is tried if Q has at
    least as many points as P. The first point of P then matters only for ties of lengths. Time is
    at most m times that of open curves.

    "polygon": a point is inside a curve that winds around it (the nonzero rule), in either
    direction. Curves may cross themselves and each other, and go around several times. The value
    does not depend on first points, directions or sampling, and `spacing` has no effect. Between
    neighbouring x of points and of crossings, edges have a fixed order; each gap between them is
    inside both curves, one or neither (the slabs of Shamos & Hoey, 1976). Exact up to rounding.
    Time O((n + m + k) a log a), where a edges lie above each other and k pairs of them cross;
    memory O(n + m + a²).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.area([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 1)])
    2.0
    >>> loop = [(0, 0), (1, 3), (4, 4), (3, 1), (0, 0)]
    >>> thinned = loop[:1] + loop[2:]
    >>> round(curvewise.area(loop, thinned, spacing="matched"), 2)
    4.0
    >>> line, constant = [(0, 0), (4, 4)], [(0, 1), (0.5, 1), (4, 1)]
    >>> curvewise.area(line, constant, spacing="function")
    5.0
    >>> crossed = [(0, 1), (1, -1)], [(0, -1), (1, 1)]
    >>> curvewise.area(*crossed), curvewise.area(*crossed, crossing="split")
    (2.0, 1.0)
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> moved = [(3, 3), (1, 3), (1, 1), (3, 1), (3, 3)]
    >>> curvewise.area(square, moved, closed=True, crossing="polygon")
    6.0
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_area(P, Q, (spacing, crossing, squared, closed))


def area_quads(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = "distance",
    crossing: Crossing = "rearrange",
    closed: bool = False,
) -> AreaQuads:
    """Return the quadrilaterals whose areas :func:`area` adds up.

    Parameters
    ----------
    P, Q, spacing, crossing, closed
        As for :func:`area`.

    Returns
    -------
    AreaQuads
        ``quads``, shape (k, 4, 2), and ``areas``, (k,). Quadrilateral i is (A[i], A[i+1], B[i+1],
        B[i]), where A is the curve with more points. A rearranged quadrilateral has its vertices in
        the order of the area; a split one in the original order. With "matched", A is P, and an
        area is negative if it reduces the area of its section. With "function", A is P, the
        quadrilaterals are strips between two values of x, and the first and the last of these
        values are the common span. Of closed curves, Q begins at its best point. With "polygon",
        the quadrilaterals are trapezoids between two values of x.

    Raises
    ------
    ValueError, TypeError
        As for :func:`area`.

    Notes
    -----
    Algorithm 1 of the paper. Time and memory as for :func:`area`.

    Examples
    --------
    >>> import curvewise
    >>> quads, areas = curvewise.area_quads([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 1)])
    >>> quads.shape, areas.tolist()
    ((2, 4, 2), [1.0, 1.0])
    """
    P, Q = as_curves(P, Q)
    options = {"spacing": spacing, "crossing": crossing, "closed": closed}
    return AreaQuads(*compiled_area_quads(P, Q, options))
