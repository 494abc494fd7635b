"""Motifs and discords: the nearest neighbour of every window of a record, its matrix profile.

Yeh et al., "Matrix profile I: all pairs similarity joins for time series" (2016). The compiled
library finds Euclidean neighbours along the diagonals of the table of all pairs (Zimmerman et al.,
"Matrix Profile XIV", 2019), and those of dtw with the bounds of :class:`curvewise.Index`.
"""

from __future__ import annotations

from typing import SupportsIndex

import numpy as np

from .._core import Index as CompiledIndex
from .._core import matrix_profile as find_profile
from .._options import Default, Window, whole_number, window_radius
from ..curves.checks import check_finite
from ..curves.inputs import Array, CurveLike, as_curve, in_columns
from ..curves.z_normalization import normalized_windows, window_moments
from ..measures.results import MatrixProfile

__all__ = ["matrix_profile"]


# Shared text: workers
def matrix_profile(
    record: CurveLike,
    length: SupportsIndex,
    *,
    window: Window = 0,
    exclusion: SupportsIndex | None = None,
    workers: SupportsIndex = Default.workers,
) -> MatrixProfile:
    """Find the nearest neighbour of every window of a record.

    The windows are all sections of `length` consecutive points. They are compared after
    :func:`curvewise.curves.z_normalized`, so that level and scale do not count. The methods of the
    result return motifs, which are the closest pairs of windows, and discords, which are windows
    without a close neighbour.

    Parameters
    ----------
    record : array_like, shape (n, d) or (n,)
        The record; of any d.
    length : int >= 2
        Number of points of a window.
    window : int >= 0 or 0 < float < 1, optional
        Half-width of the Sakoe-Chiba band of dtw. By default 0, which compares point by point: the
        Euclidean distance. A fraction is one of `length`, rounded down. None is dtw without a band.
    exclusion : int >= 0, optional
        Windows whose starts differ by at most this number are not compared. By default
        ``length // 2``.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.

    Returns
    -------
    MatrixProfile
        Distances and indices of the nearest neighbours, for ``n - length + 1`` windows.

    Raises
    ------
    ValueError
        If `record` is not finite, or has fewer than ``length + exclusion + 1`` points. If an option
        is out of range.
    TypeError
        If `record` does not hold real numbers.

    See Also
    --------
    subsequence : The windows that are most similar to a given curve.

    Notes
    -----
    Exact. The distance is the root of :func:`curvewise.dtw` with ``metric="sqeuclidean"`` and this
    `window`, of both normalised windows. Neighbours are the nearest by the sum under the root, of
    equal ones the earliest. A coordinate that is constant in a window is normalised to 0.

    Euclidean distances take O(n^2) time and O(n) memory a thread. Products of windows are updated
    along diagonals; the bound of their rounding tells which pairs must be computed as defined. For
    dtw, every window is searched for in an index of all windows: O(n^2) time for the bounds,
    O(length window) for each pair that these do not exclude, and O(n length) memory. See Yeh et
    al., "Matrix profile I: all pairs similarity joins for time series" (2016), and Zimmerman et
    al., "Matrix Profile XIV" (2019).

    Examples
    --------
    >>> import curvewise
    >>> record = [0, 1, 3, 1, 0, 0, 1, 0, 2, 5, 1, 0, 2, 6, 2, 0, 0]
    >>> profile = curvewise.matrix_profile(record, 5)
    >>> profile.motifs()
    [(0, 11)]
    >>> profile.discords()
    [4]
    """
    curve = as_curve(record, "record")
    n = whole_number("length", length, 2, "give a whole number >= 2")
    zone = n // 2
    if exclusion is not None:
        zone = whole_number("exclusion", exclusion, 0, "give a whole number >= 0, or None")
    window = window_radius(window, n, n)
    check_finite(curve, "record")
    points = in_columns(curve)
    if points.shape[1] == 0 or len(points) < n + zone + 1:
        raise ValueError(
            f"record has shape {points.shape}; length {n} and exclusion {zone} need at least "
            f"{n + zone + 1} points"
        )
    if window == 0:
        return _euclidean(points, n, zone, workers)
    return _warped(points, n, window, zone, workers)


def _euclidean(points: Array, length: int, exclusion: int, workers: SupportsIndex) -> MatrixProfile:
    # A power of two changes no digit, and keeps squares within the range of a double.
    scaled = np.ldexp(points, -np.frexp(np.abs(points).max())[1])
    means, deviations = window_moments(scaled, length)
    return MatrixProfile(*find_profile(scaled, means, deviations, exclusion, workers), exclusion)


def _warped(
    points: Array, length: int, window: int | None, exclusion: int, workers: SupportsIndex
) -> MatrixProfile:
    windows = normalized_windows(points, length, slice(0, len(points) - length + 1))
    index = CompiledIndex(list(windows), "dtw", {"metric": "sqeuclidean", "window": window})
    sums, indices, _, _ = index.kneighbors(None, 1, workers, None, exclusion)
    return MatrixProfile(np.sqrt(sums[:, 0]), indices[:, 0], exclusion)
