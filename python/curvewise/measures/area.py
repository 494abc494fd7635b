"""The area between two curves in the plane, and the quadrilaterals that it is the sum of.

Algorithm 1 of the paper. Time O(n + m + abs(n - m) log m), memory O(n + m).
"""

from __future__ import annotations

from .._core import area as compiled_area
from .._core import area_quads as compiled_area_quads
from .._docstrings import filled
from .._options import Crossing, Default, Missing, Spacing
from ..curves.inputs import CurveLike, as_curves
from ..curves.missing import skip_in_pair
from .results import AreaQuads

__all__ = ["area", "area_quads"]


@filled()
def area(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = Default.spacing,
    crossing: Crossing = Default.crossing,
    squared: bool = Default.squared,
    missing: Missing = Default.missing,
) -> float:
    """Area between two curves in the plane.

    By default the curve with fewer points is refined, its longest segment bisected again and
    again, until both have the same number; the value is the sum of the areas of the quadrilaterals
    between corresponding segments: the paper's Algorithm 1. It depends on how the curves were
    sampled. ``spacing="matched"`` does not: choose it where a test is compared with a simulation
    that has other increments. It is what ``preset="scaled"``, `Objective` and `identify` use.
    ``spacing="function"`` is the area between two functions of x: choose it for curves whose x
    never turns back.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves, each of at least 2 points.
    spacing : {"distance", "x", "arc_length", "matched", "function"}
        What the refinement measures a segment by. "distance" is sqrt(dx² + dy²), the paper's
        text. "x" is abs(dx), with which the paper's Table 4 was computed (within 1.4 %; on raw
        stress and strain "distance" gives 174 where the table says 45.1, because stress
        dominates the length): raw stress–strain loops want "x", or curves scaled by
        :func:`normalize`. "arc_length" gives each curve a vertex wherever the other has one, by
        relative arc length after scaling by P's box, so that the value does not depend on how
        either curve was sampled, as long as they do not cross; not symmetric then, as P's box
        scales. "matched" is no refinement, and survives noise too: see Notes. "function" is the
        exact integral of abs(f - g) over the x that both curves span, where f and g are linear
        between the points of P and of Q. The x of each curve must only rise or only fall. A curve
        with several points at one x jumps there.
    crossing : {"rearrange", "split"}
        What becomes of a quadrilateral that intersects itself; without effect on
        ``spacing="matched"`` and "function". "rearrange" (the paper) swaps two
        vertices until it is simple: the value jumps where a quadrilateral turns complex. "split"
        takes the two triangles at the crossing point, and does not jump there, which an optimiser
        likes. With either, "distance" and "x" jump where another segment becomes the longest, and
        "arc_length" where P's box loses a side.
    squared : bool
        Sum the squares of the areas instead (the paper's section 4, the analogue of
        sum-of-squares); with "matched", those of the pieces. With "function" the value is the
        integral of (f - g)².
    {missing}

    Returns
    -------
    float
        In units of x times units of y (squared: of that squared; with "function", of x times y
        squared). Symmetric to rounding, except
        with "arc_length" and "matched".

    Raises
    ------
    ValueError
        A curve is not finite, has fewer than 2 points or other than 2 coordinates; an unknown
        option; with "function", the x of a curve turns back, or the curves have no span of x in
        common.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Algorithm 1 of the paper; the cross product CD of its Eq. 6 is misprinted. Time
    O(n + m + abs(n - m) log m), memory O(n + m).

    "matched": coordinates are scaled by P's box. Let T be how many widths and heights of the box P
    travels, reversals of less than a third of it left out: 5 for a tension–compression–tension
    loop. Each curve is sampled at 50 T equal shares of its arc length, and the samples are matched
    by the warping path of :func:`dtw` with ``metric="cityblock"``; where T is above 280, with a
    window of 2e6 / T, so that the path takes no longer than there. It is cut into 10 T equal
    pieces. Between the ends of a piece the two curves, as they are, enclose a polygon; the value is
    the sum of the absolute values of these areas by Gauss's formula. So areas within a piece, a
    tenth of the box long, cancel where they have different signs, as those do that noise encloses.
    Seven tension–compression loops against themselves, in per cent of what moving them up by 5 %
    of their height gives (`benchmarks/validation/area_sampling.py`):

    ==================  =======  =========  ============
    second curve        default  "matched"  moved up too
    ==================  =======  =========  ============
    every second point   36–244      0–2.6        99–100
    60 increments        41–320      1–6         100–102
    noise of 2 % in y        32      4–17         98–101
    1 % in x and y       20–326     10–28         97–107
    ==================  =======  =========  ============

    The last column is that of "matched" for curves both changed and moved up: 100 would be perfect.
    What thinned curves give is what they really leave out. Its limits: outliers by a third of the
    height, at 1 % of the points and all to one side, add up to 30; where noise is above a tenth of
    the height, an objective has several minima along a line; what changes sides within a tenth of
    the box is not seen. Further vertices on the segments change nothing. Time O(n + m + (50 T)²),
    memory O(n + m).

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
    """
    if missing != "refuse":
        P, Q = skip_in_pair(P, Q, missing)
    return compiled_area(P, Q, (spacing, crossing, squared))


def area_quads(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = Default.spacing,
    crossing: Crossing = Default.crossing,
) -> AreaQuads:
    """Return the quadrilaterals whose areas :func:`area` adds up.

    Parameters
    ----------
    P, Q, spacing, crossing
        As for :func:`area`.

    Returns
    -------
    AreaQuads
        ``quads``, shape (k, 4, 2), and ``areas``, (k,). Quadrilateral i is (A[i], A[i+1], B[i+1],
        B[i]), where A is the curve with more points; one that was rearranged has its vertices in
        the order whose area is given, one that was split in the original order. With "matched",
        A is P, and an area is negative where it counts against its piece. With "function", A is
        P, the quadrilaterals are strips between two values of x, and the first and the last of
        these values are the common span.

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
    return AreaQuads(*compiled_area_quads(P, Q, {"spacing": spacing, "crossing": crossing}))
