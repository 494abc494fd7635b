"""Soft-DTW after Cuturi & Blondel (2017), by logarithms of sums of exponentials.

    r[i, j] = d[i, j] + softmin(r[i-1, j], r[i, j-1], r[i-1, j-1]),   d = |P[i] - Q[j]|^2
    softmin(a) = min(a) - gamma log(sum(exp(-(a - min(a)) / gamma)))

The table is filled along anti-diagonals. Time and memory O(n m).
"""

from __future__ import annotations

import math
from typing import SupportsFloat

import numpy as np

from .._options import Window, real_number
from ..curves.ground_distance import ground_distances
from ..curves.inputs import Array, CurveLike, as_curves
from .checks import check_pair
from .dtw import dtw_table
from .warping_table import filled_table

__all__ = ["soft_dtw", "soft_dtw_divergence"]


def soft_dtw(
    P: CurveLike, Q: CurveLike, *, gamma: SupportsFloat = 1.0, window: Window = None
) -> float:
    """Time and memory O(n m). Not for curves whose squared distances are beyond a double."""
    smoothness = _checked(gamma)
    P, Q = check_pair(*as_curves(P, Q), "soft_dtw")
    outside = np.isinf(dtw_table(P, Q, metric="sqeuclidean", window=window))
    ground = ground_distances(P[:, np.newaxis], Q, "sqeuclidean", 2.0)
    ground[outside] = np.inf

    def cell(d: Array, *before: Array) -> Array:
        least = np.minimum.reduce(before)
        reached = np.isfinite(least)
        beyond = np.where(reached, before - np.where(reached, least, 0.0), np.inf)
        with np.errstate(over="ignore"):  # a gamma so small that nothing but the least counts
            terms = np.where(reached, np.exp(-beyond / smoothness).sum(axis=0), 1.0)
        return np.where(reached, d + least - smoothness * np.log(terms), np.inf)

    return float(filled_table(ground, cell)[-1, -1])


def soft_dtw_divergence(
    P: CurveLike, Q: CurveLike, *, gamma: SupportsFloat = 1.0, window: Window = None
) -> float:
    """Three tables: Blondel, Mensch & Vert (2021), Eq. 8."""
    own = soft_dtw(P, P, gamma=gamma, window=window) + soft_dtw(Q, Q, gamma=gamma, window=window)
    return soft_dtw(P, Q, gamma=gamma, window=window) - 0.5 * own


def _checked(gamma: SupportsFloat) -> float:
    advice = "give a finite number > 0"
    smoothness = real_number("gamma", gamma, 0.0, advice)
    if smoothness == 0.0 or math.isinf(smoothness):
        raise ValueError(f"gamma is {gamma!r}; {advice}")
    return smoothness
