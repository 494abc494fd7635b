"""Short curves of a batch, computed several at a time, against single calls, to the bit.

Run as a program at a level of its own, it compares the batches of a file with this level's.
"""

from __future__ import annotations

import os
import subprocess
import sys
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import curvewise

LEVELS = curvewise.installation.build_info()["instruction_sets"]
# Around the lanes of one vector and of four, at every level.
COUNTS = [2, 3, 8, 9, 16, 17, 31, 32, 33, 41]
OPTIONS: list[tuple[str, dict[str, Any]]] = [
    ("dtw", {"metric": "sqeuclidean"}),
    ("dtw", {}),
    ("dtw", {"metric": "chebyshev"}),
    ("dtw", {"metric": "minkowski", "p": 3}),
    ("dtw", {"step_pattern": "symmetric2", "normalize": True}),
    ("dtw", {"step_pattern": "symmetric2", "metric": "sqeuclidean"}),
    ("frechet", {}),
    ("frechet", {"metric": "sqeuclidean"}),
    ("frechet", {"metric": "cityblock"}),
]


def walks(sizes: list[int], dim: int = 1, seed: int = 0) -> list[np.ndarray]:
    random = np.random.default_rng([seed, dim])
    return [random.normal(size=(n, dim)).cumsum(axis=0) for n in sizes]


def single_calls(measure: str, curves: Any, options: dict[str, Any]) -> np.ndarray:
    function = getattr(curvewise, measure)
    return np.array([function(P, Q, **options) for P, Q in combinations(curves, 2)])


@pytest.mark.parametrize("dim", [1, 2, 3, 8, 9])
@pytest.mark.parametrize(("measure", "options"), OPTIONS)
@pytest.mark.parametrize("n", [1, 2, 3, 17, 32, 65])
def test_equal_curves(measure, options, dim, n):
    curves = walks([n] * 35, dim, n)
    expected = single_calls(measure, curves, options)
    np.testing.assert_array_equal(curvewise.pdist(curves, measure, **options), expected)


@pytest.mark.parametrize("window", [0, 1, 2, 3, 6, 20, 63, 100, 0.1])
@pytest.mark.parametrize("metric", ["sqeuclidean", "euclidean"])
def test_windows(window, metric):
    options = {"metric": metric, "window": window}
    for n in (2, 16, 24, 64):
        curves = walks([n] * 33, 1, n)
        expected = single_calls("dtw", curves, options)
        np.testing.assert_array_equal(curvewise.pdist(curves, "dtw", **options), expected)


@pytest.mark.parametrize("count", COUNTS)
def test_every_number_of_curves(count):
    curves, query = walks([20] * count), walks([23], seed=1)
    for options in ({}, {"window": 2}):
        expected = [[curvewise.dtw(query[0], Q, **options) for Q in curves]]
        for workers in (1, 2, 5):
            got = curvewise.cdist(query, curves, "dtw", workers=workers, **options)
            np.testing.assert_array_equal(got, expected)
        np.testing.assert_array_equal(
            curvewise.Prepared(query[0], "dtw", **options)(curves), expected[0]
        )


@pytest.mark.parametrize("options", [{}, {"window": 5}, {"window": 0.9}, {"cutoff": 30.0}])
def test_mixed_lengths_in_any_order(options):
    sizes = np.random.default_rng(3).integers(1, 90, size=70)
    curves = walks([*sizes, 400, 2000])
    expected = single_calls("dtw", curves, options)
    for workers in (1, 2, 3):
        got = curvewise.pdist(curves, "dtw", workers=workers, **options)
        np.testing.assert_array_equal(got, expected)
    rectangle = curvewise.cdist(curves[:40], curves[40:], "dtw", **options)
    expected = [[curvewise.dtw(P, Q, **options) for Q in curves[40:]] for P in curves[:40]]
    np.testing.assert_array_equal(rectangle, expected)


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
@pytest.mark.parametrize("power", [-900, -520, -401, 401, 520, 900])
def test_extreme_scales_beside_usual_ones(measure, power):
    """Curves that are scaled, and squares below the fast root's domain, leave the others alone."""
    for dim in (1, 2):
        curves = walks([12] * 40, dim)
        for i in (0, 7, 8, 20, 39):
            curves[i] = np.ldexp(curves[i], power)
        curves[3] = np.zeros_like(curves[3])
        for metric in ("euclidean", "sqeuclidean"):
            expected = single_calls(measure, curves, {"metric": metric})
            np.testing.assert_array_equal(curvewise.pdist(curves, measure, metric=metric), expected)


@pytest.mark.parametrize("share", [0.0, 0.01, 0.3, 1.0])
@pytest.mark.parametrize(
    ("measure", "options"),
    [*OPTIONS, ("dtw", {"window": 1}), ("dtw", {"window": 4, "metric": "sqeuclidean"})],
)
def test_a_cutoff_gives_inf_above_it(measure, options, share):
    """A value equal to the cutoff stays, and so do its bits."""
    for curves in (walks([30] * 50), walks([30] * 9, 2), walks([*range(40, 48)] * 4)):
        values = curvewise.pdist(curves, measure, **options)
        cutoff = float(np.quantile(values, share, method="nearest"))
        assert cutoff in values
        expected = np.where(values > cutoff, np.inf, values)
        got = curvewise.pdist(curves, measure, cutoff=cutoff, **options)
        np.testing.assert_array_equal(got, expected)


def test_layouts_and_floats():
    curves = walks([25] * 20, 2)
    expected = curvewise.pdist(curves, "dtw")
    odd = [np.asfortranarray(P) for P in curves[:7]]
    odd += [np.repeat(P, 2, axis=0)[::2] for P in curves[7:13]]
    odd += [P[::-1].copy()[::-1] for P in curves[13:]]
    np.testing.assert_array_equal(curvewise.pdist(odd, "dtw"), expected)
    floats = [P.astype(np.float32) for P in curves]
    np.testing.assert_array_equal(curvewise.pdist(floats, "dtw"), single_calls("dtw", floats, {}))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_an_invalid_number_is_named(bad):
    curves = walks([10] * 40)
    curves[33][4] = bad
    with pytest.raises(ValueError, match=r"X\[33\]"):
        curvewise.pdist(curves, "dtw", window=1)


def test_progress_counts_every_pair():
    reports: list[tuple[int, int]] = []
    curves = walks([30] * 60)
    curvewise.pdist(curves, "dtw", progress=lambda done, total: reports.append((done, total)))
    assert reports[-1] == (30 * 30 * 60 * 59 // 2,) * 2
    assert all(a <= b for (a, _), (b, _) in pairwise(reports))


def test_a_progress_function_ends_the_call():
    class EnoughError(Exception):
        pass

    def stop(done: int, total: int) -> None:
        raise EnoughError

    with pytest.raises(EnoughError):
        curvewise.pdist(walks([60] * 400), "dtw", progress=stop)


@given(
    sizes=st.lists(st.integers(1, 40), min_size=2, max_size=45),
    dim=st.integers(1, 2),
    window=st.none() | st.integers(1, 12),
    metric=st.sampled_from(["sqeuclidean", "euclidean", "cityblock"]),
    step_pattern=st.sampled_from(["symmetric1", "symmetric2"]),
    levels=st.integers(2, 9),
)
def test_any_batch(sizes, dim, window, metric, step_pattern, levels):
    """Among small whole numbers, many paths cost the same."""
    random = np.random.default_rng(sum(sizes))
    curves = [random.integers(0, levels, size=(n, dim)).astype(float) for n in sizes]
    options = {"window": window, "metric": metric, "step_pattern": step_pattern}
    expected = single_calls("dtw", curves, options)
    np.testing.assert_array_equal(curvewise.pdist(curves, "dtw", **options), expected)


def batches() -> np.ndarray:
    found = []
    for measure, options in OPTIONS:
        for dim in (1, 2):
            found.append(curvewise.pdist(walks([27] * 37, dim), measure, **options))
    for window in (0, 1, 3):
        found.append(curvewise.pdist(walks([50] * 37), "dtw", window=window))
    found.append(curvewise.pdist(walks([*range(1, 60)]), "dtw"))
    return np.concatenate(found)


@pytest.mark.parametrize("level", LEVELS)
def test_bits_at_every_level(level: str, tmp_path: Path) -> None:
    file = tmp_path / "batches.npy"
    np.save(file, batches())
    done = subprocess.run(
        [sys.executable, __file__, str(file)],
        env={**os.environ, "CURVEWISE_ISA": level},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.split() == [level, "agrees"], done.stdout + done.stderr


if __name__ == "__main__":
    agrees = np.array_equal(np.load(sys.argv[1]), batches())
    print(curvewise.installation.build_info()["active"], "agrees" if agrees else "differs")
