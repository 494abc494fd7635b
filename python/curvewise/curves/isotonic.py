"""Isotonic regression by pooling neighbours: makes noisy values ascend.

Two descending neighbours are pooled, together with earlier values that are not below their mean.
See R. E. Barlow, D. J. Bartholomew, J. M. Bremner, H. D. Brunk, "Statistical inference under order
restrictions", Wiley, 1972. O(n) time and memory.
"""

from __future__ import annotations

import numpy as np

from .inputs import Array

__all__ = ["ascending", "isotonic"]


def ascending(values: Array, points: Array) -> tuple[Array, Array]:
    """Return the means of pools of neighbours, strictly ascending, and of the points in them."""
    means, sizes = _pools(values)
    first = np.cumsum(sizes) - sizes
    return means, np.add.reduceat(points, first, axis=0) / sizes[:, np.newaxis]


def isotonic(values: Array) -> Array:
    """Return the values that do not descend and are nearest to some, by least squares."""
    means, sizes = _pools(values)
    return np.repeat(means, sizes)


def _pools(values: Array) -> tuple[Array, np.ndarray[tuple[int], np.dtype[np.intp]]]:
    pools: list[tuple[float, int]] = []  # mean and size
    for value in values.tolist():
        mean, size = value, 1
        while pools and pools[-1][0] >= mean:
            other, count = pools.pop()
            mean, size = (mean * size + other * count) / (size + count), size + count
        pools.append((mean, size))
    return np.array([mean for mean, _ in pools]), np.array([size for _, size in pools], np.intp)
