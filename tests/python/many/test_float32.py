"""Lists of float32 curves: the bits of float64, no copy of a whole list, and lists in blocks."""

from __future__ import annotations

import re
import tracemalloc
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import curvewise

DIMS = (1, 2, 3, 4, 7)
MEASURES: dict[str, tuple[dict[str, Any], tuple[int, ...]]] = {
    "dtw": ({"metric": "sqeuclidean", "window": 9}, DIMS),
    "frechet": ({}, DIMS),
    "frechet_continuous": ({}, DIMS),
    "hausdorff": ({}, DIMS),
    "hausdorff_continuous": ({}, DIMS),
    "erp": ({}, DIMS),
    "twe": ({}, DIMS),
    "area": ({}, (2,)),
    "curve_length": ({}, (2,)),
    "pcm": ({}, (2,)),
}


def stacked(k: int, n: int, d: int, seed: int = 0) -> Any:
    return np.random.default_rng(seed).normal(size=(k, n, d)).cumsum(1).astype(np.float32)


def unaligned(array: Any) -> Any:
    room = np.empty(array.nbytes + 1, dtype=np.uint8)
    moved = room[1:].view(array.dtype).reshape(array.shape)
    moved[...] = array
    return moved


def peak_memory(call: Callable[[], Any]) -> int:
    tracemalloc.start()  # which numpy reports its arrays to
    call()
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most


LAYOUTS: dict[str, Callable[[Any], Any]] = {
    "rows": lambda X: list(X),
    "one array": lambda X: X,
    "columns": lambda X: [np.asfortranarray(x) for x in X],
    "every second": lambda X: [np.repeat(np.repeat(x, 2, 0), 2, 1)[::2, ::2] for x in X],
    "reversed": lambda X: [x[::-1, ::-1].copy()[::-1, ::-1] for x in X],
    "other byte order": lambda X: [x.astype(">f4") for x in X],
    "unaligned": lambda X: [unaligned(x) for x in X],
    "read-only": lambda X: list(np.broadcast_to(X, X.shape)),
    "float64 among them": lambda X: [x.astype(np.float64) if i % 2 else x for i, x in enumerate(X)],
}


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("name", MEASURES)
def test_values_have_the_bits_of_float64(name: str, layout: str) -> None:
    options, dims = MEASURES[name]
    for d in dims:
        X = stacked(5, 20, d)
        Y, doubles = LAYOUTS[layout](X), list(X.astype(np.float64))
        expected = curvewise.cdist(doubles, measure=name, **options)
        assert (curvewise.cdist(Y, measure=name, **options) == expected).all()
        assert (curvewise.cdist(Y[:2], doubles, name, **options) == expected[:2]).all()
        prepared = curvewise.Prepared(doubles[0], name, **options)
        assert (prepared(list(Y)) == prepared(doubles)).all()
        index, known = (curvewise.Index(curves, name, **options) for curves in (Y, doubles))
        index.add(Y[:1])
        known.add(doubles[:1])
        for asked in (Y, None):
            for found, wanted in zip(
                index.kneighbors(asked, 3), known.kneighbors(asked, 3), strict=True
            ):
                assert (found == wanted).all()
        radius = float(np.median(expected))
        for found, wanted in zip(
            index.radius_neighbors(Y, radius), known.radius_neighbors(doubles, radius), strict=True
        ):
            assert all((a == b).all() for a, b in zip(found, wanted, strict=True))


@pytest.mark.parametrize("name", ["dtw", "frechet", "msm"])
def test_flat_curves_and_triangles(name: str) -> None:
    X = [x[:, 0] for x in stacked(7, 30, 1)]
    doubles = [x.astype(np.float64) for x in X]
    assert (curvewise.pdist(X, name, workers=2) == curvewise.pdist(doubles, name)).all()


def test_degrees() -> None:
    X = np.random.default_rng(3).uniform(-80, 80, size=(5, 20, 2)).astype(np.float32)
    found = curvewise.pdist(X, "frechet", metric="haversine")
    assert (found == curvewise.pdist(X.astype(float), "frechet", metric="haversine")).all()


def test_errors_name_the_curve() -> None:
    X = stacked(3, 5, 2)
    X[2, 4, 1] = np.nan
    with pytest.raises(ValueError, match=r"^X\[2\]\[4, 1\] is nan; curves must be finite$"):
        curvewise.pdist(X)
    with pytest.raises(ValueError, match=r"^curves\[2\]\[4, 1\] is nan; curves must be finite$"):
        curvewise.Index(X)
    with pytest.raises(ValueError, match=r"^X\[2\]\[4, 1\] is nan; curves must be finite$"):
        curvewise.Index(X[:2]).kneighbors(X, 1)


def test_a_callable_is_given_float64() -> None:
    seen = set()

    def measure(P: Any, Q: Any) -> float:
        seen.update((P.dtype, Q.dtype))
        return 0.0

    curvewise.pdist(stacked(3, 4, 2), measure)
    assert seen == {np.dtype(np.float64)}


@pytest.mark.parametrize("call", ["cdist", "pdist", "Index", "kneighbors"])
def test_lists_are_not_copied(call: str) -> None:
    X = stacked(100, 2000, 2)
    calls: dict[str, Callable[[], Any]] = {
        "cdist": lambda: curvewise.cdist(X[:1], X, "area"),
        "pdist": lambda: curvewise.pdist(X, "area"),
        "Index": lambda: curvewise.Index(X, "area"),
        "kneighbors": lambda: curvewise.Index(X[:1], "area").kneighbors(X, 1),
    }
    assert peak_memory(calls[call]) < X.nbytes / 4


@pytest.mark.skipif(
    find_spec("distributed") is None, reason='no dask: pip install "curvewise[dask]"'
)
def test_lists_of_dask_stay_float32() -> None:
    import curvewise.dask

    X = stacked(9, 30, 2)
    doubles = X.astype(np.float64)
    assert (curvewise.dask.cdist(X, block=4).compute() == curvewise.cdist(doubles)).all()
    assert (curvewise.dask.cdist(X[:3], doubles).compute() == curvewise.cdist(X[:3], X)).all()
    assert (curvewise.dask.pdist(X, block=4).compute() == curvewise.pdist(doubles)).all()
    known = curvewise.Index(doubles).kneighbors(doubles[:2], 3)
    for found, wanted in zip(curvewise.dask.kneighbors(X[:2], X, 3, block=4), known, strict=True):
        assert (found.compute() == wanted).all()
    long = stacked(100, 2000, 2)
    assert peak_memory(lambda: curvewise.dask.cdist(long, measure="area")) < 1.5 * long.nbytes
    assert peak_memory(lambda: curvewise.dask.pdist(long, "area")) < 1.5 * long.nbytes
    kneighbors = curvewise.dask.kneighbors
    assert peak_memory(lambda: kneighbors(long[:1], long, 1, "area")) < 1.5 * long.nbytes


@pytest.mark.skipif(
    find_spec("distributed") is None or find_spec("zarr") is None,
    reason='no dask or no zarr: pip install "curvewise[zarr]"',
)
def test_a_store_of_float32_is_that_of_their_values(tmp_path: Path) -> None:
    import curvewise.dask

    X = stacked(5, 10, 2)
    curvewise.dask.pdist(X, store=tmp_path / "d.zarr").compute()
    again = curvewise.dask.pdist(X.astype(np.float64), store=tmp_path / "d.zarr")
    assert (again.compute() == curvewise.pdist(X)).all()


@pytest.mark.skipif(
    find_spec("sklearn") is None, reason='no scikit-learn: pip install "curvewise[sklearn]"'
)
def test_clusters_of_float32() -> None:
    from curvewise.sklearn import CurveKMeans, CurveKMedoids

    X = stacked(9, 30, 2)
    doubles = X.astype(np.float64)
    for estimator in (CurveKMedoids(3), CurveKMeans(3, random_state=0)):
        known, labels = estimator.fit(doubles).cluster_centers_, estimator.labels_.tolist()
        assert estimator.predict(X).tolist() == estimator.predict(doubles).tolist()
        estimator.fit(X)
        assert estimator.labels_.tolist() == labels
        for found, wanted in zip(estimator.cluster_centers_, known, strict=True):
            assert found.dtype == np.float64
            assert (found == wanted).all()
    long = stacked(20, 2000, 2)
    medoids = CurveKMedoids(1, measure="area")
    assert peak_memory(lambda: medoids.fit(long)) < long.nbytes / 4
    means = CurveKMeans(1, measure="frechet", random_state=0).fit(long[:1])
    assert peak_memory(lambda: means.predict(long)) < long.nbytes / 4


BLOCK = 2**21  # numbers; batch.cpp cuts lists there


@pytest.mark.parametrize(("dtype", "workers"), [(np.float32, 1), (np.float64, 2)])
def test_lists_in_blocks(dtype: Any, workers: int) -> None:
    line = np.arange(BLOCK // 4) % 101 / 7
    X = [np.column_stack([line, line * i]).astype(dtype) for i in range(1, 6)]
    expected = [[curvewise.area(P, Q) for Q in X] for P in X]
    reports: list[tuple[int, int]] = []
    found = curvewise.pdist(X, "area", workers=workers, progress=lambda *at: reports.append(at))
    assert found.tolist() == [expected[i][j] for i in range(5) for j in range(i + 1, 5)]
    assert reports[-1] == (10 * 2 * len(line),) * 2
    assert curvewise.cdist(X[:3], X, "area", workers=workers).tolist() == expected[:3]
    assert curvewise.cdist(X, measure="area", workers=workers).tolist() == expected
    assert curvewise.Prepared(X[4], "area")(X, workers=workers).tolist() == expected[4]


def test_a_list_in_blocks_where_order_matters() -> None:
    line = np.arange(BLOCK // 4) % 101 / 7
    X = [np.column_stack([line, line * i]) for i in (1.0, 3.0, 2.0)]
    found = curvewise.cdist(X, measure="curve_length")
    assert found.tolist() == [[curvewise.curve_length(P, Q) for Q in X] for P in X]


def test_errors_come_before_any_block() -> None:
    X = [np.zeros((BLOCK // 4, 2)) for _ in range(6)]
    X[5][-1, 1] = np.inf
    out = np.full(15, -1.0)
    place = rf"^X\[5\]\[{BLOCK // 4 - 1}, 1\] is inf; curves must be finite$"
    with pytest.raises(ValueError, match=place):
        curvewise.pdist(X, "frechet", out=out)
    assert (out == -1).all()


def test_what_a_measure_refuses_comes_before_any_block() -> None:
    line = np.arange(BLOCK // 4) / 7
    X = [np.column_stack([line, line % 1])] * 4 + [np.ones((5, 2))]
    out = np.full((5, 5), -1.0)
    for XA, XB, name in ((X[::-1], X, "XA[0]"), (X[:4], X, "XB[4]")):
        with pytest.raises(ValueError, match=rf"^{re.escape(name)}"):
            curvewise.cdist(XA, XB, "curve_length", out=out[: len(XA)], scale="mean_abs")
    with pytest.raises(ValueError, match=r"^Q\[4\]"):
        curvewise.Prepared(X[0], "curve_length", scale="mean_abs")(X)
    assert (out == -1).all()
