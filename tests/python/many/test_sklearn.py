"""The nearest-neighbour classifier against scikit-learn's own, and its checks of estimators.

scikit-learn is imported where it is used: every process of a run collects this file, one runs it.
"""

from __future__ import annotations

import pickle
from importlib.util import find_spec

import numpy as np
import pytest

import curvewise

# Test by test, because a file that is skipped as a whole would not be in the list of skipped tests.
pytestmark = pytest.mark.skipif(
    find_spec("sklearn") is None, reason='no scikit-learn: pip install "curvewise[sklearn]"'
)


def labelled(count: int, seed: int = 0) -> tuple[list[np.ndarray], np.ndarray]:
    random = np.random.default_rng(seed)
    curves = []
    for i in range(count):
        t = np.linspace(0, 6, random.integers(20, 40))
        curves.append(np.column_stack([t, np.sin(t + i % 3) + 0.3 * random.normal(size=t.shape)]))
    return curves, np.array(["soft", "hard", "brittle"])[np.arange(count) % 3]


@pytest.mark.parametrize("weights", ["uniform", "distance"])
@pytest.mark.parametrize("n_neighbors", [1, 4, 9])
def test_votes_as_scikit_learn_does(weights, n_neighbors):
    from sklearn.neighbors import KNeighborsClassifier

    (known, y), (new, _) = labelled(40), labelled(20, seed=1)
    new[3] = known[5]  # at distance 0
    ours = curvewise.sklearn.CurveKNeighborsClassifier(
        n_neighbors, options={"window": 9}, weights=weights
    )
    theirs = KNeighborsClassifier(n_neighbors, metric="precomputed", weights=weights)
    ours.fit(known, y)
    theirs.fit(curvewise.cdist(known, window=9), y)
    table = curvewise.cdist(new, known, window=9)
    np.testing.assert_allclose(ours.predict_proba(new), theirs.predict_proba(table), rtol=1e-12)
    np.testing.assert_array_equal(ours.predict(new), theirs.predict(table))
    np.testing.assert_array_equal(ours.kneighbors(new)[1], theirs.kneighbors(table)[1])
    assert ours.score(new, labelled(20)[1]) == theirs.score(table, labelled(20)[1])


def test_cross_validation_clones_and_pickles():
    from sklearn.base import clone
    from sklearn.model_selection import GridSearchCV, cross_val_score

    curves, y = labelled(30)
    classifier = curvewise.sklearn.CurveKNeighborsClassifier(1, measure="frechet", workers=2)
    assert cross_val_score(classifier, curves, y, cv=3).mean() > 0.5
    search = GridSearchCV(classifier, {"n_neighbors": [1, 3], "measure": ["dtw", "area"]}, cv=2)
    assert set(search.fit(curves, y).best_params_) == {"n_neighbors", "measure"}
    fitted = clone(classifier).fit(curves, y)
    again = pickle.loads(pickle.dumps(fitted))
    np.testing.assert_array_equal(again.predict(curves[:5]), fitted.predict(curves[:5]))


def test_arrays_and_lists_of_curves_alike():
    stack = np.random.default_rng(2).normal(size=(12, 15, 1))
    y = np.arange(12) % 2
    expected = curvewise.sklearn.CurveKNeighborsClassifier(3).fit(stack, y).predict(stack + 0.5)
    for X in (stack[:, :, 0], list(stack), [curve[:, 0] for curve in stack]):
        classifier = curvewise.sklearn.CurveKNeighborsClassifier(3).fit(X, y)
        np.testing.assert_array_equal(classifier.predict([c + 0.5 for c in X]), expected)


@pytest.mark.parametrize(
    "collected",
    [iter, lambda curves: dict(enumerate(curves)), lambda curves: dict(enumerate(curves)).values()],
)
@pytest.mark.parametrize(
    ("name", "options", "answer"),
    [
        ("CurveKMeans", {"n_clusters": 3, "random_state": 0}, "predict"),
        ("CurveKMedoids", {"n_clusters": 3}, "predict"),
        ("CurveKNeighborsClassifier", {"n_neighbors": 3}, "predict"),
        ("CurveDerivative", {}, "transform"),
    ],
)
def test_any_collection_of_curves_is_a_list(name, options, answer, collected):
    curves, y = labelled(12)
    estimator = getattr(curvewise.sklearn, name)(**options)
    expected = getattr(estimator.fit(curves, y), answer)(curves)
    found = getattr(estimator.fit(collected(curves), y), answer)(collected(curves))
    assert all(np.array_equal(a, b) for a, b in zip(found, expected, strict=True))


def test_passes_the_checks_of_estimators():
    """All but one: scikit-learn takes a list of rows for a table, and curves differ in length."""
    from sklearn.utils.estimator_checks import check_estimator

    reason = "a list of curves that was fitted says nothing of the length of those to come"
    results = check_estimator(
        curvewise.sklearn.CurveKNeighborsClassifier(3),
        expected_failed_checks={"check_classifiers_train": reason},
        on_skip=None,
    )
    assert len(results) > 40


def test_errors():
    curves, y = labelled(6)
    with pytest.raises(ValueError, match="unknown weights 'heavy'"):
        curvewise.sklearn.CurveKNeighborsClassifier(weights="heavy").fit(curves, y)
    with pytest.raises(ValueError, match="y has 5 classes for the 6 curves of X"):
        curvewise.sklearn.CurveKNeighborsClassifier().fit(curves, y[:5])
    with pytest.raises(ValueError, match="n_neighbors is 7; give a whole number from 1 to 6"):
        curvewise.sklearn.CurveKNeighborsClassifier(7).fit(curves, y).predict(curves)
    with pytest.raises(ValueError, match="unknown measure 'far'"):
        curvewise.sklearn.CurveKNeighborsClassifier(measure="far").fit(curves, y)
