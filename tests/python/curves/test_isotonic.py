"""Noise that reverses values: the fit, and records of machines resampled without changes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from curvewise.curves import resample, turning_points
from curvewise.curves.isotonic import ascending, isotonic

LISTS = st.lists(st.integers(-9, 9), min_size=1, max_size=12)


@given(LISTS)
def test_the_fit_is_that_of_the_max_min_formula(values: list[int]) -> None:
    # Barlow et al. (1972), theorem 1.3: the nearest values that do not descend.
    n = len(values)
    mean = {(a, b): np.mean(values[a : b + 1]) for a in range(n) for b in range(a, n)}
    expected = [max(min(mean[a, b] for b in range(i, n)) for a in range(i + 1)) for i in range(n)]
    np.testing.assert_allclose(isotonic(np.array(values, float)), expected, atol=1e-12)


@given(LISTS)
def test_pools_ascend_and_keep_the_sum_of_the_points(values: list[int]) -> None:
    points = np.arange(2.0 * len(values)).reshape(-1, 2)
    means, pooled = ascending(np.array(values, float), points)
    assert (np.diff(means) > 0.0).all()
    assert len(pooled) == len(means) <= len(points)
    assert points.min() <= pooled.min()
    assert pooled.max() <= points.max()


def test_a_noisy_column_is_resampled_to_its_line() -> None:
    random = np.random.default_rng(1)
    x = np.linspace(0.0, 1.0, 4001)
    noisy = np.column_stack((x, 3.0 * x)) + random.normal(0.0, 0.003, (x.size, 2))
    found = resample(noisy, 21, by=0)
    assert (np.diff(found[:, 0]) > 0.0).all()
    np.testing.assert_allclose(found[:, 1], 3.0 * found[:, 0], atol=0.02)


@pytest.mark.parametrize(
    "name",
    [
        "cyclic/eddq_tc_3pct",
        "cyclic/eddq_tension_rd",
        "loops/dp780_tct_3pct",
        "loops/eddq_tct_3pct",
    ],
)
def test_records_of_machines_are_resampled_as_they_are(name: str, data_dir: Path) -> None:
    record = np.loadtxt(data_dir / f"{name}.csv", delimiter=",")
    turns = turning_points(record)
    found = resample(record, 50, by=0, turns=turns)
    assert len(found) == 50 + 49 * len(turns)
    np.testing.assert_array_equal(turning_points(found), 49 * np.arange(1, len(turns) + 1))
