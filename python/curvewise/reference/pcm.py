"""Partial curve mapping: the area between the shorter curve and the best part of the longer one.

Both curves are scaled by P's bounding box. The vertices of the shorter one, at arc lengths s of
0 .. S, are mapped to the points of the longer one (of length T) at arc lengths s + o; f(o) is the
trapezoidal sum of the distances over s. The value is the smallest f(o), over a grid of offsets o
in [0, T - S] or over all of them (Witowski & Stander, 2012; section 2.1 of the paper). Each f(o)
costs O(n log m) time.
"""

from __future__ import annotations

import math
from typing import Any, Literal, NamedTuple

import numpy as np

from .._options import Offsets, whole_number
from ..curves.arc_length import box_scaled_arc_lengths, interpolate, locate, norms
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import box_scaled, range_exponent, times_power_of_two
from ..measures.results import PcmMatch
from .checks import check_length, check_pair

__all__ = ["pcm", "pcm_match"]


_EQUAL_LENGTHS = 1e-12  # relative; within it P counts as the shorter curve
_GRID = 200  # which offsets="continuous" is never above
_OFFSET_TOLERANCE = 1e-12  # f is S-Lipschitz: this far from the minimum it is 1e-12 S above it
_GOLDEN = (math.sqrt(5) - 1) / 2
_DISTANCES_AT_ONCE = 2**18


def pcm(P: CurveLike, Q: CurveLike, *, offsets: Offsets = 200) -> float:
    """Time O(offsets n log m).

    Witowski & Stander, "Parameter identification of hysteretic models using partial curve
    mapping" (2012). The error of the grid is at most S (T - S) / (2 (offsets - 1)) for lengths
    S <= T. "continuous" is meant for small curves here: it minimises each of about n m pieces on
    which the area is convex, in time O(n² m log m).
    """
    return pcm_match(P, Q, offsets=offsets).value


def pcm_match(P: CurveLike, Q: CurveLike, *, offsets: Offsets = 200) -> PcmMatch:
    """As for :func:`pcm`."""
    P, Q = as_curves(P, Q)
    if not (isinstance(offsets, str) and offsets == "continuous"):
        offsets = whole_number("offsets", offsets, 1, "give a whole number >= 1, or 'continuous'")
    P, Q = check_pair(P, Q, "pcm", least_points=2, planar=True)
    check_length(P, "P", "pcm")
    check_length(Q, "Q", "pcm")
    roles = _assign_roles(P, Q)
    longer = Q if roles.mapped == "P" else P
    S, T = roles.s[-1], roles.t[-1]
    if not np.isfinite(T):
        nowhere = np.full((len(roles.s), 2), np.nan)
        return PcmMatch(math.inf, 0.0, 0.0, roles.mapped, nowhere, math.inf)
    tried = _all_offsets(roles) if offsets == "continuous" else _grid(roles, offsets)
    areas = _areas(roles, tried)
    best = int(np.argmin(areas))  # the first among equals
    return PcmMatch(
        value=float(areas[best]),
        offset=float(tried[best]),
        coverage=float(S / T),
        mapped=roles.mapped,
        points=_mapped_points(roles, tried[best], longer),
        tolerance=_tolerance(roles, float(areas[best]), offsets),
    )


class _Roles(NamedTuple):
    """Both curves, scaled by P's box, with the arc lengths of their vertices."""

    shorter: Array
    longer: Array
    s: Array
    t: Array
    mapped: Literal["P", "Q"]


def _assign_roles(P: Array, Q: Array) -> _Roles:
    p, q = box_scaled(P, P), box_scaled(Q, P)
    s, t = box_scaled_arc_lengths(P, P), box_scaled_arc_lengths(Q, P)
    if s[-1] - t[-1] > _EQUAL_LENGTHS * s[-1]:
        return _Roles(q, p, t, s, "Q")
    return _Roles(p, q, s, t, "P")


def _grid(roles: _Roles, count: Any) -> Array:
    # P is the shorter curve even if it is longer by rounding: hence no less than 0.
    return np.linspace(0.0, max(roles.t[-1] - roles.s[-1], 0.0), count)


def _tolerance(roles: _Roles, value: float, offsets: Any) -> float:
    """Return how far the smallest area of all offsets may lie below the value: f is S-Lipschitz."""
    S, slack = float(roles.s[-1]), max(float(roles.t[-1] - roles.s[-1]), 0.0)
    if offsets == 1:
        return S * slack
    if offsets != "continuous":
        return S * (0.5 * slack / float(offsets - 1))
    at_grid = S * (0.5 * slack / (_GRID - 1))
    return min(_OFFSET_TOLERANCE * max(S, 0.1 * value), at_grid)


def _areas(roles: _Roles, offsets: Array) -> Array:
    """Return f at each offset."""
    at_once = max(1, _DISTANCES_AT_ONCE // len(roles.s))
    parts = [
        _areas_at_once(roles, offsets[first : first + at_once])
        for first in range(0, len(offsets), at_once)
    ]
    return np.concatenate(parts)


def _areas_at_once(roles: _Roles, offsets: Array) -> Array:
    position = np.minimum(roles.s + offsets[:, np.newaxis], roles.t[-1])
    points = interpolate(roles.longer, *locate(roles.t, position))
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):  # too far away: inf
        d = norms(points - roles.shorter)
        areas = np.sum((0.5 * d[:, :-1] + 0.5 * d[:, 1:]) * np.diff(roles.s), axis=1)
    return np.where(np.isfinite(areas), areas, np.inf)


def _mapped_points(roles: _Roles, offset: float, longer: Array) -> Array:
    """Return where the vertices of the shorter curve lie on the unscaled longer one."""
    position = locate(roles.t, np.minimum(roles.s + offset, roles.t[-1]))
    columns = []
    for x in longer.T:
        exponent = range_exponent(x)
        points = interpolate(times_power_of_two(x, -exponent), *position)
        columns.append(times_power_of_two(points, exponent))
    return np.column_stack(columns)


def _all_offsets(roles: _Roles) -> Array:
    """Return ascending offsets that include the best one, to the tolerance.

    While no s_i + o passes a vertex of the longer curve, each mapped point moves along a straight
    line. Its distance from its vertex, and f with it, is then convex in o. Each of these intervals
    has one minimum, which the golden-section search finds.
    """
    grid = _grid(roles, _GRID)
    breakpoints = np.subtract.outer(roles.t, roles.s).ravel()
    inside = breakpoints[(breakpoints > 0) & (breakpoints < grid[-1])]
    knots = np.unique(np.concatenate([grid, inside]))
    low, high = knots[:-1], knots[1:]
    for _ in range(_golden_section_steps(np.diff(knots))):
        left, right = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        keep_left = _areas(roles, left) <= _areas(roles, right)
        low, high = np.where(keep_left, low, left), np.where(keep_left, right, high)
    return np.unique(np.concatenate([knots, low, high]))


def _golden_section_steps(widths: Array) -> int:
    """Return how many steps narrow the widest interval to the tolerance."""
    widest = float(np.max(widths, initial=_OFFSET_TOLERANCE))
    return math.ceil(math.log(_OFFSET_TOLERANCE / widest) / math.log(_GOLDEN))
