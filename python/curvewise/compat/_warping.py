"""Dynamic time warping and the discrete Fréchet distance in similaritymeasures' names.

The compiled library computes its metrics (:func:`curvewise.dtw_table`, :func:`curvewise.frechet`):
with the same recurrence (symmetric1), and bitwise identical for all of them except minkowski. For
every other metric, and for curves with nan or inf, ``scipy.spatial.distance.cdist`` gives the
costs. The cumulative table is then filled here along anti-diagonals, whose cells depend on earlier
ones only. O(n·m) time and memory; the Fréchet distance from the library takes O(n + m) memory.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, cast, get_args

import numpy as np
import numpy.typing as npt

from .._options import CoordinateMetric, Metric
from ..curves.inputs import Array, CurveLike, as_numbers, in_columns
from ..measures import dtw_table, frechet
from ._arrays import RealArray

__all__ = ["dtw", "dtw_path", "frechet_dist"]


def dtw(
    exp_data: CurveLike,
    num_data: CurveLike,
    metric: str | Callable[..., float] = "euclidean",
    **kwargs: Any,
) -> tuple[np.float64, Array]:
    """Compute dynamic time warping and its cumulative table.

    Parameters
    ----------
    exp_data, num_data : array_like, shapes (n, d) and (m, d)
        The curves.
    metric : str or callable
        Any metric of ``scipy.spatial.distance.cdist``. "euclidean", "sqeuclidean", "cityblock",
        "chebyshev" and "minkowski" (with p >= 1) do not need scipy.
    **kwargs
        Passed to ``cdist``: `p` for "minkowski" (2 if absent), `w`, `V`, `VI`, `out`.

    Returns
    -------
    r : numpy.float64
        The distance, ``d[-1, -1]``, in the units of the metric.
    d : ndarray, shape (n, m)
        Cumulative distances.

    Raises
    ------
    ValueError
        If curves lack points or coordinates, or differ in their number of coordinates, or the
        metric is unknown.
    TypeError
        If input is complex, text, objects or masked.
    ImportError
        If scipy is required and missing.

    See Also
    --------
    curvewise.dtw : the distance alone, in O(n + m) memory.

    Notes
    -----
    d[i, j] = c[i, j] + min(d[i − 1, j], d[i, j − 1], d[i − 1, j − 1]) with c the ground distance
    (Sakoe & Chiba 1978; Senin 2008). O(n·m) time and memory.

    Examples
    --------
    >>> from curvewise.compat import dtw
    >>> r, d = dtw([[0, 0], [1, 0]], [[0, 0], [0, 0], [1, 1]])
    >>> float(r), d.tolist()
    (1.0, [[0.0, 0.0, 1.4142135623730951], [1.0, 1.0, 1.0]])
    """
    P, Q = _curves(exp_data, num_data)
    if _is_compiled(metric, kwargs) and _is_finite(P, Q):
        order = kwargs.get("p")
        table = dtw_table(P, Q, metric=cast(Metric, metric), p=order, step_pattern="symmetric1")
    else:
        # With the dtypes that were given: callables and scipy's metrics for bits look at them.
        P, Q = np.asarray(exp_data).reshape(P.shape), np.asarray(num_data).reshape(Q.shape)
        table = _cumulative_table(_scipy_costs(P, Q, metric, kwargs), np.add)
    r: np.float64 = table[-1, -1]
    return r, table


def frechet_dist(exp_data: CurveLike, num_data: CurveLike, p: float = 2) -> np.float64:
    """Compute the discrete Fréchet distance.

    Parameters
    ----------
    exp_data, num_data : array_like, shapes (n, d) and (m, d)
        The curves.
    p : float
        Order of the Minkowski distance between points: 1 for Manhattan, 2 for Euclidean, inf for
        the largest coordinate. An order below 1 is whatever scipy makes of it.

    Returns
    -------
    df : numpy.float64
        The distance, in the units of the coordinates; nan where a coordinate is nan.

    Raises
    ------
    ValueError
        If curves lack points or coordinates, or differ in their number of coordinates.
    TypeError
        If input is complex, text, objects or masked, or `p` is not a number.
    ImportError
        If scipy is required and missing.

    See Also
    --------
    curvewise.frechet : the same with a choice of metrics.

    Notes
    -----
    Eiter & Mannila (1994). O(n·m) time, O(n + m) memory.

    Examples
    --------
    >>> from curvewise.compat import frechet_dist
    >>> float(frechet_dist([[0, 0], [1, 0], [2, 0]], [[0, 1], [2, 2]]))
    2.0
    """
    df: np.float64
    P, Q = _curves(exp_data, num_data)
    if _is_compiled("minkowski", {"p": p}) and _is_finite(P, Q):
        df = np.float64(frechet(P, Q, metric="minkowski", p=p))
    else:
        costs = _scipy_costs(P, Q, "minkowski", {"p": p})
        df = _cumulative_table(costs, np.maximum)[-1, -1]
    return df


def dtw_path(d: npt.ArrayLike) -> npt.NDArray[np.int64]:
    """Find the warping path of a cumulative table.

    Parameters
    ----------
    d : array_like, shape (n, m)
        Cumulative distances, from :func:`dtw`.

    Returns
    -------
    path : ndarray of int64, shape (k, 2)
        Index pairs from (0, 0) to (n − 1, m − 1). Among equal predecessors of (i, j): (i − 1, j),
        then (i, j − 1), then the diagonal one.

    Raises
    ------
    ValueError
        If the table is not (n, m), or is empty.
    TypeError
        If input is complex, text, objects or masked.

    See Also
    --------
    curvewise.dtw_path : needs no table, and prefers the diagonal.

    Notes
    -----
    Back-tracking (Senin 2008). O(n + m) time and memory.

    Examples
    --------
    >>> from curvewise.compat import dtw, dtw_path
    >>> r, d = dtw([[0], [1], [2]], [[0], [2]])
    >>> dtw_path(d).tolist()
    [[0, 0], [1, 1], [2, 1]]
    """
    table = as_numbers(d, "d")
    if table.ndim != 2 or table.size == 0:
        raise ValueError(f"d has shape {table.shape}; give a cumulative table of shape (n, m)")
    i, j = table.shape[0] - 1, table.shape[1] - 1
    backwards = [(i, j)]
    while i > 0 and j > 0:
        up, left, diagonal = table[i - 1, j], table[i, j - 1], table[i - 1, j - 1]
        smallest = min(up, left, diagonal)
        if up == smallest:
            i -= 1
        elif left == smallest:
            j -= 1
        else:
            i, j = i - 1, j - 1
        backwards.append((i, j))
    backwards += [(row, 0) for row in range(i - 1, -1, -1)]
    backwards += [(0, column) for column in range(j - 1, -1, -1)]
    return np.array(backwards[::-1], dtype=np.int64)


def _curves(exp_data: CurveLike, num_data: CurveLike) -> tuple[Array, Array]:
    """Return both curves in two dimensions: where one is (n,), d is 1."""
    curves = []
    for values, name in ((exp_data, "exp_data"), (num_data, "num_data")):
        curve = in_columns(as_numbers(values, name))
        if curve.size == 0:
            raise ValueError(
                f"{name} has shape {curve.shape}; a curve needs at least 1 point and 1 coordinate"
            )
        curves.append(curve)
    P, Q = curves
    if P.shape[1] != Q.shape[1]:
        raise ValueError(
            f"exp_data has shape {P.shape} and num_data has shape {Q.shape}; "
            "both need the same number of coordinates"
        )
    return P, Q


def _is_compiled(metric: str | Callable[..., float], options: dict[str, Any]) -> bool:
    """Return whether the compiled library has the metric with these of cdist's options."""
    if metric == "minkowski" and options.keys() == {"p"}:
        p = options["p"]
        return isinstance(p, (int, float, np.integer, np.floating)) and bool(p >= 1)
    return not options and metric in get_args(CoordinateMetric)  # what scipy has, too


def _is_finite(P: Array, Q: Array) -> bool:
    return bool(np.isfinite(P).all() and np.isfinite(Q).all())


def _scipy_costs(
    P: RealArray,
    Q: RealArray,
    metric: str | Callable[..., float],
    options: dict[str, Any],
) -> Array:
    try:
        scipy_distance = import_module("scipy.spatial.distance")
    except ImportError as error:
        raise ImportError(
            f"metric {metric!r} with options {options} on these curves needs scipy; "
            "install it with pip install 'curvewise[compat]'"
        ) from error
    costs: Array = scipy_distance.cdist(P, Q, metric, **options)
    if isinstance(metric, str):
        # Some metrics, chebyshev among them, ignore a nan, but the distance of a curve with nan is
        # undefined.
        undefined = np.isnan(P).any(axis=1, keepdims=True) | np.isnan(Q).any(axis=1)
        costs = np.where(undefined, np.nan, costs)
    return costs


def _cumulative_table(costs: Array, combine: np.ufunc) -> Array:
    """Return c[i, j] = combine(costs[i, j], smallest of c[i−1, j], c[i, j−1], c[i−1, j−1])."""
    n, m = costs.shape
    table = np.empty((n, m))
    table[0], table[:, 0] = combine.accumulate(costs[0]), combine.accumulate(costs[:, 0])
    if n == 1 or m == 1:
        return table
    # Cell (i, t − i) of anti-diagonal t is number t + i·(m − 1) of the flat table.
    flat, flat_costs = table.reshape(-1), np.ascontiguousarray(costs).reshape(-1)
    for t in range(2, n + m - 1):
        first, last = max(1, t - m + 1), min(n - 1, t - 1)
        start, stop, step = t + first * (m - 1), t + last * (m - 1) + 1, m - 1
        up, left, diagonal = (flat[start - back : stop - back : step] for back in (m, 1, m + 1))
        # Not np.minimum: where a callable gives nan, comparisons in this order skip it.
        smallest = np.where(left < up, left, up)
        smallest = np.where(diagonal < smallest, diagonal, smallest)
        flat[start:stop:step] = combine(flat_costs[start:stop:step], smallest)
    return table
