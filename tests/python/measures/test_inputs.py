"""All inputs that numpy.asarray takes give the results of the plain array, and stay unchanged.

The tests try every memory layout and every type that holds the same numbers, for every function
that takes curves. Integers are computed in float64. Calls from several threads give the results of
single calls.
"""

from __future__ import annotations

import dataclasses
import itertools
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd
import pytest

import curvewise
from curvewise import reference

Array = npt.NDArray[Any]

FUNCTIONS = (
    "area",
    "area_quads",
    "pcm",
    "pcm_match",
    "frechet",
    "frechet_path",
    "frechet_table",
    "dtw",
    "dtw_path",
    "dtw_table",
    "curve_length",
    "curve_length_residuals",
    "sum_of_squares",
    "mse",
    "mae",
    "normalize",
    "compare",
)
FLAT_FUNCTIONS = tuple(
    name for name in FUNCTIONS if not name.startswith(("area", "pcm", "curve_length"))
)

# Small whole numbers, which every type below holds exactly.
P = np.array([(1, 2), (3, 5), (8, 4), (9, 9), (4, 11), (2, 7), (6, 1)], dtype=np.float64)
Q = np.array([(2, 2), (3, 7), (7, 5), (9, 12), (5, 10), (3, 3), (6, 6)], dtype=np.float64)


@pytest.mark.parametrize(
    "call",
    [
        lambda: curvewise.frechet_within(P, Q, "1"),
        lambda: reference.frechet_within(P, Q, "1"),
        lambda: curvewise.dtw(P, Q, cutoff="1"),
        lambda: curvewise.dtw(P, Q, metric="minkowski", p="1"),
        lambda: reference.dtw(P, Q, metric="minkowski", p="1"),
        lambda: curvewise.dtw_mean([P, Q], tolerance="1"),
        lambda: curvewise.dtw_mean([P, Q], weights=["1", "2"]),
        lambda: curvewise.curves.turning_points(P, reversal="1"),
        lambda: curvewise.curves.trim(P, "1"),
        lambda: curvewise.curves.trim(P, 3.0, "1"),
        lambda: curvewise.curves.shift_to_origin(P, elastic=("0", "1")),
    ],
)
def test_text_is_no_number(call: Callable[[], object]) -> None:
    with pytest.raises(ValueError, match=r"^\w+(\[0\])? is \(?'[01]'.*; \w"):
        call()


class Subclass(np.ndarray[Any, np.dtype[Any]]):
    """An ndarray whose arithmetic must not be used: only its numbers count."""

    def __array_ufunc__(self, *args: Any, **kwargs: Any) -> Any:
        raise AssertionError("the subclass was computed with")


@dataclasses.dataclass
class Duck:
    """What numpy knows only by its __array__ method."""

    values: Array

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:
        return np.array(self.values, dtype=dtype, subok=True)


MASKED = np.ma.masked_array(P, mask=np.arange(14).reshape(7, 2) == 5)


@pytest.mark.parametrize(
    ("hidden", "kind"),
    [
        (lambda: (row for row in MASKED), "generator"),
        (lambda: iter(MASKED), "iterator"),
        (lambda: zip(MASKED[:, 0], MASKED[:, 1], strict=True), "zip"),
        (lambda: Duck(MASKED), "Duck"),
        (lambda: MASKED, "masked array"),
        (lambda: tuple(MASKED), "list"),
    ],
)
def test_masked_entries_are_found_wherever_they_are(hidden: Any, kind: str) -> None:
    for module in (curvewise, reference):
        with pytest.raises(
            TypeError, match=f"^P is a {kind} with masked entries; drop or fill them "
        ):
            module.dtw(hidden(), Q)
    with pytest.raises(TypeError, match=rf"^X\[0\] is a {kind} with masked"):
        curvewise.pdist([hidden()])
    unmasked = np.ma.masked_array(P)
    for curve in (Duck(unmasked), iter(unmasked), unmasked):
        assert curvewise.dtw(curve, Q) == curvewise.dtw(P, Q)


def sliced(curve: Array) -> Array:
    """Return a view of every third row and second column of a larger array full of nan."""
    if curve.ndim == 1:
        view = np.full(3 * len(curve), np.nan)[::3]
    else:
        view = np.full((3 * len(curve), 2 * curve.shape[1] + 1), np.nan)[::3, 1::2]
    view[...] = curve
    return view


def reversed_rows(curve: Array) -> Array:
    return np.ascontiguousarray(curve[::-1])[::-1]


def reversed_all(curve: Array) -> Array:
    backwards = (slice(None, None, -1),) * curve.ndim
    view: Array = np.ascontiguousarray(curve[backwards])[backwards]
    return view


def read_only(curve: Array) -> Array:
    copy = curve.copy()
    copy.flags.writeable = False
    return copy


def from_bytes(curve: Array) -> Array:
    return np.frombuffer(curve.tobytes(), dtype=np.float64).reshape(curve.shape)


def unaligned(curve: Array) -> Array:
    buffer = b"x" + curve.tobytes()
    view = np.frombuffer(buffer, dtype=np.float64, offset=1).reshape(curve.shape)
    assert not view.flags.aligned
    return view


def structured_field(curve: Array) -> Array:
    """Return a field that begins three bytes into a packed record."""
    record = np.dtype([("tag", "V3"), ("point", np.float64, curve.shape[1:])])
    records = np.zeros(len(curve), dtype=record)
    records["point"] = curve
    assert not records["point"].flags.aligned
    field: Array = records["point"]
    return field


def subclass_of_field(curve: Array) -> Array:
    """Return what a field of a packed np.memmap is: unaligned, and no plain ndarray."""
    view: Array = structured_field(curve).view(Subclass)
    return view


def unmasked_field(curve: Array) -> Array:
    return np.ma.masked_array(structured_field(curve), mask=np.zeros(curve.shape, dtype=bool))


def as_type(dtype: Any) -> Callable[[Array], Array]:
    return lambda curve: curve.astype(dtype)


def subclass(curve: Array) -> Array:
    view: Array = curve.copy().view(Subclass)
    return view


def unmasked(curve: Array) -> Array:
    return np.ma.masked_array(curve, mask=np.zeros(curve.shape, dtype=bool))


def tuples(curve: Array) -> Any:
    rows = curve.tolist()
    return tuple(tuple(row) if isinstance(row, list) else row for row in rows)


def list_of_arrays(curve: Array) -> Any:
    return list(curve)


LAYOUTS: dict[str, Callable[[Array], Any]] = {
    "fortran": np.asfortranarray,
    "transposed": lambda curve: np.ascontiguousarray(curve.T).T,
    "reversed_rows": reversed_rows,
    "reversed_all": reversed_all,
    "sliced": sliced,
    "read_only": read_only,
    "from_bytes": from_bytes,
    "unaligned": unaligned,
    "structured_field": structured_field,
    "subclass_of_field": subclass_of_field,
    "unmasked_field": unmasked_field,
    "big_endian": as_type(">f8"),
    "little_endian": as_type("<f8"),
    "float32": as_type(np.float32),
    "big_endian_float32": as_type(">f4"),
    "float16": as_type(np.float16),
    "longdouble": as_type(np.longdouble),
    "int8": as_type(np.int8),
    "uint8": as_type(np.uint8),
    "big_endian_int16": as_type(">i2"),
    "int64": as_type(np.int64),
    "uint64": as_type(np.uint64),
    "unmasked": unmasked,
    "subclass": subclass,
    "duck": Duck,
    "list": lambda curve: curve.tolist(),
    "tuple": tuples,
    "list_of_ints": lambda curve: curve.astype(int).tolist(),
    "list_of_arrays": list_of_arrays,
    "memoryview": lambda curve: curve.data,
}


def plain(result: Any) -> list[Any]:
    """Return everything that a result holds, as comparable Python values."""
    if isinstance(result, curvewise.Comparison):
        return plain(list(result.values.values()))
    if dataclasses.is_dataclass(result):
        compared = [field.name for field in dataclasses.fields(result) if field.compare]
        return plain([getattr(result, name) for name in compared])
    if isinstance(result, (list, tuple)):
        return [plain(part) for part in result]
    return [result.tolist()] if isinstance(result, np.ndarray) else [result]


def content(curve: Any) -> Any:
    if isinstance(curve, np.ndarray):
        data = np.asarray(curve)
        return data.dtype, data.shape, data.strides, data.tobytes()
    if isinstance(curve, (pd.DataFrame, pd.Series, Duck, memoryview)):
        return content(np.asarray(curve))
    return repr(curve)


def check_same(name: str, given: tuple[Any, Any], arrays: tuple[Array, Array]) -> None:
    """Check that the compiled function and the reference take `given` as they take arrays."""
    before = [content(curve) for curve in given]
    expected = getattr(curvewise, name)(*arrays)
    assert plain(getattr(curvewise, name)(*given)) == plain(expected)
    assert plain(getattr(curvewise, name)(given[0], arrays[1])) == plain(expected)
    assert plain(getattr(curvewise, name)(arrays[0], given[1])) == plain(expected)
    if name != "compare":
        measure = getattr(reference, name)
        assert plain(measure(*given)) == plain(measure(*arrays))
    assert [content(curve) for curve in given] == before


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_layout_of_points_gives_the_same(name: str, layout: str) -> None:
    check_same(name, (LAYOUTS[layout](P), LAYOUTS[layout](Q)), (P, Q))


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("name", FLAT_FUNCTIONS)
def test_every_layout_of_numbers_gives_the_same(name: str, layout: str) -> None:
    flat = P[:, 1].copy(), Q[:, 0].copy()
    check_same(name, (LAYOUTS[layout](flat[0]), LAYOUTS[layout](flat[1])), flat)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_data_frames_give_the_same(name: str) -> None:
    frames = [pd.DataFrame(curve, columns=["strain", "stress"]) for curve in (P, Q)]
    frames[1].index = pd.Index(range(40, 40 + len(Q)))  # labels are not places
    check_same(name, (frames[0], frames[1]), (P, Q))
    mixed = frames[0].astype({"strain": np.int32, "stress": np.float32})
    check_same(name, (mixed, Q), (P, Q))


@pytest.mark.parametrize("name", FLAT_FUNCTIONS)
def test_series_give_the_same(name: str) -> None:
    p, q = P[:, 1].copy(), Q[:, 0].copy()
    check_same(name, (pd.Series(p, name="a"), pd.Series(q, index=range(len(q), 0, -1))), (p, q))


@pytest.mark.filterwarnings("ignore:the matrix subclass:PendingDeprecationWarning")
@pytest.mark.parametrize("name", FUNCTIONS)
def test_matrices_give_the_same(name: str) -> None:
    check_same(name, (np.matrix(P), np.matrix(Q)), (P, Q))


@pytest.mark.parametrize("name", [name for name in FLAT_FUNCTIONS if name != "compare"])
def test_broadcast_arrays_give_the_same(name: str) -> None:
    """Strides of 0, in rows, in columns, and in both."""
    shape = (7, 2)
    for source in (P[0], P[:, :1], np.float64(3.0)):
        view = np.broadcast_to(source, shape)
        assert 0 in view.strides
        check_same(name, (view, Q), (view.copy(), Q))
    flat = np.broadcast_to(np.float64(3.0), 7)
    check_same(name, (flat, P[:, 0]), (flat.copy(), P[:, 0].copy()))


@pytest.mark.parametrize("name", FLAT_FUNCTIONS)
def test_booleans_count_as_0_and_1(name: str) -> None:
    p, q = P > 4, Q > 5
    check_same(name, (p, q), (p.astype(float), q.astype(float)))


@pytest.mark.parametrize("name", ["area", "pcm", "curve_length"])
def test_a_broadcast_column_gives_the_same(name: str) -> None:
    diagonal = np.broadcast_to(P[:, :1], P.shape)
    check_same(name, (diagonal, Q), (diagonal.copy(), Q))


def test_a_flat_array_is_a_curve_in_one_dimension() -> None:
    p, q = P[:, 1], Q[:, 0]
    for name in ("frechet", "dtw", "dtw_table", "frechet_path", "mse"):
        measure = getattr(curvewise, name)
        assert plain(measure(p, q)) == plain(measure(p[:, None], q[:, None]))
    assert [curve.shape for curve in curvewise.normalize(p, q[:, None])] == [(7,), (7, 1)]


def test_integers_are_computed_in_float64() -> None:
    big = np.array([(2_000_000_000, 0), (0, 0)], dtype=np.int32)  # squares overflow in int32
    assert curvewise.dtw(big, -big) == curvewise.dtw(big.astype(float), -big.astype(float)) == 4e9
    bytes_ = np.array([(0, 250), (250, 0)], dtype=np.uint8)  # differences wrap in uint8
    assert curvewise.mae(bytes_, bytes_[::-1]) == reference.mae(bytes_, bytes_[::-1]) == 250.0
    assert curvewise.area(bytes_, bytes_ + np.uint8(5)) == reference.area(
        bytes_.astype(float), bytes_ + 5.0
    )


def test_results_are_plain_and_own_their_memory() -> None:
    assert type(curvewise.dtw(P.astype(np.float32), Q)) is float
    for array in (*curvewise.normalize(P, Q), curvewise.dtw_table(P, Q)):
        assert array.dtype == np.float64
        assert array.flags.c_contiguous
        assert array.flags.writeable
        assert not np.shares_memory(array, P)
        assert not np.shares_memory(array, Q)
    comparison = curvewise.compare(P, Q)
    assert not np.shares_memory(comparison.P, P)


def test_concurrent_calls_give_what_single_calls_give() -> None:
    rng = np.random.default_rng(0)
    A, B = (np.cumsum(rng.normal(size=(n, 2)), axis=0) for n in (300, 260))
    for curve in (A, B):
        curve.flags.writeable = False
    names = [name for name in FUNCTIONS if name not in ("sum_of_squares", "mse", "mae")]
    expected = {name: plain(getattr(curvewise, name)(A, B)) for name in names}
    threads = 8
    together = threading.Barrier(threads)

    def run(first: int) -> list[str]:
        together.wait()
        order = itertools.islice(itertools.cycle(names), first, first + 3 * len(names))
        return [name for name in order if plain(getattr(curvewise, name)(A, B)) != expected[name]]

    with ThreadPoolExecutor(threads) as pool:
        assert list(pool.map(run, range(threads))) == [[]] * threads
