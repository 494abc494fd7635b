"""The discrete Fréchet distance, by dynamic programming.

The table c[i, j] holds the smallest maximum distance of a coupling that ends at (i, j):

    c[i, j] = max(d(P[i], Q[j]), min(c[i-1, j], c[i, j-1], c[i-1, j-1]))

(Eiter & Mannila, 1994). It is filled along anti-diagonals i + j = s, whose cells depend on earlier
ones only. For the Euclidean distance, or arcs, the table holds squares, and roots are taken at the
end. Roots are monotone, so max and min choose the same cells and the values are bitwise identical.
The coupling is also read from the squares, because rounding can make the roots of different squares
equal. Time and memory O(n m).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .._options import GroundDistance, Order, Radius
from ..curves.ground_distance import Root
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from ..measures.results import Alignment
from .checks import check_pair
from .closed import closed_frechet
from .ground import Ground
from .warping_table import filled_table, traced_path

__all__ = ["frechet", "frechet_path", "frechet_table"]


# Signature: frechet without workers, prune, cutoff, missing
def frechet(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    closed: bool = False,
) -> float:
    """Time and memory O(n m). Eiter & Mannila, "Computing discrete Fréchet distance" (1994).

    Closed curves: a table for each point at which Q may begin, O(n m²).
    """
    if closed:
        return closed_frechet(P, Q, metric, p, radius).distance
    table = _accumulate(P, Q, metric, p, radius)
    return float(table.restored(table.leashes[-1, -1]))


# Signature: frechet without workers, prune, cutoff, missing
def frechet_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    closed: bool = False,
) -> Alignment:
    """As for :func:`frechet`."""
    if closed:
        return closed_frechet(P, Q, metric, p, radius)
    table = _accumulate(P, Q, metric, p, radius)
    c = table.leashes

    def is_diagonal(i: int, j: int) -> bool:
        return bool(c[i - 1, j - 1] <= min(c[i - 1, j], c[i, j - 1]))

    coupling = traced_path(c, c.shape[1] - 1, is_diagonal)
    return Alignment(float(table.restored(c[-1, -1])), coupling)


# Signature: frechet without workers, prune, cutoff, missing, closed
def frechet_table(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
) -> Array:
    """As for :func:`frechet`."""
    table = _accumulate(P, Q, metric, p, radius)
    return np.array(table.restored(table.leashes))


class _Table(NamedTuple):
    """A filled table, with the data that give a distance."""

    leashes: Array  # c[i, j], or its square, in units of 2**exponent
    root: Root | None
    exponent: int

    def restored(self, values: Array) -> Array:
        """Return values of the table in units of the curves."""
        return times_power_of_two(self.root(values) if self.root else values, self.exponent)


def _accumulate(
    P: CurveLike, Q: CurveLike, metric: GroundDistance, p: Order, radius: Radius
) -> _Table:
    """Check everything and fill the table."""
    P, Q = as_curves(P, Q)
    distance = Ground.checked(P, Q, metric, p, radius)
    P, Q = check_pair(P, Q, "frechet", on_sphere=distance.is_on_sphere)
    ground, root, exponent = distance.before_root(P, Q)
    leashes = filled_table(
        ground,
        lambda d, up, left, diagonal: np.maximum(d, np.minimum(np.minimum(up, left), diagonal)),
    )
    return _Table(leashes, root, exponent)
