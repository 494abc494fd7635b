"""Clusters around medoids, from a matrix of all distances: FasterPAM.

Medoids are chosen one by one, each as the curve that most lowers the sum of distances to the
nearest medoid (BUILD of Kaufman & Rousseeuw 1990). Then they are exchanged. The other curves are
tried in turn. For each of them, the change of the sum for the exchange with each of the k medoids
is computed at once, in O(n). The best exchange is made as soon as it lowers the sum. See Schubert &
Rousseeuw, "Fast and eager k-medoids clustering", Information Systems 101, 2021. The search ends
when no exchange lowers the sum. Cost O(n^2 k) for the first medoids and O(n^2) for each pass over
all curves; memory O(n k) in addition to the matrix.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array

__all__ = ["Clusters", "k_medoids"]

Places = npt.NDArray[np.int64]

# An exchange must lower the sum by more than its rounding, so that exchanges do not cycle.
_ROUNDING = 1e-12
_ROWS = 256  # rows of the matrix that are processed together


class Clusters(NamedTuple):
    """Medoids in ascending order, each curve's medoid, and the sum of distances."""

    medoids: Places
    labels: Places
    cost: float
    rounds: int
    converged: bool


def k_medoids(distances: Array, count: int, rounds: int) -> Clusters:
    """Return `count` medoids of n curves, exchanged until no exchange lowers the sum.

    Parameters
    ----------
    distances : ndarray, shape (n, n)
        Row c has the distances of all curves from curve c, as a medoid.
    count : int
        Number of medoids, from 1 to n.
    rounds : int
        Maximum number of passes over all curves.

    Returns
    -------
    Clusters
    """
    medoids = _first_medoids(distances, count)
    kept = _Nearest(distances, medoids)
    n = len(distances)
    turns, idle = 0, 0  # idle: turns since the last exchange
    while idle < n and turns < rounds * n:
        candidate = turns % n
        turns, idle = turns + 1, idle + 1
        if candidate in medoids:
            continue
        change, place = kept.best_exchange(distances[candidate])
        if change < -_ROUNDING * abs(kept.cost):
            medoids[place] = candidate
            kept, idle = _Nearest(distances, medoids), 0
    medoids.sort()
    kept = _Nearest(distances, medoids)
    return Clusters(medoids, kept.medoid, kept.cost, -(-turns // n), idle >= n)


def _first_medoids(distances: Array, count: int) -> Places:
    """Return medoids; each lowers the sum most, given those before it."""
    n = len(distances)
    nearest = np.full(n, np.inf)
    chosen: list[int] = []
    for _ in range(count):
        # The sum itself for the first medoid, to avoid a difference with inf.
        sums = [
            np.minimum(distances[i : i + _ROWS], nearest).sum(axis=1) for i in range(0, n, _ROWS)
        ]
        costs = np.concatenate(sums)
        costs[chosen] = np.inf
        chosen.append(int(np.argmin(costs)))
        np.minimum(nearest, distances[chosen[-1]], out=nearest)
    return np.array(chosen)


class _Nearest:
    """For each curve its medoid, the distance from it, and from the second nearest one."""

    def __init__(self, distances: Array, medoids: Places) -> None:
        among = distances[medoids]
        self.count = len(medoids)
        self.medoid: Places = np.argmin(among, axis=0)
        self.first = among.min(axis=0)
        among[self.medoid, np.arange(among.shape[1])] = np.inf
        self.second = among.min(axis=0)
        self.cost = float(self.first.sum())

    def best_exchange(self, distances: Array) -> tuple[float, int]:
        """Return how the sum changes if a curve replaces the best medoid, and which that is.

        A curve whose medoid stays moves to the new medoid if that is nearer. A curve whose medoid
        leaves moves to the new or to its second nearest medoid. The common part is added up once.
        """
        gained = np.minimum(distances - self.first, 0.0)
        lost = np.minimum(np.maximum(distances, self.first), self.second) - self.first
        changes = np.bincount(self.medoid, lost, self.count)
        place = int(np.argmin(changes))
        return float(changes[place] + gained.sum()), place
