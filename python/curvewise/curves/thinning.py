"""A subset of a curve's points, spaced about evenly along it. Time O(n)."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from .inputs import Array

__all__ = ["Rows", "thinned_rows"]

Rows: TypeAlias = npt.NDArray[np.intp]
"""Numbers of points of a curve."""


def thinned_rows(curve: Array, most: int) -> Rows:
    """Return the indices of some points of a curve, including its ends.

    Parameters
    ----------
    curve : ndarray, shape (n, d)
    most : int
        Approximate number of points to keep; all are kept if the curve has few more.
    """
    count = len(curve)
    if count <= 1.5 * most:
        return np.arange(count)
    extent = np.ptp(curve, axis=0)
    steps = np.diff(curve, axis=0) / np.where(extent > 0, extent, 1.0)
    # Noise adds length. A test that pauses must get neither all points for the pause, nor too few.
    length = np.concatenate(([0.0], np.cumsum(np.linalg.norm(steps, axis=1))))
    along = length / (length[-1] or 1.0) + np.linspace(0.0, 1.0, count)
    rows: Rows = np.unique(np.searchsorted(along, np.linspace(0.0, along[-1], most)))
    return rows
