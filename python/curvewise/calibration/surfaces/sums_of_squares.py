"""Sums of squares: vectors and values of runs, bounded minimisation.

An active-set method solves a bounded linear least-squares problem in a few unknowns. A coordinate
that meets its bound is fixed there, and released when the gradient points inwards. The function
`lsq_linear` of scipy takes twenty times as long, mostly for bookkeeping, and a search solves
hundreds of such problems. Gauss-Newton steps minimise nonlinear residuals, within a region in which
their linearisation is accurate. Cost: O(m k^2 + k^3) for each step, with m residuals of k unknowns.

A. Björck, "Numerical methods for least squares problems", SIAM (1996), sections 5.2.3 and 9.2.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar, TypeAlias

import numpy as np

from ...curves.inputs import Array
from ..objective.objective import Objective
from ..records.evaluation import Evaluation
from .robust_losses import Bend
from .surfaces import Surface

__all__ = ["ResidualsAndSlopes", "SumOfSquares", "linear_minimum", "squares_minimum"]

ResidualsAndSlopes: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""Residuals at a point, shape (m,), and their derivatives, shape (m, k)."""

_TINY = np.finfo(float).tiny
_ROUNDING = 1e-12  # of the gradient at the start, and of the mean of the diagonal
_STEPS = 12  # of Gauss and Newton
_POOR, _GOOD = 0.1, 0.7  # of what linear residuals promise: cut back below, go further above
_SMALL = 1e-4  # gains smaller than this fraction of the sum, and smaller steps, end it
# Fraction of the usual negligible value: near a perfect fit squares are smaller than distances.
_OF_SQUARES = 1e-3


class SumOfSquares:
    """Sums of squares of residuals, as `inner_search.InnerSearch` has it.

    Parameters
    ----------
    objective : Objective
        The objective of the tests.
    bend : callable, optional
        The transformation of a robust sum.
    """

    is_smooth: ClassVar[bool] = True
    sides = None

    def __init__(self, objective: Objective, bend: Bend | None) -> None:
        self._objective, self._bend = objective, bend

    @property
    def negligible(self) -> float:
        """Differences of the sum below this do not count; curve_length is the root of one."""
        if not self._objective.is_least_squares:
            return self._objective.negligible**2
        return _OF_SQUARES * self._objective.negligible

    def taken(self, run: Evaluation) -> tuple[Array, float]:
        """Return the residuals of a run and the value to minimise."""
        residuals = self._objective.residuals(run.simulations)
        return residuals, float(self._sums(residuals))

    def slopes(self, run: Evaluation, by_curve: list[Array]) -> Array:
        """Residuals are differentiated along the slopes of the curves, which takes no runs."""
        return self._objective.residual_slopes(run.simulations, by_curve)

    def values(self, surface: Surface, points: Array) -> Array:
        """Return the sums of predicted residuals."""
        return self._sums(surface.at(points))

    estimates = values

    def lowest(self, surface: Surface, start: Array, low: Array, high: Array) -> Array:
        """Return where the sum is smallest in a box."""
        return squares_minimum(self._bent(surface.with_slopes), start, low, high)[0]

    def _sums(self, residuals: Array) -> Array:
        if self._bend is not None:
            residuals, _ = self._bend(residuals)
        sums: Array = np.add.reduce(residuals * residuals, axis=-1)
        return sums

    def _bent(self, surface: ResidualsAndSlopes) -> ResidualsAndSlopes:
        """Return a surface of the residuals whose squares are summed."""
        bend = self._bend
        if bend is None:
            return surface

        def bent_surface(point: Array) -> tuple[Array, Array]:
            plain, slopes = surface(point)
            bent, derivatives = bend(plain)
            return bent, derivatives[:, np.newaxis] * slopes

        return bent_surface


def linear_minimum(residuals: Array, slopes: Array, low: Array, high: Array) -> Array:
    """Return the step in a box that minimises squares of linear residuals.

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
    curvature.ravel()[:: k + 1] += _ROUNDING * max(curvature.trace() / k, _TINY)
    enough = _ROUNDING * float(np.abs(gradient).max())
    box = list(zip(low.tolist(), high.tolist(), strict=True))
    inside = [i for i in range(k) if box[i][0] < box[i][1]]
    free, step = inside, [0.0] * k
    downhill = -gradient
    for _ in range(8 * k):
        move = dict(zip(free, _newton(curvature, downhill, free), strict=True))
        wall = _first_wall(step, move, box)
        if wall is not None:
            share, first, side = wall
            for i, by in move.items():
                step[i] = min(max(step[i] + share * by, box[i][0]), box[i][1])
            step[first] = box[first][side]
            free = [i for i in free if i != first]
        else:
            for i, by in move.items():
                step[i] += by
        downhill = -gradient - curvature @ np.array(step)
        if wall is not None:
            continue
        held = [i for i in inside if i not in move]
        inwards = [downhill[i] if step[i] <= box[i][0] else -downhill[i] for i in held]
        if not held or max(inwards) <= enough:
            break
        free = sorted([*free, held[inwards.index(max(inwards))]])
    return np.array(step)


def _newton(curvature: Array, downhill: Array, free: list[int]) -> list[float]:
    """Return the step to the minimum over some coordinates."""
    if not free:
        return []
    if len(free) < downhill.size:
        curvature, downhill = curvature[free][:, free], downhill[free]
    step: list[float] = np.linalg.solve(curvature, downhill).tolist()
    return step


def _first_wall(
    step: list[float], move: dict[int, float], box: list[tuple[float, float]]
) -> tuple[float, int, int] | None:
    """Return the fraction of a move at which it first meets a bound, and which.

    Plain numbers are used, because arrays are not faster for so few.
    """
    walls = []
    for i, by in move.items():
        low, high = box[i]
        if step[i] + by < low:
            walls.append(((low - step[i]) / by, i, 0))
        elif step[i] + by > high:
            walls.append(((high - step[i]) / by, i, 1))
    return min(walls, default=None)


def squares_minimum(
    function: ResidualsAndSlopes, start: Array, low: Array, high: Array
) -> tuple[Array, float]:
    """Return where in a box the sum of squares of residuals is smallest, and that, from a point.

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
        linear = residuals + slopes @ step
        promised = value - float(np.add.reduce(linear * linear))
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
        if promised <= _SMALL * value:  # the remaining value is the square of that
            break
    return point, float(residuals @ residuals)
