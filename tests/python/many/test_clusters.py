"""Clusters of curves: no exchange of medoids and no move of means makes them better."""

from __future__ import annotations

from importlib.util import find_spec
from itertools import combinations

import numpy as np
import pytest

import curvewise
from curvewise.curves import z_normalized
from curvewise.many.k_medoids import k_medoids
from curvewise.many.shape_means import moved_shape, shape_distances

# Test by test, because a file that is skipped as a whole would not be in the list of skipped tests.
with_scikit_learn = pytest.mark.skipif(
    find_spec("sklearn") is None, reason='no scikit-learn: pip install "curvewise[sklearn]"'
)


def bundles(count: int = 18, groups: int = 3, seed: int = 0) -> tuple[list[np.ndarray], np.ndarray]:
    """Return curves of different lengths around a few, and which of these."""
    random = np.random.default_rng(seed)
    truth = np.arange(count) % groups
    curves = []
    for k in truth:
        t = np.linspace(0, 6, random.integers(12, 25))
        curves.append(np.column_stack([t, 3 * k + np.sin(t) + 0.2 * random.normal(size=t.shape)]))
    return curves, truth


def same_groups(labels: np.ndarray, truth: np.ndarray) -> bool:
    return bool(np.array_equal(labels[:, None] == labels, truth[:, None] == truth))


@pytest.mark.parametrize(("n", "count"), [(7, 1), (8, 2), (9, 3), (10, 4), (5, 5)])
def test_no_exchange_of_a_medoid_lowers_the_sum(n, count):
    random = np.random.default_rng(n)
    for trial in range(10):
        points = random.normal(size=(n, 2))
        distances = np.linalg.norm(points[:, None] - points, axis=2)
        if trial % 2:
            distances = random.random((n, n))  # which is not symmetric
        found = k_medoids(distances, count, 100)
        assert found.converged
        sums = {
            chosen: distances[list(chosen)].min(axis=0).sum()
            for chosen in combinations(range(n), count)
        }
        ours = tuple(found.medoids.tolist())
        assert found.cost == pytest.approx(sums[ours])
        exchanged = [cost for one, cost in sums.items() if len({*one} & {*ours}) >= count - 1]
        assert found.cost == pytest.approx(min(exchanged))
        assert np.array_equal(found.labels, distances[found.medoids].argmin(axis=0))


def test_equal_curves_and_a_limit_of_rounds():
    assert k_medoids(np.zeros((4, 4)), 3, 5).cost == 0.0
    points = np.random.default_rng(1).normal(size=(200, 2))
    distances = np.linalg.norm(points[:, None] - points, axis=2)
    early, late = k_medoids(distances, 9, 1), k_medoids(distances, 9, 100)
    assert late.converged
    assert not early.converged
    assert late.cost <= early.cost


@with_scikit_learn
@pytest.mark.parametrize(("measure", "options"), [("frechet", None), ("dtw", {"window": 20})])
def test_medoids_of_curves(measure, options):
    from sklearn.metrics import silhouette_score

    curves, truth = bundles()
    found = curvewise.sklearn.CurveKMedoids(3, measure=measure, options=options).fit(curves)
    assert same_groups(found.labels_, truth)
    matrix = curvewise.cdist(curves, measure=measure, **(options or {}))
    assert found.inertia_ == pytest.approx(matrix[:, found.medoid_indices_].min(axis=1).sum())
    assert np.array_equal(found.cluster_centers_[0], curves[found.medoid_indices_[0]])
    assert np.array_equal(found.predict(curves), found.labels_)
    given = curvewise.sklearn.CurveKMedoids(3, measure="precomputed").fit(matrix)
    assert np.array_equal(given.labels_, found.labels_)
    assert np.array_equal(given.predict(matrix[4:6]), found.labels_[4:6])
    assert silhouette_score(matrix, found.labels_, metric="precomputed") > 0.5


@with_scikit_learn
def test_the_medoid_is_q_where_the_measure_is_not_symmetric():
    curves, _ = bundles(9)
    found = curvewise.sklearn.CurveKMedoids(2, measure="pcm", options={"offsets": 20}).fit(curves)
    matrix = curvewise.cdist(curves, measure="pcm", offsets=20)
    assert (matrix != matrix.T).any()
    assert found.inertia_ == pytest.approx(matrix[:, found.medoid_indices_].min(axis=1).sum())


@with_scikit_learn
@pytest.mark.parametrize(
    ("measure", "options"),
    [("dtw", None), ("dtw", {"window": 20}), ("soft_dtw", {"gamma": 0.1}), ("frechet", None)],
)
def test_means_of_curves(measure, options):
    curves, truth = bundles()
    means = curvewise.sklearn.CurveKMeans(
        3, measure=measure, options=options, n_init=3, random_state=0
    )
    found = means.fit({f"test {i}": curve for i, curve in enumerate(curves)})
    assert same_groups(found.labels_, truth)
    assert np.array_equal(found.predict(curves), found.labels_)
    inertia, centers = found.inertia_, found.cluster_centers_
    for k, center in enumerate(centers):  # no curve of a cluster is a better mean than its own
        own = [curve for curve, label in zip(curves, found.labels_, strict=True) if label == k]
        told = {
            "dtw": {"measure": "dtw", "metric": "sqeuclidean", **(options or {})},
            "soft_dtw": {"measure": curvewise.soft_dtw, **(options or {})},
            "frechet": {"measure": "frechet"},
        }[measure]
        sums = curvewise.cdist(own, [center, *own], **told).sum(axis=0)
        assert sums[0] <= sums[1:].min() * (1 + 1e-12)
        inertia -= sums[0]
    assert inertia == pytest.approx(0.0, abs=1e-9 * abs(found.inertia_))


@with_scikit_learn
def test_a_cluster_without_curves_gets_one():
    from curvewise.sklearn.k_means import MEANS, _moved

    curves = [np.array([0.0, 0]), np.array([0.0, 1]), np.array([5.0, 5])]
    centers, labels = [curves[0], np.array([99.0, 99])], np.array([0, 0, 0])
    near = np.array([0.0, 1.0, 50.0])
    weights = np.ones(3)
    moved = _moved(curves, weights, centers, labels, near, MEANS["dtw"], {"workers": 1})
    assert moved[1].tolist() == [5.0, 5.0]
    equal = curvewise.sklearn.CurveKMeans(3, random_state=0).fit([[0, 0]] * 2 + [[4, 4]] * 2)
    assert equal.inertia_ == 0.0


@with_scikit_learn
def test_tables_of_lines_have_clusters():
    shapely, geopandas = pytest.importorskip("shapely"), pytest.importorskip("geopandas")
    curves, truth = bundles(9)
    table = geopandas.GeoDataFrame(geometry=[shapely.LineString(curve) for curve in curves])
    medoids = curvewise.sklearn.CurveKMedoids(3, measure="frechet")
    assert same_groups(medoids.fit_predict(table), truth)
    assert same_groups(medoids.fit_predict(list(table.geometry)), truth)


@with_scikit_learn
@pytest.mark.parametrize(
    ("name", "options"),
    [("CurveKMedoids", {}), ("CurveKMeans", {}), ("CurveKMeans", {"measure": "sbd"})],
)
def test_clusters_pass_the_checks_of_estimators(name, options):
    from sklearn.utils.estimator_checks import check_estimator

    expected = {
        "check_sample_weight_equivalence_on_dense_data": "first centres are drawn; curves that do "
        "not count may be medoids, as of scikit-learn's KMeans"
    }
    if options:
        expected["check_clustering"] = "rows of two numbers have no level, no scale and no shape"
    estimator = getattr(curvewise.sklearn, name)(3, **options)
    results = check_estimator(estimator, expected_failed_checks=expected, on_skip=None)
    assert len(results) > 40


@with_scikit_learn
@pytest.mark.parametrize(
    ("kind", "measure"),
    [
        *(("CurveKMeans", measure) for measure in ("dtw", "soft_dtw", "frechet", "sbd")),
        ("CurveKMedoids", "frechet"),
    ],
)
def test_a_weight_is_the_curve_that_often(kind, measure):
    curves, _ = bundles(12)
    counts = np.array([1, 2, 3] * 4)
    repeated = [curve for curve, count in zip(curves, counts, strict=True) for _ in range(count)]
    begin = {"init": lambda X, count, random: curves[:count]} if kind == "CurveKMeans" else {}
    estimator = getattr(curvewise.sklearn, kind)(3, measure=measure, **begin)
    weighted = estimator.fit(curves, sample_weight=counts)
    labels, inertia, centers = weighted.labels_, weighted.inertia_, weighted.cluster_centers_
    unweighted = estimator.fit(repeated)
    assert np.array_equal(np.repeat(labels, counts), unweighted.labels_)
    assert inertia == pytest.approx(unweighted.inertia_, rel=1e-9, abs=1e-9)
    for ours, theirs in zip(centers, unweighted.cluster_centers_, strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-6)
    without = estimator.fit(curves, sample_weight=np.r_[0.0, np.ones(11)])
    assert without.labels_.shape == (12,)
    with pytest.raises(ValueError, match=r"sample_weight is 0|at least one non-zero"):
        estimator.fit(curves, sample_weight=np.zeros(12))


def pulses(count: int = 24, seed: int = 0) -> tuple[list[np.ndarray], np.ndarray]:
    """Return pulses of three shapes, at any time, level and height, and their shapes."""
    random = np.random.default_rng(seed)
    truth = np.arange(count) % 3
    curves = []
    for k in truth:
        t = np.linspace(-1, 1, random.integers(18, 24))
        pulse = [np.exp(-20 * t**2), np.sin(np.pi * t), np.sin(3 * np.pi * t)][k]
        curve = np.roll(np.concatenate([np.zeros(30), pulse, np.zeros(30)]), random.integers(-9, 9))
        curves.append(9 * random.normal() + random.uniform(1, 9) * curve)
    return curves, truth


@with_scikit_learn
def test_k_shape_finds_shapes_at_any_time_level_and_scale():
    curves, truth = pulses()
    found = curvewise.sklearn.CurveKMeans(3, measure="sbd", random_state=0).fit(curves)
    assert same_groups(found.labels_, truth)
    assert np.array_equal(found.predict([5 + 3 * curve for curve in curves]), found.labels_)
    normalized = [z_normalized(curve) for curve in curves]
    distances = curvewise.cdist(normalized, found.cluster_centers_, curvewise.sbd)
    assert found.inertia_ == pytest.approx(distances.min(axis=1).sum(), abs=1e-12)
    for center in found.cluster_centers_:
        np.testing.assert_allclose([center.mean(), center.std()], [0.0, 1.0], atol=1e-12)
    with pytest.raises(TypeError, match="under 'sbd' has no option 'window'; it has none"):
        curvewise.sklearn.CurveKMeans(3, measure="sbd", options={"window": 2}).fit(curves)


def test_distances_from_shapes_are_sbd():
    random = np.random.default_rng(4)
    for d in (1, 2, 5):
        curves = [random.normal(size=(n, d)) for n in (1, 2, 9, 30, 17)] + [np.zeros((4, d))]
        centers = [random.normal(size=(n, d)) for n in (3, 12, 1)] + [np.zeros((5, d))]
        expected = [[curvewise.sbd(curve, center) for center in centers] for curve in curves]
        np.testing.assert_allclose(shape_distances(curves, centers), expected, atol=1e-13)


@pytest.mark.parametrize(("n", "d", "count"), [(12, 1, 30), (12, 1, 4), (9, 2, 5), (9, 2, 40)])
def test_no_shape_correlates_more(n, d, count):
    random = np.random.default_rng(n * count)
    curves = list(random.normal(size=(count, n, d)))
    center, weights = random.normal(size=(n, d)), random.uniform(0.1, 2.0, count)
    aligned = []
    for curve in curves:  # shift by shift
        shifted = {}
        for shift in range(-n + 1, n):
            copy = np.zeros((n, d))
            copy[max(shift, 0) : n + min(shift, 0)] = curve[max(-shift, 0) : n - max(shift, 0)]
            shifted[(copy * center).sum()] = copy
        aligned.append(shifted[max(shifted)])

    def strength(shape: np.ndarray) -> float:
        shape = shape - shape.mean(axis=0)
        products = np.array([(curve * shape).sum() for curve in aligned])
        return float(weights @ products**2 / (shape**2).sum())

    found = moved_shape(center, curves, weights)
    assert weights @ [(curve * found).sum() for curve in aligned] > 0.0
    np.testing.assert_allclose(found.mean(axis=0), 0.0, atol=1e-12)
    for step in (1e-3, 0.1, 10.0):
        for _ in range(30):
            other = found + step * random.normal(size=(n, d))
            assert strength(other) <= strength(found) * (1 + 1e-12)
    still = [np.full((n, d), 3.0)]
    assert moved_shape(center, still, np.ones(1)) is not None


@with_scikit_learn
def test_first_centres_and_starts():
    from curvewise.sklearn.k_means import CurveKMeans

    curves, truth = bundles(30, 5, seed=3)
    sums = [CurveKMeans(5, n_init=1, random_state=seed).fit(curves).inertia_ for seed in range(10)]
    assert max(sums) < 1.15 * min(sums)  # without several draws, up to 20 times the best
    assert same_groups(CurveKMeans(5, random_state=0).fit(curves).labels_, truth)
    short, long = [np.zeros(10)] * 50, [np.zeros(20_000)] * 50
    assert CurveKMeans(3)._starts(short, 3) == 10
    assert CurveKMeans(3)._starts(long, 3) == 1
    assert CurveKMeans(3, n_init=4)._starts(long, 3) == 4
    with pytest.raises(ValueError, match='n_init is 0; give a whole number >= 1, or "auto"'):
        CurveKMeans(3, n_init=0).fit(curves)
    with pytest.raises(ValueError, match="unknown init 'random'; choose from k-means"):
        CurveKMeans(3, init="random").fit(curves)
    with pytest.raises(ValueError, match="init returns 2 curves; give 3, one a cluster"):
        CurveKMeans(3, init=lambda X, count, random: X[:2]).fit(curves)


@with_scikit_learn
def test_too_few_rounds_warn():
    from sklearn.exceptions import ConvergenceWarning

    curves = list(np.random.default_rng(1).normal(size=(60, 8, 2)))
    with pytest.warns(ConvergenceWarning, match="exchange still lowered .* max_iter=1 rounds"):
        curvewise.sklearn.CurveKMedoids(9, max_iter=1).fit(curves)
    with pytest.warns(ConvergenceWarning, match="sum still fell .* after max_iter=1 moves"):
        curvewise.sklearn.CurveKMeans(3, max_iter=1, random_state=0).fit(curves)


@with_scikit_learn
def test_errors():
    curves, _ = bundles(4)
    medoids, means = curvewise.sklearn.CurveKMedoids, curvewise.sklearn.CurveKMeans
    for wrong, error, message in [
        (medoids(5), ValueError, "n_clusters is 5; give a whole number from 1 to 4, the curves"),
        (means(0), ValueError, "n_clusters is 0; give a whole number from 1 to 4, the curves"),
        (medoids(2, max_iter=0), ValueError, "max_iter is 0; give a whole number >= 1"),
        (medoids(2, measure="far"), ValueError, "unknown measure 'far'"),
        (means(2, measure="area"), ValueError, "unknown measure 'area'"),
        (means(2, options={"metric": "cityblock"}), TypeError, "no option 'metric'; it has window"),
        (means(2, tol=-1), ValueError, "tol is -1; give a number >= 0"),
    ]:
        with pytest.raises(error, match=message):
            wrong.fit(curves)
    with pytest.raises(ValueError, match=r"X has shape \(4, 3\); the distances of k curves have"):
        medoids(2, measure="precomputed").fit(np.ones((4, 3)))
