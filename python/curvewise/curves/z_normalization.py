"""Curves, and windows of a curve, with mean 0 and deviation 1 per coordinate.

Mean and deviation are computed from the window's numbers in two passes. Differences of running sums
would lose all digits of a small wave on a large level. Time O(n) for each window.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from numpy.lib.stride_tricks import sliding_window_view

from .checks import checked_curve
from .inputs import Array, CurveLike

__all__ = ["normalized_windows", "window_moments", "z_normalized"]

_NUMBERS_AT_ONCE = 1 << 18


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
    windows, _, deviations, _ = _centred(curve, points, starts)
    windows /= np.where(deviations == 0.0, 1.0, deviations)
    return np.moveaxis(windows, 0, -1)


def window_moments(curve: Array, points: int) -> tuple[Array, Array]:
    """Return mean and deviation of each coordinate of all windows, of shape (windows, d).

    A coordinate that is constant has the deviation 0. Windows are normalised with these numbers in
    :func:`normalized_windows`.
    """
    count = len(curve) - points + 1
    means, deviations = np.empty((2, count, curve.shape[1]))
    step = max(_NUMBERS_AT_ONCE // (points * curve.shape[1]), 1)
    for first in range(0, count, step):
        some = slice(first, min(first + step, count))
        _, mean, deviation, exponents = _centred(curve, points, some)
        means[some] = np.ldexp(mean, exponents)[..., 0].T
        deviations[some] = np.ldexp(deviation, exponents)[..., 0].T
    return means, deviations


def _centred(
    curve: Array, points: int, starts: slice | Sequence[int]
) -> tuple[Array, Array, Array, npt.NDArray[np.intc]]:
    """Return windows (d, starts, points) without their means, means, deviations and exponents.

    The first three are to be multiplied by two to the exponents.
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
    exponents = np.zeros((*windows.shape[:2], 1), dtype=np.intc)
    if sizes.max(initial=0.0) > 2.0**500 or ((sizes > 0.0) & (sizes < 2.0**-500)).any():
        # A power of two changes no digit, and keeps squares within the range of a double.
        _, exponents = np.frexp(np.abs(windows).max(axis=-1, keepdims=True))
        windows = np.ldexp(windows, -exponents)
    means = windows.mean(axis=-1, keepdims=True)
    windows -= means
    deviations = np.sqrt(np.square(windows).mean(axis=-1, keepdims=True))
    deviations[is_constant] = 0.0
    windows[is_constant] = 0.0
    return windows, means, deviations, exponents
