"""The ground distance of dtw and frechet: named or user-defined.

All distances at once, in a table of shape (n, m). Time and memory O(n m).
"""

from __future__ import annotations

from typing import NamedTuple, cast

import numpy as np

from .._options import GroundDistance, Metric, Order, Radius
from ..curves.ground_distance import Root, before_root, check_metric, ground_distances, in_range
from ..curves.inputs import Array
from ..curves.own_distance import (
    BlockDistances,
    block_distances,
    is_own_metric,
    refuse_own_metric,
)

__all__ = ["Ground"]


class Ground(NamedTuple):
    """A metric that has been checked."""

    metric: Metric
    order: float
    own: BlockDistances | None = None  # in place of both

    @classmethod
    def checked(
        cls, P: Array, Q: Array, metric: GroundDistance, p: Order, radius: Radius
    ) -> Ground:
        """Check it; a user-defined matrix must also fit these curves."""
        if not is_own_metric(metric):
            return cls(*check_metric(cast(Metric, metric), p, radius))
        refuse_own_metric(p, radius)
        return cls("euclidean", 2.0, block_distances(metric, P, Q))

    @property
    def is_on_sphere(self) -> bool:
        """Whether points are longitudes and latitudes."""
        return self.metric == "haversine"

    def distances(self, P: Array, Q: Array, constant: float = 0.0) -> tuple[Array, int]:
        """Return d(P[i], Q[j]) in units of 2**exponent, and that exponent.

        `constant` is one that is added to distances, see :func:`in_range`.
        """
        if self.own is not None:
            return np.array(self.own(0, len(P), 0, len(Q))), 0
        P, Q, exponent = in_range(P, Q, self.metric, constant)
        return ground_distances(P[:, np.newaxis], Q, self.metric, self.order), exponent

    def before_root(self, P: Array, Q: Array) -> tuple[Array, Root | None, int]:
        """Return the same, or values before a monotone root, and that root."""
        if self.own is not None:
            return np.array(self.own(0, len(P), 0, len(Q))), None, 0
        P, Q, exponent = in_range(P, Q, self.metric)
        return *before_root(P[:, np.newaxis], Q, self.metric, self.order), exponent
