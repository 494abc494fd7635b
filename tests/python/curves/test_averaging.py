"""Dense, noisy records: their reversals, their remaining noise, and records that stay unchanged."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from curvewise.curves import turning_points
from curvewise.curves.averaging import averaged

ENDS = (0.0, 0.0101, -0.00993, 0.01003, -0.0097, 0.01011)


def along(parts: list[tuple[float, float]]) -> Callable[[np.ndarray], np.ndarray]:
    """Return a wave over times from 0 to 1, of lines that take some time to a value."""
    times, values = np.array([(0.0, ENDS[0]), *parts]).T
    times = np.cumsum(times)
    return lambda t: np.interp(t * times[-1], times, values)


def sine(t: np.ndarray) -> np.ndarray:
    """Return half waves between the ends, the first a quarter."""
    k = np.minimum((5.0 * t).astype(int), 4)
    part = 5.0 * t - k
    begin, end = np.array(ENDS)[k], np.array(ENDS)[k + 1]
    quarter = end * np.sin(0.5 * np.pi * part)
    return np.where(k == 0, quarter, begin + 0.5 * (end - begin) * (1.0 - np.cos(np.pi * part)))


WAVES = {
    "triangle": along([(1.0, end) for end in ENDS[1:]]),
    "sine": sine,
    "dwell": along([part for end in ENDS[1:] for part in ((1.0, end), (0.7, end))]),
    "fast unloading": along([((1.0, 0.2)[i % 2], end) for i, end in enumerate(ENDS[1:])]),
    "two speeds": along(
        [
            part
            for begin, end in pairwise(ENDS)
            for part in ((1.0, begin + 0.2 * (end - begin)), (0.6, end))
        ]
    ),
    "steps with rests": along(
        [
            (1.0, begin + (end - begin) * share)
            for begin, end in pairwise(ENDS)
            for share in np.repeat(np.linspace(0.2, 1.0, 5), 2)
        ]
    ),
}
# The error of a converter that shows one number for a whole dwell is not averaged.
MOVING = ("triangle", "fast unloading", "two speeds")


def check(wave: str, rows: int, noise: float, quantum: float, seed: int) -> None:
    true = WAVES[wave](np.linspace(0.0, 1.0, rows))
    seen = true + np.random.default_rng(seed).normal(0.0, noise, rows)
    if quantum:
        seen = quantum * np.round(seen / quantum)
    deviation = np.hypot(noise, quantum / np.sqrt(12.0))
    found, turns = averaged(np.column_stack((seen, true)), turning_points(seen))
    assert len(turns) == 4
    assert np.abs(found[turns, 0] - ENDS[1:5]).max() < deviation / 3.0
    error = found[:, 0] - found[:, 1]
    assert np.sqrt(np.mean(error**2)) < deviation / 3.0
    for a, b in pairwise([0, *turns, len(found) - 1]):
        assert abs(error[a : b + 1].mean()) < 0.1 * deviation


@pytest.mark.parametrize("wave", WAVES)
@pytest.mark.parametrize(("noise", "quantum"), [(1e-5, 0.0), (4e-5, 0.0), (1e-5, 1e-5)])
def test_reversals_are_found_through_noise(
    wave: str, noise: float, quantum: float, rounds: Callable[[int], int]
) -> None:
    for seed in range(6, 6 + rounds(5)):
        check(wave, 60_000, noise, quantum, seed)


@pytest.mark.parametrize("wave", MOVING)
@pytest.mark.parametrize(("noise", "quantum"), [(0.0, 4e-5), (3e-6, 2e-5)])
def test_reversals_are_found_between_the_numbers_of_a_converter(
    wave: str, noise: float, quantum: float
) -> None:
    check(wave, 60_000, noise, quantum, 0)


@pytest.mark.nightly
@pytest.mark.parametrize("wave", WAVES)
@pytest.mark.parametrize("rows", [60_000, 200_000])
def test_reversals_of_many_records(wave: str, rows: int) -> None:
    for seed in range(3):
        for noise, quantum in ((1e-5, 0.0), (3e-5, 0.0), (1e-4, 0.0), (1e-5, 1e-5), (2e-5, 4e-5)):
            check(wave, rows, noise, quantum, seed)


def test_the_other_columns_are_means_that_keep_to_the_curve() -> None:
    random = np.random.default_rng(5)
    true = WAVES["triangle"](np.linspace(0.0, 1.0, 60_000))
    record = np.column_stack((true, 100.0 * true, np.ones_like(true)))
    record += random.normal(0.0, 1.0, record.shape) * (2e-5, 0.3, 0.0)
    found, turns = averaged(record, turning_points(record))
    error = found[:, 1] - 100.0 * found[:, 0]
    rows = len(record) / len(found)  # in a block
    assert error.std() == pytest.approx(0.3 / np.sqrt(rows), rel=0.05)
    assert np.abs(error[[0, *turns, -1]]).max() < 4.0 * error.std()
    assert np.ptp(found[:, 2]) < 1e-9


def test_a_record_of_many_cycles_keeps_its_reversals() -> None:
    ends = np.array([0.0, *(0.01, -0.01) * 40, 0.01])
    true = np.interp(np.linspace(0.0, 81.0, 81 * 400), np.arange(82), ends)
    seen = true + np.random.default_rng(2).normal(0.0, 1.5e-4, len(true))
    found, turns = averaged(seen[:, np.newaxis], turning_points(seen))
    error = found[turns, 0] - ends[1:-1]
    assert np.sqrt(np.mean(error**2)) < 1.5e-4 / 3.0
    assert abs(error.mean()) < 1.5e-4 / 10.0


@pytest.mark.parametrize(
    ("branches", "rows"), [(1, 20), (1, 200), (3, 20), (3, 200), (3, 20_000), (40, 20), (40, 200)]
)
@pytest.mark.parametrize("noise", [0.0, 0.5])  # of the step from row to row
@pytest.mark.parametrize(
    "way",
    [
        lambda random, n: np.linspace(0.0, 1.0, n),
        lambda random, n: np.cumsum(random.exponential(1.0, n)) / n,
        lambda random, n: 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, n)),
        lambda random, n: np.minimum(np.linspace(0.0, 2.0, n), 1.0),
        lambda random, n: np.linspace(0.0, 1.0, n) ** 3,
    ],
    ids=["steady", "jerky", "sine", "dwell", "accelerated"],
)
def test_a_record_with_less_noise_than_its_step_is_left_alone(
    branches: int, rows: int, noise: float, way: Callable[..., np.ndarray]
) -> None:
    random = np.random.default_rng(7)
    ends = [0.0, *(0.01 * (-1.0) ** k for k in range(branches))]
    x = np.concatenate([a + (b - a) * way(random, rows) for a, b in pairwise(ends)])
    x += random.normal(0.0, noise * np.abs(np.diff(x)).mean(), len(x))
    assert averaged(np.column_stack((x, x)), turning_points(x)) is None


@pytest.mark.parametrize(
    "seen",
    [
        np.zeros(5000),
        np.arange(3.0),
        np.random.default_rng(0).normal(0.0, 1.0, 5000),
        np.linspace(0.0, 1.0, 5000) + np.random.default_rng(0).normal(0.0, 0.1, 5000),
    ],
    ids=["constant", "short", "noise alone", "loud"],
)
def test_what_cannot_be_seen_through_the_noise_is_left_alone(seen: np.ndarray) -> None:
    assert averaged(seen[:, np.newaxis], turning_points(seen)) is None


def test_measured_loops_are_left_alone(data_dir: Path) -> None:
    paths = [*(data_dir / "loops").glob("*.csv"), *(data_dir / "cyclic").glob("eddq*.csv")]
    assert len(paths) > 8
    for path in paths:
        loop = np.loadtxt(path, delimiter=",", skiprows=1)
        assert averaged(loop, turning_points(loop)) is None, path.name
