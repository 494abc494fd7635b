"""curvewise.aeon: the bits of curvewise's functions, the values of aeon, and errors."""

from __future__ import annotations

import pickle
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import curvewise
import curvewise.aeon

needs_aeon = pytest.mark.skipif(
    find_spec("aeon") is None, reason='no aeon: pip install "curvewise[aeon]"'
)
# An option of each, there and here.
DISTANCES: list[tuple[str, dict[str, Any], str, dict[str, Any]]] = [
    ("dtw", {}, "dtw", {"metric": "sqeuclidean"}),
    ("adtw", {}, "dtw", {"metric": "sqeuclidean", "penalty": 1.0}),
    ("adtw", {"warp_penalty": 0.3}, "dtw", {"metric": "sqeuclidean", "penalty": 0.3}),
    ("wdtw", {"g": 0.2}, "wdtw", {"steepness": 0.2}),
    ("lcss", {"epsilon": 0.4}, "lcss", {"epsilon": 0.4}),
    ("erp", {"g": 0.3}, "erp", {"gap": 0.3}),
    ("edr", {"epsilon": 0.3}, "edr", {"epsilon": 0.3}),
    ("twe", {"nu": 0.02, "lmbda": 0.5}, "twe", {"stiffness": 0.02, "penalty": 0.5}),
    ("msm", {"c": 0.3}, "msm", {"cost": 0.3}),
    ("frechet", {}, "frechet", {}),
    ("frechet_continuous", {}, "frechet_continuous", {}),
    ("hausdorff", {}, "hausdorff", {}),
]
every_distance = pytest.mark.parametrize(("name", "given", "measure", "options"), DISTANCES)
OF_AEON = [(name, given) for name, given, *_ in DISTANCES[:9]]


def function(name: str, kind: str = "distance") -> Any:
    return getattr(curvewise.aeon, f"{name}_{kind}")


def series(*shape: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=shape)


@every_distance
def test_series_are_curves_transposed(
    name: str, given: dict[str, Any], measure: str, options: dict[str, Any]
) -> None:
    known = getattr(curvewise, measure)
    x, y = series(2, 9), series(2, 12, seed=1)
    assert function(name)(x, y, **given) == known(x.T, y.T, **options)
    assert function(name)(x[0], y[0], **given) == known(x[0], y[0], **options)
    assert function(name)(x[:1], y[:1], **given) == known(x[0], y[0], **options)


@every_distance
def test_every_layout_of_a_collection(
    name: str, given: dict[str, Any], measure: str, options: dict[str, Any]
) -> None:
    distance, pairwise = function(name), function(name, "pairwise_distance")
    X, Y = series(4, 2, 9), series(3, 2, 12, seed=1)
    expected = [[distance(x, y, **given) for y in Y] for x in X]
    assert_array_equal(pairwise(X, Y, **given), expected)
    assert_array_equal(pairwise(list(X), list(Y), n_jobs=-1, **given), expected)
    assert_array_equal(pairwise(X, Y[0], **given), np.array(expected)[:, :1])  # one series
    assert_array_equal(pairwise(X[0], Y, **given), expected[:1])
    flat = [[distance(x, y, **given) for y in Y[:, 0]] for x in X[:, 0]]
    assert_array_equal(pairwise(X[:, 0], Y[:, 0], **given), flat)  # (n_cases, n_timepoints)
    assert_array_equal(pairwise(X[:, 0], Y[0, 0], **given), np.array(flat)[:, :1])
    itself = pairwise(X, **given)
    assert_array_equal(itself, pairwise(X, X, **given))


@pytest.mark.parametrize("name", ["dtw", "adtw", "wdtw", "erp", "edr", "twe"])
def test_matrices_and_paths(name: str) -> None:
    x, y = series(2, 9), series(2, 12, seed=1)
    path, distance = function(name, "alignment_path")(x, y)
    assert distance == function(name)(x, y)
    assert path[-1] == (8, 11)  # the first of edr may be any of the first points
    assert function(name, "cost_matrix")(x, y).shape == (9, 12)


def test_a_window_is_a_share_of_the_length() -> None:
    x, y = series(10), series(10, seed=1)
    for share, band in ((0.0, 0), (0.1, 1), (0.35, 3)):
        expected = curvewise.dtw(x, y, metric="sqeuclidean", window=band)
        assert curvewise.aeon.dtw_distance(x, y, share) == expected
    assert curvewise.aeon.dtw_distance(x, y, window=1.0) == curvewise.aeon.dtw_distance(x, y)


def test_what_is_lacking_is_refused() -> None:
    x, y = series(10), series(12, seed=1)
    dtw, lcss = curvewise.aeon.dtw_distance, curvewise.aeon.lcss_distance
    with pytest.raises(ValueError, match=r"window with series of 10 to 12 timepoints: aeon's band"):
        dtw(x, y, window=0.2)
    with pytest.raises(ValueError, match=r"window = 3: give the share of the series' length, from"):
        dtw(x, x, window=3)
    with pytest.raises(ValueError, match=r"window = 0.05 leaves the diagonal alone, on which aeon"):
        lcss(x, x, window=0.05)
    with pytest.raises(TypeError, match=r"dtw of curvewise.aeon has no option 'itakura_max_slope'"):
        dtw(x, y, itakura_max_slope=0.5)
    with pytest.raises(TypeError, match=r"it has window, warp_penalty; did you mean 'warp_penalty"):
        curvewise.aeon.adtw_distance(x, y, warppenalty=0.5)
    with pytest.raises(TypeError, match="hausdorff has no window"):
        curvewise.aeon.hausdorff_distance(x, y, window=0.5)
    with pytest.raises(
        ValueError, match=r"x has 3 dimensions; a series has shape \(n_channels, n_"
    ):
        dtw(series(2, 2, 2), y)


def test_functions_have_the_names_and_docstrings_of_their_own() -> None:
    for name in set(curvewise.aeon.__all__) - {"entries"}:
        found = getattr(curvewise.aeon, name)
        assert found.__name__ == name
        assert "Returns" in found.__doc__
        assert pickle.loads(pickle.dumps(found)) is found  # joblib sends it to processes


@needs_aeon
@pytest.mark.nightly
@pytest.mark.parametrize(("name", "given"), OF_AEON)
def test_values_are_those_of_aeon(name: str, given: dict[str, Any]) -> None:
    import aeon.distances

    theirs = getattr(aeon.distances, f"{name}_distance")
    for seed in range(40):
        channels, n, m = np.random.default_rng(seed).integers((1, 4, 4), (4, 25, 25))
        x, y, z = (series(channels, k, seed=seed + i) for i, k in enumerate((n, m, n)))
        assert_allclose(function(name)(x, y, **given), theirs(x, y, **given), rtol=1e-12)
        for window in (0.3, 1.0):
            mine = function(name)(x, z, window=window, **given)
            assert_allclose(mine, theirs(x, z, window=window, **given), rtol=1e-12)
        if hasattr(curvewise.aeon, f"{name}_cost_matrix"):
            matrix = getattr(aeon.distances, f"{name}_cost_matrix")(x, y, **given)
            assert_allclose(function(name, "cost_matrix")(x, y, **given), matrix, rtol=1e-12)


@needs_aeon
@pytest.mark.nightly
def test_aeon_classifies_and_clusters_with_it(monkeypatch: pytest.MonkeyPatch) -> None:
    from aeon.classification.distance_based import KNeighborsTimeSeriesClassifier
    from aeon.clustering import TimeSeriesKMedoids
    from aeon.distances import _distance

    X = series(30, 2, 20) + np.repeat([0.0, 1.0], 15)[:, None, None]
    y = np.repeat(["low", "high"], 15)
    theirs = KNeighborsTimeSeriesClassifier(distance="dtw").fit(X[::2], y[::2]).predict(X[1::2])
    given = KNeighborsTimeSeriesClassifier(distance=curvewise.aeon.dtw_distance)
    assert_array_equal(given.fit(X[::2], y[::2]).predict(X[1::2]), theirs)
    clusters = TimeSeriesKMedoids(2, distance="dtw", random_state=0).fit(X).labels_
    table = {entry["name"]: entry for entry in curvewise.aeon.entries()}
    monkeypatch.setattr(_distance, "DISTANCES_DICT", {**_distance.DISTANCES_DICT, **table})
    assert _distance.get_distance_function("dtw") is curvewise.aeon.dtw_distance
    again = KNeighborsTimeSeriesClassifier(distance="dtw").fit(X[::2], y[::2])
    assert_array_equal(again.predict(X[1::2]), theirs)
    fitted = TimeSeriesKMedoids(2, distance="dtw", random_state=0).fit(X)
    assert_array_equal(fitted.labels_, clusters)


@pytest.mark.skipif(find_spec("aeon") is not None, reason="aeon is installed")
def test_without_aeon_its_entries_say_how_to_install_it() -> None:
    with pytest.raises(ImportError, match=r'need aeon: pip install "curvewise\[aeon\]"'):
        curvewise.aeon.entries()
