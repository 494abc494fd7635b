"""closed=True: the least over where both curves begin, against all beginnings and the reference."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference

Array = npt.NDArray[np.float64]
METRICS: list[dict[str, Any]] = [
    {"metric": "euclidean"},
    {"metric": "sqeuclidean"},
    {"metric": "cityblock"},
    {"metric": "chebyshev"},
    {"metric": "minkowski", "p": 3},
]


def ring(curve: Array) -> Array:
    return curve[:-1] if len(curve) > 1 and np.array_equal(curve[0], curve[-1]) else curve


def from_all_points(measure: str, P: Array, Q: Array, **options: Any) -> float:
    """Return the least value of open curves over where each begins."""
    P, Q = ring(P), ring(Q)
    function = getattr(curvewise, measure)
    return min(
        function(np.roll(P, i, axis=0), np.roll(Q, j, axis=0), **options)
        for i in range(len(P))
        for j in range(len(Q))
    )


def check(P: Array, Q: Array, options: dict[str, Any]) -> None:
    for measure, join in (("dtw", sum), ("frechet", max)):
        value = getattr(curvewise, measure)(P, Q, closed=True, **options)
        expected = from_all_points(measure, P, Q, **options)
        if measure == "frechet":
            assert value == expected
            of_reference = getattr(reference, measure)(P, Q, closed=True, **options)
            assert of_reference == pytest.approx(value, rel=1e-14)
        else:
            assert value == pytest.approx(expected, rel=1e-13, abs=1e-300)
        for package in (curvewise, reference):
            found = getattr(package, f"{measure}_path")(P, Q, closed=True, **options)
            assert found.distance == pytest.approx(value, rel=1e-13, abs=1e-300)
            check_walk(ring(P), ring(Q), found.path)
            pairs = (
                curvewise.dtw(ring(P)[i : i + 1], ring(Q)[j : j + 1], **options)
                for i, j in found.path.tolist()
            )
            assert join(pairs) == pytest.approx(value, rel=1e-12, abs=1e-300)


def check_walk(P: Array, Q: Array, path: npt.NDArray[np.int64]) -> None:
    """Steps of at most one point, and once around both curves."""
    assert path[0, 0] == 0
    steps = np.roll(path, -1, axis=0) - path
    around = steps % (len(P), len(Q))
    for c, curve in enumerate((P, Q)):
        assert set(path[:, c].tolist()) == set(range(len(curve)))
        if len(curve) > 1:
            assert around[:, c].max() <= 1
            assert around[:, c].sum() == len(curve)


@pytest.mark.parametrize("options", METRICS, ids=lambda options: options["metric"])
@pytest.mark.parametrize("d", [1, 2, 3, 7])
def test_random_curves_from_all_points(options: dict[str, Any], d: int) -> None:
    rng = np.random.default_rng([d, len(options["metric"])])
    for number, (n, m) in enumerate([(1, 1), (1, 4), (5, 1), (2, 3), (7, 7), (9, 16), (17, 8)]):
        P, Q = rng.normal(size=(n, d)), rng.normal(size=(m, d))
        if number % 2:  # ties, and points that close a curve
            P, Q = np.rint(P), np.rint(Q)
            P = np.vstack([P, P[:1]])
        check(P, Q, options)


@pytest.mark.parametrize("m", [15, 16, 17, 63, 64, 65, 66, 130])
def test_sizes_across_vectors_and_chunks(m: int) -> None:
    rng = np.random.default_rng(m)
    P, Q = np.cumsum(rng.normal(size=(5, 2)), axis=0), np.cumsum(rng.normal(size=(m, 2)), axis=0)
    for A, B in ((P, Q), (Q, P)):
        value = curvewise.frechet(A, B, closed=True)
        assert value == from_all_points("frechet", A, B)
        expected = from_all_points("dtw", A, B)
        assert curvewise.dtw(A, B, closed=True) == pytest.approx(expected, rel=1e-13)


COORDINATES = st.integers(-16, 16).map(lambda k: k / 4)
CURVES = st.lists(st.tuples(COORDINATES, COORDINATES), min_size=1, max_size=9).map(np.array)


@given(CURVES, CURVES, st.integers(0, 8), st.integers(0, 8), st.sampled_from(METRICS[1:4]))
@settings(derandomize=True, deadline=None)
def test_what_closed_curves_promise(
    P: Array, Q: Array, i: int, j: int, options: dict[str, Any]
) -> None:
    P, Q = ring(P), ring(Q)
    for measure in (curvewise.dtw, curvewise.frechet):  # of exact numbers: with ==
        value = measure(P, Q, closed=True, **options)
        turned = np.roll(P, i, axis=0), np.roll(Q, j, axis=0)
        assert measure(*turned, closed=True, **options) == value
        assert measure(Q, P, closed=True, **options) == value
        assert measure(P[::-1], Q[::-1], closed=True, **options) == value
        assert measure(P, turned[0], closed=True, **options) == 0.0
        assert value <= measure(P, Q, **options)
        shut = np.vstack([P, P[:1]])
        assert measure(shut, Q, closed=True, **options) == value


def test_a_loop_cut_elsewhere_is_the_same_loop() -> None:
    square = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]
    other = [(1, 1), (0, 1), (0, 0), (1, 0), (1, 1)]
    assert curvewise.frechet(square, other) == 2**0.5
    assert curvewise.frechet(square, other, closed=True) == 0.0
    assert curvewise.dtw(square, other, closed=True) == 0.0
    path = curvewise.dtw_path(square, other, closed=True).path
    assert path.tolist() == [[0, 2], [1, 3], [2, 0], [3, 1]]
    assert curvewise.frechet_path(square, other, closed=True).path.tolist() == path.tolist()


@pytest.mark.parametrize("exponent", [-1000, -520, 520, 1000])
def test_the_ends_of_the_range(exponent: int) -> None:
    rng = np.random.default_rng(1)
    P, Q = rng.normal(size=(9, 2)), rng.normal(size=(7, 2))
    for name in ("dtw", "frechet"):
        measure = getattr(curvewise, name)
        expected = np.ldexp(measure(P, Q, closed=True), exponent)
        assert measure(np.ldexp(P, exponent), np.ldexp(Q, exponent), closed=True) == expected


def test_haversine() -> None:
    rng = np.random.default_rng(2)
    P, Q = rng.uniform(-50, 50, (8, 2)), rng.uniform(-50, 50, (6, 2))
    value = curvewise.frechet(P, Q, closed=True, metric="haversine")
    assert value == pytest.approx(from_all_points("frechet", P, Q, metric="haversine"), rel=1e-12)


def test_cutoff() -> None:
    rng = np.random.default_rng(3)
    for _ in range(20):
        P, Q = rng.normal(size=(9, 2)), rng.normal(size=(7, 2))
        for measure in (curvewise.dtw, curvewise.frechet):
            value = measure(P, Q, closed=True)
            assert measure(P, Q, closed=True, cutoff=value) == value
            assert measure(P, Q, closed=True, cutoff=np.nextafter(value, 0)) == np.inf


def test_layouts_and_many_curves() -> None:
    rng = np.random.default_rng(4)
    curves = [rng.normal(size=(n, 2)) for n in (8, 5, 7)]
    for name in ("dtw", "frechet"):
        measure = getattr(curvewise, name)
        value = measure(curves[0], curves[1], closed=True)
        assert measure(np.asfortranarray(curves[0]), curves[1].tolist(), closed=True) == value
        assert measure(np.repeat(curves[0], 2, axis=0)[::2], curves[1], closed=True) == value
        matrix = curvewise.cdist(curves, measure=name, closed=True)
        expected = [[measure(P, Q, closed=True) for Q in curves] for P in curves]
        assert matrix.tolist() == expected
        condensed = curvewise.pdist(curves, name, closed=True)
        assert condensed.tolist() == [expected[0][1], expected[0][2], expected[1][2]]
        options = {name: {"closed": True}}
        compared = curvewise.compare(*curves[:2], preset="raw", measures=[name], options=options)
        assert compared[name] == value


def test_the_defaults_of_many_curves() -> None:
    """Options that only pairs have may be written out with their defaults."""
    rng = np.random.default_rng(6)
    curves = [rng.normal(size=(n, 2)) for n in (8, 5)]
    for name in ("dtw", "frechet", "frechet_continuous"):
        options = {"closed": False} | ({"dependent": True} if name == "dtw" else {})
        expected = getattr(curvewise, name)(*curves)
        assert curvewise.cdist(curves, measure=name, **options)[0, 1] == expected
        assert curvewise.pdist(curves, name, **options).tolist() == [expected]
        assert curvewise.Prepared(curves[0], name, **options)(curves[1]) == expected
        index = curvewise.Index(curves[1:], name, **options)
        assert index.kneighbors(curves[:1], 1)[0].tolist() == [[expected]]


def test_what_is_refused() -> None:
    P, Q = np.eye(2), np.ones((3, 2))
    for package in (curvewise, reference):
        for option, value in (
            ("step_pattern", "symmetric2"),
            ("window", 3),
            ("open_end", True),
            ("penalty", 1.0),
        ):
            message = rf"^closed=True has no {option}; leave out {option}={value!r}$"
            for function in (package.dtw, package.dtw_path):
                with pytest.raises(ValueError, match=message):
                    function(P, Q, closed=True, **{option: value})
        with pytest.raises(ValueError, match=r"^closed=True has no normalize"):
            package.dtw(P, Q, closed=True, normalize=True)
        with pytest.raises(ValueError, match=r"^P\[0, 1\] is nan; curves must be finite$"):
            package.frechet([[0, np.nan]], Q, closed=True)
        with pytest.raises(ValueError, match=r"^P has shape \(0, 2\); dtw needs at least 1 point"):
            package.dtw(P[:0], Q, closed=True)
        with pytest.raises(ValueError, match=r"^unknown metric"):
            package.dtw(P, Q, closed=True, metric="foo")
    with pytest.raises(ValueError, match="choose from euclidean"):
        curvewise.frechet(P, Q, closed=True, metric=np.ones((2, 3)))
    with pytest.raises(ValueError, match="takes a metric by its name"):
        reference.frechet(P, Q, closed=True, metric=np.ones((2, 3)))
    with pytest.raises(ValueError, match="cutoff"):
        curvewise.dtw(P, Q, closed=True, cutoff=-1)
