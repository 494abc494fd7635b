"""The mean under dtw against the reference, and its guarantees; the medoid."""

from __future__ import annotations

import numpy as np
import pytest

import curvewise
from curvewise import reference


def waves(count: int, dim: int = 2) -> list[np.ndarray]:
    random = np.random.default_rng([count, dim])
    curves = []
    for n in random.integers(15, 30, count):
        t = np.linspace(0, 6, n) ** random.uniform(0.9, 1.1)
        curves.append(np.column_stack([np.sin(t + c) for c in range(dim)]))
    return curves


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"window": 12},
        {"window": 0.4},
        {"weights": [1, 0, 2.5, 0.5, 3]},
        {"iterations": 2, "tolerance": 0.0},
        {"iterations": 0},
    ],
)
@pytest.mark.parametrize("dim", [1, 3])
@pytest.mark.filterwarnings("ignore:the mean has not converged")
def test_equal_to_the_reference(options, dim):
    curves = waves(5, dim)
    expected = reference.nearest.dtw_mean(curves, curves[2][::2], **options)
    for workers in (1, 2, 3):
        found = curvewise.dtw_mean(curves, initial=curves[2][::2], workers=workers, **options)
        np.testing.assert_array_equal(found.curve, expected.curve)
        np.testing.assert_array_equal(found.costs, expected.costs)
        assert found.converged == expected.converged


def test_the_mean_of_series_is_a_series():
    series = [curve[:, 0] for curve in waves(4, 1)]
    expected = reference.nearest.dtw_mean(series, series[1])
    found = curvewise.dtw_mean(series, initial=series[1])
    assert found.curve.shape == series[1].shape
    np.testing.assert_array_equal(found.curve, expected.curve)


def test_the_cost_is_the_sum_of_the_distances_and_never_rises():
    curves = waves(12)
    mean = curvewise.dtw_mean(curves)
    assert np.all(np.diff(mean.costs) <= 0)
    distances = curvewise.cdist([mean.curve], curves, metric="sqeuclidean")
    assert mean.costs[-1] == pytest.approx(distances.sum())
    start = curvewise.medoid(curves, metric="sqeuclidean")
    assert mean.costs[0] == pytest.approx(
        curvewise.cdist([curves[start]], curves, metric="sqeuclidean").sum()
    )
    assert mean.converged


def test_the_mean_of_one_curve_is_that_curve():
    (curve,) = waves(1)
    mean = curvewise.dtw_mean([curve])
    np.testing.assert_array_equal(mean.curve, curve)
    assert mean.costs.tolist() == [0.0, 0.0]
    assert curvewise.dtw_mean([[1, 2, 3]]).curve.shape == (3,)


def test_errors_of_the_mean():
    curves = waves(3)
    for options, message in [
        ({"weights": [1, 2]}, "weights has 2 entries for 3 curves"),
        ({"weights": [1, -2, 1]}, r"weights\[1\] is -2"),
        ({"weights": [0, 0, 0]}, "all weights are 0"),
        ({"weights": 3}, "weights has 0 array dimensions"),
        ({"iterations": -1}, "iterations is -1; give a whole number >= 0"),
        ({"tolerance": -1}, "tolerance is -1"),
        ({"window": -1}, "window is -1"),
        ({"window": 0, "initial": curves[0][:3]}, "window=0 admits no path between 3 and"),
        ({"initial": [0, 1]}, r"initial has shape \(2,\) and curves\[0\]"),
        ({"initial": [(0, np.nan)]}, r"initial\[0, 1\] is nan"),
        ({"workers": 0}, "workers is 0"),
    ]:
        with pytest.raises(ValueError, match=message):
            curvewise.dtw_mean(curves, **options)
    with pytest.raises(ValueError, match="no curves; a mean needs at least 1"):
        curvewise.dtw_mean([], initial=[1])


def test_a_mean_that_could_still_be_moved_warns():
    curves = waves(5)
    said = r"the last of 2 moves lowered the sum by .* %; give more iterations, or a larger tol"
    for average in (curvewise.dtw_mean, curvewise.soft_dtw_mean):
        with pytest.warns(UserWarning, match=said):
            mean = average(curves, iterations=2)
        assert not mean.converged
    assert not curvewise.dtw_mean(curves, iterations=0).converged  # which asks for no move


def test_a_mean_shows_its_curves():
    for curves, axes in [
        (waves(70), ("x", "y")),
        (waves(3, 1), ("index", "value")),
        (waves(3, 3), ("coordinate 0", "coordinate 1")),
    ]:
        mean = curvewise.dtw_mean(iter(curves), initial=curves[0])
        (ax,) = mean.plot().axes
        assert (ax.get_xlabel(), ax.get_ylabel()) == axes
        *drawn, line = ax.lines
        assert len(drawn) == min(50, len(curves))
        np.testing.assert_array_equal(line.get_ydata(), mean.curve[:, :2][:, -1])
        assert "sum of distances" in str(mean.parts()[0].text())
    assert len(reference.nearest.dtw_mean(curves, curves[0]).plot().axes[0].lines) == 1


@pytest.mark.filterwarnings("ignore:the mean has not converged")
def test_progress_of_the_mean():
    calls: list[tuple[int, int]] = []
    curves = waves(6) * 20
    curvewise.dtw_mean(curves, iterations=3, progress=lambda *call: calls.append(call))
    assert calls[-1][0] == calls[-1][1]
    assert [done for done, _ in calls] == sorted(done for done, _ in calls)


@pytest.mark.parametrize("measure", curvewise.available_measures())
def test_the_medoid_has_the_smallest_sum(measure, monkeypatch):
    curves = waves(9)
    options = {"scale": "range"} if measure == "curve_length" else {}
    table = curvewise.cdist(curves, measure=measure, **options)
    expected = int(np.argmin(table.sum(axis=0)))
    assert curvewise.medoid(curves, measure, **options) == expected
    monkeypatch.setattr("curvewise.many.averages._BLOCK", 20)  # two curves at a time
    assert curvewise.medoid(curves, measure, **options) == expected


def test_the_medoid_of_nothing():
    with pytest.raises(ValueError, match="no curves; a medoid needs at least 1"):
        curvewise.medoid([])
    with pytest.raises(ValueError, match=r"XA\[1\]\[0\] is nan"):
        curvewise.medoid([[0], [np.nan]])


@pytest.mark.parametrize("gamma", [0.01, 1.0])
def test_the_soft_mean_is_where_slopes_vanish(gamma: float) -> None:
    random = np.random.default_rng(4)
    curves = [random.normal(size=(n, 2)).cumsum(axis=0) for n in (9, 12, 9, 15)]
    weights = np.array([1.0, 2.0, 0.5, 1.0])
    mean = curvewise.soft_dtw_mean(
        curves, gamma=gamma, weights=weights, iterations=500, tolerance=1e-13
    )
    assert mean.converged
    assert (np.diff(mean.costs) <= 0).all()
    pairs = [
        curvewise.value_and_gradient(curve, mean.curve, "soft_dtw", gamma=gamma) for curve in curves
    ]
    assert mean.costs[-1] == pytest.approx(
        sum(w * v for w, (v, _) in zip(weights, pairs, strict=True))
    )
    slopes = [w * gradient for w, (_, gradient) in zip(weights, pairs, strict=True)]
    assert np.abs(np.sum(slopes, axis=0)).max() < 1e-4 * np.abs(slopes).max()
    moved = mean.curve + 0.01 * random.normal(size=mean.curve.shape)
    assert (
        sum(
            w * curvewise.soft_dtw(moved, curve, gamma=gamma)
            for w, curve in zip(weights, curves, strict=True)
        )
        > mean.costs[-1]
    )


def test_the_soft_mean_of_equal_curves_and_of_those_with_one_coordinate() -> None:
    curve = np.sin(np.arange(20) / 3)
    mean = curvewise.soft_dtw_mean([curve, curve], gamma=1e-4)
    np.testing.assert_allclose(mean.curve, curve, atol=0.02)
    assert mean.curve.shape == curve.shape


def test_errors_of_the_soft_mean() -> None:
    with pytest.raises(ValueError, match="no curves"):
        curvewise.soft_dtw_mean([], initial=[1.0])
    with pytest.raises(ValueError, match="weights has 1 entries for 2 curves; give one for each"):
        curvewise.soft_dtw_mean([[1.0], [2.0]], weights=[1.0])
    with pytest.raises(ValueError, match="gamma is 0; give a finite number > 0"):
        curvewise.soft_dtw_mean([[1.0], [2.0]], gamma=0)
    with pytest.raises(ValueError, match=r"curves\[1\]\[0\] is nan"):
        curvewise.soft_dtw_mean([[1.0], [np.nan]], initial=[1.0])
    with pytest.raises(ValueError, match="iterations is -1; give a whole number >= 0"):
        curvewise.soft_dtw_mean([[1.0], [2.0]], iterations=-1)
