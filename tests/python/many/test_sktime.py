"""curvewise.sktime: the bits of cdist, sktime's own checks, and its estimators with it."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import curvewise

# Importing sktime takes seconds.
pytestmark = [
    pytest.mark.skipif(
        find_spec("sktime") is None, reason='no sktime: pip install "curvewise[sktime]"'
    ),
    pytest.mark.nightly,
    pytest.mark.filterwarnings("ignore"),  # of sktime's own
]


def panel(k: int = 12, n: int = 15, variables: int = 2, seed: int = 0) -> np.ndarray:
    """Return series in sktime's numpy3D: instance, variable, time point."""
    random = np.random.default_rng(seed)
    return random.normal(size=(k, variables, n)) + np.repeat([0.0, 2.0], k // 2)[:, None, None]


def frames(lengths: list[int]) -> list[Any]:
    import pandas as pd

    return [pd.DataFrame(panel(2, n, seed=n)[0].T) for n in lengths]


@pytest.mark.parametrize(
    ("measure", "options"),
    [("dtw", {"metric": "sqeuclidean", "window": 3}), ("frechet", {}), ("area", {}), ("pcm", {})],
)
def test_a_distance_is_cdist(measure: Any, options: dict[str, Any]) -> None:
    from curvewise.sktime import CurveDistance

    X, Y = panel(), panel(6, 18, seed=1)
    distance = CurveDistance(measure, options, workers=2)
    P, Q = X.transpose(0, 2, 1), Y.transpose(0, 2, 1)
    if "window" not in options:
        assert_array_equal(distance(X, Y), curvewise.cdist(P, Q, measure, **options))
    assert_array_equal(distance(X), curvewise.cdist(P, measure=measure, **options))
    assert distance.get_tag("symmetric") is (measure == "frechet" or measure == "area")


def test_series_of_different_lengths() -> None:
    from curvewise.sktime import CurveDistance

    X = frames([9, 12, 15])
    assert_array_equal(CurveDistance("frechet")(X), curvewise.cdist(X, measure="frechet"))


@pytest.mark.parametrize("name", ["CurveDistance", "CurveKNeighborsTimeSeriesClassifier"])
def test_the_checks_of_sktime(name: str) -> None:
    from sktime.utils.estimator_checks import check_estimator

    import curvewise.sktime

    checks = check_estimator(getattr(curvewise.sktime, name), verbose=False)
    assert len(checks) > 200
    assert {key: found for key, found in checks.items() if found != "PASSED"} == {}


def test_classifiers_agree() -> None:
    from sktime.classification.distance_based import KNeighborsTimeSeriesClassifier

    from curvewise.sktime import CurveDistance, CurveKNeighborsTimeSeriesClassifier

    X, y = panel(40), np.repeat(["low", "high"], 20)
    known, asked = X[::2], X[1::2]
    theirs = KNeighborsTimeSeriesClassifier(3, distance=CurveDistance("dtw")).fit(known, y[::2])
    own = CurveKNeighborsTimeSeriesClassifier(3).fit(known, y[::2])
    assert_array_equal(own.predict(asked), theirs.predict(asked))
    assert_array_equal(own.predict_proba(asked), theirs.predict_proba(asked))
    assert (own.predict(asked) == y[1::2]).mean() > 0.8


def test_distances_are_added_and_clustered() -> None:
    from sktime.clustering.dbscan import TimeSeriesDBSCAN

    from curvewise.sktime import CurveDistance

    X = panel()
    dtw, frechet = CurveDistance("dtw"), CurveDistance("frechet")
    assert_array_equal((dtw + frechet)(X), dtw(X) + frechet(X))
    labels = TimeSeriesDBSCAN(distance=frechet, eps=4.0, min_samples=2).fit(X).labels_
    assert len(labels) == 12
