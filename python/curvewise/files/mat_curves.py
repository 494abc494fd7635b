"""Curves from MATLAB's .mat files, through scipy: their real arrays, taken apart into columns.

Time and memory are linear in the size of the file.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from typing import Any

import numpy as np

from .._extras import extra
from ..curves.inputs import Array
from .column_choice import choose_columns

__all__ = ["read_mat_columns"]


def read_mat_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None
) -> tuple[Array, list[str]]:
    """Read columns of the arrays of a .mat file, and their names."""
    file = os.fspath(path)
    with extra("curves", f"to read {file}, curvewise needs scipy"):
        io = import_module("scipy.io")
    try:
        content = io.loadmat(file, appendmat=False, simplify_cells=True)
    except NotImplementedError as error:
        raise ValueError(
            f"{file} is a .mat file of version 7.3; save it in MATLAB with save(..., '-v7')"
        ) from error
    except (ValueError, TypeError) as error:  # scipy's words for a file of another kind
        raise ValueError(f"{file} is not a .mat file that scipy reads: {error}") from error
    found = dict(_columns(content))
    if not found:
        raise ValueError(f"{file} holds no real arrays; a curve is one point per row")
    names = list(found)
    chosen = [names[j] for j in choose_columns(file, names, len(names), columns)]
    for name in chosen:
        column = found[name]
        if len(column) != len(found[chosen[0]]):
            raise ValueError(
                f"{file}: {chosen[0]} has {len(found[chosen[0]])} values and {name} has "
                f"{len(column)}; choose columns of one length"
            )
        if not np.isfinite(column).all():
            first = int(np.argmin(np.isfinite(column)))
            raise ValueError(
                f"{file}: {name}({first + 1}) is {column[first]}; curves must be finite"
            )
    return np.column_stack([found[name] for name in chosen]), chosen


def _columns(content: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Array]]:
    """Yield the names and values of all columns, those of structures inside too."""
    for variable, value in content.items():
        name = prefix + variable
        if isinstance(value, Mapping):
            yield from _columns(value, f"{name}.")
        elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub" and value.size:
            if value.ndim == 1:
                yield name, value.astype(np.float64)
            elif value.ndim == 2:
                for k, column in enumerate(value.T, 1):
                    yield f"{name}(:,{k})", column.astype(np.float64)
