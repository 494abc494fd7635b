"""Soft dynamic time warping, which has a gradient everywhere, and its divergence.

Cuturi & Blondel (2017); Blondel, Mensch & Vert (2021). Time O(n m), memory O(n + m).
"""

from __future__ import annotations

from typing import SupportsFloat

from .._core import soft_dtw as compiled_soft_dtw
from .._options import Window
from ..curves.inputs import CurveLike, as_curves
from ..curves.layouts import settled_layout

__all__ = ["soft_dtw", "soft_dtw_divergence"]


def soft_dtw(
    P: CurveLike, Q: CurveLike, *, gamma: SupportsFloat = 1.0, window: Window = None
) -> float:
    """Compute soft dynamic time warping: dtw with a smooth minimum.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    gamma : float > 0
        Smoothing parameter, in units of squared coordinates. For small values the result tends to
        ``dtw(P, Q, metric="sqeuclidean")``.
    window : int >= 0 or 0 < float < 1, optional
        Sakoe–Chiba band, as for :func:`dtw`.

    Returns
    -------
    float
        The value, in squared units of the coordinates, with squared Euclidean ground distances. It
        is below dtw by at most gamma times the logarithm of the number of warping paths, and so
        negative for similar curves: it is not a distance. Use :func:`soft_dtw_divergence` for one.
        Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, or the curves differ in d. If gamma is not finite and
        above 0. If no path fits the window (window = 0 and n != m).
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Cuturi & Blondel (2017): r[i, j] = d[i, j] + softmin(r[i-1, j], r[i, j-1], r[i-1, j-1]) with
    softmin(a) = -gamma log(sum(exp(-a / gamma))). It is computed as exp(-r / gamma), a mantissa and
    an unbounded exponent, so that small gammas do not overflow: one exponential for each cell. With
    a gamma below 2^-900 of the squared distances the value is the limit, to rounding. Time O(n m),
    or the cells of the band; memory O(n + m). With derivatives (``value_and_gradient(P, Q,
    "soft_dtw")``) memory is O(n sqrt(m)), never the table.

    Examples
    --------
    >>> import curvewise
    >>> round(curvewise.soft_dtw([0, 1, 2, 3], [0, 2, 3], gamma=0.1), 6)
    0.930672
    >>> round(curvewise.soft_dtw([0, 1, 2, 3], [0, 2, 3], gamma=1e-9), 9)
    0.999999999
    """
    P, Q = as_curves(P, Q)
    return compiled_soft_dtw(P, Q, {"gamma": gamma, "window": window})


def soft_dtw_divergence(
    P: CurveLike, Q: CurveLike, *, gamma: SupportsFloat = 1.0, window: Window = None
) -> float:
    """Compute the soft-DTW divergence: 0 for equal curves.

    It is soft-DTW less half of that of each curve with itself.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    gamma, window
        As for :func:`soft_dtw`.

    Returns
    -------
    float
        In squared units of the coordinates. Not negative, except by rounding; 0 where the curves
        are equal. Symmetric.

    Raises
    ------
    ValueError, TypeError
        As for :func:`soft_dtw`.

    Notes
    -----
    Blondel, Mensch & Vert (2021), "Differentiable divergences between time series", Eq. 8, which
    proves it non-negative for their kernel, and finds it so for squared distances. Time O(n^2 +
    n m + m^2), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.soft_dtw_divergence([0, 1, 2, 3], [0, 1, 2, 3])
    0.0
    >>> round(curvewise.soft_dtw_divergence([0, 1, 2, 3], [0, 2, 3]), 6)
    0.669339
    """
    between = soft_dtw(P, Q, gamma=gamma, window=window)
    with settled_layout():
        within = [soft_dtw(C, C, gamma=gamma, window=window) for C in (P, Q)]
    return between - 0.5 * (within[0] + within[1])
