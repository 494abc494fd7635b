"""The regressor and the transformers of scikit-learn against what they are made of.

scikit-learn is imported where it is used: every process of a run collects this file, one runs it.
"""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_sklearn import labelled

import curvewise
from curvewise import reference
from curvewise.curves import derivative, resample, z_normalized

with_scikit_learn = pytest.mark.skipif(
    find_spec("sklearn") is None, reason='no scikit-learn: pip install "curvewise[sklearn]"'
)


def slope_by_slope(curve: np.ndarray) -> np.ndarray:
    """Return the estimate of Keogh & Pazzani (2001) as the paper writes it."""
    return np.array(
        [
            ((curve[i] - curve[i - 1]) + ((curve[i + 1] - curve[i - 1]) / 2)) / 2
            for i in range(1, len(curve) - 1)
        ]
    )


@settings(deadline=None, max_examples=60)
@given(st.integers(3, 40), st.sampled_from([1, 2, 3, 4, 7]), st.integers(0, 2**32))
def test_the_derivative_is_that_of_keogh_and_pazzani(n, d, seed):
    curve = np.random.default_rng(seed).normal(size=(n, d)) * 10.0 ** (seed % 9 - 4)
    assert np.array_equal(derivative(curve), slope_by_slope(curve))
    assert np.array_equal(derivative(curve[:, 0]), slope_by_slope(curve[:, 0]))
    assert np.array_equal(derivative(np.asfortranarray(curve)), derivative(curve))
    line = np.arange(n) * 3.0 - 5.0
    assert np.array_equal(derivative(line), np.full(n - 2, 3.0))


def test_dtw_of_derivatives_is_ddtw_and_wddtw():
    P, Q = np.random.default_rng(1).normal(size=(2, 20, 2)).cumsum(axis=1)
    ours = curvewise.dtw(derivative(P), derivative(Q))
    assert ours == reference.dtw(slope_by_slope(P), slope_by_slope(Q))
    if find_spec("aeon") is None:
        return
    from aeon.distances import ddtw_distance, wddtw_distance

    squared = curvewise.dtw(derivative(P), derivative(Q), metric="sqeuclidean")
    assert squared == pytest.approx(ddtw_distance(P.T, Q.T), rel=1e-12)
    weighted = curvewise.aeon.wdtw_distance(derivative(P).T, derivative(Q).T)
    assert weighted == pytest.approx(wddtw_distance(P.T, Q.T), rel=1e-12)


def test_errors_of_the_derivative():
    with pytest.raises(ValueError, match=r"curve has shape \(2, 1\); at least 3 points are needed"):
        derivative([0.0, 1.0])
    with pytest.raises(ValueError, match=r"curve\[1, 0\] is nan"):
        derivative([0.0, np.nan, 2.0])


def transformers():
    from curvewise.sklearn import CurveBoxScaler, CurveDerivative, CurveResampler, CurveZNormalizer

    curves = labelled(9)[0]
    box = np.concatenate(curves)
    return curves, {
        CurveZNormalizer(): z_normalized,
        CurveDerivative(): derivative,
        CurveResampler(11): lambda c: resample(c, 11, by=np.arange(len(c))),
        CurveResampler(11, by="arc_length"): lambda c: resample(c, 11),
        CurveResampler(11, by=0): lambda c: resample(c, 11, by=0),
        CurveBoxScaler(): lambda c: curvewise.normalize(box, c)[1],
    }


@with_scikit_learn
def test_transformers_are_functions_of_each_curve():
    curves, each = transformers()
    for transformer, function in each.items():
        found = transformer.fit_transform(curves)
        assert isinstance(found, list)
        for curve, result in zip(curves, found, strict=True):
            assert np.array_equal(result, function(curve))
        stacked = np.stack([resample(curve, 30) for curve in curves])
        array = transformer.fit(curves).transform(stacked)
        assert array.shape[0::2] == (len(curves), 2)
        assert np.array_equal(array[4], function(stacked[4]))
        by_label = transformer.transform({"a": curves[0]})
        assert np.array_equal(by_label[0], found[0])


@with_scikit_learn
def test_tables_of_rows_stay_tables():
    from curvewise.sklearn import CurveBoxScaler, CurveDerivative, CurveResampler, CurveZNormalizer

    table = np.random.default_rng(2).normal(size=(6, 15))
    assert np.array_equal(CurveDerivative().fit_transform(table)[2], derivative(table[2]))
    assert np.array_equal(CurveZNormalizer().fit_transform(table)[2], z_normalized(table[2]))
    assert CurveResampler(8).fit_transform(table).shape == (6, 8)
    assert CurveResampler(15).fit_transform(table) == pytest.approx(table)
    scaled = CurveBoxScaler().fit_transform(table)
    assert scaled.min() == 0.0
    assert scaled.max() == 1.0


@with_scikit_learn
@pytest.mark.parametrize(
    "name",
    [
        *("CurveBoxScaler", "CurveDerivative", "CurveResampler", "CurveZNormalizer"),
        "CurveKNeighborsRegressor",
    ],
)
def test_they_pass_the_checks_of_estimators(name):
    """All but one, as the classifier: a list of rows is a list of curves."""
    from sklearn.utils.estimator_checks import check_estimator

    expected = {
        "check_fit_idempotent": "two points have no slope at an inner point",
        "check_transformer_data_not_an_array": "a list of rows comes back as a list of curves",
    }
    estimator = getattr(curvewise.sklearn, name)()
    results = check_estimator(estimator, expected_failed_checks=expected, on_skip=None)
    failed = {one["check_name"] for one in results if one["status"] == "xfail"}
    assert len(results) > 40
    assert len(failed) == {"CurveKNeighborsRegressor": 0, "CurveDerivative": 2}.get(name, 1)


@with_scikit_learn
@pytest.mark.parametrize("weights", ["uniform", "distance"])
def test_the_regressor_is_scikit_learns(weights):
    from sklearn.neighbors import KNeighborsRegressor

    (known, _), (new, _) = labelled(40), labelled(20, seed=1)
    y = np.random.default_rng(5).normal(size=40)
    new[3] = known[5]  # at distance 0
    options = {"window": 9}
    ours = curvewise.sklearn.CurveKNeighborsRegressor(4, options=options, weights=weights)
    theirs = KNeighborsRegressor(4, metric="precomputed", weights=weights)
    theirs.fit(curvewise.cdist(known, **options), y)
    table = curvewise.cdist(new, known, **options)
    found = ours.fit(known, y).predict(new)
    np.testing.assert_allclose(found, theirs.predict(table), rtol=1e-12)
    assert ours.score(new, y[:20]) == pytest.approx(theirs.score(table, y[:20]))
    with pytest.raises(ValueError, match=r"y\[1\] is nan"):
        ours.fit(known[:3], [0.0, np.nan, 1.0])
    with pytest.raises(ValueError, match="y has 2 numbers for the 3 curves of X"):
        ours.fit(known[:3], [0.0, 1.0])


@with_scikit_learn
def test_a_callable_measure_is_as_its_name():
    from curvewise.sklearn import (
        CurveKMedoids,
        CurveKNeighborsClassifier,
        CurveKNeighborsRegressor,
    )

    (known, y), (new, _) = labelled(20), labelled(7, seed=1)
    for kind, target in (
        (CurveKNeighborsClassifier, y),
        (CurveKNeighborsRegressor, np.arange(20.0)),
    ):
        options = {"window": 9}
        called = kind(3, measure=curvewise.dtw, options=options).fit(known, target)
        named = kind(3, measure="dtw", options=options).fit(known, target)
        assert np.array_equal(called.predict(new), named.predict(new))
        for X in (new, None):
            for ours, theirs in zip(called.kneighbors(X), named.kneighbors(X), strict=True):
                assert np.array_equal(ours, theirs)
        with pytest.raises(ValueError, match="n_neighbors is 21; give a whole number from 1 to 20"):
            called.kneighbors(new, 21)
    medoids = CurveKMedoids(3, measure=curvewise.frechet).fit(known)
    assert np.array_equal(medoids.labels_, CurveKMedoids(3, measure="frechet").fit(known).labels_)


@with_scikit_learn
def test_options_are_parameters():
    from sklearn.base import clone
    from sklearn.model_selection import GridSearchCV
    from sklearn.pipeline import Pipeline

    from curvewise.sklearn import CurveDerivative, CurveKNeighborsClassifier

    curves, y = labelled(30)
    nearest = CurveKNeighborsClassifier(1, options={"metric": "cityblock"})
    search = GridSearchCV(nearest, {"options__window": [5, 9]}, cv=2).fit(curves, y)
    assert search.best_estimator_.options == {
        "metric": "cityblock",
        "window": search.best_params_["options__window"],
    }
    assert nearest.options == {"metric": "cityblock"}  # what was given is left as it is
    pipeline = Pipeline([("slopes", CurveDerivative()), ("nearest", nearest)])
    pipeline.set_params(nearest__options__window=7)
    assert pipeline.get_params()["nearest__options__window"] == 7
    assert clone(pipeline).fit(curves, y).predict(curves[:3]).tolist() == y[:3].tolist()
    slopes = [derivative(curve) for curve in curves]
    alone = CurveKNeighborsClassifier(1, options={"metric": "cityblock", "window": 7})
    assert np.array_equal(
        pipeline.fit(curves[:20], y[:20]).predict(curves),
        alone.fit(slopes[:20], y[:20]).predict(slopes),
    )
    with pytest.raises(ValueError, match="Invalid parameter 'widow'"):
        nearest.set_params(widow=3)
