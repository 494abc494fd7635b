"""A matrix on disk: complete and right after SIGKILL, and only for the call that began it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

import curvewise

# Test by test, because a file that is skipped as a whole would not be in the list of skipped tests.
pytestmark = pytest.mark.skipif(
    find_spec("dask") is None or find_spec("zarr") is None,
    reason='no dask or no zarr: pip install "curvewise[zarr]"',
)


def walks(count: int = 23, seed: int = 0) -> list[np.ndarray[Any, np.dtype[np.float64]]]:
    random = np.random.default_rng(seed)
    return [random.normal(size=(n, 2)).cumsum(axis=0) for n in random.integers(5, 30, count)]


@pytest.mark.parametrize(("measure", "others"), [("dtw", None), ("dtw", 9), ("pcm", None)])
def test_a_store_has_the_bits_of_the_local_matrix(measure, others, tmp_path):
    import zarr

    curves, store = walks(), tmp_path / "d.zarr"
    XB = None if others is None else walks(others, seed=1)
    local = curvewise.cdist(curves, XB, measure)
    lazy = curvewise.dask.cdist(curves, XB, measure, block=4, store=store)
    assert np.array_equal(lazy.compute(scheduler="sync"), local)
    assert np.array_equal(zarr.open_array(store, mode="r")[:], local)


@pytest.mark.parametrize("count", [0, 1, 2, 23])
@pytest.mark.parametrize("block", [1, 5, 100, None])
def test_the_triangle_has_the_bits_of_the_local_one(count, block):
    curves = walks(count)
    lazy = curvewise.dask.pdist(curves, "frechet", block=block)
    assert np.array_equal(lazy.compute(scheduler="sync"), curvewise.pdist(curves, "frechet"))


def test_only_the_blocks_that_are_not_there_are_computed(tmp_path):
    curves, store = walks(), tmp_path / "d.zarr"
    local = curvewise.pdist(curves)
    curvewise.dask.pdist(curves, block=4, store=str(store))
    chunks = sorted(store.glob("c/*"))
    assert len(chunks) == 16  # of 253 distances, 16 each
    removed, *others = chunks
    (store / "checksums" / removed.name).unlink()
    times = [chunk.stat().st_mtime_ns for chunk in others]
    removed.unlink()
    half = store / "c" / "3.0123abcd.partial"  # zarr's name for an unfinished block
    half.write_bytes(b"half a block")
    again = curvewise.dask.pdist(curves, block=4, store=store)
    assert np.array_equal(again.compute(scheduler="sync"), local)
    assert [chunk.stat().st_mtime_ns for chunk in others] == times
    assert not half.exists()


@pytest.mark.parametrize(
    ("other", "said"),
    [
        ({"measure": "frechet"}, "measure dtw, not frechet"),
        ({"window": 30}, r"options \[\], not \[\('window', 30\)\]"),
        ({"cutoff": 3}, "cutoff inf, not 3.0"),
        ({"block": 7}, r"block \(8, 8\), not \(7, 7\)"),
        ({"XA": walks(seed=1), "XB": walks()}, "other curves XA"),
        ({"XB": walks(seed=1)}, "other curves XB"),
    ],
)
def test_another_matrix_is_refused(other, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    given = {"XA": walks(), "block": 8, "store": "d.zarr"}
    curvewise.dask.cdist(**given)
    advice = "; give what it was begun with, or another store"
    with pytest.raises(ValueError, match=f"^d.zarr was begun with {said}{advice}$"):
        curvewise.dask.cdist(**{**given, **other})


def test_what_is_no_store_is_refused_and_left_alone(tmp_path):
    import zarr

    file, folder, array = tmp_path / "file", tmp_path / "folder", tmp_path / "array"
    file.write_text("mine")
    folder.mkdir()
    (folder / "mine").touch()
    zarr.create_array(array, shape=(3,), dtype="float64")
    for store in (file, folder, array):
        with pytest.raises(ValueError, match="is there and holds no distances that curvewise"):
            curvewise.dask.cdist(walks(3), store=store)
    assert file.read_text() == "mine"


def test_a_function_has_no_store(tmp_path):
    with pytest.raises(ValueError, match="a store needs a measure by its name"):
        curvewise.dask.cdist(walks(3), measure=curvewise.dtw, store=tmp_path / "d.zarr")
    assert not (tmp_path / "d.zarr").exists()


def test_a_zarr_that_writes_chunks_in_place_is_refused(tmp_path, monkeypatch):
    import zarr

    monkeypatch.setattr(zarr, "__version__", "3.1.2")
    with pytest.raises(ImportError, match=r"needs zarr >= 3\.1\.3"):
        curvewise.dask.cdist(walks(3), store=tmp_path / "d.zarr")


SCRIPT = """
import sys
import numpy as np
import dask
import curvewise.dask

curves = np.random.default_rng(0).normal(size=(24, 1500, 2)).cumsum(axis=1)
with dask.config.set(scheduler="threads", num_workers=2):
    curvewise.dask.cdist(curves, measure="dtw", block=2, store=sys.argv[1], prune=False)
"""


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL is one of POSIX systems")
@pytest.mark.nightly
def test_killed_three_times_and_whole(tmp_path):
    store = tmp_path / "d.zarr"

    def chunks() -> int:
        return sum(1 for file in store.glob("c/*/*") if file.suffix != ".partial")

    for wanted in (15, 50, 90):
        process = subprocess.Popen([sys.executable, "-c", SCRIPT, str(store)])
        deadline = time.monotonic() + 60
        while chunks() < wanted:
            assert process.poll() is None, "it came to its end before it was killed"
            assert time.monotonic() < deadline, f"only {chunks()} blocks in a minute"
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.wait()
        assert chunks() < 144
    curves = np.random.default_rng(0).normal(size=(24, 1500, 2)).cumsum(axis=1)
    lazy = curvewise.dask.cdist(curves, measure="dtw", block=2, store=store, prune=False)
    assert chunks() == 144
    assert np.array_equal(lazy.compute(scheduler="sync"), curvewise.cdist(curves))
