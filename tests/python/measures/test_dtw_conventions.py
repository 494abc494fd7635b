"""Distances per step, and bands given as fractions: dtw in the conventions of other packages."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, get_args

import numpy as np
import numpy.typing as npt
import pytest

import curvewise
from curvewise import reference
from curvewise._options import CoordinateMetric

Array = npt.NDArray[np.float64]

PER_STEP: dict[str, Any] = {"step_pattern": "symmetric2", "normalize": True}


def pair(seed: int, dim: int = 2) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    n, m = rng.integers(1, 60, 2)
    return rng.normal(size=(n, dim)).cumsum(axis=0), rng.normal(size=(m, dim)).cumsum(axis=0)


@pytest.mark.parametrize("metric", get_args(CoordinateMetric))
def test_normalized_is_the_distance_by_the_weight_of_a_path(metric: Any) -> None:
    for seed in range(50):
        P, Q = pair(seed)
        whole = curvewise.dtw(P, Q, metric=metric, step_pattern="symmetric2")
        found = curvewise.dtw(P, Q, metric=metric, **PER_STEP)
        assert found == whole / (len(P) + len(Q))
        assert found == reference.dtw(P, Q, metric=metric, **PER_STEP)
        path = curvewise.dtw_path(P, Q, metric=metric, step_pattern="symmetric2").path
        assert 2 + np.diff(path, axis=0).sum() == len(P) + len(Q)


def test_normalized_equals_dtw_python(data_dir: Path) -> None:
    expected = json.loads((data_dir / "golden" / "expected.json").read_text())["values"]
    checked = 0
    with np.load(data_dir / "golden" / "cases.npz") as curves:
        for name, case in expected.items():
            P, Q = curves[f"{name}/P"], curves[f"{name}/Q"]
            if (distance := case["dtw_symmetric2_euclidean"]) is None:
                continue
            assert curvewise.dtw(P, Q, **PER_STEP) == pytest.approx(
                distance / (len(P) + len(Q)), rel=1e-12
            )
            checked += 1
    assert checked > 0


def test_it_does_not_grow_with_the_number_of_points() -> None:
    t = np.linspace(0.0, 6.0, 2000)
    P = np.column_stack((t, np.sin(t)))
    Q = P + np.array((0.0, 0.1))
    assert curvewise.dtw(P, Q, **PER_STEP) == pytest.approx(
        curvewise.dtw(P[::4], Q[::4], **PER_STEP), rel=0.02
    )


def test_normalized_in_batches_and_with_a_cutoff() -> None:
    curves = [pair(seed)[0] for seed in range(12)]
    single = np.array([[curvewise.dtw(P, Q, **PER_STEP) for Q in curves] for P in curves])
    np.testing.assert_array_equal(curvewise.cdist(curves, measure="dtw", **PER_STEP), single)
    upper = single[np.triu_indices(12, 1)]
    np.testing.assert_array_equal(curvewise.pdist(curves, "dtw", **PER_STEP), upper)
    for cutoff in np.quantile(single, (0.2, 0.5, 0.8)):
        expected = np.where(single <= cutoff, single, np.inf)
        found = curvewise.cdist(curves, measure="dtw", cutoff=cutoff, **PER_STEP)
        np.testing.assert_array_equal(found, expected)
        for i, P in enumerate(curves):
            assert curvewise.dtw(P, curves[0], cutoff=cutoff, **PER_STEP) == expected[i, 0]


def test_paths_of_symmetric1_have_no_common_length() -> None:
    for dtw in (curvewise.dtw, reference.dtw):
        with pytest.raises(ValueError, match=r"^normalize needs step_pattern='symmetric2'"):
            dtw([1, 2], [1, 3], normalize=True)


@pytest.mark.parametrize("fraction", [0.05, 0.1, 1 / 3, 0.99, np.float64(0.25)])
def test_a_fraction_is_one_of_the_longer_curve(fraction: float) -> None:
    for seed in range(50):
        P, Q = pair(seed)
        radius = int(fraction * max(len(P), len(Q)))
        if radius == 0 and len(P) != len(Q) and min(len(P), len(Q)) > 1:
            for dtw in (curvewise.dtw, reference.dtw):
                with pytest.raises(ValueError, match=r"^window=0 admits no path between"):
                    dtw(P, Q, window=fraction)
            continue
        found = curvewise.dtw(P, Q, window=fraction)
        assert found == curvewise.dtw(P, Q, window=radius)
        assert found == reference.dtw(P, Q, window=fraction)
        path = curvewise.dtw_path(P, Q, window=fraction).path
        np.testing.assert_array_equal(path, reference.dtw_path(P, Q, window=fraction).path)


def test_a_fraction_in_batches_is_one_of_each_pair() -> None:
    curves = [pair(seed)[0] for seed in range(40, 52)]
    curves = [curve for curve in curves if len(curve) > 4]
    found = curvewise.cdist(curves, measure="dtw", window=0.5)
    for i, P in enumerate(curves):
        for j, Q in enumerate(curves):
            assert found[i, j] == curvewise.dtw(P, Q, window=0.5)
