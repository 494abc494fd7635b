"""Lower bounds of dtw by their definitions, point by point."""

from __future__ import annotations

from typing import get_args

import numpy as np

from .._options import BoundMetric, Window, check_choice, window_radius
from ..curves.ground_distance import ground_distances
from ..curves.inputs import Array, CurveLike, as_curves
from .checks import check_pair
from .dtw import sakoe_chiba_band

__all__ = ["lb_improved", "lb_keogh", "lb_kim"]


def lb_keogh(
    P: CurveLike, Q: CurveLike, *, metric: BoundMetric = "euclidean", window: Window = None
) -> float:
    """One box of a band's points for each point of P. Time O(n m d)."""
    first, second = _checked(P, Q, metric, "lb_keogh")
    return _outside(first, _nearest_in_boxes(first, second, window), metric)


def lb_improved(
    P: CurveLike, Q: CurveLike, *, metric: BoundMetric = "euclidean", window: Window = None
) -> float:
    """Two such sums, not reduced by the bound of their rounding. Time O(n m d)."""
    first, second = _checked(P, Q, metric, "lb_improved")
    if first.shape[1] > 1 and metric not in ("sqeuclidean", "cityblock"):
        raise ValueError(
            f"metric is {metric!r}; lb_improved of {first.shape[1]} coordinates needs "
            "metric='sqeuclidean' or 'cityblock'; lb_keogh has the others"
        )
    nearest = _nearest_in_boxes(first, second, window)
    back = _nearest_in_boxes(second, nearest, window)
    return _outside(first, nearest, metric) + _outside(second, back, metric)


def lb_kim(P: CurveLike, Q: CurveLike, *, metric: BoundMetric = "euclidean") -> float:
    """Coordinate by coordinate. Time O(n d + m d)."""
    first, second = _checked(P, Q, metric, "lb_kim")
    features = [float(ground_distances(first[end], second[end], metric, 2.0)) for end in (0, -1)]
    for p, q in zip(first.T, second.T, strict=True):
        for extreme in (min, max):
            ends = np.array([extreme(p)]), np.array([extreme(q)])
            features.append(float(ground_distances(*ends, metric, 2.0)))
    return max(features)


def _checked(P: CurveLike, Q: CurveLike, metric: str, measure: str) -> tuple[Array, Array]:
    check_choice("metric", metric, get_args(BoundMetric))
    return check_pair(*as_curves(P, Q), measure)


def _nearest_in_boxes(P: Array, Q: Array, window: Window) -> Array:
    band = sakoe_chiba_band(len(P), len(Q), window_radius(window, len(P), len(Q)))
    boxes = [(Q[inside].min(axis=0), Q[inside].max(axis=0)) for inside in band]
    return np.array([p.clip(*box) for p, box in zip(P, boxes, strict=True)])


def _outside(P: Array, nearest: Array, metric: BoundMetric) -> float:
    total = 0.0
    for distance in ground_distances(P, nearest, metric, 2.0):
        total += float(distance)
    return total
