"""Two curves as functions of x, and the strips between them: what ``spacing="function"`` measures.

The strips end at each x at which either function has a point; both functions are linear in between.
The integrals of their difference and of its square have closed forms there. Time
O((n + m) log(n + m)), memory O(n + m).
"""

from __future__ import annotations

import numpy as np

from ..curves.inputs import Array
from ..curves.scaling import times_power_of_two

__all__ = ["function_strips", "strip_areas", "strip_squares"]


def function_strips(P: Array, Q: Array, exponent: int) -> Array:
    """Return the strips over the common span of x, shape (k, 4, 2), in units of 2**exponent.

    Corners: P at the lower x, P and Q at the higher one, Q at the lower one.
    """
    functions = [_rising(curve, name) for curve, name in ((P, "P"), (Q, "Q"))]
    p, q = (times_power_of_two(function, -exponent) for function in functions)
    low, high = max(p[0, 0], q[0, 0]), min(p[-1, 0], q[-1, 0])
    if not low < high:
        spans = [f"from {function[0, 0]:g} to {function[-1, 0]:g}" for function in functions]
        raise ValueError(
            f"P spans x {spans[0]} and Q {spans[1]}; "
            "area with spacing='function' needs a common span"
        )
    x = np.unique(np.concatenate([p[:, 0], q[:, 0]]))
    x = x[(x >= low) & (x <= high)]
    (p_low, p_high), (q_low, q_high) = _ends(p, x), _ends(q, x)
    return np.stack([p_low, p_high, q_high, q_low], axis=1)


def strip_areas(strips: Array) -> Array:
    """Return the integral of abs(f - g) over each strip."""
    width, first, last = _differences(strips)
    total = np.abs(first) + np.abs(last)
    crosses = (np.minimum(first, last) < 0) & (np.maximum(first, last) > 0)
    divisor = np.where(crosses, total, 1.0)
    # Two triangles, whose widths are as their heights.
    height = np.abs(first) * (np.abs(first) / divisor) + np.abs(last) * (np.abs(last) / divisor)
    return 0.5 * (width * np.where(crosses, height, total))


def strip_squares(strips: Array) -> Array:
    """Return the integral of (f - g)² over each strip."""
    width, first, last = _differences(strips)
    middle, half = 0.5 * (first + last), 0.5 * (last - first)
    return width * (middle * middle + half * half / 3.0)


def _rising(curve: Array, name: str) -> Array:
    """Return a curve in the order of x; raise an error if x reverses."""
    steps = np.sign(np.diff(curve[:, 0]))
    moving = np.flatnonzero(steps)
    back = np.flatnonzero(steps[moving[1:]] != steps[moving[:-1]])
    if len(back):
        raise ValueError(
            f"{name}[{moving[back[0] + 1] + 1}] reverses in x; area with spacing='function' "
            "needs x that only rises or only falls: sort the points by x, or choose another spacing"
        )
    return curve[::-1] if curve[-1, 0] < curve[0, 0] else curve


def _ends(curve: Array, x: Array) -> tuple[Array, Array]:
    """Return a function at the lower and at the higher end of each strip."""
    segment = np.searchsorted(curve[:, 0], x[:-1], side="right") - 1
    a, b = curve[segment], curve[segment + 1]
    return _at(a, b, x[:-1]), _at(a, b, x[1:])


def _at(a: Array, b: Array, x: Array) -> Array:
    h = (x - a[:, 0]) / (b[:, 0] - a[:, 0])
    y = np.where(h == 1.0, b[:, 1], a[:, 1] + h * (b[:, 1] - a[:, 1]))
    return np.stack([x, y], axis=1)


def _differences(strips: Array) -> tuple[Array, Array, Array]:
    """Return the width of each strip, and P's y less Q's at its ends."""
    width = strips[:, 1, 0] - strips[:, 0, 0]
    return width, strips[:, 0, 1] - strips[:, 3, 1], strips[:, 1, 1] - strips[:, 2, 1]
