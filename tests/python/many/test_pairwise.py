"""cdist, pdist and Prepared against the measures' own functions, to the bit."""

from __future__ import annotations

import pickle
from itertools import combinations
from typing import Any

import numpy as np
import pytest

import curvewise

CASES: list[tuple[str, dict[str, Any]]] = [
    ("dtw", {}),
    ("dtw", {"metric": "minkowski", "p": 3}),
    ("dtw", {"step_pattern": "symmetric2"}),
    ("dtw", {"window": 40}),
    ("dtw", {"open_begin": True, "open_end": True}),
    ("frechet", {}),
    ("frechet", {"metric": "cityblock"}),
    ("area", {}),
    ("area", {"spacing": "arc_length", "crossing": "split", "squared": True}),
    ("area", {"spacing": "matched"}),
    ("pcm", {}),
    ("pcm", {"offsets": "continuous"}),
    ("curve_length", {"scale": "range"}),
]
SYMMETRIC = [
    (measure, options)
    for measure, options in CASES
    if measure not in ("pcm", "curve_length")
    and "open_end" not in options
    and options.get("spacing") not in ("arc_length", "matched")
]
WORKERS = [1, 2, 5, -1]


def random_walk(n: int, dim: int = 2, seed: int = 0) -> np.ndarray:
    return np.random.default_rng([n, dim, seed]).normal(size=(n, dim)).cumsum(axis=0)


@pytest.fixture(scope="module")
def curves() -> list[np.ndarray]:
    """Ragged, of any size around a SIMD vector and a strip, and in any order."""
    sizes = [17, 2, 64, 300, 5, 33, 8, 257, 3, 9, 128, 40]
    return [random_walk(n, seed=seed) for seed, n in enumerate(sizes)]


def one_by_one(measure: str, XA: Any, XB: Any, options: dict[str, Any]) -> np.ndarray:
    function = getattr(curvewise, measure)
    return np.array([[function(P, Q, **options) for Q in XB] for P in XA])


@pytest.mark.parametrize(("measure", "options"), CASES)
def test_cdist_is_every_pair(measure, options, curves):
    XA, XB = curves[:7], curves[4:]
    expected = one_by_one(measure, XA, XB, options)
    for workers in WORKERS:
        actual = curvewise.cdist(XA, XB, measure, workers=workers, **options)
        np.testing.assert_array_equal(actual, expected)


@pytest.mark.parametrize(("measure", "options"), CASES)
def test_cdist_of_one_list(measure, options, curves):
    expected = one_by_one(measure, curves, curves, options)
    if (measure, options) in SYMMETRIC:
        expected = np.triu(expected) + np.triu(expected, 1).T
        np.testing.assert_array_equal(np.diag(expected), 0.0)
    for workers in WORKERS:
        actual = curvewise.cdist(curves, measure=measure, workers=workers, **options)
        np.testing.assert_array_equal(actual, expected)


@pytest.mark.parametrize(("measure", "options"), SYMMETRIC)
def test_pdist_is_the_upper_triangle(measure, options, curves):
    function = getattr(curvewise, measure)
    expected = [function(P, Q, **options) for P, Q in combinations(curves, 2)]
    for workers in WORKERS:
        actual = curvewise.pdist(curves, measure, workers=workers, **options)
        np.testing.assert_array_equal(actual, expected)


def test_many_pairs_fill_whole_tiles():
    X = [random_walk(2 + k % 13, seed=k) for k in range(150)]
    matrix = curvewise.cdist(X, X, "frechet", workers=3)
    condensed = curvewise.pdist(X, "frechet", workers=2)
    np.testing.assert_array_equal(condensed, matrix[np.triu_indices(len(X), 1)])
    for i, j in [(0, 0), (149, 0), (31, 32), (32, 31), (77, 140)]:
        assert matrix[i, j] == curvewise.frechet(X[i], X[j])


def test_pair_that_all_threads_sweep_together():
    """One pair of 36 million cells among small ones: more than 2^23 for each of two threads."""
    X = [random_walk(6000), random_walk(10), random_walk(6001), random_walk(30)]
    expected = one_by_one("frechet", X, X, {})
    np.testing.assert_array_equal(curvewise.cdist(X, X, "frechet", workers=2), expected)
    expected_pairs = expected[np.triu_indices(4, 1)]
    np.testing.assert_array_equal(curvewise.pdist(X, "frechet", workers=2), expected_pairs)


@pytest.mark.parametrize("dim", [1, 2, 3, 4, 7])
def test_dimensions_and_layouts(dim):
    X = np.random.default_rng(dim).normal(size=(6, 20, dim))
    expected = one_by_one("dtw", X, X, {})
    layouts = [
        X,
        np.asfortranarray(X),
        X.astype(">f8"),
        list(X),
        tuple(curve.tolist() for curve in X),
        np.repeat(X, 2, axis=1)[:, ::2],
        X[::-1][::-1],
    ]
    for layout in layouts:
        np.testing.assert_array_equal(curvewise.cdist(layout, X), expected)
    flat = [curve[:, 0] for curve in X]
    np.testing.assert_array_equal(curvewise.pdist(flat), curvewise.pdist(X[:, :, :1]))


def test_values_out_of_the_range_of_squares():
    X = [random_walk(20, seed=k) * scale for k, scale in enumerate([1.0, 1e200, 1e-200, 1e300])]
    np.testing.assert_array_equal(curvewise.cdist(X, X, workers=2), one_by_one("dtw", X, X, {}))


@pytest.mark.parametrize(("measure", "options"), CASES)
@pytest.mark.parametrize("quantile", [0.0, 0.3, 1.0])
def test_cutoff(measure, options, quantile, curves):
    values = curvewise.cdist(curves, curves, measure, **options)
    cutoff = float(np.quantile(values, quantile))
    expected = np.where(values > cutoff, np.inf, values)
    for workers in (1, 2):
        actual = curvewise.cdist(curves, curves, measure, cutoff=cutoff, workers=workers, **options)
        np.testing.assert_array_equal(actual, expected)


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
def test_cutoff_between_rows_of_strips(measure):
    """Pairs of several strips whose ends touch: given up in the middle, or not, by the value."""
    loops = [
        np.column_stack((np.sin(t := np.linspace(0, 6.28, n)) * size, np.cos(t) * size - size))
        for n, size in [(900, 1.0), (1000, 1.5), (700, 2.0), (800, 1.0001)]
    ]
    values = curvewise.pdist(loops, measure)
    for cutoff in [*values, *np.nextafter(values, 0), 0.0, 1e-300, 1e300]:
        expected = np.where(values > cutoff, np.inf, values)
        np.testing.assert_array_equal(curvewise.pdist(loops, measure, cutoff=cutoff), expected)


def test_out_may_overlap_the_curves():
    Z = np.random.default_rng(1).normal(size=(6, 6))
    expected = curvewise.cdist(Z[:, :, np.newaxis])
    found = curvewise.cdist(Z[:, :, np.newaxis], out=Z)
    assert found is Z
    np.testing.assert_array_equal(Z, expected)
    flat = np.random.default_rng(2).normal(size=45)
    curves = flat[:40].reshape(10, 4)
    expected = curvewise.pdist(list(curves))
    np.testing.assert_array_equal(curvewise.pdist(list(curves), out=flat), expected)


def test_out_is_filled_and_returned(curves):
    out = np.full((len(curves), 3), np.nan)
    assert curvewise.cdist(curves, curves[:3], out=out) is out
    np.testing.assert_array_equal(out, curvewise.cdist(curves, curves[:3]))
    condensed = np.full(3, np.nan)
    assert curvewise.pdist(curves[:3], out=condensed) is condensed


def test_no_curves():
    X = [random_walk(3)]
    assert curvewise.cdist([], X).shape == (0, 1)
    assert curvewise.cdist(X, []).shape == (1, 0)
    assert curvewise.cdist([]).shape == (0, 0)
    assert curvewise.pdist([]).shape == (0,)
    assert curvewise.pdist(X).shape == (0,)
    assert curvewise.Prepared(X[0])([]).shape == (0,)


def test_callable_measure(curves):
    def gap(P, Q, *, scale=1.0):
        return scale * abs(len(P) - len(Q))

    sizes = np.array([len(curve) for curve in curves], dtype=float)
    expected = np.abs(sizes[:, None] - sizes)
    np.testing.assert_array_equal(curvewise.cdist(curves, measure=gap), expected)
    np.testing.assert_array_equal(curvewise.cdist(curves, curves[:2], gap), expected[:, :2])
    np.testing.assert_array_equal(
        curvewise.pdist(curves, gap, scale=2.0, cutoff=50.0),
        [2 * v if 2 * v <= 50 else np.inf for v in expected[np.triu_indices(len(curves), 1)]],
    )


def test_callable_may_return_nan(curves):
    assert np.isnan(curvewise.pdist(curves[:2], lambda P, Q: np.nan)).all()


@pytest.mark.parametrize(("measure", "options"), CASES)
def test_prepared(measure, options, curves):
    for P in (curves[0], curves[3]):
        prepared = curvewise.Prepared(P, measure, **options)
        expected = one_by_one(measure, [P], curves, options)[0]
        assert [prepared(Q) for Q in curves] == expected.tolist()
        for workers in WORKERS:
            np.testing.assert_array_equal(prepared(curves, workers=workers), expected)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(prepared))(curves), expected)


def test_prepared_keeps_a_copy_of_the_reference():
    P, Q = random_walk(30), random_walk(20, seed=1)
    prepared = curvewise.Prepared(P, "pcm")
    before = prepared(Q)
    P[:] = 0.0
    assert prepared(Q) == before


def test_prepared_tells_one_curve_from_a_list():
    plane = curvewise.Prepared([(0, 0), (1, 1)], "dtw")
    assert plane([(0, 0), (1, 1)]) == 0.0
    assert plane([[(0, 0), (1, 1)]]).tolist() == [0.0]
    assert plane(np.zeros((3, 5, 2))).shape == (3,)
    flat = curvewise.Prepared([0, 1], "dtw")
    assert flat([0, 1]) == 0.0
    assert flat([[0, 1], [0, 1, 1]]).tolist() == [0.0, 0.0]


def test_prepared_repr():
    prepared = curvewise.Prepared([(0, 0), (1, 1)], "dtw", window=3)
    assert repr(prepared) == "Prepared(<P of shape (2, 2)>, 'dtw', window=3)"


def test_the_diagonal_is_that_of_single_calls() -> None:
    level, line = [1.0, 1.0, 1.0], [0.0, 2.0, 5.0]
    for options in ({}, {"epsilon": 0.0}, {"epsilon": 0.5}):  # without one, level has 0
        found = curvewise.cdist([level, line], measure="edr", **options)
        expected = [curvewise.edr(curve, curve, **options) for curve in (level, line)]
        assert found.diagonal().tolist() == expected
    assert curvewise.cdist([level, line], measure="edr", cutoff=0.5)[0, 0] == np.inf


@pytest.mark.parametrize("measure", ["dtw", "frechet", "area", "frechet_continuous"])
def test_a_cutoff_of_a_call_of_a_prepared_curve(measure):
    P, *others = np.random.default_rng(3).normal(size=(9, 12, 2)).cumsum(axis=1)
    prepared = curvewise.Prepared(P, measure)
    values = prepared(others)
    limit = np.median(values)
    expected = np.where(values > limit, np.inf, values)
    assert np.isinf(expected).any()
    assert prepared(others, cutoff=limit, workers=2).tolist() == expected.tolist()
    assert [prepared(Q, cutoff=limit) for Q in others] == expected.tolist()
    assert [prepared(Q.tolist(), cutoff=limit) for Q in others] == expected.tolist()
    assert prepared(others).tolist() == values.tolist()
    with pytest.raises(ValueError, match="cutoff is -1; give a number >= 0, or None"):
        prepared(others, cutoff=-1)
