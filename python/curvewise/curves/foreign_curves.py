"""Recognises curves in objects of other packages, and suggests alternatives.

Other packages are not imported. An object is recognised by its attributes: ``__geo_interface__``
(shapely and other packages with GeoJSON), named columns (pandas, polars, pyarrow),
``requires_grad`` (torch), ``__next__`` (``zip(x, y)``). Objects that numpy reads correctly are left
to numpy. The cost is a few attribute look-ups, and nothing for arrays of float64.
docs/reference/accepted_inputs.md has the table.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from .column_roles import coordinates_among

__all__ = [
    "advice",
    "all_columns",
    "chosen_columns",
    "column_names",
    "columns_as_curves",
    "is_curve_of_another_package",
    "list_instead",
    "opened",
    "warn",
]

_NATIVE = (list, tuple, np.ndarray, float, int)
_LINES = ("LineString", "LinearRing")
_INSTEAD_OF_SHAPES = {
    "Point": "a curve needs several: shapely.LineString of the points is one",
    "MultiPoint": "its points have no order that counts: give shapely.get_coordinates({name})",
    "Polygon": "give {name}.exterior",
    "MultiLineString": "give one of its lines, {name}.geoms[0], or shapely.line_merge({name})",
}


def opened(curve: Any, name: str) -> Any:
    """Return what numpy reads as the numbers of `curve`.

    Raises
    ------
    TypeError
        If the object does not hold exactly one curve in main memory; the message suggests an
        alternative.
    """
    if isinstance(curve, _NATIVE):
        return curve
    kind = type(curve).__name__
    if hasattr(curve, "geom_type") or hasattr(curve, "__geo_interface__"):
        return _points_of_shape(curve, name, kind)
    if hasattr(curve, "requires_grad"):
        return _values_of_tensor(curve, name)
    if hasattr(curve, "data_vars"):
        first = [f"{name}[{variable!r}]" for variable in list(curve.data_vars)[:2]]
        raise TypeError(
            f"{name} is a {kind}; give its variables as columns: "
            f"numpy.column_stack([{', '.join(first)}])"
        )
    if hasattr(curve, "collect_schema") and hasattr(curve, "collect"):
        raise TypeError(f"{name} is a {kind}, not computed yet; give {name}.collect()")
    if hasattr(curve, "columns") and hasattr(curve, "items"):
        return _values_of_frame(curve)
    if hasattr(curve, "__next__"):  # zip(x, y), a generator
        return list(curve)
    return curve


def _points_of_shape(shape: Any, name: str, kind: str) -> Any:
    """Return the points of a line; refuse other shapes, and tables of shapes."""
    if hasattr(shape, "geometry") or hasattr(shape, "iloc"):  # GeoDataFrame, GeoSeries
        column = f"{name}.geometry" if hasattr(shape, "columns") else name
        of_points = all(one == "Point" for one in shape.geom_type)
        instead = (
            f"the track along its points is {column}.get_coordinates()"
            if of_points
            else f"give one of its curves, {column}.iloc[0], or all of them to cdist"
        )
        raise TypeError(f"{name} is a {kind}, many shapes; {instead}")
    interface = getattr(shape, "__geo_interface__", {})
    found = interface.get("type", kind)
    if found not in _LINES:
        instead = _INSTEAD_OF_SHAPES.get(found, "give a LineString").format(name=name)
        raise TypeError(f"{name} is a {found}, not a line; {instead}")
    points = shape.coords if hasattr(shape, "coords") else interface["coordinates"]
    return points if len(points) > 0 else np.empty((0, 2))


def _values_of_tensor(tensor: Any, name: str) -> Any:
    """Return a tensor that numpy can read; say how to make another one so."""
    steps = []
    if tensor.requires_grad:
        steps.append(("requires a gradient", ".detach()"))
    if str(device := getattr(tensor, "device", "cpu")) != "cpu":
        steps.append((f"is on {device}", ".cpu()"))
    if str(getattr(tensor, "dtype", "")) == "torch.bfloat16":
        steps.append(("has dtype bfloat16", ".float()"))
    if steps:
        what = " and ".join(reason for reason, _ in steps)
        raise TypeError(
            f"{name} is a tensor that {what}; give {name}{''.join(c for _, c in steps)}"
        )
    return tensor


def _values_of_frame(frame: Any) -> Any:
    """Return a DataFrame's numbers, column by column where numpy makes objects of them.

    It does so of nullable columns of pandas and of those of pyarrow. One column alone is float64,
    with nan where its value is missing.
    """
    whole = np.asarray(frame)
    if whole.dtype != object:
        return whole
    columns = [np.asarray(column) for _, column in frame.items()]
    numbers = all(column.dtype.kind in "fiub" and column.ndim == 1 for column in columns)
    return np.column_stack(columns) if columns and numbers else whole


def advice(curve: Any, array: np.ndarray[Any, Any], name: str) -> str:
    """Return what to write instead of a curve that numpy reads as `array`, no numbers, if known."""
    if isinstance(curve, str | os.PathLike):
        return f": curvewise.read_curve({name}) reads a file"
    if isinstance(curve, Mapping):
        if any(np.ndim(value) == 2 for value in curve.values()):
            return f": list({name}.values()) is a list of curves, for cdist"
        return f": numpy.column_stack(list({name}.values())) has its values as columns"
    if array.dtype.names:
        reader = "numpy.lib.recfunctions.structured_to_unstructured"
        return f": {reader}({name}) has its fields as columns"
    if hasattr(curve, "columns"):
        return _advice_on_columns(curve)
    if array.ndim == 1 and len(array) and hasattr(array[0], "__geo_interface__"):
        return f": shapely.get_coordinates({name}) has the points as rows"
    for place, value in np.ndenumerate(array):
        if value is None:
            return f", but {name}{list(place)} is None: leave it out, or write nan"
    return ""


def _advice_on_columns(frame: Any) -> str:
    for column in column_names(frame):
        dtype = np.asarray(frame[column]).dtype
        if dtype.kind not in "fiub":
            return f": column {column!r} has dtype {dtype}; convert it, or leave it out"
    return ""


def column_names(curve: Any) -> list[Any]:
    """Return the names of a table's columns; nothing for anything else, nor for an array.

    An array that knows what its columns are called (named_curve.py) does so for pictures alone.
    """
    if isinstance(curve, np.ndarray):
        return []
    names = getattr(curve, "column_names", None)  # pyarrow: its columns are the values
    return list(getattr(curve, "columns", []) if names is None else names)


def list_instead(curves: Any, name: str) -> str:
    """Return what to write instead of an unsuitable collection, if known."""
    if not type(curves).__name__.endswith("GroupBy"):
        return ""
    # For polars; the groups also contain the key, which is not a coordinate.
    keys = getattr(curves, "by", ())
    keys = keys if isinstance(keys, list | tuple) else [keys]
    names = [one for one in column_names(getattr(curves, "df", None)) if one not in keys]
    chosen = f"[{coordinates_among(names)}]" if names else ""
    return f"give {{key: group{chosen} for key, group in {name}}}"


def chosen_columns(table: Any, name: str, columns: list[Any]) -> str:
    """Return what to write for some columns of a table."""
    if hasattr(table, "column_names"):  # pyarrow
        return f"{name}.select({columns})"
    return f"{name}[{columns}]"


def all_columns(table: Any, name: str) -> str:
    """Return what to write for all columns of a table, as an array."""
    if hasattr(table, "column_names"):
        return f"numpy.column_stack({name}.columns)"
    return f"{name}.to_numpy()"


def columns_as_curves(table: Any, name: str) -> str:
    """Return what to write for the series of a table or array with two dimensions, as curves."""
    if hasattr(table, "column_names"):  # pyarrow
        return f"{name}.to_pydict()"
    if hasattr(table, "columns"):
        return f"dict({name}.items())" if hasattr(table, "items") else f"{name}.to_dict()"
    return f"list({name})"


def is_curve_of_another_package(thing: Any) -> bool:
    """Return whether something without an array's `ndim` is a curve: a table or a line."""
    return bool(column_names(thing)) or getattr(thing, "geom_type", "") in _LINES


def warn(message: str | Warning) -> None:
    """Warn the line that called the package, however deep in it the reason was found."""
    frame, level = sys._getframe(), 1
    package = __name__.partition(".")[0]
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] == package:
        frame, level = frame.f_back, level + 1
    warnings.warn(message, stacklevel=level)
