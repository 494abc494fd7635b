"""How far the lowest place of a weighted sum of squares moves with what is added to each of them.

P. R. Bevington, "Data reduction and error analysis for the physical sciences", McGraw-Hill (1969).
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array

__all__ = ["moves_of"]


def moves_of(weights: Array, slopes: Array) -> tuple[Array, Array]:
    """Return by how much the place moves with each, and the inverse of the normal matrix.

    What none of them notices is as uncertain as the bounds are wide, and no more. Time O(n k²).

    Parameters
    ----------
    weights : ndarray, shape (n,)
        The roots of the factors of the squares.
    slopes : ndarray, shape (n, k)
        By the place in the unit cube, of what is squared.

    Returns
    -------
    moves : ndarray, shape (n, k)
    inverse : ndarray, shape (k, k)
    """
    left, values, right = np.linalg.svd(weights[:, np.newaxis] * slopes, full_matrices=False)
    noticed = np.maximum(values, float(np.sqrt(np.mean(weights**2))))
    return weights[:, np.newaxis] * (left / noticed) @ right, (right.T / noticed**2) @ right
