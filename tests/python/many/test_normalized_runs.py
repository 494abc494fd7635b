"""subsequence(normalize=True): the runs that a search of all windows, one by one, finds."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import curvewise
from curvewise.curves import z_normalized

Array = npt.NDArray[np.float64]


def by_hand(curve: Array) -> Array:
    """Return a curve with mean 0 and deviation 1, summed without rounding."""
    columns = []
    for x in curve.reshape(len(curve), -1).T.tolist():
        mean = math.fsum(x) / len(x)
        deviation = math.sqrt(math.fsum((value - mean) ** 2 for value in x) / len(x))
        still = min(x) == max(x)
        columns.append([0.0 if still else (value - mean) / deviation for value in x])
    return np.reshape(np.array(columns).T, curve.shape)


def brute(P: Array, Q: Array, k: int, measure: str, **options: Any) -> list[tuple[float, int]]:
    """Return the best windows, one after another, each apart from those before."""
    n, function = len(P), getattr(curvewise, measure)
    left = {
        start: function(z_normalized(P), z_normalized(Q[start : start + n]), **options)
        for start in range(len(Q) - n + 1)
    }
    found: list[tuple[float, int]] = []
    while left and len(found) < k:
        best = min(left, key=lambda start: (left[start], start))
        found.append((left[best], best))
        left = {start: value for start, value in left.items() if abs(start - best) >= n}
    return found


def record(seed: int, points: int, dim: int) -> Array:
    """Return a walk on a large level, with repeats, plateaus, and places of another scale."""
    rng = np.random.default_rng(seed)
    walk = rng.normal(size=(points, dim)).cumsum(axis=0).round(1)
    walk[points // 3 : points // 3 + 30] = walk[points // 3]
    walk[points // 2 :] = walk[: points - points // 2] * 1e-3
    return np.asarray((walk + 1e4)[:, 0] if dim == 1 else walk + 1e4)


@pytest.mark.parametrize("dim", [1, 2])
@pytest.mark.parametrize(
    ("measure", "options"),
    [
        ("dtw", {}),
        ("dtw", {"window": 0, "metric": "sqeuclidean"}),
        ("dtw", {"window": 3, "metric": "minkowski", "p": 3}),
        ("frechet", {"metric": "chebyshev"}),
    ],
    ids=str,
)
def test_equal_to_a_search_of_all_windows(measure: Any, options: dict[str, Any], dim: int) -> None:
    for seed in (1, 4):
        Q = record(seed, 200, dim)
        start = 30 * seed
        P = np.exp(seed) * Q[start : start + 24] - 3.0
        expected = brute(P, Q, 5, measure, **options)
        found = curvewise.subsequence(P, Q, k=5, measure=measure, normalize=True, **options)
        assert [(run.distance, run.start) for run in found] == expected
        assert all(run.stop == run.start + 23 for run in found)
        cutoff = expected[2][0]
        some = curvewise.subsequence(
            P, Q, k=5, measure=measure, normalize=True, cutoff=cutoff, workers=2, **options
        )
        assert [run.start for run in some] == [at for value, at in expected if value <= cutoff]


def test_a_run_that_is_shifted_and_scaled_is_found_with_its_path() -> None:
    Q = record(3, 300, 2)
    P = 5.0 * Q[100:130] + [3.0, -7.0]
    (run,) = curvewise.subsequence(P, Q, normalize=True, path=True)
    assert (run.start, run.stop) == (100, 129)
    assert run.distance < 1e-6
    assert run.path is not None
    assert run.path[[0, -1]].tolist() == [[0, 100], [29, 129]]


def test_a_small_wave_on_a_large_level_keeps_its_digits() -> None:
    t = np.arange(2000.0)
    wave = np.sin(t / 7) * 2.0**-10
    exact = z_normalized(wave[500:564])
    level = 2.0**36  # the sum of squares less the square of the mean has lost all digits
    on_level = z_normalized((level + wave.round(9))[500:564])
    assert np.abs(on_level - exact).max() < 2e-2
    np.testing.assert_allclose(
        by_hand((level + wave)[500:564]), z_normalized((level + wave)[500:564]), atol=1e-9
    )
    for scale in (1e-300, 5e-324, 1e300):
        shape = np.array([0.0, 1.0, 3.0, 2.0]) * scale
        np.testing.assert_allclose(z_normalized(shape), z_normalized([0, 1, 3, 2]), rtol=1e-12)


def test_windows_that_stand_still_are_zero() -> None:
    assert z_normalized(np.full(7, 0.1)).tolist() == [0.0] * 7
    assert z_normalized([(0.1, 1), (0.1, 3)]).tolist() == [[0.0, -1.0], [0.0, 1.0]]
    Q = np.concatenate([np.full(20, 0.3), np.arange(20.0), np.full(20, 0.7)])
    found = curvewise.subsequence(np.full(10, 5.0), Q, k=3, normalize=True)
    assert [(run.distance, run.start) for run in found] == [(0.0, 0), (0.0, 10), (0.0, 40)]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"window": 3}, "window needs normalize=True"),
        ({"normalize": True, "window": -1}, "window is -1; give a whole number >= 0, a fraction"),
        ({"normalize": True, "window": 3, "measure": "frechet"}, "window needs measure='dtw'"),
        ({"normalize": True, "metric": "haversine"}, "normalize needs coordinates to scale"),
        ({"normalize": True, "cutoff": -1}, "cutoff is -1; give a number >= 0, or None"),
    ],
)
def test_refusals(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        curvewise.subsequence([(0, 1), (2, 3)], [(0, 1), (2, 3), (4, 4)], **options)
    with pytest.raises(ValueError, match=r"Q\[1, 0\] is nan; curves must be finite"):
        curvewise.subsequence([(0, 1)], [(0, 1), (np.nan, 3)], normalize=True)


def test_a_curve_longer_than_the_record_has_no_runs() -> None:
    assert curvewise.subsequence([0, 1, 2], [0, 1], normalize=True) == []
