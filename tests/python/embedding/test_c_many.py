"""Many curves in C: prepared curves, indexes, and controls that watch and stop a call."""

from __future__ import annotations

import ctypes
import threading
import time
from collections.abc import Callable, Iterator
from ctypes import byref, c_double, c_int64, c_ssize_t, c_void_p
from pathlib import Path

import numpy as np
import pytest
from c_structs import (
    FAILED,
    INVALID_ARGUMENT,
    MEASURES,
    NO_ROOM,
    OK,
    STOPPED,
    Batch,
    Dtw,
    Error,
    Report,
    Search,
    curves,
    doubles,
    integers,
    view,
    walk,
)
from programs import MARKS

import curvewise

pytestmark = MARKS

INF = float("inf")
X = [walk(20 + k, seed=k) for k in range(30)]
Q = walk(25, seed=99)
DTW = MEASURES.index("dtw")


@pytest.fixture
def typed(library) -> ctypes.CDLL:
    """Return the library, with the types of the functions that return no int."""
    library.curvewise_index_size.restype = c_ssize_t
    for name in ("done", "total"):
        getattr(library, f"curvewise_control_{name}").restype = c_int64
    return library


@pytest.fixture
def control(typed) -> Iterator[Callable[..., c_void_p]]:
    """Return a function that creates controls, which are destroyed at the end."""
    kept = []

    def create(report=None, interval: int = 50) -> c_void_p:
        given, error = c_void_p(), Error()
        callback = Report(report) if report else ctypes.cast(None, Report)
        status = typed.curvewise_control_create(
            callback, None, interval, byref(given), byref(error)
        )
        assert status == OK, error.message
        kept.append((given, callback))
        return given

    yield create
    for one, _ in kept:
        typed.curvewise_control_destroy(one)


@pytest.fixture
def prepared(typed) -> Iterator[c_void_p]:
    given, error = c_void_p(), Error()
    points = Q.copy()
    options = byref(Dtw(2, 2.0, 1, 0, 0, -1, 1, 1, INF, 0.0, 0, 0.0, 1.0))
    arguments = byref(view(points)), DTW, options, byref(given), byref(error)
    assert typed.curvewise_prepared_create(*arguments) == OK, error.message
    points[:] = np.nan  # it has a copy
    yield given
    typed.curvewise_prepared_destroy(given)


def test_prepared(typed, prepared) -> None:
    expected = curvewise.cdist([Q], X, "dtw", metric="cityblock", step_pattern="symmetric2")[0]
    error, out, value = Error(), np.empty(len(X)), c_double()

    def values(batch) -> int:
        count = c_ssize_t(len(X))
        return typed.curvewise_prepared_values(
            prepared, curves(*X), count, batch, doubles(out), byref(error)
        )

    assert values(None) == OK, error.message
    np.testing.assert_array_equal(out, expected)
    cutoff = float(np.median(expected))
    assert values(byref(Batch(2, cutoff))) == OK
    np.testing.assert_array_equal(out, np.where(expected > cutoff, INF, expected))
    for batch, limit in ((None, INF), (byref(Batch(1, cutoff)), cutoff)):
        for points, one in zip(X[:5], expected, strict=False):
            arguments = byref(view(points)), batch, byref(value), byref(error)
            assert typed.curvewise_prepared_value(prepared, *arguments) == OK
            assert value.value == (one if one <= limit else INF)


def test_prepared_refused(typed, prepared) -> None:
    error, value, handle = Error(), c_double(-1.0), c_void_p()

    def message(status: int) -> str:
        assert status == INVALID_ARGUMENT
        return error.message.decode()

    into = byref(value), byref(error)
    q = byref(view(X[0]))
    refused = typed.curvewise_prepared_value(None, q, None, *into)
    assert message(refused) == "prepared is a null pointer"
    space = byref(view(walk(5, dim=3)))
    assert "both need the same" in message(
        typed.curvewise_prepared_value(prepared, space, None, *into)
    )
    assert value.value == -1.0
    create = typed.curvewise_prepared_create
    assert message(create(q, 9, None, byref(handle), byref(error))) == (
        "unknown measure 9; choose from 0 to 5"
    )
    assert message(create(None, 3, None, byref(handle), byref(error))) == "P is a null pointer"
    assert message(create(q, 3, None, None, byref(error))) == "prepared is a null pointer"
    assert handle.value is None
    typed.curvewise_prepared_destroy(None)


@pytest.fixture
def index(typed) -> Iterator[c_void_p]:
    """An index of the first half of the curves."""
    given, error = c_void_p(), Error()
    half = curves(*X[:15])
    arguments = half, c_ssize_t(15), DTW, None, None, byref(given), byref(error)
    assert typed.curvewise_index_create(*arguments) == OK, error.message
    yield given
    typed.curvewise_index_destroy(given)


def test_index(typed, index) -> None:
    error, queries = Error(), curves(Q, X[20])
    assert typed.curvewise_index_size(index) == 15
    added = typed.curvewise_index_add(index, curves(*X[15:]), c_ssize_t(15), None, byref(error))
    assert added == OK, error.message
    assert typed.curvewise_index_size(index) == 30
    distances, indices = np.empty((2, 4)), np.empty((2, 4), np.int64)
    for options in (None, byref(Search(2, 1, 1))):
        arguments = queries, c_ssize_t(2), c_ssize_t(4), options
        into = doubles(distances), integers(indices), byref(error)
        assert typed.curvewise_index_kneighbors(index, *arguments, *into) == OK, error.message
        expected = curvewise.Index(X).kneighbors([Q, X[20]], 4)
        np.testing.assert_array_equal(distances, expected[0])
        np.testing.assert_array_equal(indices, expected[1])


def nearest_of(typed, index) -> tuple[bytes, bytes]:
    """Return the bytes of the distances and indices of the 13 curves nearest to Q."""
    distances, indices = np.empty(13), np.empty(13, np.int64)
    arguments = curves(Q), c_ssize_t(1), c_ssize_t(13), None, doubles(distances), integers(indices)
    assert typed.curvewise_index_kneighbors(index, *arguments, None) == OK
    return distances.tobytes(), indices.tobytes()


def test_removed(typed, index) -> None:
    error, gone = Error(), np.array([3, 7])

    def remove(count: int) -> int:
        return typed.curvewise_index_remove(index, integers(gone), c_ssize_t(count), byref(error))

    assert remove(2) == OK, error.message
    assert typed.curvewise_index_size(index) == 13
    assert remove(1) == INVALID_ARGUMENT
    assert error.message
    assert remove(-1) == INVALID_ARGUMENT
    assert error.message == b"there are -1 indices; give a whole number >= 0"
    indices = np.frombuffer(nearest_of(typed, index)[1], np.int64)
    assert set(indices) == set(range(15)) - {3, 7}


def test_saved_and_opened(typed, index, tmp_path) -> None:
    """An index of C, and one of Python."""
    error, count, indices = Error(), c_ssize_t(-1), np.full(13, -1)
    paths = [str(tmp_path / name).encode() for name in ("of_c.index", "of_python.index")]
    typed.curvewise_index_remove(index, integers(np.array([3, 7])), c_ssize_t(2), byref(error))
    assert typed.curvewise_index_save(index, paths[0], None, byref(error)) == OK, error.message
    of_python = curvewise.Index(X[:15])
    of_python.remove([3, 7])
    of_python.save(paths[1].decode())
    for path in paths:
        opened = c_void_p()
        into = byref(opened), byref(error)
        assert typed.curvewise_index_open(path, DTW, None, None, *into) == OK, error.message
        for room, status in ((12, NO_ROOM), (13, OK)):
            indices[:] = -1
            into = c_ssize_t(room), byref(count), byref(error)
            assert typed.curvewise_index_indices(opened, integers(indices), *into) == status
            assert count.value == 13
            assert set(indices) == (set(range(15)) - {3, 7} if status == OK else {-1})
        assert nearest_of(typed, opened) == nearest_of(typed, index)
        typed.curvewise_index_destroy(opened)


def test_files_refused(typed, index, control, tmp_path) -> None:
    error, opened = Error(), c_void_p()
    path = str(tmp_path / "curves.index").encode()

    def open_it() -> int:
        into = byref(opened), byref(error)
        return typed.curvewise_index_open(path, DTW, None, None, *into)

    assert open_it() == FAILED
    assert b"curves.index" in error.message
    Path(path.decode()).write_bytes(b"x,y\n0,0\n" * 1000)
    assert open_it() == FAILED
    assert b"curves.index" in error.message
    stop = control()
    typed.curvewise_control_stop(stop)
    assert typed.curvewise_index_save(index, path, stop, byref(error)) == STOPPED
    assert Path(path.decode()).read_bytes().startswith(b"x,y")
    for given, name in ((None, b"path"), (path, b"index")):
        refused = typed.curvewise_index_save(None if given else index, given, None, byref(error))
        assert refused == INVALID_ARGUMENT
        assert error.message == name + b" is a null pointer"
    assert opened.value is None


def test_radius(typed, index) -> None:
    error, queries = Error(), curves(Q, X[3], walk(3, seed=1) + 1e6)
    radius = float(np.median(curvewise.cdist([Q], X[:15], "dtw")))
    starts = np.full(4, -1)
    place = starts.ctypes.data_as(ctypes.POINTER(c_ssize_t))

    def search(options, distances, indices, capacity: int) -> int:
        return typed.curvewise_index_radius_neighbors(
            index,
            queries,
            c_ssize_t(3),
            c_double(radius),
            options,
            place,
            distances,
            indices,
            c_ssize_t(capacity),
            byref(error),
        )

    assert search(None, None, None, 0) == OK, error.message
    found = curvewise.Index(X[:15]).radius_neighbors([Q, X[3], walk(3, seed=1) + 1e6], radius)
    lengths = [len(one) for one in found[1]]
    assert lengths[0] > 3
    assert lengths[2] == 0
    np.testing.assert_array_equal(starts, np.cumsum([0, *lengths]))
    count = int(starts[3])
    distances, indices = np.full(count, np.nan), np.full(count, -1)
    starts[:] = -1
    assert search(None, doubles(distances), integers(indices), count - 1) == NO_ROOM
    assert starts[3] == count
    assert (indices == -1).all()
    assert search(None, doubles(distances), integers(indices), count) == OK
    np.testing.assert_array_equal(distances, np.concatenate(found[0]))
    np.testing.assert_array_equal(indices, np.concatenate(found[1]))
    assert search(byref(Search(1, 0, 0)), None, integers(indices), count) == OK
    np.testing.assert_array_equal(indices, np.concatenate([np.sort(one) for one in found[1]]))


def test_index_refused(typed, index) -> None:
    error, handle = Error(), c_void_p()

    def message(status: int) -> str:
        assert status == INVALID_ARGUMENT
        return error.message.decode()

    space = curves(walk(5, dim=3))
    add, one = typed.curvewise_index_add, c_ssize_t(1)
    assert "curves[0]" in message(add(index, space, one, None, byref(error)))
    assert message(add(None, space, one, None, byref(error))) == "index is a null pointer"
    assert typed.curvewise_index_size(index) == 15
    numbers, places = np.empty(20), np.empty(20, np.int64)
    into = None, doubles(numbers), integers(places), byref(error)
    search = typed.curvewise_index_kneighbors
    assert message(search(index, curves(Q), one, c_ssize_t(16), *into)).startswith("n_neighbors")
    into = None, None, integers(places), byref(error)
    assert message(search(index, curves(Q), one, one, *into)) == "distances is a null pointer"
    create = typed.curvewise_index_create
    arguments = None, c_ssize_t(-1), 3, None, None, byref(handle), byref(error)
    assert message(create(*arguments)) == "curves has -1 curves; give a whole number >= 0"
    arguments = None, c_ssize_t(0), 3, None, None, byref(handle), byref(error)
    assert create(*arguments) == OK
    assert typed.curvewise_index_size(handle) == 0
    typed.curvewise_index_destroy(handle)
    typed.curvewise_index_destroy(None)
    assert typed.curvewise_index_size(None) == 0


def batched(typed, batch: Batch, error) -> int:
    out = np.empty(len(X) * (len(X) - 1) // 2)
    arguments = curves(*X), c_ssize_t(len(X)), DTW, None, byref(batch), doubles(out), byref(error)
    return typed.curvewise_pdist(*arguments)


def test_a_control_counts_and_reports(typed, control) -> None:
    seen = []

    def report(_context, done: int, total: int) -> int:
        seen.append((done, total))
        return 1

    watch, batch, error = control(report, interval=0), Batch(2, INF), Error()
    batch.control = watch
    assert batched(typed, batch, error) == OK, error.message
    done, total = typed.curvewise_control_done(watch), typed.curvewise_control_total(watch)
    assert done == total > 0
    assert seen[-1] == (total, total)
    assert typed.curvewise_control_stopped(watch) == 0


@pytest.mark.parametrize("workers", [1, 2])
def test_a_report_stops(workers, typed, control) -> None:
    watch = control(lambda _context, _done, _total: 0, interval=0)
    batch, error = Batch(workers, INF), Error()
    batch.control = watch
    assert batched(typed, batch, error) == STOPPED
    assert error.message == b"stopped before the work was done"
    assert typed.curvewise_control_stopped(watch) == 1


def test_another_thread_stops_a_long_call(typed, control) -> None:
    watch, value, error = control(), c_double(-1.0), Error()
    long = [walk(60_000, seed=seed) for seed in (1, 2)]
    options = Dtw(0, 2.0, 0, 0, 0, -1, 1, 0, INF, 0.0, 0, 0.0, 1.0)
    options.control = watch

    def stop() -> None:
        while typed.curvewise_control_done(watch) == 0:
            time.sleep(0.001)
        typed.curvewise_control_stop(watch)

    thread = threading.Thread(target=stop)
    thread.start()
    both = (byref(view(one)) for one in long)
    assert typed.curvewise_dtw(*both, byref(options), byref(value), byref(error)) == STOPPED
    thread.join()
    assert value.value == -1.0
    assert 0 < typed.curvewise_control_done(watch) < typed.curvewise_control_total(watch)


def test_every_long_call_takes_a_control(typed, control, prepared, index) -> None:
    watch, error, handle = control(), Error(), c_void_p()
    typed.curvewise_control_stop(watch)
    numbers, places = np.empty(200), np.empty(200, np.int64)
    count, starts, value = c_ssize_t(), (c_ssize_t * 3)(), c_double()
    search, batch, dtw = Search(1, 1, 1), Batch(1, INF), Dtw(0, 2.0, 0, 0, 0, -1, 1)
    for options in (search, batch, dtw):
        options.control = watch
    p, q, one = byref(view(Q)), byref(view(X[0])), c_ssize_t(1)
    out = doubles(numbers)
    calls = {
        "dtw_path": (p, q, byref(dtw), out, integers(places), c_ssize_t(99), byref(count)),
        "evaluate": (p, q, DTW, byref(dtw), byref(value)),
        "cdist": (curves(Q), one, curves(Q), one, DTW, None, byref(batch), out),
        "prepared_value": (prepared, q, byref(batch), out),
        "prepared_values": (prepared, curves(Q), one, byref(batch), out),
        "index_create": (curves(Q), one, DTW, None, watch, byref(handle)),
        "index_add": (index, curves(Q), one, watch),
        "index_kneighbors": (index, curves(Q), one, one, byref(search), out, integers(places)),
        "index_radius_neighbors": (
            *(index, curves(Q), one, c_double(1.0), byref(search), starts, out),
            *(integers(places), one),
        ),
    }
    for name, arguments in calls.items():
        status = getattr(typed, f"curvewise_{name}")(*arguments, byref(error))
        assert (status, name) == (STOPPED, name)
    assert handle.value is None
    assert typed.curvewise_index_size(index) == 15


def test_control_refused(typed) -> None:
    error, handle = Error(), c_void_p()
    none = ctypes.cast(None, Report)
    create = typed.curvewise_control_create
    assert create(none, None, -1, byref(handle), byref(error)) == INVALID_ARGUMENT
    assert error.message == b"interval is -1; give a whole number >= 0"
    assert create(none, None, 1, None, byref(error)) == INVALID_ARGUMENT
    typed.curvewise_control_destroy(None)
    typed.curvewise_control_stop(None)
    assert typed.curvewise_control_done(None) == typed.curvewise_control_stopped(None) == 0
