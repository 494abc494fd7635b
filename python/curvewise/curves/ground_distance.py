"""The ground distance: how far each point of P is from each point of Q.

One row for each metric, in `_ROWS`: its arithmetic and what else the measures ask of it. The
coordinates are added one after another, c = 0 .. d-1, never by np.sum, whose pairwise order gives
other bits. Time O(n m d), memory O(n m).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple, TypeAlias, cast, get_args

import numpy as np

from .._options import EARTH_RADIUS, Metric, check_choice, real_number
from .inputs import Array
from .own_distance import is_own_metric
from .scaling import range_exponent, times_power_of_two
from .sphere import arcs, in_space

__all__ = ["before_root", "check_metric", "degree", "ground_distances", "in_range"]


_SAME_AS_MINKOWSKI: dict[float, Metric] = {
    1.0: "cityblock",
    2.0: "euclidean",
    np.inf: "chebyshev",
}


def check_metric(metric: Metric, p: Any, radius: Any = None) -> tuple[Metric, float]:
    """Check a metric and its order or radius; return metric and number.

    "minkowski" with p = 1, 2 or inf is computed as the equivalent metric. The order is 2 for
    metrics without an order.

    Raises
    ------
    ValueError
        If the metric is unknown or user-defined. If p or radius is given for a metric that does not
        have one. If p < 1 or radius <= 0.
    """
    if is_own_metric(metric):
        raise ValueError(
            "a metric of one's own is for dtw and frechet of one pair, their paths, tables and "
            "infos, and as a callable for cdist and pdist of them; nothing else computes with it, "
            f"or has bounds of it: choose from {', '.join(get_args(Metric))}"
        )
    check_choice("metric", metric, get_args(Metric))
    if radius is not None and metric != "haversine":
        raise ValueError(f"radius applies to metric='haversine' only, not to {metric!r}")
    if metric == "haversine" and p is None:
        length = EARTH_RADIUS if radius is None else radius
        length = real_number("radius", length, math.ulp(0.0), "give a finite number > 0")
        if math.isinf(length):
            raise ValueError(f"radius is {radius!r}; give a finite number > 0")
        return metric, length
    if p is None:
        return ("euclidean", 2.0) if metric == "minkowski" else (metric, 2.0)
    if metric != "minkowski":
        raise ValueError(f"p applies to metric='minkowski' only, not to {metric!r}")
    order = real_number("p", p, 1.0, "minkowski needs 1 <= p <= inf")
    return _SAME_AS_MINKOWSKI.get(order, metric), order


def in_range(
    P: Array, Q: Array, metric: Metric, constant: float = 0.0, coordinate: float = 0.0
) -> tuple[Array, Array, int]:
    """Return both curves scaled so that squares stay in range, and the exponent.

    A distance between the curves is the distance between the returned ones, times 2**exponent. The
    curves stay unchanged for a metric of degree 0, for which small coordinates count too. A
    constant that is added to distances is not enlarged beyond 2**1000: curves that are very small
    compared with it keep fewer bits. Other coordinates reach at most 2**500.
    """
    power = degree(metric)
    exponent = range_exponent(P, Q) if power > 0 else 0
    if exponent < 0 < constant:
        least = -((1000 - math.frexp(constant)[1]) // power)
        exponent = min(0, max(exponent, least))
    if coordinate != 0.0 and power > 0:
        exponent = max(exponent, math.frexp(coordinate)[1] - 500)
    P, Q = times_power_of_two(P, -exponent), times_power_of_two(Q, -exponent)
    return P, Q, exponent * power


def degree(metric: Metric) -> int:
    """Return the power of a common factor with which a distance grows."""
    return _ROWS[metric].degree


Root: TypeAlias = Callable[[Array], Array]


def before_root(P: Array, Q: Array, metric: Metric, p: float) -> tuple[Array, Root | None]:
    """Return ground distances before their root, and the root to apply last.

    This is valid if distances are only compared, because the root is monotone. Otherwise, and in
    one dimension, the result is the ground distances and None.
    """
    points = _points(P, Q, metric)
    root = _ROWS[metric].root
    if root is None or len(points) == 1:
        return ground_distances(P, Q, metric, p), None
    with np.errstate(under="ignore"):
        return _squares(points, p), partial(root, p)


def ground_distances(P: Array, Q: Array, metric: Metric, p: float) -> Array:
    """Return the distances between points, by the metric and order that `check_metric` returns.

    The last axis of P and of Q is that of the coordinates; the others are broadcast. Shapes (n, 1,
    d) and (m, d) give the (n, m) table, and two arrays of shape (k, d) the distances of k pairs.
    """
    row = _ROWS[metric]
    points = _points(P, Q, metric)
    if len(points) == 1 and row.is_absolute_in_one_dimension:
        row = _ROWS["cityblock"]
    with np.errstate(under="ignore"):
        return row.distances(points, p)


# The coordinates of the points, one pair of arrays for each.
_Points = list[tuple[Array, Array]]


def _points(P: Array, Q: Array, metric: Metric) -> _Points:
    if metric == "haversine":
        P, Q = in_space(P), in_space(Q)
    return [(P[..., c], Q[..., c]) for c in range(P.shape[-1])]


def _deltas(points: _Points) -> list[Array]:
    return [np.abs(p - q) for p, q in points]


def _added(terms: list[Array]) -> Array:
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total


def _squares(points: _Points, _: float) -> Array:
    return _added([delta * delta for delta in _deltas(points)])


def _euclidean(points: _Points, order: float) -> Array:
    return np.sqrt(_squares(points, order))


def _haversine(points: _Points, radius: float) -> Array:
    return arcs(_squares(points, radius), radius)


def _cityblock(points: _Points, _: float) -> Array:
    return _added(_deltas(points))


def _chebyshev(points: _Points, _: float) -> Array:
    return cast(Array, np.maximum.reduce(_deltas(points)))


def _minkowski(points: _Points, order: float) -> Array:
    # Relative to the largest, so that no power overflows.
    deltas = _deltas(points)
    largest = np.maximum.reduce(deltas)
    divisor = np.where(largest > 0, largest, 1.0)
    powers = _added([(delta / divisor) ** order for delta in deltas])
    return cast(Array, largest * powers ** (1 / order))


class _Row(NamedTuple):
    """The properties of a metric that the measures use."""

    distances: Callable[[_Points, float], Array]
    degree: int  # the power of a common factor with which a distance grows
    is_absolute_in_one_dimension: bool  # |difference|, and computed as that
    root: Callable[[float, Array], Array] | None = None  # of squares, where it is one


_ROWS: dict[Metric, _Row] = {
    "euclidean": _Row(_euclidean, 1, True, root=lambda _, squares: np.sqrt(squares)),
    "sqeuclidean": _Row(_squares, 2, False),
    "cityblock": _Row(_cityblock, 1, True),
    "chebyshev": _Row(_chebyshev, 1, True),
    "minkowski": _Row(_minkowski, 1, True),
    "haversine": _Row(_haversine, 0, False, root=lambda radius, squares: arcs(squares, radius)),
}
