"""A quasi-Newton search in the unit cube for functions with kinks whose gradient is known.

The BFGS method with a line search that requires only a sufficient decrease and a sufficient
increase of the slope (weak Wolfe conditions). It therefore descends on functions that are smooth
almost everywhere, such as sums of absolute values, where line searches for smooth functions fail.
A search that cannot leave its start may stand on a kink. Its next direction is then the shortest
vector of the convex hull of the gradients on both sides, which is a direction along the kink. If
the search stops later, it restarts with smaller steps, at most twice. Coordinates that press
against a side of the cube are fixed there. Cost: 20 to 100 evaluations for up to ten coordinates.

A. S. Lewis, M. L. Overton, "Nonsmooth optimization via quasi-Newton methods", Math. Program. 141
(2013) 135-163. P. Wolfe, "A method of conjugate subgradients for minimizing nondifferentiable
functions", Math. Program. Study 3 (1975) 145-173.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from ..._extras import required
from ...curves.inputs import Array
from .bfgs import DECREASE, has_curvature, updated

__all__ = ["nonsmooth_descent"]

ValueAndGradient: TypeAlias = Callable[[Array], tuple[float, Array]]

_TURN = 0.9  # the slope must fall to this fraction; the second Wolfe constant
_CURVATURE = 1e-12  # least cosine between a step and the change of the gradient
_ENOUGH = 1e-5  # gains below ten times this fraction of the value are small
_PATIENCE = 4  # number of consecutive small gains that ends a round
_TRIALS = 10  # of a line search
_FIRST_STEPS = (0.1, 0.03, 0.01)  # of each round, in sides of the cube
_WORTH_A_ROUND = 1e-4  # a round that gains less, as a fraction of the value, is the last


class _Place(NamedTuple):
    point: Array
    value: float
    gradient: Array


def nonsmooth_descent(
    function: ValueAndGradient, start: Array, *, negligible: float, most: int
) -> Array:
    """Return the lowest point that was found.

    Parameters
    ----------
    function : callable
        Returns value and gradient at a point, shape (k,).
    start : ndarray, shape (k,)
        Within the unit cube.
    negligible : float
        Gains below this do not count.
    most : int
        The most evaluations.
    """
    counted = _Counted(function, most)
    best = counted(start)
    for length in _FIRST_STEPS:
        before = best.value
        best = _round(counted, best, length, negligible)
        if before - best.value <= max(negligible, _WORTH_A_ROUND * abs(best.value)):
            break
    return best.point


class _Counted:
    """The function with a limit of evaluations, its first place and its lowest one so far."""

    def __init__(self, function: ValueAndGradient, most: int) -> None:
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
        free = ~(((point <= 0.0) & (gradient > 0.0)) | ((point >= 1.0) & (gradient < 0.0)))
        norm = float(np.linalg.norm(gradient[free]))
        if norm == 0.0:
            break
        scaled = np.eye(k) * (length / norm) if inverse is None else inverse
        direction = -(scaled * np.outer(free, free)) @ gradient
        if -float(gradient @ direction) <= max(negligible, _ENOUGH * 1e-2 * abs(place.value)):
            break
        trial, is_lower = _searched(function, place, direction, free)
        if not is_lower:
            beyond.append(trial.gradient)
            if place is not function.first or len(beyond) > k:
                break
            continue
        step, change = trial.point - point, trial.gradient - place.gradient
        beyond.clear()
        if has_curvature(step, change, _CURVATURE):
            if inverse is None:  # the first is of the right size
                scaled = np.eye(k) * (float(step @ change) / float(change @ change))
            inverse = updated(scaled, step, change)
        gain = place.value - trial.value
        small = small + 1 if gain < max(negligible, 10.0 * _ENOUGH * abs(place.value)) else 0
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
    for _ in range(_TRIALS):
        trial = function(np.clip(place.point + length * direction, 0.0, 1.0))
        # A path that bends along the sides of the cube does not have a single slope.
        is_bent = bool(((trial.point <= 0.0) | (trial.point >= 1.0))[free].any())
        if trial.value > place.value + DECREASE * length * slope:
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
    weights, _ = required("scipy.optimize").nnls(
        equations, np.append(np.zeros(len(columns)), heavy)
    )
    shortest: Array = columns @ (weights / weights.sum())
    return shortest
