"""dtw and frechet of closed curves, by a table for each point at which Q may begin.

Rows are P's points and its first one again, columns Q's points from one on and that one again. The
first and the last cell are the same pair, which counts once. A point at the end of a curve that
equals its first one is left out. Time O(n m²), memory O(n m).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .._options import GroundDistance, Order, Radius
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.own_distance import is_own_metric
from ..curves.scaling import times_power_of_two
from ..measures.results import Alignment
from .checks import check_pair
from .ground import Ground

__all__ = ["closed_dtw", "closed_frechet", "without_repeated_end"]


class _Walk(NamedTuple):
    value: float
    pairs: npt.NDArray[np.int64]


def closed_dtw(
    P: CurveLike, Q: CurveLike, metric: GroundDistance, p: Order, radius: Radius
) -> Alignment:
    """Return the least sum of the distances of a closed walk, and its pairs."""
    distances, exponent = _distances("dtw", P, Q, metric, p, radius)
    walk = _least(distances, lambda before, d: before + d, counts_first=False)
    return Alignment(float(times_power_of_two(np.array(walk.value), exponent)), walk.pairs)


def closed_frechet(
    P: CurveLike, Q: CurveLike, metric: GroundDistance, p: Order, radius: Radius
) -> Alignment:
    """Return the least maximum of the distances of a closed walk, and its pairs."""
    distances, exponent = _distances("frechet", P, Q, metric, p, radius)
    walk = _least(distances, max, counts_first=True)
    return Alignment(float(times_power_of_two(np.array(walk.value), exponent)), walk.pairs)


def _distances(
    measure: str, P: CurveLike, Q: CurveLike, metric: GroundDistance, p: Order, radius: Radius
) -> tuple[Array, int]:
    if is_own_metric(metric):
        raise ValueError("closed=True takes a metric by its name")
    A, B = as_curves(P, Q)
    distance = Ground.checked(A, B, metric, p, radius)
    A, B = check_pair(A, B, measure, on_sphere=distance.is_on_sphere)
    return distance.distances(without_repeated_end(A), without_repeated_end(B))


def without_repeated_end(curve: Array) -> Array:
    """Return a closed curve without a last point that equals the first one."""
    closes = len(curve) > 1 and np.array_equal(curve[0], curve[-1])
    return curve[:-1] if closes else curve


def _least(distances: Array, join: Callable[[float, float], float], *, counts_first: bool) -> _Walk:
    n, m = distances.shape
    walks = []
    for begin in range(m):
        columns = (begin + np.arange(m + 1)) % m
        cells = distances[np.ix_(np.arange(n + 1) % n, columns)].tolist()
        first = cells[0][0] if counts_first else 0.0
        walk = _least_from(cells, first, join)
        pairs = walk.pairs[:-1]  # the first pair, met again
        walks.append(_Walk(walk.value, np.column_stack([pairs[:, 0] % n, columns[pairs[:, 1]]])))
    return min(walks, key=lambda walk: walk.value)


def _least_from(
    cells: list[list[float]], first: float, join: Callable[[float, float], float]
) -> _Walk:
    """Fill one table, and trace its path."""
    table: dict[tuple[int, int], float] = {(0, 0): first}
    before: dict[tuple[int, int], tuple[int, int]] = {}
    for i, row in enumerate(cells):
        for j, d in enumerate(row):
            from_cells = [(i - 1, j - 1), (i - 1, j), (i, j - 1)]
            if known := [cell for cell in from_cells if cell in table]:
                before[i, j] = min(known, key=table.__getitem__)
                table[i, j] = join(table[before[i, j]], d)
    path = [(len(cells) - 1, len(cells[0]) - 1)]
    while path[-1] != (0, 0):
        path.append(before[path[-1]])
    return _Walk(table[path[0]], np.array(path[::-1], dtype=np.int64))
