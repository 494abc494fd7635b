"""Sums of squares of residuals, plain or robust: values of runs, and bounded minimisation.

Gauss-Newton steps minimise nonlinear residuals, within a region in which their linearisation is
accurate. An active-set method solves the bounded linear problem of each step, in a twentieth of the
time of scipy's `lsq_linear`: O(m k^2 + k^3), with m residuals of k unknowns.

A robust sum, f^2 times the sum of rho((r / f)^2), is a sum of squares of transformed residuals, f
sign(r) sqrt(rho((r / f)^2)). Names and functions rho are those of scipy.optimize.least_squares.

A. Björck, "Numerical methods for least squares problems", SIAM (1996), sections 5.2.3 and 9.2. B.
Triggs, P. F. McLauchlan, R. I. Hartley, A. W. Fitzgibbon, "Bundle adjustment - a modern synthesis",
Lecture Notes in Computer Science 1883 (2000) 298-372, section 4.3.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar, Literal, TypeAlias, get_args

import numpy as np

from ...curves.inputs import Array
from ..objective.objective import Objective
from ..records.evaluation import Evaluation
from .steps import GOOD, POOR, ROUNDING, SHRUNK, SMALL
from .surfaces import Surface

__all__ = ["Loss", "SumOfSquares", "bend_of", "check_loss", "linear_minimum", "squares_minimum"]

Loss: TypeAlias = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]
Bend: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""Residuals to those whose squares are added up, and the derivatives of these by those."""
ResidualsAndSlopes: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""Residuals at a point, shape (m,), and their derivatives, shape (m, k)."""

_STEPS = 12  # of Gauss and Newton
# Fraction of the usual negligible value: near a perfect fit squares are smaller than distances.
_OF_SQUARES = 1e-3

# rho(z) and its derivative.
_RHO: dict[str, Callable[[Array], tuple[Array, Array]]] = {
    "soft_l1": lambda z: (2.0 * z / (1.0 + np.sqrt(1.0 + z)), 1.0 / np.sqrt(1.0 + z)),
    "huber": lambda z: (
        np.where(z <= 1.0, z, 2.0 * np.sqrt(np.maximum(z, 1.0)) - 1.0),
        1.0 / np.sqrt(np.maximum(z, 1.0)),
    ),
    "cauchy": lambda z: (np.log1p(z), 1.0 / (1.0 + z)),
    "arctan": lambda z: (np.arctan(z), 1.0 / (1.0 + z**2)),
}


def bend_of(loss: Loss, scale: float) -> Bend | None:
    """Return the transformation of residuals above a scale; None for "linear", the identity."""
    if loss == "linear":
        return None

    def bend(residuals: Array) -> tuple[Array, Array]:
        scaled = residuals / scale
        value, derivative = _RHO[loss](scaled**2)
        bent = np.sqrt(value)
        with np.errstate(divide="ignore", invalid="ignore"):
            slopes = np.where(bent > 0.0, derivative * np.abs(scaled) / bent, 1.0)
        return scale * np.sign(scaled) * bent, slopes

    return bend


def check_loss(loss: str) -> None:
    """Refuse the name of an unknown loss."""
    if loss not in get_args(Loss):
        raise ValueError(f"loss is {loss!r}; choose from {', '.join(get_args(Loss))}")


class SumOfSquares:
    """Sums of squares of residuals, or of bent ones, as `inner_search.InnerSearch` has it."""

    is_smooth: ClassVar[bool] = True
    sides = None

    def __init__(self, objective: Objective, bend: Bend | None) -> None:
        self._objective, self._bend = objective, bend

    @property
    def negligible(self) -> float:
        """Differences of the sum below this do not count; some measures are the root of one."""
        if not self._objective.is_least_squares:
            return self._objective.negligible**2
        return _OF_SQUARES * self._objective.negligible

    def taken(self, run: Evaluation) -> tuple[Array, float]:
        """Return the residuals of a run and the value to minimise."""
        residuals = self._objective.residuals(run.simulations)
        return residuals, float(self._sums(residuals))

    def slopes(self, run: Evaluation, by_curve: list[Array]) -> Array:
        """Return the derivatives of the residuals, along the slopes of the curves."""
        return self._objective.residual_slopes(run.simulations, by_curve)

    def values(self, surface: Surface, points: Array) -> Array:
        """Return the sums of predicted residuals."""
        return self._sums(surface.at(points))

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
    """Return the step in a box, shape (k,), that minimises squares of linear residuals.

    `residuals`, shape (m,), are those at a step of 0, which lies in the box.
    """
    k = low.size
    gradient = slopes.T @ residuals
    curvature = slopes.T @ slopes
    curvature.ravel()[:: k + 1] += ROUNDING * max(curvature.trace() / k, np.finfo(float).tiny)
    enough = ROUNDING * float(np.abs(gradient).max())
    free, step, downhill = low < high, np.zeros(k), -gradient
    held = np.zeros(k, dtype=bool)
    for _ in range(8 * k):
        move = np.zeros(k)
        move[free] = np.linalg.solve(curvature[free][:, free], downhill[free])
        walls = np.where(move < 0.0, low, high) - step
        share = np.divide(walls, move, out=np.full(k, np.inf), where=np.abs(move) > np.abs(walls))
        first = int(np.argmin(share))
        if share[first] < 1.0:
            step = np.clip(step + share[first] * move, low, high)
            step[first] = low[first] if move[first] < 0.0 else high[first]
            free[first], held[first] = False, True
            downhill = -gradient - curvature @ step
            continue
        step = step + move
        downhill = -gradient - curvature @ step
        inwards = np.where(held, np.where(step <= low, downhill, -downhill), -np.inf)
        released = int(np.argmax(inwards))
        if inwards[released] <= enough:
            break
        free[released], held[released] = True, False
    return step


def squares_minimum(
    function: ResidualsAndSlopes, start: Array, low: Array, high: Array
) -> tuple[Array, float]:
    """Return where in a box the sum of squares of residuals is smallest, and that, from a point."""
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
        if gain < POOR * promised:
            reach = SHRUNK * float(np.abs(step).max())
            if reach < SMALL or promised <= SMALL * value:
                break
            continue
        if gain > GOOD * promised:
            reach = min(1.0, 2.0 * reach)
        point, residuals, slopes, value = trial, there, slopes_there, value - gain
        if promised <= SMALL * value:  # the remaining value is the square of that
            break
    return point, float(residuals @ residuals)
