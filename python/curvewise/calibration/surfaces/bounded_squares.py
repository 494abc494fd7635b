"""The smallest sum of squares in a box: of linear residuals exactly, of others step by step.

A bounded linear least squares problem in a handful of unknowns is solved by an active set: a
coordinate that meets its bound is held there, and let go again where the gradient points inwards.
scipy's lsq_linear does the same in twenty times the time, most of it bookkeeping; a search asks for
hundreds. Residuals that are not linear are minimised by Gauss and Newton's steps, cut back to a
region in which the linear residuals foretell what comes. Cost: O(m k^2 + k^3) a step for m
residuals of k unknowns.

A. Björck, "Numerical methods for least squares problems", SIAM (1996), sections 5.2.3 and 9.2.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ...curves.inputs import Array

__all__ = ["ResidualsAndSlopes", "linear_minimum", "squares_minimum"]

ResidualsAndSlopes: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""Residuals at a point, shape (m,), and their derivatives, shape (m, k)."""

_ROUNDING = 1e-12  # of the gradient at the start, and of the mean of the diagonal
_STEPS = 12  # of Gauss and Newton
_POOR, _GOOD = 0.1, 0.7  # of what linear residuals promise: cut back below, go further above
_SMALL = 1e-4  # gains smaller than this fraction of the sum, and smaller steps, end it


def linear_minimum(residuals: Array, slopes: Array, low: Array, high: Array) -> Array:
    """Return the step in a box that makes the sum of squares of linear residuals smallest.

    Parameters
    ----------
    residuals : ndarray, shape (m,)
        At a step of 0.
    slopes : ndarray, shape (m, k)
    low, high : ndarray, shape (k,)
        The box; low <= 0 <= high.
    """
    k = low.size
    gradient = slopes.T @ residuals
    curvature = slopes.T @ slopes
    curvature += _ROUNDING * max(np.trace(curvature) / k, np.finfo(float).tiny) * np.eye(k)
    enough = _ROUNDING * float(np.abs(gradient).max())
    step, is_free = np.zeros(k), low < high
    for _ in range(8 * k):
        free = is_free.nonzero()[0]
        downhill = -gradient - curvature @ step
        move = np.zeros(k)
        if free.size:
            move[free] = np.linalg.solve(curvature[free][:, free], downhill[free])
        target = step + move
        beyond = ((target < low) | (target > high)).nonzero()[0]
        if beyond.size:
            walls = np.where(move[beyond] > 0, high[beyond], low[beyond])
            shares = (walls - step[beyond]) / move[beyond]
            first = int(shares.argmin())
            step = np.minimum(np.maximum(step + shares[first] * move, low), high)
            step[beyond[first]] = walls[first]
            is_free[beyond[first]] = False
            continue
        step = target
        held = (~is_free & (low < high)).nonzero()[0]
        if not held.size:
            break
        downhill = -gradient - curvature @ step
        inwards = np.where(step[held] <= low[held], downhill[held], -downhill[held])
        first = int(inwards.argmax())
        if inwards[first] <= enough:
            break
        is_free[held[first]] = True
    return step


def squares_minimum(function: ResidualsAndSlopes, start: Array, low: Array, high: Array) -> Array:
    """Return where in a box the sum of squares of residuals is smallest, from a point of it.

    Parameters
    ----------
    function : callable
        Residuals and slopes at a point.
    start, low, high : ndarray, shape (k,)
    """
    point, reach = start, 1.0
    residuals, slopes = function(point)
    value = float(residuals @ residuals)
    for _ in range(_STEPS):
        step = linear_minimum(
            residuals, slopes, np.maximum(low - point, -reach), np.minimum(high - point, reach)
        )
        promised = value - float(np.sum((residuals + slopes @ step) ** 2))
        trial = np.minimum(np.maximum(point + step, low), high)
        there, slopes_there = function(trial)
        gain = value - float(there @ there)
        if gain < _POOR * promised:
            reach = 0.4 * float(np.abs(step).max())
            if reach < _SMALL or promised <= _SMALL * value:
                break
            continue
        if gain > _GOOD * promised:
            reach = min(1.0, 2.0 * reach)
        point, residuals, slopes, value = trial, there, slopes_there, value - gain
        if promised <= _SMALL * value:  # what is left is the square of that
            break
    return point
