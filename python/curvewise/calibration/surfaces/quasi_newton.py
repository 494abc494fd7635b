"""Quasi-Newton methods (BFGS) for functions that cost less than an optimiser's own bookkeeping.

`nonsmooth_descent` is for functions with kinks whose gradient is known, in the unit cube. Its line
search requires only a sufficient decrease and a sufficient increase of the slope (weak Wolfe
conditions), so it descends where line searches for smooth functions fail. Where it cannot leave its
start, a kink, its next direction is the shortest vector of the convex hull of the gradients on both
sides. Cost: 20 to 100 evaluations for up to ten coordinates.

`quasi_newton` uses forward differences and backtracking, from an inverse Hessian of the right
magnitude. Cost: about k + 2 evaluations for each step in k coordinates.

J. Nocedal, S. J. Wright, "Numerical optimization", Springer (2006), chapter 6. A. S. Lewis, M. L.
Overton, "Nonsmooth optimization via quasi-Newton methods", Math. Program. 141 (2013) 135-163. P.
Wolfe, "A method of conjugate subgradients for minimizing nondifferentiable functions", Math.
Program. Study 3 (1975) 145-173.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..._extras import required
from ...curves.inputs import Array
from .steps import FEW, ROUNDING, SMALL

__all__ = ["nonsmooth_descent", "quasi_newton"]

# Wolfe's constants are SMALL, a usual value, and _TURN; _PATIENCE small gains in a row end a round.
_TURN, _PATIENCE = 0.9, 4
_FIRST_STEPS = (0.1, 0.03, 0.01)  # of each round, in sides of the cube


class _Place(NamedTuple):
    point: Array
    value: float
    gradient: Array


def nonsmooth_descent(
    function: Callable[[Array], tuple[float, Array]],
    start: Array,
    *,
    negligible: float,
    most: int = 60,
) -> Array:
    """Return the lowest point of the unit cube that was found, shape (k,).

    The function returns value and gradient. Gains below `negligible` do not count, and `most` is
    the maximum number of evaluations.
    """
    counted = _Counted(function, most)
    best = counted(start)
    for length in _FIRST_STEPS:
        before = best.value
        best = _round(counted, best, length, negligible)
        if before - best.value <= max(negligible, SMALL * abs(best.value)):
            break
    return best.point


class _Counted:
    """The function with a limit of evaluations, its first place and its lowest one so far."""

    def __init__(self, function: Callable[[Array], tuple[float, Array]], most: int) -> None:
        self._function, self.left = function, most
        self.first: _Place | None = None
        self.best: _Place | None = None

    def __call__(self, point: Array) -> _Place:
        self.left -= 1
        place = _Place(point, *self._function(point))
        if self.first is None or self.best is None:
            self.first = self.best = place
        elif place.value < self.best.value:
            self.best = place
        return place


def _round(function: _Counted, place: _Place, length: float, negligible: float) -> _Place:
    """Go down from a place, with a first step of a length; return the lowest place of all."""
    k = place.point.size
    inverse: Array | None = None  # of the Hessian
    beyond: list[Array] = []  # gradients where no step from the start has led down
    small = 0
    while function.left > 0 and small < _PATIENCE:
        point, gradient = place.point, _shortest([place.gradient, *beyond])
        # Coordinates that press against a side of the cube are fixed there.
        free = ~(((point <= 0.0) & (gradient > 0.0)) | ((point >= 1.0) & (gradient < 0.0)))
        norm = float(np.linalg.norm(gradient[free]))
        if norm == 0.0:
            break
        scaled = np.eye(k) * (length / norm) if inverse is None else inverse
        direction = -(scaled * np.outer(free, free)) @ gradient
        if -float(gradient @ direction) <= max(negligible, 1e-3 * SMALL * abs(place.value)):
            break
        trial, is_lower = _searched(function, place, direction, free)
        if not is_lower:
            beyond.append(trial.gradient)
            if place is not function.first or len(beyond) > k:
                break
            continue
        step, change = trial.point - point, trial.gradient - place.gradient
        beyond.clear()
        if _has_curvature(step, change):
            if inverse is None:  # the first is of the right size
                scaled = np.eye(k) * (float(step @ change) / float(change @ change))
            inverse = _updated(scaled, step, change)
        small = (
            small + 1
            if place.value - trial.value < max(negligible, SMALL * abs(place.value))
            else 0
        )
        place = trial
    assert function.best is not None
    return function.best


def _searched(
    function: _Counted, place: _Place, direction: Array, free: npt.NDArray[np.bool_]
) -> tuple[_Place, bool]:
    """Return a place along a direction that meets Wolfe's weak conditions, or the last tried.

    Also return whether any place along it has a sufficiently lower value.
    """
    slope = float(place.gradient @ direction)
    low, high, length = 0.0, np.inf, 1.0
    trial = place
    for _ in range(FEW):
        trial = function(np.clip(place.point + length * direction, 0.0, 1.0))
        # A path that bends along the sides of the cube does not have a single slope.
        is_bent = bool(((trial.point <= 0.0) | (trial.point >= 1.0))[free].any())
        if trial.value > place.value + SMALL * length * slope:
            high = length
        elif not is_bent and float(trial.gradient @ direction) < _TURN * slope:
            low = length
        else:
            return trial, True
        length = 2.0 * length if np.isinf(high) else (low + high) / 2.0
        if function.left <= 0:
            break
    return trial, low > 0.0


def _shortest(gradients: Sequence[Array]) -> Array:
    """Return the shortest vector of the convex hull of gradients."""
    if len(gradients) == 1:
        return gradients[0]
    columns = np.column_stack(gradients)
    heavy = 1e3 * float(np.abs(columns).max())  # holds the sum of the weights at 1
    equations = np.vstack((columns, np.full(len(gradients), heavy)))
    known = np.append(np.zeros(len(columns)), heavy)
    weights, _ = required("scipy.optimize").nnls(equations, known)
    shortest: Array = columns @ (weights / weights.sum())
    return shortest


def _has_curvature(step: Array, change: Array) -> bool:
    """Return whether the gradient's change over a step shows convexity."""
    lengths = float(np.linalg.norm(step) * np.linalg.norm(change))
    return float(step @ change) > ROUNDING * lengths


def _updated(inverse: Array, step: Array, change: Array) -> Array:
    """Return the inverse Hessian with what a step has shown, by the BFGS update."""
    curvature = float(step @ change)
    moved = np.eye(step.size) - np.outer(step, change) / curvature
    update: Array = moved @ inverse @ moved.T + np.outer(step, step) / curvature
    return update


def quasi_newton(
    function: Callable[[Array], float],
    start: Array,
    inverse_hessian: Array,
    *,
    difference: float,
    enough: float,
    maxiter: int,
) -> Array:
    """Return where a function of a point, shape (k,), is lowest.

    `difference` is the step of the derivatives. The search ends if a step predicts to gain less
    than `enough`, or after `maxiter` steps.
    """

    def gradient_at(point: Array, value: float) -> Array:
        return np.array([(function(point + axis) - value) / axis.sum() for axis in axes])

    axes = difference * np.eye(start.size)
    B, point, value = inverse_hessian, start, function(start)
    gradient = gradient_at(point, value)
    for _ in range(maxiter):
        step = _stepped(function, point, value, gradient, B, enough)
        if step is None and B is not inverse_hessian:  # kinks may have spoilt it: restart
            B = inverse_hessian
            step = _stepped(function, point, value, gradient, B, enough)
        if step is None:
            break
        trial, value = step
        after = gradient_at(trial, value)
        moved, change = trial - point, after - gradient
        if _has_curvature(moved, change):
            B = _updated(B, moved, change)
        point, gradient = trial, after
    return point


def _stepped(
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
    for _ in range(FEW):
        trial = point + length * direction
        there = function(trial)
        if there <= value + SMALL * length * slope:
            return trial, there
        length *= 0.5
    return None
