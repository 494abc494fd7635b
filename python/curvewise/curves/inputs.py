"""Converts user input to a float64 array of one or two dimensions.

Only this module handles lists, DataFrames and dtypes. foreign_curves.py recognises the objects of
other packages; docs/reference/accepted_inputs.md has the table. The computing code checks the
numbers themselves (finite, long enough, matching dimensions): the C++ library for the compiled
functions, numpy code for the reference.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeAlias, cast, get_args

import numpy as np
import numpy.typing as npt

from .._options import check_choice
from .column_roles import are_coordinates, are_names, coordinates_among
from .foreign_curves import (
    advice,
    all_columns,
    chosen_columns,
    column_names,
    columns_as_curves,
    is_curve_of_another_package,
    list_instead,
    opened,
)
from .labels import unlabelled
from .layouts import Layout, ask_about_list, with_known_layout

__all__ = [
    "Array",
    "CurveLike",
    "as_curve",
    "as_curve_list",
    "as_curve_lists",
    "as_curves",
    "as_numbers",
    "check_column_names",
    "column_names",
    "copy_of",
    "in_columns",
]

Array: TypeAlias = npt.NDArray[np.float64]
CurveLike: TypeAlias = npt.ArrayLike
"""Anything ``numpy.asarray`` turns into a real array of shape (n, d) or (n,)."""

_FLOAT64 = np.dtype(np.float64)
_ROWS_AT_ONCE = 2**20
_MAY_HOLD_MASKED = (np.ma.MaskedArray, list, tuple)


def as_curve(curve: Any, name: str, keep_float32: bool = False) -> Array:
    """Return a curve as :func:`as_numbers` does; every column is a coordinate.

    Raises
    ------
    TypeError, ValueError
        As for :func:`as_numbers`. If rarely all columns of such a table are coordinates, see
        column_roles.py.
    """
    array = as_numbers(curve, name, keep_float32)
    names = column_names(curve)
    if len(names) > 2 and not are_coordinates(names):
        chosen = coordinates_among(names)
        raise ValueError(
            f"{name} has columns {names}, each of which would be a coordinate; choose: "
            f"{chosen_columns(curve, name, chosen)} for example, or {all_columns(curve, name)} for "
            "all"
        )
    if array.ndim == 2 and array.shape[1] > len(array) and _knows_its_layout(curve, names):
        return with_known_layout(array)
    return array


def _knows_its_layout(curve: Any, names: list[Any]) -> bool:
    """Return whether a curve is a table whose columns have names, or a line."""
    return are_names(names) or (is_curve_of_another_package(curve) and not names)


def as_numbers(curve: Any, name: str, keep_float32: bool = False) -> Array:
    """Return `curve` as an aligned, native float64 array of shape (n, d) or (n,).

    A float64 array is returned unchanged, without a copy, whatever its strides. With `keep_float32`
    so is a float32 array, although the type hints omit it: compiled functions of lists accept both.

    Raises
    ------
    TypeError
        If the input is complex numbers, text, objects, dates, or masked entries. If it is an object
        of another package that is not a curve, or not in main memory; the message suggests an
        alternative.
    ValueError
        If lists are ragged, or an array has 0 or more than 2 dimensions.
    """
    if type(curve) is np.ndarray and curve.dtype is _FLOAT64 and 1 <= curve.ndim <= 2:
        return _aligned(curve)
    if curve is None:
        raise TypeError(f"{name} is None; give a curve")
    values = opened(curve, name)
    _refuse_masked(values, curve, name)
    try:
        # Not asarray, which drops the mask that __array__ returns.
        array = np.asanyarray(values)
    except ValueError as error:
        raise ValueError(
            f"{name} is ragged; a curve is n points with the same number of coordinates each"
        ) from error
    except (TypeError, RuntimeError) as error:  # in the words of its package
        raise TypeError(f"{name}, a {type(curve).__name__}, gives no array: {error}") from error
    _refuse_masked(array, curve, name)
    array = np.asarray(array)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} is complex; a curve is real: give real and imaginary as columns")
    if array.dtype.kind not in "fiub":
        instead = advice(curve, array, name)
        raise TypeError(f"{name} has dtype {array.dtype}; a curve holds real numbers{instead}")
    if not 1 <= array.ndim <= 2:
        raise ValueError(
            f"{name} has {array.ndim} array dimensions; give shape (n, d), or (n,) for d = 1"
            f"{_advice_on_a_single(array.shape, name)}"
        )
    if keep_float32 and array.dtype.type is np.float32 and array.dtype.isnative:
        return _aligned(cast("Array", array))
    # astype, not asarray: float64 of the other byte order must be converted too.
    with np.errstate(over="ignore"):  # a longdouble beyond float64 becomes inf: reported as such
        return _aligned(array.astype(_FLOAT64, copy=False))


def _advice_on_a_single(shape: tuple[int, ...], name: str) -> str:
    """Return what to write for an array of one curve, with its points as rows or as columns."""
    if len(shape) != 3 or shape[0] != 1 or shape[1] == shape[2]:
        return ""
    return f": {name}[0]" if shape[1] > shape[2] else f": {name}[0].T?"


def _refuse_masked(values: Any, curve: Any, name: str) -> None:
    if _has_masked(values):
        known = {np.ma.MaskedArray: "masked array", tuple: "list"}
        kind = known.get(type(curve), type(curve).__name__)
        raise TypeError(f"{name} is a {kind} with masked entries; drop or fill them first")


def _has_masked(curve: Any, depth: int = 2) -> bool:
    """Return whether entries are masked: of an array, or of the rows of a list.

    Out of a list, numpy takes masked rows as if they were not.
    """
    if isinstance(curve, np.ma.MaskedArray):
        return bool(np.ma.is_masked(curve))
    if depth == 0 or not isinstance(curve, list | tuple):
        return False
    return any(isinstance(row, _MAY_HOLD_MASKED) and _has_masked(row, depth - 1) for row in curve)


def _aligned(array: Array) -> Array:
    return array if array.flags.aligned else copy_of(array)


def copy_of(curve: Array) -> Array:
    """Return a copy of the same type, in pieces: Ctrl-C is heard between them, not inside numpy."""
    copy = np.empty(curve.shape, curve.dtype)
    for first in range(0, len(curve), _ROWS_AT_ONCE):
        copy[first : first + _ROWS_AT_ONCE] = curve[first : first + _ROWS_AT_ONCE]
    return copy


def in_columns(array: Array) -> Array:
    """Return an array of shape (n, d): (n, 1) for one of shape (n,)."""
    return array[:, np.newaxis] if array.ndim == 1 else array


def as_curves(P: Any, Q: Any) -> tuple[Array, Array]:
    """Return both curves as arrays; DataFrames must have the same columns."""
    # Inputs that are returned unchanged are found without a call: short curves take a microsecond.
    if (
        type(P) is type(Q) is np.ndarray
        and P.dtype is Q.dtype is _FLOAT64
        and 1 <= P.ndim <= 2
        and 1 <= Q.ndim <= 2
        and P.flags.aligned
        and Q.flags.aligned
    ):
        return P, Q
    if type(P) is not np.ndarray and type(Q) is not np.ndarray:
        check_column_names(column_names(P), "P", column_names(Q), "Q")
    return as_curve(P, "P"), as_curve(Q, "Q")


def as_curve_list(
    curves: Any, name: str, *, keep_float32: bool = False, layout: Layout | None = None
) -> list[Array]:
    """Return the curves of an array of shape (k, n, d), or of a sequence, as a list of arrays.

    Labels are dropped: callers that keep them call labels.py first. float32 as for
    :func:`as_numbers`. Without a `layout`, a doubtful one causes a warning: see layouts.py.

    Raises
    ------
    TypeError, ValueError
        If the input is not a list of curves, or :func:`as_curve` refuses a curve (named ``XA[3]``).
        If the columns of a DataFrame differ from those of the first curve. If the layout is
        unknown.
    """
    converted = _converted(curves, name, None, keep_float32, layout)
    if layout is None:
        ask_about_list(converted, name)
    return converted


def as_curve_lists(
    XA: Any, XB: Any, *, keep_float32: bool = False, layout: Layout | None = None
) -> tuple[list[Array], list[Array] | None]:
    """Return the curves of XA, and of XB if there are any, as :func:`as_curve_list` does.

    Raises
    ------
    TypeError, ValueError
        As for :func:`as_curve_list`. If the columns of a DataFrame of XB differ from those of XA.
    """
    rows = _converted(XA, "XA", None, keep_float32, layout)
    columns = None if XB is None else _converted(XB, "XB", XA, keep_float32, layout)
    if layout is None and rows:
        ask_about_list(rows + (columns or []), "XA")
    return rows, columns


def _converted(
    curves: Any, name: str, like: Any, keep_float32: bool, layout: Layout | None
) -> list[Array]:
    """Return curves as arrays whose rows are points; tables have the columns of the list `like`."""
    if layout is not None:
        check_choice("layout", layout, get_args(Layout))
    given = _listed(curves, name)
    first, first_name = column_names(given[0]) if given else [], f"{name}[0]"
    others = [] if like is None else unlabelled(like, "XA")[0]
    if len(others) > 0:
        first, first_name = column_names(others[0]), "XA[0]"
    for i, curve in enumerate(given):
        if type(curve) is not np.ndarray:  # whose columns have no names
            check_column_names(first, first_name, column_names(curve), f"{name}[{i}]")
    converted = [
        # Inputs that are returned unchanged are found without a call.
        curve
        if type(curve) is np.ndarray
        and curve.dtype is _FLOAT64
        and 1 <= curve.ndim <= 2
        and curve.flags.aligned
        else as_curve(curve, f"{name}[{i}]", keep_float32)
        for i, curve in enumerate(given)
    ]
    return [curve.T for curve in converted] if layout == "channels_first" else converted


def _listed(curves: Any, name: str) -> list[Any]:
    """Return what a collection holds; refuse single arrays and tables, of whatever package."""
    curves, _ = unlabelled(curves, name)
    if instead := list_instead(curves, name):
        raise TypeError(f"{name} is a {type(curves).__name__}; {instead}")
    dimensions = _dimensions(curves)
    if dimensions not in (None, 3):
        raise ValueError(
            f"{name} has {dimensions} array dimensions; give k curves as shape (k, n, d) or as "
            f"a list: [{name}] for a single curve, {columns_as_curves(curves, name)} for k curves "
            "with d = 1"
        )
    if isinstance(curves, str | bytes) or not isinstance(curves, Iterable):
        raise TypeError(f"{name} is of type {type(curves).__name__}; give a list of curves")
    return list(curves)


def _dimensions(curves: Any) -> int | None:
    """Return the array dimensions of one array or table of numbers; None for a list of curves."""
    if isinstance(curves, np.ndarray):
        return None if curves.dtype == object else curves.ndim
    if hasattr(curves, "columns"):
        return 2
    shape = getattr(curves, "shape", None)  # xarray, torch, jax, dask, h5py, zarr, scipy.sparse
    # A series of lists, with a single dimension, is a list of curves.
    return len(shape) if isinstance(shape, tuple) and len(shape) != 1 else None


def check_column_names(first: list[Any], first_name: str, second: list[Any], name: str) -> None:
    """Raise ValueError where both curves have named columns and the names differ."""
    if first and second and first != second:
        raise ValueError(
            f"{first_name} has columns {first} and {name} has columns {second}; "
            "name and order them alike"
        )
