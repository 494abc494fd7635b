"""A stored matrix grows by new curves: only their distances are computed, with the same bits."""

from __future__ import annotations

import os
import shutil
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

import curvewise

pytestmark = pytest.mark.skipif(
    find_spec("dask") is None or find_spec("zarr") is None,
    reason='no dask or no zarr: pip install "curvewise[zarr]"',
)

RANDOM = np.random.default_rng(57)
CURVES = [RANDOM.normal(size=(n, 2)).cumsum(axis=0) for n in RANDOM.integers(5, 30, 30)]


def stored(XA: Any, XB: Any = None, **options: Any) -> Any:
    import dask

    with dask.config.set(scheduler="sync"):
        return curvewise.dask.cdist(XA, XB, **options)


@pytest.fixture
def computed(monkeypatch):
    """Return the list to which each block adds the number of its pairs."""
    from curvewise.many import pairwise

    local, counts = pairwise.cdist, []

    def counted(XA: Any, XB: Any = None, *given: Any, **options: Any) -> Any:
        counts.append(len(XA) * (len(XA) if XB is None else len(XB)))
        return local(XA, XB, *given, **options)

    monkeypatch.setattr(pairwise, "cdist", counted)
    return counts


@pytest.mark.parametrize("measure", ["dtw", "pcm"])  # symmetric and not
@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("block", [1, 4, 7, 100])
def test_growing_step_by_step_is_the_whole(measure, dtype, block, tmp_path, computed):
    import zarr

    store, before = tmp_path / "d.zarr", 0
    for count in (0, 5, 6, 14, 14, 23):
        curves = CURVES[:count]
        whole = curvewise.cdist(curves, measure=measure).astype(dtype)
        computed.clear()
        lazy = stored(curves, measure=measure, block=block, store=store, dtype=dtype)
        grown = count**2 - before**2
        assert sum(computed) == grown if measure == "pcm" else sum(computed) <= grown
        assert lazy.dtype == dtype
        assert np.array_equal(lazy.compute(scheduler="sync"), whole)
        if count:
            assert np.array_equal(zarr.open_array(store, mode="r")[:], whole)
        before = count


def test_a_hundred_curves_behind_a_thousand(tmp_path, computed):
    curves = np.random.default_rng(0).normal(size=(1100, 6)).cumsum(axis=1)[:, :, np.newaxis]
    store = tmp_path / "d.zarr"
    stored(curves[:1000], measure="frechet", store=store)
    computed.clear()
    lazy = stored(curves, measure="frechet", store=store)
    assert sum(computed) == 1000 * 100 + 100**2
    whole = curvewise.cdist(curves, measure="frechet")
    assert np.array_equal(lazy.compute(scheduler="sync"), whole)


def test_rows_and_columns_of_two_lists_grow(tmp_path, computed):
    store, before = tmp_path / "d.zarr", 0
    for k, m in ((5, 3), (9, 3), (9, 8), (14, 11)):
        given = CURVES[:k], CURVES[30 - m :][::-1]
        computed.clear()
        lazy = stored(*given, measure="area", block=4, store=store)
        assert sum(computed) == k * m - before
        assert np.array_equal(lazy.compute(scheduler="sync"), curvewise.cdist(*given, "area"))
        before = k * m


def test_the_store_keeps_its_blocks(tmp_path):
    """The default depends on the lengths of the curves."""
    store = tmp_path / "d.zarr"
    short, long = CURVES[:5], [np.zeros((40_000, 2))]
    size = stored(short, measure="frechet", store=store, block=3).chunks[0][0]
    lazy = stored([*short, *long], measure="frechet", store=store)
    assert lazy.chunks[0] == (size, size)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"XA": CURVES[:6]}, "9 curves XA, not 6 and 9 curves XB, not 6"),
        ({"XA": CURVES[1:20]}, "other curves XA and other curves XB"),
        ({"XA": CURVES[:12], "XB": CURVES[:8]}, "9 curves XB, not 8"),
        ({"XA": CURVES[:12], "dtype": "float32"}, "dtype float64, not float32"),
        ({"XA": CURVES[:12], "window": 9}, r"options \[\], not \[\('window', 9\)\]"),
        ({"XA": CURVES[:12], "block": 3}, r"block \(4, 4\), not \(3, 3\)"),
    ],
)
def test_what_does_not_extend_it_is_refused(given, said, tmp_path):
    store = tmp_path / "d.zarr"
    stored(CURVES[:9], block=4, store=store)
    with pytest.raises(ValueError, match=f"d.zarr was begun with {said}; give what it was begun"):
        stored(**{"store": store, "block": 4} | given)
    again = stored(CURVES[:9], block=4, store=store)
    assert np.array_equal(again.compute(scheduler="sync"), curvewise.cdist(CURVES[:9]))


def test_a_triangle_does_not_grow(tmp_path):
    store = tmp_path / "d.zarr"
    curvewise.dask.pdist(CURVES[:9], block=4, store=store)
    words = "other curves X; give .*, or another store: only a store of cdist grows by new curves$"
    with pytest.raises(ValueError, match=words):
        curvewise.dask.pdist(CURVES[:12], block=4, store=store)


class KilledError(Exception):
    """What ends a call in place of SIGKILL."""


@pytest.mark.parametrize("when", ["before", "without a record", "without the record of the chunk"])
def test_a_growth_that_is_interrupted_continues(when, tmp_path, monkeypatch, computed, recwarn):
    """At each step of writing, a block has its old distances, its new ones, or no record."""
    from curvewise.dask.block_store import BlockStore

    small, large, begun = CURVES[:9], CURVES[:14], tmp_path / "begun.zarr"
    stored(small, block=4, store=begun)
    write, whole = BlockStore.write, curvewise.cdist(large)
    for step in range(12):  # blocks that the growth writes
        store = shutil.copytree(begun, tmp_path / f"{step}.zarr")
        left = [step]

        def killed(self, block, values, left=left):
            left[0] -= 1
            if left[0] >= 0:
                return write(self, block, values)
            if when == "without the record of the chunk":
                write(self, block, values)
            if when != "before":
                self._record(block.place).unlink(missing_ok=True)
            raise KilledError

        with monkeypatch.context() as changed:
            changed.setattr(BlockStore, "write", killed)
            with pytest.raises(KilledError):
                stored(large, block=4, store=store)
        computed.clear()
        again = stored(large, block=4, store=store)
        assert sum(computed) < 14**2 - 8**2
        assert np.array_equal(again.compute(scheduler="sync"), whole)
    assert not recwarn.list


def test_damage_of_what_is_extended(tmp_path):
    store = tmp_path / "d.zarr"
    earlier = stored(CURVES[:9], block=4, store=store)
    (store / "c" / "2" / "0").write_bytes(bytes(4 * 4 * 8 + 4))
    shutil.copy(store / "c" / "2" / "1", store / "c" / "1" / "2")
    with pytest.warns(UserWarning, match=r"again: block \(1, 2\): .*; block \(2, 0\): its content"):
        lazy = stored(CURVES[:14], block=4, store=store)
    whole = curvewise.cdist(CURVES[:14])
    assert np.array_equal(lazy.compute(scheduler="sync"), whole)
    assert np.array_equal(earlier[:8, :8].compute(scheduler="sync"), whole[:8, :8])
    with pytest.raises(ValueError, match=r"block \(\d, \d\) is damaged: it is not the block"):
        earlier.compute(scheduler="sync")


def test_records_of_more_than_the_block(tmp_path):
    store = tmp_path / "d.zarr"
    stored(CURVES[:9], block=4, store=store)
    record = store / "checksums" / "2" / "2"
    for text in (b"", b"2 2 0123", b"1 0123", b"\xff", b"0 1 0123", b"a 1 0123"):
        record.write_bytes(text)
        with pytest.warns(UserWarning, match=r"block \(2, 2\): it is not the block"):
            lazy = stored(CURVES[:9], block=4, store=store)
        assert np.array_equal(lazy.compute(scheduler="sync"), curvewise.cdist(CURVES[:9]))


@pytest.mark.parametrize("function", ["cdist", "pdist"])
def test_float32_rounds_once(function, tmp_path):
    exact = getattr(curvewise, function)(CURVES)
    compute = getattr(curvewise.dask, function)
    sizes = {}
    for dtype in (np.float32, "float64"):
        store = tmp_path / np.dtype(dtype).name
        for options in ({}, {"store": store}):
            lazy = compute(CURVES, block=5, dtype=dtype, **options)
            assert lazy.dtype == dtype
            assert np.array_equal(lazy.compute(scheduler="sync"), exact.astype(dtype))
        sizes[dtype] = sum(f.stat().st_size - 4 for f in store.glob("c/**/*") if f.is_file())
    assert 2 * sizes[np.float32] == sizes["float64"]
    with pytest.raises(ValueError, match="unknown dtype 'float16'; choose from float64, float32"):
        compute(CURVES, dtype="float16")


def test_the_description_is_replaced_in_one_step(tmp_path, monkeypatch):
    store = tmp_path / "d.zarr"
    stored(CURVES[:9], block=4, store=store)

    def killed(*_: Any) -> None:
        raise KilledError

    with monkeypatch.context() as changed:
        changed.setattr(os, "replace", killed)
        with pytest.raises(KilledError):
            stored(CURVES[:14], block=4, store=store)
    again = stored(CURVES[:9], block=4, store=store)
    assert np.array_equal(again.compute(scheduler="sync"), curvewise.cdist(CURVES[:9]))
