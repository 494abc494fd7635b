"""Less noise, branch by branch: a filter that runs across a turning point rounds it off.

Savitzky and Golay's filter (Analytical Chemistry 36 (1964) 1627), through scipy: every point is
replaced by the value, at its place, of a polynomial fitted to the points around it. O(n window)
time, O(n) memory.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module

import numpy as np

from .._extras import extra
from .checks import Turns, branch_slices, check_column, checked_curve
from .great_circles import warn_of_longitudes
from .inputs import Array, CurveLike
from .named_curve import renamed

__all__ = ["smooth"]


def smooth(
    curve: CurveLike,
    window: int | float = 0.2,
    *,
    order: int = 2,
    turns: Turns = (),
    columns: Sequence[int] | None = None,
) -> Array:
    """Smooth a curve by a Savitzky-Golay filter, branch by branch.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve, sampled about evenly within the window: the filter uses the order of the points,
        not their distances.
    window : int or float, default 0.2
        Number of points for each fitted polynomial: an odd integer above `order`, or a fraction of
        each branch's points, between 0 and 1. A fifth of a branch works well before pcm and
        curve_length. A window that is longer than the knee of a stress–strain curve changes the
        yield stress.
    order : int, default 2
        Degree of the polynomials, at least 0.
    turns : sequence of int, optional
        Indices of the turning points, as `turning_points` returns them. At a turning point, the two
        polynomials that end there are averaged.
    columns : sequence of int, optional
        The coordinates to smooth, from 0; by default all. In an unevenly sampled test, such as the
        generated pair, smoothing the stress alone over the point number causes an error above the
        noise. Smoothing the strain too halves this error.

    Returns
    -------
    ndarray, shape (n, d)
        The smoothed points. Shape (n, 1) for a curve of shape (n,).

    Raises
    ------
    ImportError
        If scipy is missing.
    TypeError, ValueError
        If `curve` does not hold finite numbers, `turns` do not ascend, or a column does not exist.
        If the window is even, not above `order`, or longer than a branch.

    Warns
    -----
    UserWarning
        If the coordinates look like longitude and latitude, and the longitude jumps by more than
        180 between neighbours.

    Notes
    -----
    O(n window) time, O(n) memory. Area and DTW need no filter: their noise averages out.

    Examples
    --------
    >>> import curvewise
    >>> from curvewise.curves import smooth, turning_points
    >>> test, simulation = curvewise.datasets.hysteresis_pair()
    >>> smoothed = smooth(test, turns=turning_points(test))
    >>> [round(curvewise.pcm(P, simulation), 2) for P in (test, smoothed)]  # noise is length
    [0.32, 0.24]
    """
    with extra("curves", "curvewise.curves.smooth needs scipy"):
        savgol_filter = import_module("scipy.signal").savgol_filter
    points = checked_curve(curve, 1)
    warn_of_longitudes(points, "unwrap it first, by numpy.unwrap(longitude, period=360)")
    if isinstance(order, bool) or int(order) != order or order < 0:
        raise ValueError(f"order is {order}; it must be a whole number from 0 on")
    smoothed = [
        check_column(points, c) for c in (range(points.shape[1]) if columns is None else columns)
    ]
    total = np.zeros((len(points), len(smoothed)))
    owners = np.zeros((len(points), 1))
    for k, branch in enumerate(branch_slices(turns, len(points))):
        length = branch.stop - branch.start
        width = _odd_window(window, order, length, k)
        total[branch] += savgol_filter(points[branch][:, smoothed], width, order, axis=0)
        owners[branch] += 1.0
    result = points.copy()
    result[:, smoothed] = total / owners
    return renamed(curve, result)


def _odd_window(window: int | float, order: int, length: int, branch: int) -> int:
    if isinstance(window, float) and 0.0 < window < 1.0:
        width = 2 * int(window * length / 2.0) + 1
        if width <= order:
            raise ValueError(
                f"branch {branch} has {length} points, of which window={window} leaves {width}; "
                f"order={order} needs more"
            )
        return width
    if int(window) != window or window % 2 != 1 or window <= order:
        raise ValueError(
            f"window is {window}; give an odd number above order={order}, or a fraction of a "
            "branch between 0 and 1"
        )
    if window > length:
        raise ValueError(f"window is {window}; branch {branch} has only {length} points")
    return int(window)
