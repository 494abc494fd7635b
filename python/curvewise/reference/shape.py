"""The shape-based distance by its definition, shift by shift."""

from __future__ import annotations

import numpy as np

from ..curves.inputs import CurveLike, as_curves
from .checks import check_pair

__all__ = ["sbd"]


def sbd(P: CurveLike, Q: CurveLike) -> float:
    """One trace of the table of products for each shift. Time and memory O(n m)."""
    first, second = check_pair(*as_curves(P, Q), "sbd")
    first, second = (curve / max(np.abs(curve).max(), 1e-300) for curve in (first, second))
    size = np.linalg.norm(first) * np.linalg.norm(second)
    if size == 0.0:
        return float(first.any() or second.any())
    n, m = len(first), len(second)
    products = first @ second.T  # of every two points
    best = max(np.trace(products, offset=-shift) for shift in range(-m + 1, n))
    return float(1.0 - best / size)
