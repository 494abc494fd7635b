"""An index of short curves, which computes several pairs at a time, against all distances.

The definition is that of test_index.py: ``cdist`` and a stable sort. Pairs of one size fill the
lanes of SIMD vectors, so the numbers of curves and of queries here are those around full vectors.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import curvewise
from curvewise import Index

# What is computed beside each other, with and without a band.
OPTIONS: list[tuple[str, dict[str, Any]]] = [
    ("dtw", {"metric": "sqeuclidean"}),
    ("dtw", {"metric": "sqeuclidean", "window": 2}),
    (
        "dtw",
        {
            "metric": "sqeuclidean",
            "window": 0.2,
            "step_pattern": "symmetric2",
            "normalize": True,
        },
    ),
    ("dtw", {}),
    ("dtw", {"window": 3, "step_pattern": "symmetric2"}),
    ("frechet", {}),
    ("frechet", {"metric": "sqeuclidean"}),
]
COUNTS = [1, 7, 8, 9, 31, 32, 33, 67]


def curves_of(
    random: np.random.Generator, count: int, n: int, dim: int, *, on_lattice: bool = False
) -> np.ndarray:
    """Return curves of which some are equal; on a lattice, many distances are equal, too."""
    if on_lattice:
        curves = random.integers(0, 3, size=(count, n, dim)).astype(float)
    else:
        curves = random.normal(size=(count, n, dim)).cumsum(axis=1)
        curves += 3 * random.integers(0, 3, size=(count, 1, dim))
    curves[count // 2 :: 3] = curves[0]
    return curves


def check(
    index: Index, X: Any, table: np.ndarray, *, counts: tuple[int, ...], workers: int = 1
) -> None:
    order = np.argsort(table, axis=1, kind="stable")
    sorted_table = np.take_along_axis(table, order, axis=1)
    for count in counts:
        distances, indices = index.kneighbors(X, count, workers=workers)
        np.testing.assert_array_equal(indices, order[:, :count])
        np.testing.assert_array_equal(distances, sorted_table[:, :count])
    for radius in (sorted_table[0, table.shape[1] // 3], np.nextafter(sorted_table.min(), -1), 0.0):
        if radius < 0:
            continue
        near = index.radius_neighbors(X, radius, workers=workers)
        bare = index.radius_neighbors(
            X, radius, return_distance=False, sort_results=False, workers=workers
        )
        for i, row in enumerate(sorted_table):
            np.testing.assert_array_equal(near[0][i], row[row <= radius])
            np.testing.assert_array_equal(near[1][i], order[i][row <= radius])
            np.testing.assert_array_equal(bare[i], np.flatnonzero(table[i] <= radius))


@pytest.mark.parametrize(("measure", "options"), OPTIONS)
@pytest.mark.parametrize("dim", [1, 2, 5])
@pytest.mark.parametrize("n", [1, 2, 8, 24, 65])
def test_equal_to_brute_force_around_full_vectors(measure, options, dim, n):
    random = np.random.default_rng([n, dim, len(measure)])
    for k, count in enumerate(COUNTS):
        on_lattice = (k + n) % 2 == 0
        curves = curves_of(random, count, n, dim, on_lattice=on_lattice)
        X = curves_of(random, COUNTS[-1 - k], n, dim, on_lattice=on_lattice)
        table = curvewise.cdist(X, curves, measure, **options)
        index = Index(curves, measure, **options)
        check(index, X, table, counts=(1, (count + 1) // 2, count), workers=1 + k % 3)


@pytest.mark.parametrize(("n", "dim", "window"), [(24, 1, 2), (24, 1, None), (40, 2, 3)])
@pytest.mark.parametrize("spread", [0.0, 30.0])
def test_many_curves_with_and_without_trees_that_pay(n, dim, window, spread):
    random = np.random.default_rng(n)
    curves = curves_of(random, 2500, n, dim) + spread * random.integers(0, 9, size=(2500, 1, dim))
    X = curves_of(random, 70, n, dim)
    options = {"metric": "sqeuclidean", "window": window}
    index = Index(curves[:1400], **options)
    index.add(curves[1400:])
    check(index, X, curvewise.cdist(X, curves, **options), counts=(1, 5, 40))


@pytest.mark.parametrize("window", [25, 42])
@pytest.mark.parametrize("metric", ["euclidean", "sqeuclidean"])
def test_long_curves_in_narrow_bands(window, metric):
    # Their bounds are raised before the distance is computed.
    random = np.random.default_rng(window)
    known = curves_of(random, 40, 430, 1)
    X = np.concatenate([known[:5] + 0.1, curves_of(random, 4, 430, 1)])
    options = {"metric": metric, "window": window}
    check(Index(known, **options), X, curvewise.cdist(X, known, **options), counts=(1, 6, 40))


def test_more_long_curves_than_are_searched_at_once():
    random = np.random.default_rng(3)
    known = curves_of(random, 2100, 300, 1)
    X = known[[0, 2099, 2070]] + 0.1
    options = {"metric": "sqeuclidean", "window": 40}
    check(Index(known, **options), X, curvewise.cdist(X, known, **options), counts=(1, 30))


def test_curves_of_the_index_removed_curves_and_saved_ones(tmp_path):
    random = np.random.default_rng(5)
    curves = curves_of(random, 90, 24, 1)
    options = {"metric": "sqeuclidean", "window": 3}
    index = Index(curves, **options)
    gone = np.r_[0:3, 31:34, 60, 89]
    index.remove(gone)
    kept = np.setdiff1d(np.arange(90), gone)
    index.save(tmp_path / "index")
    table = curvewise.cdist(curves[kept], curves[kept], **options)
    np.fill_diagonal(table, np.inf)
    order = np.argsort(table, axis=1, kind="stable")[:, :7]
    for some in (index, Index.open(tmp_path / "index")):
        for workers in (1, 2):
            distances, indices = some.kneighbors(n_neighbors=7, workers=workers)
            np.testing.assert_array_equal(indices, kept[order])
            np.testing.assert_array_equal(distances, np.take_along_axis(table, order, axis=1))


def test_curves_beyond_the_usual_range_and_float32():
    random = np.random.default_rng(6)
    curves = curves_of(random, 40, 24, 1)
    curves[5:9] *= 2.0**520
    curves[20] *= 2.0**-530
    X = np.concatenate([curves[3:7], curves_of(random, 30, 24, 1)])
    table = curvewise.cdist(X, curves)
    check(Index(curves), X, table, counts=(1, 40))
    single = curves_of(random, 40, 24, 1).astype(np.float32)
    X = [curve[::-1] for curve in curves_of(random, 33, 24, 1).astype(np.float32)]
    check(Index(single), X, curvewise.cdist(X, single), counts=(1, 5))


def test_queries_or_curves_of_different_lengths():
    random = np.random.default_rng(7)
    curves = curves_of(random, 40, 24, 1)
    X = [curve[: 20 + i % 5] for i, curve in enumerate(curves_of(random, 35, 24, 1))]
    check(Index(curves), X, curvewise.cdist(X, curves), counts=(1, 5))
    check(Index(X), curves, curvewise.cdist(curves, X), counts=(1, 5))


def test_more_neighbours_than_curves_are_refused():
    curves = curves_of(np.random.default_rng(7), 40, 24, 1)
    with pytest.raises(ValueError, match="n_neighbors is 41; give a whole number from 1 to 40"):
        Index(curves).kneighbors(curves, 41)


def test_a_query_that_is_nan_is_refused_by_name():
    curves = curves_of(np.random.default_rng(8), 40, 24, 1)
    X = curves.copy()
    X[37, 3] = np.nan
    with pytest.raises(ValueError, match=r"^X\[37\]\[3, 0\] is nan; curves must be finite$"):
        Index(curves).kneighbors(X, 1)


def test_progress_counts_every_pair_once():
    curves = curves_of(np.random.default_rng(9), 70, 24, 1)
    for workers in (1, 2):
        calls: list[tuple[int, int]] = []
        Index(curves).kneighbors(
            curves, 1, workers=workers, progress=lambda *call, to=calls: to.append(call)
        )
        total = (70 * 24) ** 2
        assert calls[-1] == (total, total)
        assert [done for done, _ in calls] == sorted(done for done, _ in calls)


def test_bounds_leave_out_most_pairs_of_groups():
    random = np.random.default_rng(10)
    groups = 100.0 * random.integers(0, 10, size=(200, 1, 1))
    curves = random.normal(size=(200, 24, 1)).cumsum(axis=1) + groups
    index = Index(curves, metric="sqeuclidean")
    pairs, refined, computed = index._index.kneighbors(curves, 1, 1, None, 0)[2]
    assert pairs == refined == 200 * 200
    assert computed < pairs / 5
