"""Shared code of the quasi-Newton searches: BFGS update and decrease.

The update of Broyden, Fletcher, Goldfarb and Shanno. J. Nocedal, S. J. Wright, "Numerical
optimization", Springer (2006), chapter 6. Cost: O(k^3) for k coordinates.
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array

__all__ = ["DECREASE", "has_curvature", "updated"]

DECREASE = 1e-4  # a step has to gain this fraction of what the slope promises (Armijo, Wolfe)


def has_curvature(step: Array, change: Array, least: float) -> bool:
    """Return whether the gradient's change over a step shows convexity.

    Parameters
    ----------
    step, change : ndarray, shape (k,)
    least : float
        Least cosine between the two.
    """
    return float(step @ change) > least * float(np.linalg.norm(step) * np.linalg.norm(change))


def updated(inverse: Array, step: Array, change: Array) -> Array:
    """Return the inverse Hessian with what a step has shown, shape (k, k)."""
    curvature = float(step @ change)
    moved = np.eye(step.size) - np.outer(step, change) / curvature
    update: Array = moved @ inverse @ moved.T + np.outer(step, step) / curvature
    return update
