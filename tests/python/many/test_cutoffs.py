"""A cutoff changes a value above it to inf, and no other bit, whatever bounds leave out."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import curvewise

# Every measure whose pairs have bounds, by lanes or one by one, and some that have none.
CASES: list[tuple[str, dict[str, Any]]] = [
    ("dtw", {}),
    ("dtw", {"metric": "sqeuclidean"}),
    ("dtw", {"metric": "sqeuclidean", "window": 0.1}),
    ("dtw", {"window": 2}),
    ("dtw", {"metric": "sqeuclidean", "window": 0}),
    ("dtw", {"metric": "cityblock", "window": 3}),
    ("dtw", {"metric": "chebyshev"}),
    ("dtw", {"metric": "minkowski", "p": 3}),
    ("dtw", {"step_pattern": "symmetric2", "metric": "sqeuclidean", "window": 4}),
    ("dtw", {"step_pattern": "symmetric2", "normalize": True}),
    ("dtw", {"open_begin": True, "open_end": True}),
    ("dtw", {"open_end": True}),
    ("dtw", {"penalty": 0.5}),
    ("frechet", {}),
    ("frechet", {"metric": "cityblock"}),
    ("frechet_continuous", {}),
    ("hausdorff", {}),
    ("edr", {"epsilon": 0.5}),
    ("erp", {"window": 5}),
]


def clustered(sizes: list[int], dim: int, seed: int) -> list[np.ndarray]:
    """Walks around a few others, so that some pairs are near and most are far."""
    random = np.random.default_rng([seed, dim, len(sizes)])
    centres = random.normal(size=(4, max(sizes), dim)).cumsum(axis=1) + random.normal(
        size=(4, 1, dim), scale=4.0
    )
    return [
        centres[k % 4, :n] + random.normal(size=(n, dim), scale=0.3) for k, n in enumerate(sizes)
    ]


def check(measure: str, curves: Any, options: dict[str, Any], shares: Any = (0, 0.02, 0.2)) -> None:
    """Compare with the values, for cutoffs at some of them and next to these."""
    values = curvewise.cdist(curves, curves, measure, **options)
    apart = values[~np.eye(len(curves), dtype=bool)]
    is_symmetric = not (options.get("open_begin") or options.get("open_end"))
    for share in shares:
        value = np.quantile(apart, share, method="nearest")
        for cutoff in (value, np.nextafter(value, 0.0), np.nextafter(value, np.inf)):
            expected = np.where(values > cutoff, np.inf, values)
            got = curvewise.cdist(curves, curves, measure, cutoff=cutoff, **options)
            np.testing.assert_array_equal(got, expected)
            if is_symmetric:
                got = curvewise.pdist(curves, measure, cutoff=cutoff, **options)
                expected = expected[np.triu_indices(len(curves), 1)]
                np.testing.assert_array_equal(got, expected)


@pytest.mark.parametrize(("measure", "options"), CASES)
@pytest.mark.parametrize("dim", [1, 2, 3, 4, 7])
def test_equal_sizes(measure, options, dim):
    for n, count in ((9, 34), (40, 6)):
        check(measure, clustered([n] * count, dim, n), options, (0.05,))


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
@pytest.mark.parametrize("metric", ["euclidean", "sqeuclidean"])
@pytest.mark.parametrize("dim", [1, 2])
def test_many_sizes(measure, metric, dim):
    """The longest columns of a group of lanes are up to an eighth longer than the shortest."""
    sizes = [*range(1, 20), *range(40, 48), 64, 63, 60, 130, 270]
    check(measure, clustered(sizes, dim, 1), {"metric": metric}, (0.02, 0.2))


@pytest.mark.parametrize("window", [0, 1, 5, 0.05, 0.2, 400])
@pytest.mark.parametrize("dim", [1, 2])
@pytest.mark.parametrize("step_pattern", ["symmetric1", "symmetric2"])
def test_windows(window, dim, step_pattern):
    options = {"metric": "sqeuclidean", "window": window, "step_pattern": step_pattern}
    check("dtw", clustered([70] * 34, dim, 2), options, (0.02,))


@pytest.mark.parametrize("radius", [1e-9, 1.0, 6.4e6])
@pytest.mark.parametrize(("measure", "window"), [("dtw", 2), ("dtw", None), ("frechet", None)])
def test_spheres_of_any_radius(measure, window, radius):
    """Bounds are those of chords: for a small sphere, squares of chords exceed its distances."""
    options = {"metric": "haversine", "radius": radius}
    if window:
        options["window"] = window
    check(measure, clustered([40] * 12, 2, 7), options)


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
@pytest.mark.parametrize("power", [-900, -520, -401, 401, 900])
def test_scales(measure, power):
    """Curves that are scaled have no bounds, and the others keep theirs."""
    for dim in (1, 2):
        curves = clustered([20] * 30, dim, 3)
        for i in (0, 5, 17):
            curves[i] = np.ldexp(curves[i], power)
        curves[9] = np.zeros_like(curves[9])
        check(measure, curves, {}, (0.02, 0.9))
        check(measure, [np.ldexp(curve, power) for curve in clustered([20] * 12, dim, 4)], {})


@pytest.mark.parametrize(("measure", "options"), CASES)
@pytest.mark.parametrize("sizes", [(1, 1), (1, 5), (40, 33), (270, 260)])
def test_single_pairs(measure, options, sizes):
    """Within the first chunks of diagonals, between strips, and at the last cell."""
    if "window" in options and abs(sizes[0] - sizes[1]) > 0:
        options = {**options, "window": 40}
    if measure in ("erp", "edr", "frechet_continuous", "hausdorff") and sizes[0] > 200:
        sizes = (60, 50)
    for dim in (1, 2):
        function = getattr(curvewise, measure)
        for P, Q in (clustered(list(sizes), dim, 5), walks(sizes, dim)):
            value = function(P, Q, **options)
            for cutoff in (value, np.nextafter(value, 0.0), value / 3, value / 30, 0.0, 2 * value):
                if measure == "frechet_continuous":
                    got = curvewise.cdist([P], [Q], measure, cutoff=cutoff, **options)[0, 0]
                else:
                    got = function(P, Q, cutoff=cutoff, **options)
                assert got == (value if value <= cutoff else np.inf)


def walks(sizes: Any, dim: int) -> list[np.ndarray]:
    """One walk, and the same with noise."""
    random = np.random.default_rng([*sizes, dim])
    walk = random.normal(size=(max(sizes), dim)).cumsum(axis=0)
    return [walk[:n] + random.normal(size=(n, dim), scale=0.01) for n in sizes]


@pytest.mark.parametrize("workers", [2, 5])
def test_threads(workers):
    for n, window in ((30, 2), (120, None)):
        curves = clustered([n] * 90, 2, 6)
        values = curvewise.pdist(curves, "dtw", window=window)
        cutoff = np.quantile(values, 0.05)
        got = curvewise.pdist(curves, "dtw", window=window, cutoff=cutoff, workers=workers)
        np.testing.assert_array_equal(got, np.where(values > cutoff, np.inf, values))


@pytest.mark.parametrize(("n", "window"), [(30, 2), (120, None)])
def test_progress_counts_pairs_that_are_left_out(n, window):
    reports: list[tuple[int, int]] = []
    curves = clustered([n] * 50, 1, 7)
    cutoff = float(np.quantile(curvewise.pdist(curves, "dtw", window=window), 0.02))
    curvewise.pdist(
        curves,
        "dtw",
        window=window,
        cutoff=cutoff,
        progress=lambda done, total: reports.append((done, total)),
    )
    assert reports[-1] == (n * n * 50 * 49 // 2,) * 2


@given(
    sizes=st.lists(st.integers(1, 40), min_size=2, max_size=36),
    is_even=st.booleans(),
    dim=st.integers(1, 2),
    window=st.none() | st.integers(1, 12),
    metric=st.sampled_from(["sqeuclidean", "euclidean", "cityblock"]),
    measure=st.sampled_from(["dtw", "frechet"]),
    levels=st.integers(2, 9),
    share=st.floats(0, 1),
)
def test_any_batch(sizes, is_even, dim, window, metric, measure, levels, share):
    """Among small whole numbers, bounds and many values are equal to the cutoff."""
    random = np.random.default_rng(sum(sizes))
    sizes = [max(sizes)] * len(sizes) if is_even else sizes
    curves = [random.integers(0, levels, size=(n, dim)).astype(float) for n in sizes]
    options = {"metric": metric} | ({"window": window} if measure == "dtw" else {})
    values = curvewise.pdist(curves, measure, **options)
    cutoff = np.quantile(values, share, method="nearest")
    got = curvewise.pdist(curves, measure, cutoff=cutoff, **options)
    np.testing.assert_array_equal(got, np.where(values > cutoff, np.inf, values))


def test_values_of_a_batch_with_a_cutoff_are_those_of_single_calls():
    curves = clustered([24] * 20, 1, 8)
    values = [curvewise.dtw(P, Q, window=2) for P, Q in combinations(curves, 2)]
    cutoff = float(np.median(values))
    got = curvewise.pdist(curves, "dtw", window=2, cutoff=cutoff)
    np.testing.assert_array_equal(got, np.where(np.array(values) > cutoff, np.inf, values))
