"""Means under the shape-based distance, and distances of many curves from a few of them.

Shape extraction of Paparrizos & Gravano, "k-Shape: Efficient and Accurate Clustering of Time
Series", SIGMOD 2015. Curves are shifted to where they correlate most with the mean so far, and
centred. The new mean is the curve with the largest sum of squared products with these, an
eigenvector. A shift moves all coordinates together. Time O(k d n log n) for k curves of n points,
and O(k n d min(k, n d)) for a mean.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..curves.inputs import Array, in_columns

__all__ = ["moved_shape", "shape_distances"]

_NUMBERS_AT_ONCE = 1 << 20


def shape_distances(curves: list[Array], centers: list[Array]) -> Array:
    """Return :func:`curvewise.sbd` of curves and centers, a row for each curve.

    The squares of all numbers must be within the range of a double.
    """
    distances = np.empty((len(curves), len(centers)))
    sizes = np.array([np.linalg.norm(curve) for curve in curves])
    for center, column in zip(centers, distances.T, strict=True):
        size = np.linalg.norm(center)
        for first, sums in _correlations(center, curves):
            column[first : first + len(sums)] = sums.max(axis=1)
        both = sizes * size
        with np.errstate(invalid="ignore"):
            column[:] = np.where(both > 0.0, 1.0 - column / both, (sizes != size) * 1.0)
    return np.clip(distances, 0.0, 2.0)


def moved_shape(center: Array, curves: list[Array], weights: Array) -> Array:
    """Return the shape of curves aligned with `center`, which has its number of points."""
    n, d = in_columns(center).shape
    aligned = np.zeros((len(curves), n, d))
    for first, sums in _correlations(center, curves):
        shifts = np.argmax(sums, axis=1) - (sums.shape[1] - n)
        for k, shift in enumerate(shifts.tolist(), first):
            curve = in_columns(curves[k])[max(-shift, 0) :][: n - max(shift, 0)]
            aligned[k, max(shift, 0) :][: len(curve)] = curve
    aligned -= aligned.mean(axis=1, keepdims=True)
    rows = aligned.reshape(len(curves), n * d) * np.sqrt(weights)[:, np.newaxis]
    shape = _strongest(rows)
    size = np.linalg.norm(shape)
    if size == 0.0:  # all curves are constant
        return center
    if (rows @ shape) @ np.sqrt(weights) < 0.0:
        shape = -shape
    return np.asarray((shape * (np.sqrt(n * d) / size)).reshape(center.shape))


def _strongest(rows: Array) -> Array:
    """Return a vector with the largest sum of squared products with rows for its length."""
    if len(rows) > rows.shape[1]:
        return np.asarray(np.linalg.eigh(rows.T @ rows)[1][:, -1])
    return np.asarray(rows.T @ np.linalg.eigh(rows @ rows.T)[1][:, -1])


def _correlations(center: Array, curves: list[Array]) -> Iterator[tuple[int, Array]]:
    """Yield parts of the curves: the index of the first, and a row of sums of products for each.

    The columns are the shifts of a curve along `center`, in ascending order; the last is n - 1.
    Shifts without an overlap have -inf.
    """
    p = in_columns(center)
    n, d = p.shape
    longest = max(map(len, curves), default=0)
    size = 1 << (n + longest - 2).bit_length()
    spectrum = np.fft.rfft(p, size, axis=0)
    step = max(_NUMBERS_AT_ONCE // (size * d), 1)
    for first in range(0, len(curves), step):
        part = [in_columns(curve) for curve in curves[first : first + step]]
        padded = np.zeros((len(part), longest, d))
        for row, curve in zip(padded, part, strict=True):
            row[: len(curve)] = curve
        products = spectrum * np.fft.rfft(padded, size, axis=1).conj()
        circular = np.fft.irfft(products.sum(axis=2), size, axis=1)
        sums = np.concatenate([circular[:, size - longest + 1 :], circular[:, :n]], axis=1)
        for row, curve in zip(sums, part, strict=True):
            row[: longest - len(curve)] = -np.inf
        yield first, sums
