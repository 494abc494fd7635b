"""Curves removed from an index: it answers as one of the remaining curves, whose indices stay."""

from __future__ import annotations

import copy
import pickle
import threading
from typing import Any

import numpy as np
import pandas as pd
import pytest

from curvewise import Index

RAMP, STEP, PEAK, LONG = [0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0], [0, 1, 2, 3, 4, 5]


def random_curves(count: int) -> list[np.ndarray]:
    random = np.random.default_rng(3)
    return [random.normal(size=(n, 2)).cumsum(axis=0) for n in random.integers(5, 20, count)]


@pytest.mark.parametrize("measure", ["dtw", "frechet_continuous", "area"])
def test_equal_to_an_index_of_the_remaining_curves(measure):
    curves = random_curves(30)
    X, curves = curves[:5], curves[5:]
    index = Index(curves[:20], measure)
    index.remove(np.array([3, 19, 0]))
    index.add(curves[20:])
    index.remove([21, 4])
    remaining = np.setdiff1d(np.arange(25), [0, 3, 4, 19, 21])
    np.testing.assert_array_equal(index.indices, remaining)
    expected = Index([curves[j] for j in remaining], measure)
    for one in (index, pickle.loads(pickle.dumps(index)), copy.deepcopy(index)):
        assert len(one) == len(expected) == 20
        np.testing.assert_array_equal(one.indices, remaining)
        for asked, most in ((X, 20), (None, 19)):
            distances, indices = one.kneighbors(asked, most, workers=2)
            theirs = expected.kneighbors(asked, most)
            np.testing.assert_array_equal(distances, theirs[0])
            np.testing.assert_array_equal(indices, remaining[theirs[1]])
            radius = float(np.median(distances))
            near, found = one.radius_neighbors(asked, radius)
            for ours, theirs in zip(near, expected.radius_neighbors(asked, radius)[0], strict=True):
                np.testing.assert_array_equal(ours, theirs)
            pairs = zip(found, expected.radius_neighbors(asked, radius)[1], strict=True)
            for ours, theirs in pairs:
                np.testing.assert_array_equal(ours, remaining[theirs])
        graph = one.kneighbors_graph(X, 2, mode="distance").toarray()
        assert graph.shape == (5, 25)
        own = one.radius_neighbors_graph(radius=radius, mode="distance").toarray()
        small = expected.radius_neighbors_graph(radius=radius, mode="distance").toarray()
        assert own.shape == (25, 25)
        np.testing.assert_array_equal(own[np.ix_(remaining, remaining)], small)
        assert not own[[0, 3, 4, 19, 21]].any()
        assert not own[:, [0, 3, 4, 19, 21]].any()
        assert one.kneighbors_graph(n_neighbors=3).sum() == 60
        one.add(X)
        assert one.indices[-5:].tolist() == [25, 26, 27, 28, 29]


def test_labels_of_removed_curves():
    index = Index(pd.Series({"ramp": RAMP, "step": STEP, "peak": PEAK}))
    index.remove(["step"])
    assert index.kneighbors([STEP], 2, return_distance=False).loc[0].tolist() == ["ramp", "peak"]
    own = index.kneighbors(n_neighbors=1)[1]
    assert (own.index.tolist(), own[0].tolist()) == (["ramp", "peak"], ["peak", "ramp"])
    with pytest.raises(ValueError, match="label 'ramp', which another curve has"):
        index.add({"step": LONG, "ramp": LONG})
    index.add({"step": LONG, "long": LONG})
    for one in (index, pickle.loads(pickle.dumps(index))):
        nearest = one.kneighbors([LONG], 2, return_distance=False)
        assert nearest.loc[0].tolist() == ["step", "long"]
        found = one.radius_neighbors(radius=0.0, return_distance=False)
        assert found.index.tolist() == ["ramp", "peak", "step", "long"]
        assert found["step"].tolist() == ["long"]
        one.remove(pd.Index(["step", "ramp"]))
        assert one.indices.tolist() == [2, 4]
        with pytest.raises(ValueError, match="indices has the label 'step', which no curve"):
            one.remove(["peak", "step"])
        with pytest.raises(ValueError, match="indices has the label 'peak' twice; give each"):
            one.remove(["peak", "peak"])
        with pytest.raises(TypeError, match=r"^indices is 'peak'; give a list, such as \['peak'\]"):
            one.remove("peak")
        assert len(one) == 2


def test_whole_numbers_as_labels_stay_whole_numbers():
    index = Index({7: RAMP, 8: STEP, 9: PEAK})
    index.remove([7])
    for one in (index, pickle.loads(pickle.dumps(index))):
        found = one.kneighbors([RAMP], 1)[1]
        assert found.dtypes[0] == np.int64
        assert found.loc[0].tolist() == [8]


@pytest.mark.parametrize(
    ("indices", "error", "message"),
    [
        (
            [0, 3],
            ValueError,
            r"^indices\[1\] is 3; give indices of curves of the index, from 0 to 2$",
        ),
        ([-1], ValueError, r"^indices\[0\] is -1; give"),
        ([10**30], ValueError, r"^indices\[0\] is 10{30}; give"),
        ([0, 1], ValueError, r"^indices\[1\] is 1, which was removed before; give"),
        ([2, 2], ValueError, r"^indices\[1\] is 2 again; give each index once$"),
        ([True, False], ValueError, r"^indices\[0\] is True; give indices"),
        ([0.0], ValueError, r"^indices\[0\] is 0.0; give indices"),
        (["ramp"], ValueError, r"^indices\[0\] is 'ramp'; give indices"),
        (0, TypeError, r"^indices is 0; give a list, such as \[0\]$"),
    ],
)
def test_none_is_removed_if_one_is_refused(indices, error, message):
    index = Index([RAMP, STEP, PEAK])
    index.remove([1])
    with pytest.raises(error, match=message):
        index.remove(indices)
    assert index.indices.tolist() == [0, 2]
    with pytest.raises(ValueError, match=r"n_neighbors is 3; give .* from 1 to 2, the curves"):
        index.kneighbors([RAMP], 3)
    with pytest.raises(ValueError, match=r"n_neighbors is 2; give .* from 1 to 1, the other"):
        index.kneighbors(n_neighbors=2)


def test_no_curves_remain():
    index = Index([RAMP])
    index.remove([0])
    assert len(index) == 0
    assert [part.shape for part in index.radius_neighbors([RAMP], 9.0)] == [(1,), (1,)]
    assert [part.shape for part in index.radius_neighbors()] == [(0,), (0,)]
    assert index.radius_neighbors_graph().shape == (1, 1)
    assert pickle.loads(pickle.dumps(index)).indices.tolist() == []
    with pytest.raises(ValueError, match=r"^indices\[0\] is 0; the index has no curves$"):
        Index([]).remove([0])


def test_removing_from_a_report_of_a_search_is_refused():
    index = Index(np.random.default_rng(7).normal(size=(200, 100, 2)))
    with pytest.raises(RuntimeError, match="remove was called by the progress function of a sea"):
        index.kneighbors(n_neighbors=5, progress=lambda done, total: index.remove([0]))
    assert len(index) == 200


def run_in_threads(*functions: Any) -> None:
    failures: list[BaseException] = []

    def run(function: Any) -> None:
        try:
            function()
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=run, args=(function,)) for function in functions]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failures:
        raise failures[0]


def test_searches_know_the_labels_of_all_that_they_see():
    """The answer to a curve itself is its label; own queries have a row for each curve seen."""
    curves = {f"curve {j}": np.full((300, 1), float(j)) for j in range(400)}
    index = Index({name: curves[name] for name in list(curves)[:4]}, "frechet")
    is_done = threading.Event()

    def search() -> None:
        while not is_done.is_set():
            found = index.radius_neighbors([curves["curve 0"]], 1e6, return_distance=False)[0]
            assert [name for name in found if name not in curves] == []
            distances, nearest = index.kneighbors(n_neighbors=1)
            assert nearest.index.equals(distances.index)
            assert set(distances[0]) <= {1.0}
            numbers = [int(name.split()[1]) for name in nearest.index]
            assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
            theirs = [int(name.split()[1]) for name in nearest[0]]
            assert theirs == [numbers[1], *numbers[:-1]]

    def change() -> None:
        try:
            names = list(curves)
            for j in range(4, 400):
                index.add({names[j]: curves[names[j]]})
                if j % 3 == 0:
                    index.remove(names[j - 6 : j - 3])
        finally:
            is_done.set()

    run_in_threads(search, search, change)
    assert len(index) == 4


def test_labels_are_there_before_their_curves():
    index = Index({"ramp": RAMP})
    compiled = index._index
    found = []

    class SearchedMeanwhile:
        def add(self, curves: list[np.ndarray]) -> None:
            compiled.add(curves)
            index._index = compiled
            found.append(index.kneighbors([STEP], 1, return_distance=False)[0].tolist())

    index._index = SearchedMeanwhile()  # type: ignore[assignment]
    index.add({"step": STEP})
    assert found == [["step"]]
    with pytest.raises(ValueError, match="nan"):
        index.add({"peak": [np.nan]})
    index.add({"peak": PEAK})
    assert index.kneighbors([PEAK], 1)[1][0].tolist() == ["peak"]


def test_adds_of_several_threads_keep_labels_and_curves_together():
    index = Index({-1: [-9.0]}, "dtw")

    def add(first: int) -> None:
        for j in range(first, first + 50):
            index.add({j: [float(j)]})
            if j % 2:
                index.remove([j])

    run_in_threads(*(lambda first=first: add(first) for first in (0, 100, 200)))
    kept = [j for first in (0, 100, 200) for j in range(first, first + 50, 2)]
    found = index.kneighbors([[float(j)] for j in kept], 1)
    assert found[0][0].tolist() == [0.0] * len(kept)
    assert found[1][0].tolist() == kept
