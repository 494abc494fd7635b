"""The area between two curves: Algorithm 1 of the paper.

The curve with fewer points is refined until both have the same number of points. Corresponding
segments then form quadrilaterals, whose areas are added up. The signs of the cross products of
consecutive edges tell whether a quadrilateral intersects itself ("complex"). The area of a simple
one is half the cross product of its diagonals, which is Gauss's formula without its cancellation.
Time O(n + (n - m) log m), memory O(n).

With "matched", a warping path matches the curves instead (matching.py). Areas are signed then, and
cancel within each section of the path. With "function" the strips between two functions of x are
integrated instead (function_strips.py).

Closed curves are compared from each point of Q on. With "polygon", the trapezoids of the symmetric
difference are added up instead (symmetric_difference.py).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, get_args

import numpy as np
import numpy.typing as npt

from .._options import Crossing, Spacing, check_choice
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import range_exponent, times_power_of_two
from ..measures.results import AreaQuads
from .checks import check_pair
from .closed import without_repeated_end
from .function_strips import function_strips, strip_areas, strip_squares
from .matched_curves import Indices, matched_curves
from .refinement import facing_curves
from .symmetric_difference import symmetric_difference

__all__ = ["area", "area_quads"]


def area(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = "distance",
    crossing: Crossing = "rearrange",
    squared: bool = False,
    closed: bool = False,
) -> float:
    """Add up the areas of :func:`area_quads`, where cost and source are."""
    if crossing == "polygon" and squared:
        raise ValueError("crossing='polygon' has no squared; leave out squared=True")
    return min(_total(m, spacing, squared) for m in _measure(P, Q, spacing, crossing, closed))


def _total(measured: _Measured, spacing: Spacing, squared: bool) -> float:
    parts = measured.areas
    if spacing == "function" and squared:
        squares = np.asarray(np.sum(strip_squares(measured.quads)))
        return float(times_power_of_two(squares, 3 * measured.exponent))
    if measured.pieces is not None:
        with np.errstate(under="ignore"):
            parts = np.add.reduceat(parts, measured.pieces)
    with np.errstate(over="ignore", under="ignore"):
        total = np.asarray(np.sum(parts * parts if squared else parts))
    return float(times_power_of_two(total, (4 if squared else 2) * measured.exponent))


def area_quads(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = "distance",
    crossing: Crossing = "rearrange",
    closed: bool = False,
) -> AreaQuads:
    """Algorithm 1 of the paper; its Eq. 6 has a misprint: CD = (x4 - x3, y4 - y3).

    Time O(n + (n - m) log m) where n >= m, memory O(n); with "arc_length" O(n + m); with "matched"
    see matching.py. Closed curves take m times as long, the trapezoids of "polygon" the time of
    symmetric_difference.py.
    """
    quads, areas, exponent, _ = min(
        _measure(P, Q, spacing, crossing, closed), key=lambda m: _total(m, spacing, squared=False)
    )
    return AreaQuads(times_power_of_two(quads, exponent), times_power_of_two(areas, 2 * exponent))


class _Measured(NamedTuple):
    """Quadrilaterals and their areas, in units of 2**exponent and its square."""

    quads: Array
    areas: Array
    exponent: int
    pieces: Indices | None  # where each begins, of curves that were matched


def _measure(
    P: CurveLike, Q: CurveLike, spacing: Spacing, crossing: Crossing, closed: bool
) -> Iterator[_Measured]:
    """Measure the curves, if closed from each point of Q on."""
    P, Q = as_curves(P, Q)
    check_choice("spacing", spacing, get_args(Spacing))
    check_choice("crossing", crossing, get_args(Crossing))
    if crossing == "polygon" and not closed:
        raise ValueError("crossing='polygon' is for closed curves; add closed=True")
    if closed and spacing == "function":
        raise ValueError(
            "closed=True has no spacing='function'; choose from distance, x, arc_length, matched"
        )
    P, Q = check_pair(P, Q, "area", least_points=2, planar=True)
    exponent = range_exponent(P, Q)
    if crossing == "polygon":
        yield _Measured(*symmetric_difference(P, Q, exponent), exponent, None)
    elif closed:
        P, Q = without_repeated_end(P), without_repeated_end(Q)
        for start in range(len(Q)):
            around = np.roll(Q, -start, axis=0)
            yield _measure_open(
                np.vstack([P, P[:1]]), np.vstack([around, around[:1]]), exponent, spacing, crossing
            )
    else:
        yield _measure_open(P, Q, exponent, spacing, crossing)


def _measure_open(
    P: Array, Q: Array, exponent: int, spacing: Spacing, crossing: Crossing
) -> _Measured:
    if spacing == "function":
        strips = function_strips(P, Q, exponent)
        return _Measured(strips, strip_areas(strips), exponent, None)
    if spacing == "matched":
        P, Q = times_power_of_two(P, -exponent), times_power_of_two(Q, -exponent)
        return _measure_pieces(P, Q, exponent)
    quads = _between(*facing_curves(P, Q, spacing, exponent))
    with np.errstate(over="ignore", under="ignore"):
        quads, areas = _measured(quads, crossing)
    return _Measured(quads, areas, exponent, None)


def _measure_pieces(P: Array, Q: Array, exponent: int) -> _Measured:
    """Measure curves that were matched: an area is negative if it counts against its piece."""
    A, B, ends = matched_curves(P, Q)
    quads = _between(A, B)
    pieces = np.concatenate([[0], ends[:-1]])
    with np.errstate(under="ignore"):
        areas = 0.5 * _twice_signed_area(quads)
        signs = np.where(np.add.reduceat(areas, pieces) < 0, -1.0, 1.0)
    areas *= np.repeat(signs, np.diff(pieces, append=len(areas)))
    return _Measured(quads, areas, exponent, pieces)


def _between(A: Array, B: Array) -> Array:
    return np.stack([A[:-1], A[1:], B[1:], B[:-1]], axis=1)


def _measured(quads: Array, crossing: Crossing) -> tuple[Array, Array]:
    """Return quadrilaterals in the order whose area is taken, and the areas."""
    if crossing == "rearrange":
        quads = _rearranged(quads)
    areas = 0.5 * np.abs(_twice_signed_area(quads))
    if crossing == "split":
        is_complex = ~_is_simple(quads)
        split_areas = _areas_of_triangles(quads[is_complex])
        # If a corner lies on a side, up to rounding, one of the triangles vanishes and the other
        # equals the quadrilateral.
        areas[is_complex] = np.where(np.isnan(split_areas), areas[is_complex], split_areas)
    return quads, areas


def _cross(a: Array, b: Array) -> Array:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _is_simple(quads: Array) -> npt.NDArray[np.bool_]:
    """Say which do not intersect themselves: those that turn the same way at three corners."""
    edges = np.roll(quads, -1, axis=1) - quads
    turns = _cross(edges, np.roll(edges, -1, axis=1))
    left, right = (turns >= 0).sum(axis=1), (turns <= 0).sum(axis=1)
    return np.asarray(np.maximum(left, right) >= 3)


def _twice_signed_area(quads: Array) -> Array:
    """Return the cross product of the diagonals: positive if the corners turn left."""
    A, B, C, D = np.moveaxis(quads, 1, 0)
    return _cross(C - A, D - B)


def _rearranged(quads: Array) -> Array:
    """Swap the first two vertices of complex ones, or their second and third if that fails."""
    quads = quads.copy()
    is_complex = ~_is_simple(quads)
    first_swapped = quads[is_complex][:, [1, 0, 2, 3]]
    second_swapped = quads[is_complex][:, [0, 2, 1, 3]]
    # The second swap is taken unchecked: no third order would be left.
    use_first = _is_simple(first_swapped)[:, np.newaxis, np.newaxis]
    quads[is_complex] = np.where(use_first, first_swapped, second_swapped)
    return quads


def _areas_of_triangles(quads: Array) -> Array:
    """Return the areas of the two triangles at the crossing point of AB and CD, or BC and DA.

    nan where rounding leaves neither pair crossing.
    """
    first = _areas_at_crossing(quads)
    second = _areas_at_crossing(np.roll(quads, -1, axis=1))
    return np.where(np.isnan(first), second, first)


def _areas_at_crossing(quads: Array) -> Array:
    """Return the areas of XBC and XDA, where AB and CD cross in X; nan where they do not.

    X divides CD in the ratio of the distances of C and D from the line AB, which is that of the
    triangles ABC and ABD. So XBC is the part abc / (abc + abd) of the triangle CDB, and XDA is
    the part abd / (abc + abd) of CDA.
    """
    A, B, C, D = np.moveaxis(quads, 1, 0)
    abc, abd = _cross(B - A, C - A), _cross(B - A, D - A)
    cda, cdb = _cross(D - C, A - C), _cross(D - C, B - C)
    crosses = _opposite(abc, abd) & _opposite(cda, cdb)
    total = np.where(crosses, np.abs(abc) + np.abs(abd), 1.0)
    # Quotients first: the product of two cross products may overflow.
    areas = 0.5 * (np.abs(abc) / total * np.abs(cdb) + np.abs(abd) / total * np.abs(cda))
    return np.where(crosses, areas, np.nan)


def _opposite(s: Array, t: Array) -> npt.NDArray[np.bool_]:
    """Say where s and t have opposite signs; one of the two may be 0."""
    return np.asarray((np.minimum(s, t) <= 0) & (np.maximum(s, t) >= 0) & (s != t))
