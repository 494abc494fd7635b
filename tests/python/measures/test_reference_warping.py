"""The numpy reference of dtw and frechet against all warping paths of short curves, enumerated.

As in `test_reference.py`, nothing is compared with the compiled library.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from typing import Any, get_args

import numpy as np
import numpy.typing as npt
import pytest

from curvewise import reference
from curvewise._options import CoordinateMetric

Array = npt.NDArray[np.float64]
Step = tuple[int, int]

GEOS_P = [(2, 5), (3, 3), (4, 3), (5, 4), (0, 0), (3, 4)]
GEOS_Q = [(0, 4), (4, 4), (5, 1)]


def warping_paths(n: int, m: int, open_begin: bool = False) -> Iterator[list[Step]]:
    """Yield every path to (n - 1, m - 1)."""
    if n == 1 and (m == 1 or open_begin):
        yield [(0, m - 1)]
    for i, j in ((n - 1, m), (n, m - 1), (n - 1, m - 1)):
        if i >= 1 and j >= 1 and not (n == 1 and open_begin):
            yield from ([*path, (n - 1, m - 1)] for path in warping_paths(i, j, open_begin))


def path_cost(ground: Array, path: list[Step], weight: float = 1.0) -> float:
    """Return the sum of ground distances along a path, diagonal steps `weight` times."""
    cost = float(ground[path[0]])
    for (i, j), cell in itertools.pairwise(path):
        cost += float(ground[cell]) * (weight if cell == (i + 1, j + 1) else 1.0)
    return cost


def leash(ground: Array, path: list[Step]) -> float:
    return max(float(ground[cell]) for cell in path)


def ground_by_hand(P: Array, Q: Array, metric: str) -> Array:
    norm: Callable[[Array], Any] = {
        "euclidean": lambda delta: math.sqrt(sum(delta**2)),
        "sqeuclidean": lambda delta: sum(delta**2),
        "cityblock": lambda delta: sum(abs(delta)),
        "chebyshev": lambda delta: max(abs(delta)),
        "minkowski": lambda delta: math.sqrt(sum(delta**2)),  # of order 2, the default
    }[metric]
    return np.array([[norm(p - q) for q in Q] for p in P])


def integer_pairs(seed: int, count: int, longest: int) -> Iterator[tuple[Array, Array]]:
    """Yield curves on a small integer grid, on which ties abound and most sums are exact."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        n, m = rng.integers(1, longest + 1, 2)
        d = rng.integers(1, 4)
        yield rng.integers(-3, 4, (n, d)).astype(float), rng.integers(-3, 4, (m, d)).astype(float)


@pytest.mark.parametrize("metric", get_args(CoordinateMetric))
@pytest.mark.parametrize(("step_pattern", "weight"), [("symmetric1", 1.0), ("symmetric2", 2.0)])
def test_dtw_is_the_cheapest_of_all_warping_paths(
    metric: Any, step_pattern: Any, weight: float
) -> None:
    options = {"metric": metric, "step_pattern": step_pattern}
    for P, Q in integer_pairs(1, 40, 5):
        ground = ground_by_hand(P, Q, metric)
        best = min(path_cost(ground, path, weight) for path in warping_paths(len(P), len(Q)))
        assert reference.dtw(P, Q, **options) == pytest.approx(best, rel=1e-14)
        found = reference.dtw_path(P, Q, **options)
        path = [(int(i), int(j)) for i, j in found.path]
        assert path in warping_paths(len(P), len(Q))
        assert path_cost(ground, path, weight) == found.distance


@pytest.mark.parametrize("metric", get_args(CoordinateMetric))
def test_frechet_is_the_shortest_leash_of_all_couplings(metric: Any) -> None:
    for P, Q in integer_pairs(2, 60, 5):
        ground = ground_by_hand(P, Q, metric)
        best = min(leash(ground, path) for path in warping_paths(len(P), len(Q)))
        assert reference.frechet(P, Q, metric=metric) == best
        found = reference.frechet_path(P, Q, metric=metric)
        path = [(int(i), int(j)) for i, j in found.path]
        assert path in warping_paths(len(P), len(Q))
        assert leash(ground, path) == found.distance == best


@pytest.mark.parametrize("open_begin", [False, True])
@pytest.mark.parametrize("open_end", [False, True])
def test_open_ends_match_a_part_of_q(open_begin: bool, open_end: bool) -> None:
    for P, Q in integer_pairs(3, 40, 5):
        ground = ground_by_hand(P, Q, "cityblock")
        ends = range(1, len(Q) + 1) if open_end else [len(Q)]
        costs = [
            min(path_cost(ground, path) for path in warping_paths(len(P), m, open_begin))
            for m in ends
        ]
        options: Any = {"metric": "cityblock", "open_begin": open_begin, "open_end": open_end}
        found = reference.dtw_path(P, Q, **options)
        assert found.distance == min(costs) == reference.dtw(P, Q, **options)
        assert found.path[-1, 1] == ends[int(np.argmin(costs))] - 1
        assert path_cost(ground, [(int(i), int(j)) for i, j in found.path]) == found.distance
        assert found.path[0, 0] == 0
        assert open_begin or found.path[0, 1] == 0


@pytest.mark.parametrize("window", [0, 1, 2])
def test_the_window_admits_only_paths_in_the_band(window: int) -> None:
    for P, Q in integer_pairs(4, 60, 5):
        n, m = len(P), len(Q)
        reach = window * (max(n, m) - 1) if min(n, m) > 1 else math.inf

        def inside(cell: Step, n: int = n, m: int = m, reach: float = reach) -> bool:
            return abs(cell[0] * (m - 1) - cell[1] * (n - 1)) <= reach

        ground = ground_by_hand(P, Q, "cityblock")
        paths = [path for path in warping_paths(n, m) if all(map(inside, path))]
        if not paths:
            words = f"window=0 admits no path between {n} and {m} points; use at least 1"
            with pytest.raises(ValueError, match=words):
                reference.dtw(P, Q, window=window)
            continue
        best = min(path_cost(ground, path) for path in paths)
        assert reference.dtw(P, Q, metric="cityblock", window=window) == best
        table = reference.dtw_table(P, Q, metric="cityblock", window=window)
        assert all(inside((i, j)) for i, j in np.argwhere(np.isfinite(table)))


def test_minkowski_is_the_cube_root_of_cubes() -> None:
    P, Q = np.random.default_rng(5).normal(size=(2, 9, 3))
    expected = float(sum(abs(P[0] - Q[0]) ** 3)) ** (1 / 3)
    assert reference.dtw(P[:1], Q[:1], metric="minkowski", p=3) == pytest.approx(
        expected, rel=1e-14
    )


@pytest.mark.parametrize(
    ("p", "metric"),
    [(1, "cityblock"), (2, "euclidean"), (None, "euclidean"), (math.inf, "chebyshev")],
)
def test_minkowski_of_a_named_order_is_that_metric(p: float | None, metric: Any) -> None:
    P, Q = np.random.default_rng(6).normal(size=(2, 9, 3))
    for table in (reference.dtw_table, reference.frechet_table):
        np.testing.assert_array_equal(
            table(P, Q, metric="minkowski", p=p), table(P, Q, metric=metric)
        )


def test_ties_go_to_the_diagonal_then_up_then_left() -> None:
    diagonal = [[0, 0], [1, 1], [2, 2]]
    assert reference.dtw_path([0, 0, 0], [0, 0, 0]).path.tolist() == diagonal
    assert reference.frechet_path([0, 0, 0], [0, 0, 0]).path.tolist() == diagonal
    # To (1, 1): 3 from above, 3 from the left, 4 along the diagonal.
    up = reference.dtw_path([0, 1], [0, -1], step_pattern="symmetric2")
    assert up.path.tolist() == [[0, 0], [0, 1], [1, 1]]
    # Before (2, 2) the value is 5 above and on the left, 10 on the diagonal.
    up = reference.frechet_path([0, 5, 0], [0, -5, 0])
    assert up.path.tolist() == [[0, 0], [0, 1], [1, 2], [2, 2]]
    # With an open end the first of two equal columns is taken.
    assert reference.dtw_path([1], [3, 1, 1], open_begin=True, open_end=True).path.tolist() == [
        [0, 1]
    ]


def test_frechet_of_the_pair_on_which_geos_errs() -> None:
    assert reference.frechet(GEOS_P, GEOS_Q) == 5.0
    assert reference.frechet(GEOS_Q, GEOS_P) == 5.0
