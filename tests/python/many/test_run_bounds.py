"""Bounds of z-normalised windows: below the distances, and close to them, whatever the level."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise.curves import z_normalized
from curvewise.curves.ground_distance import check_metric
from curvewise.curves.z_normalization import normalized_windows
from curvewise.many import run_bounds
from curvewise.many.normalized_runs import NormalizedRuns

Array = npt.NDArray[np.float64]
POINTS = 16
METRICS = ["euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski"]


def record(seed: int, dim: int, level: float, scale: float) -> Array:
    """Return a walk with a plateau, a plateau with one step in it, and repeats."""
    rng = np.random.default_rng(seed)
    walk = rng.normal(size=(160, dim)).cumsum(axis=0)
    walk[20:50] = walk[20]
    walk[60:90] = walk[60]
    walk[75:] += [1e-9] + [0.0] * (dim - 1)
    walk[120:140] = walk[:20]
    return np.asarray(walk * scale + level)


def bounds_and_distances(
    Q: Array, measure: Any, metric: Any, window: int | None
) -> tuple[Array, Array]:
    """Return those of all windows of Q, for a copy of one of them."""
    order = 3.0 if metric == "minkowski" else None
    options: dict[str, Any] = {"metric": metric, "p": order}
    P = z_normalized(5.0 * Q[100 : 100 + POINTS])
    bounds = run_bounds.run_bounds(P, Q, measure, *check_metric(metric, order), window)
    if window is not None:
        options["window"] = window
    windows = normalized_windows(Q, POINTS, range(len(Q) - POINTS + 1))
    (distances,) = curvewise.cdist([P], list(windows), measure, **options)
    return bounds, distances


@pytest.mark.parametrize("metric", METRICS)
@settings(max_examples=15)
@given(
    seed=st.integers(0, 2**32),
    dim=st.integers(1, 4),
    measure_and_window=st.sampled_from([("dtw", 0), ("dtw", 3), ("dtw", None), ("frechet", None)]),
)
def test_no_distance_is_below_its_bound(
    metric: str, seed: int, dim: int, measure_and_window: Any
) -> None:
    levels = [(level, 1.0) for level in (0.0, 1e3, 1e6, 1e9, 1e12, 1e15)]
    scales = [(0.0, scale) for scale in (1e160, 1e-160, 1e-300)]
    for level, scale in levels + scales:
        Q = record(seed, dim, level, scale)
        bounds, distances = bounds_and_distances(
            Q, measure_and_window[0], metric, measure_and_window[1]
        )
        assert (bounds <= distances).all()


@pytest.mark.parametrize("metric", METRICS)
@pytest.mark.parametrize(("level", "lost"), [(0.0, 1e-8), (1e6, 1e-4), (1e9, 1e-2), (1e12, 1e-6)])
def test_bounds_point_by_point_are_the_distances(level: float, lost: float, metric: str) -> None:
    for dim in (1, 2, 3):
        bounds, distances = bounds_and_distances(record(1, dim, level, 1.0), "dtw", metric, 0)
        assert (bounds >= distances * (1.0 - lost) - lost).all()


@pytest.fixture
def computed(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return a list that is told which windows are computed."""
    starts: list[int] = []
    compute = NormalizedRuns._compute

    def told(self: NormalizedRuns, batch: list[int], limit: float) -> None:
        starts.extend(batch)
        compute(self, batch, limit)

    monkeypatch.setattr(NormalizedRuns, "_compute", told)
    return starts


def test_few_windows_are_computed_where_bounds_are_close(computed: list[int]) -> None:
    Q = np.random.default_rng(2).normal(size=5000).cumsum()
    options: dict[str, Any] = {"window": 0, "metric": "sqeuclidean"}
    assert len(curvewise.subsequence(Q[1000:1050], Q, k=30, normalize=True, **options)) == 30
    assert len(computed) < 1000  # many begin where an answer is


def test_what_was_given_up_is_not_computed_again_for_each_answer(computed: list[int]) -> None:
    Q = np.random.default_rng(3).normal(size=3000).cumsum()
    curvewise.subsequence(Q[1000:1030], Q, k=60, window=6, normalize=True)
    assert len(computed) < 3 * len(set(computed))
