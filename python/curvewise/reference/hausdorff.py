"""The Hausdorff distance between the points of two curves, off the table of all pairs.

For the Euclidean distance it is that of the squares, of which one root is taken at the end: sqrt is
monotone, so the bits are the same. Time and memory O(n m).
"""

from __future__ import annotations

import numpy as np

from .._options import Default, Metric, Order
from ..curves.ground_distance import check_metric, ground_distances, in_range, without_root
from ..curves.inputs import CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from .checks import check_pair

__all__ = ["hausdorff"]


def hausdorff(
    P: CurveLike, Q: CurveLike, *, metric: Metric = Default.metric, p: Order = Default.p
) -> float:
    """Time and memory O(n m)."""
    P, Q = as_curves(P, Q)
    metric, order = check_metric(metric, p)
    P, Q = check_pair(P, Q, "hausdorff")
    P, Q, exponent = in_range(P, Q, metric)
    under_root = without_root(metric, P.shape[1])
    ground = ground_distances(P[:, np.newaxis], Q, under_root, order)
    farthest = max(ground.min(axis=0).max(), ground.min(axis=1).max())
    value = np.sqrt(farthest) if under_root != metric else farthest
    return float(times_power_of_two(value, exponent))
