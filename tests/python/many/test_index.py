"""The index against its definition: all distances, and a stable sort.

``benchmarks/speed/nearest.py --stress`` runs the random queries of this file a thousand times.
"""

from __future__ import annotations

import pickle
import threading
from typing import Any, get_args

import numpy as np
import pytest

import curvewise
from curvewise import Index
from curvewise._options import CoordinateMetric

# Measures with options that have bounds or do not have bounds.
CASES: list[tuple[str, dict[str, Any]]] = [
    *(("dtw", {"metric": metric}) for metric in get_args(CoordinateMetric)),
    *(("frechet", {"metric": metric}) for metric in get_args(CoordinateMetric)),
    ("dtw", {"step_pattern": "symmetric2"}),
    ("dtw", {"window": 4}),
    ("dtw", {"window": 40, "metric": "cityblock", "step_pattern": "symmetric2"}),
    ("dtw", {"window": 0.5, "step_pattern": "symmetric2", "normalize": True}),
    ("dtw", {"open_end": True}),
    ("dtw", {"open_begin": True}),
    ("dtw", {"open_begin": True, "open_end": True, "metric": "chebyshev"}),
    ("dtw", {"metric": "minkowski", "p": 3}),
    ("dtw", {"prune": False}),
    ("frechet_continuous", {}),
    ("area", {}),
    ("pcm", {"offsets": 20}),
    ("curve_length", {"scale": "range"}),
]
PLANAR = ("area", "pcm", "curve_length")


def random_curves(random: np.random.Generator, count: int, measure: str) -> list[np.ndarray]:
    """Return curves of different lengths, some of them equal, many of their distances too."""
    dim = 2 if measure in PLANAR else int(random.integers(1, 5))
    # Far beyond each other, exact comparisons of continuous curves take long.
    longest = int(random.choice([4, 12] if measure == "frechet_continuous" else [4, 12, 60, 150]))
    on_lattice = random.random() < 0.4 and measure not in PLANAR
    spread = random.choice([0, 10])
    curves = []
    for _ in range(count):
        shape = (int(random.integers(2, longest + 2)), dim)
        if on_lattice:
            curve = random.integers(0, 3, size=shape).astype(float)
        else:
            curve = random.normal(size=shape).cumsum(axis=0) + spread * random.normal(size=dim)
        curves.append(curve)
    for i in range(0, count - 1, 5):
        curves[count - 1 - i] = curves[i]
    return curves


def brute_force(
    X: list[np.ndarray], curves: list[np.ndarray], measure: str, options: dict[str, Any]
) -> tuple[np.ndarray, np.ndarray]:
    table = curvewise.cdist(X, curves, measure, **options)
    order = np.argsort(table, axis=1, kind="stable")
    return np.take_along_axis(table, order, axis=1), order


@pytest.mark.parametrize(("measure", "options"), CASES)
def test_equal_to_brute_force_for_any_number_of_threads(measure, options):
    random = np.random.default_rng(sum(map(ord, measure + repr(options))))
    for count in (1, 2, 30):
        curves = random_curves(random, count + 6, measure)
        X, curves = [*curves[-6:], curves[0]], curves[:-6]
        distances, indices = brute_force(X, curves, measure, options)
        index = Index(curves, measure, **options)
        for n_neighbors in {1, (count + 1) // 2, count}:
            for workers in (1, 2, 3):
                found = index.kneighbors(X, n_neighbors, workers=workers)
                np.testing.assert_array_equal(found[0], distances[:, :n_neighbors])
                np.testing.assert_array_equal(found[1], indices[:, :n_neighbors])
        for radius in (distances[0, count // 2], np.nextafter(distances[0, 0], 0), 0.0, np.inf):
            near = index.radius_neighbors(X, radius, workers=2)
            unsorted = index.radius_neighbors(X, radius, sort_results=False)
            decided = index.radius_neighbors(X, radius, return_distance=False, sort_results=False)
            for i in range(len(X)):
                within = distances[i] <= radius
                np.testing.assert_array_equal(near[0][i], distances[i][within])
                np.testing.assert_array_equal(near[1][i], indices[i][within])
                np.testing.assert_array_equal(unsorted[1][i], np.sort(indices[i][within]))
                np.testing.assert_array_equal(decided[i], unsorted[1][i])


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
def test_equal_to_the_reference(measure):
    random = np.random.default_rng(1)
    curves = [random.normal(size=(n, 2)).cumsum(axis=0) for n in random.integers(2, 40, 12)]
    X, curves = curves[:3], curves[3:]
    index = Index(curves, measure)
    for ours, theirs in zip(
        index.kneighbors(X, 4),
        curvewise.reference.nearest.kneighbors(curves, X, 4, measure),
        strict=True,
    ):
        np.testing.assert_array_equal(ours, theirs)
    radius = index.kneighbors(X, 4)[0][0, 2]
    theirs = curvewise.reference.nearest.radius_neighbors(curves, X, radius, measure)
    for i, (distances, indices) in enumerate(zip(*theirs, strict=True)):
        np.testing.assert_array_equal(index.radius_neighbors(X, radius)[0][i], distances)
        np.testing.assert_array_equal(index.radius_neighbors(X, radius)[1][i], indices)


@pytest.mark.parametrize(("measure", "options"), CASES[:4])
def test_curves_of_the_index_are_no_neighbours_of_themselves(measure, options):
    curves = random_curves(np.random.default_rng(5), 20, measure)
    table = curvewise.cdist(curves, curves, measure, **options)
    np.fill_diagonal(table, np.inf)
    order = np.argsort(table, axis=1, kind="stable")[:, :19]
    index = Index(curves, measure, **options)
    distances, indices = index.kneighbors(n_neighbors=19, workers=2)
    np.testing.assert_array_equal(indices, order)
    np.testing.assert_array_equal(distances, np.take_along_axis(table, order, axis=1))
    radius = float(np.median(table))
    for i, near in enumerate(index.radius_neighbors(radius=radius, return_distance=False)):
        np.testing.assert_array_equal(np.sort(near), np.flatnonzero(table[i] <= radius))


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
@pytest.mark.parametrize("factor", [2.0**480, 2.0**505, 2.0**-505, 2.0**-530, 1e-160])
def test_large_and_small_coordinates(measure, factor):
    random = np.random.default_rng(3)
    curves = [random.normal(size=(50, 2)).cumsum(axis=0) for _ in range(20)]
    curves = [curve * (factor if i % 2 else 1.0) for i, curve in enumerate(curves)]
    X, curves = curves[:4], curves[4:]
    distances, indices = brute_force(X, curves, measure, {})
    found = Index(curves, measure).kneighbors(X, 16)
    np.testing.assert_array_equal(found[0], distances)
    np.testing.assert_array_equal(found[1], indices)


def test_distances_beyond_a_double_come_last_by_index():
    far = [[0.0] * 3, [1e308] * 3, [-1e308] * 3, [1.0] * 3]
    distances, indices = Index(far, "dtw", metric="sqeuclidean").kneighbors([[0.0] * 3], 4)
    assert indices.tolist() == [[0, 3, 1, 2]]
    assert distances.tolist() == [[0.0, 3.0, np.inf, np.inf]]


def test_one_point_curves_and_flat_curves():
    index = Index([[3], [1], [2], [1]], "dtw")
    assert index.kneighbors([[1]], 4)[1].tolist() == [[1, 3, 2, 0]]
    assert index.kneighbors([[[1]]], 1)[1].tolist() == [[1]]  # (1, 1) has as many coordinates


def test_long_curves_are_pruned_as_pairs_are():
    random = np.random.default_rng(8)
    curves = [random.normal(size=(1300, 2)).cumsum(axis=0) for _ in range(3)]
    curves += [curve + 0.01 * random.normal(size=curve.shape) for curve in curves]
    for measure in ("dtw", "frechet"):
        distances, indices = brute_force(curves[:2], curves, measure, {})
        found = Index(curves, measure).kneighbors(curves[:2], 3)
        np.testing.assert_array_equal(found[0], distances[:, :3])
        np.testing.assert_array_equal(found[1], indices[:, :3])


def test_add_pickle_and_copy():
    random = np.random.default_rng(2)
    curves = [random.normal(size=(n, 2)) for n in (30, 40, 50, 20)]
    index = Index(curves[:1], "dtw", window=9)
    curves[0][:] += 0.0  # the index has a copy
    index.add(curves[1:3])
    index.add(curves[3:])
    assert len(index) == 4
    expected = Index(curves, "dtw", window=9).kneighbors(curves, 4)
    for other in (index, pickle.loads(pickle.dumps(index))):
        for ours, theirs in zip(other.kneighbors(curves, 4), expected, strict=True):
            np.testing.assert_array_equal(ours, theirs)
    curves[0][:] = 0.0
    np.testing.assert_array_equal(index.kneighbors([curves[1]], 4)[0][0], expected[0][1])
    assert repr(index) == "Index(<4 curves>, 'dtw', window=9)"
    flat = pickle.loads(pickle.dumps(Index([[1, 2], [3]])))
    assert flat.kneighbors([[1, 2]], 1)[0].tolist() == [[0.0]]


def test_a_refused_curve_adds_none():
    index = Index([[0.0, 1.0]])
    with pytest.raises(ValueError, match=r"^curves\[1\]\[0\] is nan; curves must be finite$"):
        index.add([[1.0], [np.nan]])
    with pytest.raises(ValueError, match="both need the same number of coordinates"):
        index.add([[(1.0, 2.0)]])
    assert len(index) == 1
    line = [[(0, 0), (1, 1)]]
    pcm = Index(line, "curve_length", scale="range")
    with pytest.raises(ValueError, match=r"curves\[1\] has zero length"):
        pcm.add([*line, [(1, 1), (1, 1)]])
    assert len(pcm) == 1


def test_errors_say_what_and_where():
    index = Index([[(0, 0), (1, 1)], [(1, 1), (2, 2)]])
    refused = [
        (lambda: index.kneighbors([[(0, 0)], [(0, np.inf)]], 1), r"X\[1\]\[0, 1\] is inf"),
        (lambda: index.kneighbors([[0, 1]], 1), r"curve 0 of the index has shape \(2, 2\) and X"),
        (lambda: index.kneighbors([[(0, 0)]], 3), "n_neighbors is 3; give .* from 1 to 2, the cur"),
        (lambda: index.kneighbors(n_neighbors=2), "n_neighbors is 2; .* 1 to 1, the other curves"),
        (lambda: index.kneighbors([[(0, 0)]], 0), "n_neighbors is 0"),
        (lambda: index.kneighbors([[(0, 0)]], 1.5), "n_neighbors is 1.5; give a whole number"),
        (lambda: index.radius_neighbors([[(0, 0)]], -1.0), "radius is -1.0; give a number >= 0"),
        (lambda: index.radius_neighbors([[(0, 0)]], np.nan), "radius is nan"),
        (lambda: index.radius_neighbors([[(0, 0)]], "1"), "radius is '1'; give a number >= 0"),
        (lambda: index.radius_neighbors([[(0, 0)]], None), "radius is None; give a number >= 0"),
        (lambda: index.radius_neighbors_graph(radius=b"1"), "radius is b'1'; give a number >= 0"),
        (lambda: index.radius_neighbors(radius=[[1]]), "radius is .*; give a number >= 0"),
        (lambda: index.kneighbors([[(0, 0)]], 1, workers=0), "workers is 0"),
        (lambda: index.kneighbors_graph(n_neighbors=1, mode="near"), "unknown mode 'near'"),
        (lambda: Index([[0], [np.nan]]), r"curves\[1\]\[0\] is nan"),
        (lambda: Index([[(0, 0, 0)] * 2], "area"), "area needs 2 coordinates"),
        (lambda: Index([[0]], "euclidean"), "is a ground distance"),
        (lambda: Index([[0, 1], [0, 1, 2]], window=0).kneighbors([[0, 1]], 1), "window=0 admits"),
    ]
    for call, message in refused:
        with pytest.raises(ValueError, match=message):
            call()
    with pytest.raises(TypeError, match="dtw has no option 'offsets'"):
        Index([[0]], offsets=3)
    with pytest.raises(TypeError, match="is of type int; give a list of curves"):
        index.kneighbors(3)


def test_no_queries_and_no_curves():
    index = Index([], "frechet")
    assert len(index) == 0
    index.add([[0, 1]])
    distances, indices = index.kneighbors([], 1)
    assert distances.shape == indices.shape == (0, 1)
    assert indices.dtype == np.int64
    assert [part.shape for part in index.radius_neighbors([], 1.0)] == [(0,), (0,)]
    assert index.kneighbors_graph([], 1).shape == (0, 1)


def test_graphs_are_what_scikit_learn_makes_of_the_table():
    pytest.importorskip("sklearn", reason='no scikit-learn: pip install "curvewise[sklearn]"')
    from sklearn.cluster import DBSCAN
    from sklearn.neighbors import NearestNeighbors

    random = np.random.default_rng(4)
    curves = [random.normal(size=(20, 2)) + 4 * (i % 3) for i in range(24)]
    table = curvewise.cdist(curves)
    theirs = NearestNeighbors(n_neighbors=4, metric="precomputed").fit(table)
    index = Index(curves)
    for mode in ("connectivity", "distance"):
        ours = index.kneighbors_graph(n_neighbors=4, mode=mode)
        np.testing.assert_array_equal(
            ours.toarray(), theirs.kneighbors_graph(n_neighbors=4, mode=mode).toarray()
        )
        radius = float(np.quantile(table, 0.2))
        np.testing.assert_array_equal(
            index.radius_neighbors_graph(radius=radius, mode=mode).toarray(),
            theirs.radius_neighbors_graph(radius=radius, mode=mode).toarray(),
        )
    radius = float(np.quantile(table, 0.3))
    graph = index.radius_neighbors_graph(radius=radius, mode="distance")
    labels = DBSCAN(eps=radius, metric="precomputed").fit_predict(graph)
    expected = DBSCAN(eps=radius, metric="precomputed").fit_predict(table)
    np.testing.assert_array_equal(labels, expected)
    assert len(set(labels)) == 3


def test_progress_counts_every_pair():
    random = np.random.default_rng(6)
    curves = [random.normal(size=(n, 2)) for n in range(150, 250)]
    total = sum(map(len, curves[:50])) * sum(map(len, curves))
    for workers in (1, 2):
        calls: list[tuple[int, int]] = []
        index = Index(curves)
        index.kneighbors(
            curves[:50], 1, workers=workers, progress=lambda *call, to=calls: to.append(call)
        )
        assert {of for _, of in calls} == {total}
        assert [done for done, _ in calls] == sorted(done for done, _ in calls)
        assert calls[-1] == (total, total)


def test_an_exception_in_the_report_ends_the_search():
    index = Index(np.random.default_rng(7).normal(size=(200, 100, 2)))

    def fail(done: int, total: int) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        index.kneighbors(n_neighbors=199, progress=fail)


def test_adding_from_a_report_of_a_search_is_refused():
    curves = np.random.default_rng(7).normal(size=(200, 100, 2))
    index, other = Index(curves), Index(curves[:3])

    def add(done: int, total: int) -> None:
        other.add(curves[:1])
        index.kneighbors(curves[:1], 1, progress=lambda done, total: None)  # a search in a search
        index.add(curves[:1])

    for search in (
        lambda: index.kneighbors(n_neighbors=5, progress=add),
        lambda: index.radius_neighbors(radius=1.0, progress=add),
        lambda: index.kneighbors_graph(n_neighbors=5, progress=add),
    ):
        with pytest.raises(
            RuntimeError, match=r"progress function of a search in the same index.*; a"
        ):
            search()
    index.add(curves[:1])
    assert len(index) == 201
    assert pickle.loads(pickle.dumps(index)).kneighbors(curves[:1], 1)[0].tolist() == [[0.0]]


@pytest.mark.parametrize("count", [10**10, 10**18, 10**30])
def test_more_neighbours_than_curves_take_no_memory(count):
    index = Index(np.random.default_rng(7).normal(size=(20, 10, 2)))
    for X, most in ((None, "19, the other curves of the index"), ([[(0, 0)]], "20, the curves of")):
        message = f"^n_neighbors is {count}; give a whole number from 1 to {most}"
        with pytest.raises(ValueError, match=message):
            index.kneighbors(X, count)
    assert len(curvewise.subsequence([0, 1], [0, 1, 0, 1], k=count)) <= 4


def test_curves_may_be_added_while_others_search():
    random = np.random.default_rng(9)
    curves = list(random.normal(size=(60, 30, 2)))
    index = Index(curves[:10])
    expected = Index(curves).kneighbors(curves[:3], 5)
    failures: list[Exception] = []

    def search() -> None:
        try:
            for _ in range(30):
                index.kneighbors(curves[:3], 5)
        except Exception as error:
            failures.append(error)

    threads = [threading.Thread(target=search) for _ in range(2)]
    for thread in threads:
        thread.start()
    threads.append(threading.Thread(target=lambda: [index.add([c]) for c in curves[10:]]))
    threads[-1].start()
    # A search that reports needs the interpreter's lock, which no waiting thread may hold.
    while threads[-1].is_alive():
        index.kneighbors(curves, 10, progress=lambda done, total: None)
    for thread in threads:
        thread.join()
    assert not failures
    for ours, theirs in zip(index.kneighbors(curves[:3], 5), expected, strict=True):
        np.testing.assert_array_equal(ours, theirs)
