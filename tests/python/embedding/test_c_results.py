"""Results of more than a number in C: comparisons, paths, places and quadrilaterals.

The values are Python's, to the last bit. Structs have the sizes that they say they have.
"""

from __future__ import annotations

import ctypes
from ctypes import byref, c_double, c_ssize_t

import numpy as np
import pytest
from c_structs import (
    INVALID_ARGUMENT,
    MEASURES,
    NO_ROOM,
    OK,
    Area,
    Batch,
    Compare,
    Comparison,
    CurveLength,
    Dtw,
    Error,
    Frechet,
    Pcm,
    PcmPlace,
    curves,
    doubles,
    integers,
    view,
    walk,
)
from programs import MARKS

import curvewise
from curvewise.measures.registry import PRESETS

pytestmark = MARKS

P, Q = walk(60), walk(45, seed=6)
INF = float("inf")


def compared(library: ctypes.CDLL, p: np.ndarray, q: np.ndarray, preset: int | None) -> Comparison:
    found, error = Comparison(), Error()
    options = None if preset is None else byref(Compare(preset))
    arguments = byref(view(p)), byref(view(q)), options, byref(found), byref(error)
    assert library.curvewise_compare(*arguments) == OK, error.message
    return found


def test_compare(library) -> None:
    for code, preset in enumerate(PRESETS):
        expected = curvewise.compare(P, Q, preset=preset).to_dict()
        found = compared(library, P, Q, code)
        assert {name: getattr(found, name) for name in expected} == expected
    assert compared(library, P, Q, None).area == compared(library, P, Q, 0).area
    space = [walk(20, dim=3), walk(30, seed=6, dim=3)]
    found = compared(library, *space, None)
    expected = curvewise.compare(*space).to_dict()
    assert {name: getattr(found, name) for name in expected} == expected
    assert np.isnan([found.area, found.pcm, found.curve_length]).all()


def test_compare_refused(library) -> None:
    found, error = Comparison(), Error()

    def message(options, into=found) -> str:
        arguments = byref(view(P)), byref(view(Q)), options, into and byref(into), byref(error)
        assert library.curvewise_compare(*arguments) == INVALID_ARGUMENT
        return error.message.decode()

    assert message(byref(Compare(3))) == "unknown preset 3; choose from 0 to 2"
    assert message(None, into=None) == "found is a null pointer"
    found.size -= 8
    assert message(None) == wrong_size(found.size, found.size + 8, "CURVEWISE_COMPARISON")


def wrong_size(given: int, needed: int, start: str) -> str:
    return (
        f"the size of the struct is {given}, and curvewise {curvewise.__version__} needs {needed}; "
        f"start from {start}"
    )


@pytest.mark.parametrize("name", ["dtw", "frechet"])
def test_paths(name, library) -> None:
    function = getattr(library, f"curvewise_{name}_path")
    expected = getattr(curvewise, f"{name}_path")(P, Q)
    distance, count, error = c_double(), c_ssize_t(), Error()
    path = np.full((len(P) + len(Q) - 1, 2), -1)

    def found(capacity: int, options=None) -> int:
        return function(
            byref(view(P)),
            byref(view(Q)),
            options and byref(options),
            byref(distance),
            integers(path),
            c_ssize_t(capacity),
            byref(count),
            byref(error),
        )

    assert found(len(expected.path) - 1) == NO_ROOM
    assert error.message.decode() == (
        f"the result has {len(expected.path)} elements, and the arrays have room for "
        f"{len(expected.path) - 1}"
    )
    assert (count.value, distance.value) == (len(expected.path), 0.0)
    assert (path == -1).all()
    assert found(len(path)) == OK, error.message
    assert (distance.value, count.value) == (expected.distance, len(expected.path))
    np.testing.assert_array_equal(path[: count.value], expected.path)
    options = {
        "dtw": Dtw(2, 2.0, 1, 0, 0, -1, 1, 1, INF, 0.0, 0, 0.0, 1.0),
        "frechet": Frechet(2, 2.0, 1, 1, INF, 1.0),
    }
    assert found(len(path), options[name]) == OK
    pattern = {"step_pattern": "symmetric2"} if name == "dtw" else {}
    expected = getattr(curvewise, f"{name}_path")(P, Q, metric="cityblock", **pattern)
    assert distance.value == expected.distance
    np.testing.assert_array_equal(path[: count.value], expected.path)


@pytest.mark.parametrize("swapped", [False, True])
def test_pcm_match(swapped, library) -> None:
    p, q = (Q, P) if swapped else (P, Q)
    expected = curvewise.pcm_match(p, q, offsets=50)
    place, count, error = PcmPlace(), c_ssize_t(), Error()
    points = np.full((60, 2), np.nan)
    both = byref(view(p)), byref(view(q)), byref(Pcm(50, 0)), byref(place)

    def matched(points, capacity: int, count) -> int:
        return library.curvewise_pcm_match(*both, points, c_ssize_t(capacity), count, byref(error))

    assert matched(None, 0, None) == OK, error.message
    assert matched(doubles(points), 3, byref(count)) == NO_ROOM
    assert matched(doubles(points), 60, byref(count)) == OK
    np.testing.assert_array_equal(points[: count.value], expected.points)
    for name in ("value", "offset", "coverage", "tolerance"):
        assert getattr(place, name) == getattr(expected, name)
    assert matched(doubles(points), 60, None) == INVALID_ARGUMENT
    assert error.message == b"count is a null pointer"


@pytest.mark.parametrize("spacing", ["distance", "matched"])
def test_area_quads(spacing, library) -> None:
    expected = curvewise.area_quads(P, Q, spacing=spacing)
    code = ["distance", "x", "arc_length", "matched"].index(spacing)
    count, error = c_ssize_t(), Error()
    both = byref(view(P)), byref(view(Q)), byref(Area(code, 0, 0))

    def found(quads, areas, capacity: int) -> int:
        return library.curvewise_area_quads(
            *both, quads, areas, c_ssize_t(capacity), byref(count), byref(error)
        )

    assert found(None, None, 0) == OK, error.message
    assert count.value == len(expected.areas)
    quads, areas = np.empty((count.value, 4, 2)), np.empty(count.value)
    assert found(doubles(quads), doubles(areas), count.value - 1) == NO_ROOM
    assert found(doubles(quads), None, count.value) == INVALID_ARGUMENT
    assert error.message == b"areas is a null pointer"
    assert found(doubles(quads), doubles(areas), count.value) == OK
    np.testing.assert_array_equal(quads, expected.quads)
    np.testing.assert_array_equal(areas, expected.areas)


OPTIONS = {
    "area": Area(0, 0, 0),
    "pcm": Pcm(1, 0),
    "frechet": Frechet(0, 2.0, 1),
    "dtw": Dtw(0, 2.0, 0, 0, 0, -1, 1),
    "curve_length": CurveLength(0),
}


@pytest.mark.parametrize("name", OPTIONS)
def test_a_struct_of_another_size_is_refused(name, library) -> None:
    """Above all one of zeros, and the options of another measure."""
    options, size = OPTIONS[name], ctypes.sizeof(OPTIONS[name])
    value, error = c_double(-1.0), Error()
    for wrong in (0, size - 8, size + 8):
        options.size = wrong
        function = getattr(library, f"curvewise_{name}")
        arguments = byref(view(P)), byref(view(Q)), byref(options), byref(value), byref(error)
        assert function(*arguments) == INVALID_ARGUMENT
        start = f"CURVEWISE_{name.upper()}_DEFAULTS"
        assert error.message.decode() == wrong_size(wrong, size, start)
    options.size = size
    assert value.value == -1.0
    batch, out = Batch(1, INF), np.empty(1)
    batch.size = 16
    pair = curves(P, Q)
    arguments = pair, c_ssize_t(2), 3, None, byref(batch), doubles(out), byref(error)
    assert library.curvewise_pdist(*arguments) == INVALID_ARGUMENT
    assert error.message.decode() == wrong_size(
        16, ctypes.sizeof(Batch), "CURVEWISE_BATCH_DEFAULTS"
    )
    arguments = pair, c_ssize_t(2), 3, byref(Frechet(0, 2.0, 1)), None, doubles(out), byref(error)
    assert library.curvewise_pdist(*arguments) == INVALID_ARGUMENT
    assert error.message.decode() == wrong_size(
        ctypes.sizeof(Frechet), ctypes.sizeof(Dtw), "CURVEWISE_DTW_DEFAULTS"
    )


def test_the_measures_by_number(library) -> None:
    value, error = c_double(), Error()
    for code, name in enumerate(MEASURES):
        both = byref(view(P)), byref(view(Q))
        assert library.curvewise_evaluate(*both, code, None, byref(value), byref(error)) == OK
        assert value.value == getattr(curvewise, name)(P, Q)
    assert library.curvewise_evaluate(*both, 6, None, byref(value), byref(error)) == (
        INVALID_ARGUMENT
    )
    assert error.message == b"unknown measure 6; choose from 0 to 5"
