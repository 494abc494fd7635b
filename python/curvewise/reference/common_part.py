"""The common part of two curves: the earliest starts that reach each pair of points.

Time and memory O(n m).
"""

from __future__ import annotations

from typing import SupportsFloat

import numpy as np

from .._options import Metric, Order, Radius, real_number
from ..curves.inputs import CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from ..measures.results import CommonPart
from .checks import check_pair
from .ground import Ground

__all__ = ["common_part"]


def common_part(
    P: CurveLike,
    Q: CurveLike,
    distance: SupportsFloat,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
) -> CommonPart:
    """Every pair within the distance is reached from an earliest point of P, then of Q."""
    P, Q = as_curves(P, Q)
    ground = Ground.checked(P, Q, metric, p, radius)
    P, Q = check_pair(P, Q, "common_part", on_sphere=ground.is_on_sphere)
    most = real_number("distance", distance, 0.0, "give a number >= 0")
    is_free = times_power_of_two(*ground.distances(P, Q)) <= most
    edges = [
        float(times_power_of_two(*ground.distances(P[i : i + 1], P[i + 1 : i + 2]))[0, 0])
        for i in range(len(P) - 1)
    ]
    along = np.cumsum([0.0, *edges])
    starts: dict[tuple[int, int], tuple[int, int]] = {}
    best, longest = CommonPart(0.0, slice(0, 0), slice(0, 0)), -1.0
    for i, row in enumerate(is_free):
        for j in row.nonzero()[0].tolist():
            before = [(i - 1, j), (i - 1, j - 1), (i, j - 1)]
            starts[i, j] = min([starts[cell] for cell in before if cell in starts], default=(i, j))
        ends = [j for j in range(len(Q)) if (i, j) in starts]
        if not ends:
            continue
        j = min(ends, key=lambda j: starts[i, j])
        first, column = starts[i, j]
        if along[i] - along[first] > longest:
            longest = along[i] - along[first]
            length = float(np.cumsum([0.0, *edges[first:i]])[-1])
            best = CommonPart(length, slice(first, i + 1), slice(column, j + 1))
    return best
