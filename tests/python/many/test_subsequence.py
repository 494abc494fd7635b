"""Runs of a long curve against the reference, which searches every piece by itself."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest

import curvewise
from curvewise import reference
from curvewise._options import CoordinateMetric


def triples(found: list[curvewise.Subsequence]) -> list[tuple[float, int, int]]:
    return [(one.distance, one.start, one.stop) for one in found]


def pairs(count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    random = np.random.default_rng(0)
    made = []
    for i in range(count):
        n, m, dim = random.integers((1, 1, 1), (10, 60, 4))
        if i % 2:
            made.append(tuple(random.integers(0, 3, (k, dim)).astype(float) for k in (n, m)))
        else:
            made.append(tuple(random.normal(size=(k, dim)).cumsum(axis=0) for k in (n, m)))
    return made


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
@pytest.mark.parametrize("metric", get_args(CoordinateMetric))
def test_equal_to_the_reference(measure, metric):
    for i, (P, Q) in enumerate(pairs(25)):
        options = {"measure": measure, "metric": metric, "k": 1 + i % 8}
        expected = reference.nearest.subsequence(P, Q, **options)
        found = curvewise.subsequence(P, Q, workers=1 + i % 3, **options)
        assert triples(found) == triples(expected)
        cutoff = expected[len(expected) // 2].distance
        found = curvewise.subsequence(P, Q, cutoff=cutoff, **options)
        assert triples(found) == [one for one in triples(expected) if one[0] <= cutoff]


def test_the_first_answer_is_that_of_dtw_with_open_ends():
    for P, Q in pairs(20):
        (found,) = curvewise.subsequence(P, Q, path=True)
        alignment = curvewise.dtw_path(P, Q, open_begin=True, open_end=True)
        assert found.distance == alignment.distance
        np.testing.assert_array_equal(found.path, alignment.path)
        assert (found.start, found.stop) == (alignment.path[0, 1], alignment.path[-1, 1])


def test_every_run_is_at_its_distance_and_none_overlaps():
    random = np.random.default_rng(1)
    P, Q = (random.normal(size=(n, 2)).cumsum(axis=0) for n in (40, 3000))
    for measure, function in (("dtw", curvewise.dtw), ("frechet", curvewise.frechet)):
        found = curvewise.subsequence(P, Q, k=50, measure=measure, path=True)
        assert len(found) == 50
        used = np.zeros(len(Q), dtype=int)
        for one in found:
            used[one.start : one.stop + 1] += 1
            assert function(P, Q[one.start : one.stop + 1]) == one.distance
            assert tuple(one.path[0]) == (0, one.start)
            assert tuple(one.path[-1]) == (len(P) - 1, one.stop)
        assert used.max() == 1
        distances = [one.distance for one in found]
        assert distances == sorted(distances)


def test_frechet_finds_the_best_of_all_runs():
    for P, Q in pairs(8):
        Q = Q[:12]
        runs = [(a, b) for b in range(len(Q)) for a in range(b + 1)]
        best = min(curvewise.frechet(P, Q[a : b + 1]) for a, b in runs)
        assert curvewise.subsequence(P, Q, measure="frechet")[0].distance == best


@pytest.mark.parametrize("subsequence", [curvewise.subsequence, reference.nearest.subsequence])
def test_of_equal_distances_the_first_run_comes_first(subsequence):
    # Whose squares are not equal: 1 + 2**-52, and 1.
    found = subsequence([(0, 0)], [(3, 4), (1, 2**-26), (1, 0)], measure="frechet", k=3)
    assert triples(found) == [(1.0, 1, 1), (1.0, 2, 2), (5.0, 0, 0)]


def test_all_of_a_curve_is_used_up():
    found = curvewise.subsequence([0.0], [3, 1, 2, 1], k=10)
    assert triples(found) == [(1.0, 1, 1), (1.0, 3, 3), (2.0, 2, 2), (3.0, 0, 0)]
    assert curvewise.subsequence([0.0], [3, 1], k=10, cutoff=0.5) == []


@pytest.mark.parametrize("factor", [2.0**505, 2.0**-505])
def test_large_and_small_coordinates(factor):
    P, Q = np.random.default_rng(2).normal(size=(2, 30, 2)).cumsum(axis=1) * factor
    for measure in ("dtw", "frechet"):
        expected = reference.nearest.subsequence(P, Q, k=3, measure=measure)
        assert triples(curvewise.subsequence(P, Q, k=3, measure=measure)) == triples(expected)


def test_errors_say_what_and_where():
    for options, message in [
        ({"k": 0}, "k is 0; give a whole number >= 1"),
        ({"k": "many"}, "k is 'many'"),
        ({"measure": "area"}, "unknown measure 'area'; choose from dtw, frechet"),
        ({"metric": "far"}, "unknown metric 'far'"),
        ({"cutoff": -1}, "cutoff is -1"),
        ({"workers": 0}, "workers is 0"),
    ]:
        with pytest.raises(ValueError, match=message):
            curvewise.subsequence([0, 1], [0, 1, 2], **options)
    with pytest.raises(ValueError, match=r"Q\[1\] is nan"):
        curvewise.subsequence([0], [0, np.nan])
    with pytest.raises(ValueError, match="both need the same number of coordinates"):
        curvewise.subsequence([0], [(0, 0)])


def test_a_fraction_is_one_of_the_query() -> None:
    random = np.random.default_rng(6)
    P, Q = random.normal(size=20).cumsum(), random.normal(size=300).cumsum()
    found = curvewise.subsequence(P, Q, k=3, normalize=True, window=0.17)
    assert found == curvewise.subsequence(P, Q, k=3, normalize=True, window=3)
    assert found != curvewise.subsequence(P, Q, k=3, normalize=True, window=2)


@pytest.mark.parametrize("queries", [[np.zeros((3, 2))] * 2, np.zeros((2, 3, 1))])
def test_a_list_of_queries_is_refused_with_the_call_that_works(queries) -> None:
    with pytest.raises(ValueError, match=r"\[curvewise.subsequence\(query, Q\) for query in P\]"):
        curvewise.subsequence(queries, np.zeros((9, 2)))
