"""The discrete Fréchet distance: the shortest leash for two walks along the points.

The table c[i, j] holds the shortest leash for a coupling that ends at (i, j):

    c[i, j] = max(d(P[i], Q[j]), min(c[i-1, j], c[i, j-1], c[i-1, j-1]))

(Eiter & Mannila, 1994). It is filled along anti-diagonals i + j = s, whose cells depend on earlier
ones only. For the Euclidean distance the table is that of the squares, and roots are taken at the
end: sqrt is monotone, so max and min choose the same cells and the values have the same bits. The
coupling is read off the squares too, because the rounding of sqrt can make two of them equal that
are not. Time and memory O(n m).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .._options import Default, Metric, Order
from ..curves.ground_distance import check_metric, ground_distances, in_range, without_root
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from ..measures.results import Alignment
from .checks import check_pair
from .warping_table import filled_table, traced_path

__all__ = ["frechet", "frechet_path", "frechet_table"]


def frechet(
    P: CurveLike, Q: CurveLike, *, metric: Metric = Default.metric, p: Order = Default.p
) -> float:
    """Time and memory O(n m). Eiter & Mannila, "Computing discrete Fréchet distance" (1994)."""
    table = _accumulate(P, Q, metric, p)
    return float(table.restored(table.leashes[-1, -1]))


def frechet_path(
    P: CurveLike, Q: CurveLike, *, metric: Metric = Default.metric, p: Order = Default.p
) -> Alignment:
    """As for :func:`frechet`."""
    table = _accumulate(P, Q, metric, p)
    c = table.leashes

    def is_diagonal(i: int, j: int) -> bool:
        return bool(c[i - 1, j - 1] <= min(c[i - 1, j], c[i, j - 1]))

    coupling = traced_path(c, c.shape[1] - 1, is_diagonal)
    return Alignment(float(table.restored(c[-1, -1])), coupling)


def frechet_table(
    P: CurveLike, Q: CurveLike, *, metric: Metric = Default.metric, p: Order = Default.p
) -> Array:
    """As for :func:`frechet`."""
    table = _accumulate(P, Q, metric, p)
    return np.array(table.restored(table.leashes))


class _Table(NamedTuple):
    """A filled table, with what is needed to read a distance off it."""

    leashes: Array  # c[i, j], or its square, in units of 2**exponent
    squared: bool
    exponent: int

    def restored(self, values: Array) -> Array:
        """Return values of the table in units of the curves."""
        return times_power_of_two(np.sqrt(values) if self.squared else values, self.exponent)


def _accumulate(P: CurveLike, Q: CurveLike, metric: Metric, p: Order) -> _Table:
    """Check everything and fill the table."""
    P, Q = as_curves(P, Q)
    metric, order = check_metric(metric, p)
    P, Q = check_pair(P, Q, "frechet")
    P, Q, exponent = in_range(P, Q, metric)
    under_root = without_root(metric, P.shape[1])
    ground = ground_distances(P[:, np.newaxis], Q, under_root, order)
    leashes = filled_table(
        ground,
        lambda d, up, left, diagonal: np.maximum(d, np.minimum(np.minimum(up, left), diagonal)),
    )
    return _Table(leashes, under_root != metric, exponent)
