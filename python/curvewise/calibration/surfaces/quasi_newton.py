"""A small quasi-Newton search for functions that cost less than an optimiser's own bookkeeping.

The BFGS method with forward differences and backtracking. It starts from an inverse Hessian of the
right magnitude, so that each of thousands of similar functions takes only a few steps. Cost: about
k + 2 evaluations for each step.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...curves.inputs import Array
from .bfgs import DECREASE, has_curvature, updated

__all__ = ["quasi_newton"]

_HALVINGS = 8  # of a step
_CURVATURE = 1e-10  # least cosine between a step and the change of the gradient


def quasi_newton(
    function: Callable[[Array], float],
    start: Array,
    inverse_hessian: Array,
    *,
    difference: float,
    enough: float,
    maxiter: int,
) -> Array:
    """Return where a function is lowest.

    Parameters
    ----------
    function : callable
        A function of a point, shape (k,).
    start : ndarray, shape (k,)
    inverse_hessian : ndarray, shape (k, k)
        Positive definite; of the right size.
    difference : float
        For derivatives.
    enough : float
        The search ends where a step promises to gain less than this.
    maxiter : int
        The most steps.
    """
    axes = difference * np.eye(start.size)
    B, point, value = inverse_hessian, start, function(start)
    gradient = _gradient(function, point, value, axes)
    for _ in range(maxiter):
        step = _step(function, point, value, gradient, B, enough)
        if step is None and B is not inverse_hessian:  # kinks may have spoilt it: restart
            B = inverse_hessian
            step = _step(function, point, value, gradient, B, enough)
        if step is None:
            break
        trial, value = step
        after = _gradient(function, trial, value, axes)
        moved, change = trial - point, after - gradient
        if has_curvature(moved, change, _CURVATURE):
            B = updated(B, moved, change)
        point, gradient = trial, after
    return point


def _step(
    function: Callable[[Array], float],
    point: Array,
    value: float,
    gradient: Array,
    B: Array,
    enough: float,
) -> tuple[Array, float] | None:
    """Return the next point and its value, or None if no step gains enough."""
    direction = -B @ gradient
    slope = float(gradient @ direction)
    if not slope < -2.0 * enough:
        return None
    length = 1.0
    for _ in range(_HALVINGS):
        trial = point + length * direction
        there = function(trial)
        if there <= value + DECREASE * length * slope:
            return trial, there
        length *= 0.4
    return None


def _gradient(function: Callable[[Array], float], point: Array, value: float, axes: Array) -> Array:
    return np.array([(function(point + axis) - value) / axis.sum() for axis in axes])
