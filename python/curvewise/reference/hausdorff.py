"""The Hausdorff distance between the points of two curves.

For the Euclidean distance, or arcs, the table of all pairs holds squares, and one root is taken at
the end. The root is monotone, so the result is bitwise identical. Time and memory O(n m).
"""

from __future__ import annotations

import numpy as np

from .._options import Metric, Order, Radius
from ..curves.ground_distance import before_root, check_metric, in_range
from ..curves.inputs import CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from .checks import check_pair

__all__ = ["hausdorff"]


# Signature: hausdorff without cutoff
def hausdorff(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
) -> float:
    """Time and memory O(n m)."""
    P, Q = as_curves(P, Q)
    metric, order = check_metric(metric, p, radius)
    P, Q = check_pair(P, Q, "hausdorff", on_sphere=metric == "haversine")
    P, Q, exponent = in_range(P, Q, metric)
    ground, root = before_root(P[:, np.newaxis], Q, metric, order)
    farthest = max(ground.min(axis=0).max(), ground.min(axis=1).max())
    value = root(farthest) if root else farthest
    return float(times_power_of_two(value, exponent))
