"""The ground distance: how far each point of P is from each point of Q.

The coordinates are added one after another, c = 0 .. d-1, never by np.sum, whose pairwise order
gives other bits. In one dimension euclidean, cityblock, chebyshev and minkowski are all the
absolute difference. Time O(n m d), memory O(n m).
"""

from __future__ import annotations

from typing import Any, cast, get_args

import numpy as np

from .._options import Metric, check_choice
from .inputs import Array

__all__ = ["check_metric", "degree", "ground_distances"]


_SAME_AS_MINKOWSKI: dict[float, Metric] = {
    1.0: "cityblock",
    2.0: "euclidean",
    np.inf: "chebyshev",
}


def check_metric(metric: Metric, p: Any) -> tuple[Metric, float]:
    """Check a metric and its order, and return those that are computed.

    "minkowski" with p = 1, 2 or inf is computed as the metric that it is; the order of a metric
    that has none is returned as 2.

    Raises
    ------
    ValueError
        An unknown metric, p with a metric that has none, or p < 1.
    """
    check_choice("metric", metric, get_args(Metric))
    if p is None:
        return ("euclidean", 2.0) if metric == "minkowski" else (metric, 2.0)
    if metric != "minkowski":
        raise ValueError(f"p applies to metric='minkowski' only, not to {metric!r}")
    order = _order(p)
    return _SAME_AS_MINKOWSKI.get(order, metric), order


def _order(p: Any) -> float:
    try:
        order = np.nan if isinstance(p, (str, bytes)) else float(p)
    except (TypeError, ValueError, OverflowError):
        order = np.nan
    if not order >= 1:
        raise ValueError(f"p is {p!r}; minkowski needs 1 <= p <= inf")
    return order


def degree(metric: Metric) -> int:
    """Return by which power of a factor the distance grows when both curves do."""
    return 2 if metric == "sqeuclidean" else 1


def ground_distances(P: Array, Q: Array, metric: Metric, p: float) -> Array:
    """Return the distances between points, by the metric and order that `check_metric` returns.

    The last axis of P and of Q is that of the coordinates; the others are broadcast: shapes
    (n, 1, d) and (m, d) give the (n, m) table, and (k, d) twice the distances of k pairs.
    """
    # Absolute differences, one array for each coordinate.
    deltas = [np.abs(P[..., c] - Q[..., c]) for c in range(P.shape[-1])]
    if len(deltas) == 1 and metric != "sqeuclidean":
        return cast(Array, deltas[0])
    if metric == "cityblock":
        return _added(deltas)
    if metric == "chebyshev":
        return cast(Array, np.maximum.reduce(deltas))
    with np.errstate(under="ignore"):
        if metric == "minkowski":
            return _minkowski(deltas, p)
        squares = _added([delta * delta for delta in deltas])
        return squares if metric == "sqeuclidean" else np.sqrt(squares)


def _added(terms: list[Array]) -> Array:
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total


def _minkowski(deltas: list[Array], p: float) -> Array:
    # Relative to the largest, so that no power overflows.
    largest = np.maximum.reduce(deltas)
    divisor = np.where(largest > 0, largest, 1.0)
    powers = _added([(delta / divisor) ** p for delta in deltas])
    return cast(Array, largest * powers ** (1 / p))
