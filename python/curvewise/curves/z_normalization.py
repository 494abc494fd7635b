"""Curves, and windows of a curve, with mean 0 and deviation 1 per coordinate.

Mean and deviation are computed from the window's numbers in two passes. Differences of running sums
would lose all digits of a small wave on a large level. Time O(n) for each window.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from .checks import checked_curve
from .inputs import Array, CurveLike

__all__ = ["normalized_windows", "z_normalized"]


def z_normalized(curve: CurveLike) -> Array:
    """Scale each coordinate of a curve to mean 0 and standard deviation 1.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve.

    Returns
    -------
    ndarray, of the same shape
        A coordinate that is the same in all points is 0.

    Raises
    ------
    TypeError, ValueError
        If the curve does not hold finite numbers.

    Notes
    -----
    The deviation is that of all points, with n in the denominator. Time and memory O(n d).

    Examples
    --------
    >>> from curvewise.curves import z_normalized
    >>> z_normalized([1, 3, 1, 3]).tolist()
    [-1.0, 1.0, -1.0, 1.0]
    """
    columns = checked_curve(curve, 1)
    normalized = normalized_windows(columns, len(columns), slice(0, 1))[0]
    return np.asarray(normalized[:, 0] if np.ndim(curve) == 1 else normalized)


def normalized_windows(curve: Array, points: int, starts: slice | Sequence[int]) -> Array:
    """Return the windows of `points` points that begin at `starts`.

    `curve` has shape (n, d), the result (starts, points, d).
    """
    # Coordinates first, so that sums run over adjacent numbers.
    windows = np.array(sliding_window_view(curve.T, points, axis=1)[:, starts], order="C")
    is_constant = windows[..., 0] == windows[..., -1]
    candidates = windows[is_constant]
    is_constant[is_constant] = (candidates == candidates[:, :1]).all(axis=-1)
    if isinstance(starts, slice):
        sizes = np.abs(curve[starts.start : starts.stop + points - 1])
    else:
        sizes = np.abs(windows)
    if sizes.max(initial=0.0) > 2.0**500 or ((sizes > 0.0) & (sizes < 2.0**-500)).any():
        # A power of two changes no digit, and keeps squares within the range of a double.
        _, exponents = np.frexp(np.abs(windows).max(axis=-1, keepdims=True))
        windows = np.ldexp(windows, -exponents)
    windows -= windows.mean(axis=-1, keepdims=True)
    deviations = np.sqrt(np.square(windows).mean(axis=-1, keepdims=True))
    deviations[is_constant] = 1.0
    windows[is_constant] = 0.0
    windows /= deviations
    return np.moveaxis(windows, 0, -1)
