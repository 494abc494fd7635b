"""Robust sums: residuals that are large count less than their squares.

A robust sum, f^2 times the sum of rho((r / f)^2), is a sum of squares of transformed residuals, f
sign(r) sqrt(rho((r / f)^2)). Any method for sums of squares therefore also minimises robust sums.
The names and the functions rho are those of scipy.optimize.least_squares. Cost: O(1) for a
residual.

B. Triggs, P. F. McLauchlan, R. I. Hartley, A. W. Fitzgibbon, "Bundle adjustment - a modern
synthesis", Lecture Notes in Computer Science 1883 (2000) 298-372, section 4.3.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeAlias, get_args

import numpy as np

from ...curves.inputs import Array

__all__ = ["Bend", "Loss", "bend_of", "check_loss"]

Loss: TypeAlias = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]
Bend: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""Residuals to those whose squares are added up, and the derivatives of these by those."""


def _soft_l1(z: Array) -> tuple[Array, Array]:
    root = np.sqrt(1.0 + z)
    return 2.0 * z / (1.0 + root), 1.0 / root  # 2 (root - 1), exact near 0


def _huber(z: Array) -> tuple[Array, Array]:
    root = np.sqrt(np.maximum(z, 1.0))
    return np.where(z <= 1.0, z, 2.0 * root - 1.0), 1.0 / root


def _cauchy(z: Array) -> tuple[Array, Array]:
    return np.log1p(z), 1.0 / (1.0 + z)


def _arctan(z: Array) -> tuple[Array, Array]:
    return np.arctan(z), 1.0 / (1.0 + z**2)


_RHO = {"soft_l1": _soft_l1, "huber": _huber, "cauchy": _cauchy, "arctan": _arctan}


def bend_of(loss: Loss, scale: float) -> Bend | None:
    """Return the transformation of residuals; None for "linear", the identity.

    Parameters
    ----------
    loss : str
        One of scipy's names.
    scale : float
        Residuals above this count less.
    """
    if loss == "linear":
        return None
    rho = _RHO[loss]

    def bend(residuals: Array) -> tuple[Array, Array]:
        scaled = residuals / scale
        value, derivative = rho(scaled**2)
        bent = np.sqrt(value)
        with np.errstate(divide="ignore", invalid="ignore"):
            slopes = np.where(bent > 0.0, derivative * np.abs(scaled) / bent, 1.0)
        return scale * np.sign(scaled) * bent, slopes

    return bend


def check_loss(loss: str) -> None:
    """Refuse the name of a loss that there is not."""
    if loss not in get_args(Loss):
        raise ValueError(f"loss is {loss!r}; choose from {', '.join(get_args(Loss))}")
