"""The note in the file of an index: what `Index.open` needs besides the curves, in JSON.

Floats are written so that they are read with the same bits.
"""

from __future__ import annotations

import json
import operator
from importlib import import_module
from numbers import Real
from typing import Any

import numpy as np

from .._extras import extra
from ..measures.step_pattern import StepPattern

__all__ = ["read_note", "write_note"]


def write_note(described: dict[str, Any], labels: list[Any] | None) -> bytes:
    """Return measure, options, layout and reference system of an index, and its labels.

    Raises
    ------
    TypeError
        If an option or a label cannot be written.
    """
    options = {
        name: _written(value, f"the option {name}={value!r}; give it as text or numbers")
        for name, value in described["_options"].items()
    }
    if labels is not None:
        labels = [_written(label, f"the label {label!r}; give text or numbers") for label in labels]
    crs = described["_crs"]
    note = {
        "measure": described["_measure"],
        "options": options,
        "layout": described["_layout"],
        "crs": None if crs is None else crs.to_wkt(),
        "labels": labels,
    }
    return json.dumps(note, ensure_ascii=False).encode("utf-8", "surrogatepass")


def read_note(note: bytes, path: str) -> tuple[dict[str, Any], list[Any] | None]:
    """Return what :func:`write_note` has written.

    Raises
    ------
    ValueError
        If a C++ program has written the file without such a note.
    """
    try:
        read = json.loads(note.decode("utf-8", "surrogatepass"))
        options = {name: _read(value) for name, value in read["options"].items()}
        labels = None if read["labels"] is None else [_read(label) for label in read["labels"]]
        described = {
            "_measure": read["measure"],
            "_options": options,
            "_layout": read["layout"],
            "_crs": read["crs"],
        }
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise ValueError(
            f"{path} does not name the measure of its index, because a C++ program wrote it; open "
            "it with Index::open in C++"
        ) from error
    if described["_crs"] is not None:
        with extra("geo", "an index of tracks in a reference system needs pyproj"):
            described["_crs"] = import_module("pyproj").CRS.from_wkt(described["_crs"])
    return described, labels


def _written(value: Any, what: str) -> Any:
    """Return a value that JSON keeps exactly; tuples and step patterns as dicts."""
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, tuple):
        return {"tuple": [_written(item, what) for item in value]}
    if isinstance(value, list):
        return [_written(item, what) for item in value]
    if isinstance(value, StepPattern):
        return {"steps": [list(row) for row in value.rows], "per": value.normalization}
    try:
        return operator.index(value)
    except TypeError:
        if isinstance(value, Real) and (float(value) == value or value != value):
            return float(value)
    raise TypeError(f"save cannot write {what}")


def _read(value: Any) -> Any:
    if isinstance(value, list):
        return [_read(item) for item in value]
    if isinstance(value, dict):
        if "tuple" in value:
            return tuple(_read(item) for item in value["tuple"])
        return StepPattern([tuple(row) for row in value["steps"]], value["per"])
    return value
