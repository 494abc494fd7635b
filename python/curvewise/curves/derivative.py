"""Slopes of a curve, as derivative dynamic time warping compares them."""

from __future__ import annotations

import numpy as np

from .checks import checked_curve
from .inputs import Array, CurveLike

__all__ = ["derivative"]


def derivative(curve: CurveLike) -> Array:
    """Estimate the slope of each coordinate at the inner points of a curve.

    ``dtw(derivative(P), derivative(Q))`` is derivative dynamic time warping (ddtw), and with
    ``wdtw`` its weighted form (wddtw).

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve, whose points are evenly spaced in time; at least 3.

    Returns
    -------
    ndarray, shape (n - 2, d) or (n - 2,)
        Differences per step: the mean of the slope from the point before and of the slope from the
        point before to the point after.

    Raises
    ------
    TypeError, ValueError
        If `curve` does not have at least 3 finite points.

    Notes
    -----
    The estimate of Keogh & Pazzani (2001), which aeon's ``ddtw_distance`` uses. Time and memory
    O(n d).

    Examples
    --------
    >>> import curvewise
    >>> from curvewise.curves import derivative
    >>> derivative([0, 1, 4, 9]).tolist()
    [1.5, 3.5]
    >>> curvewise.dtw(derivative([0, 1, 4, 9]), derivative([5, 6, 9, 14]))
    0.0
    """
    points = checked_curve(curve, 3)
    backward = points[1:-1] - points[:-2]
    slopes = (backward + (points[2:] - points[:-2]) / 2.0) / 2.0
    return np.asarray(slopes[:, 0] if np.ndim(curve) == 1 else slopes)
