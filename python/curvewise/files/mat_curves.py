"""Curves from MATLAB's .mat files, read by scipy.

The columns are the real arrays of a file. scipy's reader can crash the process on a damaged file.
It therefore runs in a separate process (mat_process.py), which returns the columns through a pipe;
that takes half a second. Time and memory are linear in the size of the file.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from importlib import import_module

import numpy as np

from .._extras import extra
from .._option_names import called
from ..curves.inputs import Array
from .column_choice import choose_columns
from .file_options import Reading
from .number_tables import say_left_out

__all__ = ["read_mat_columns"]

_SCRIPT = os.path.join(os.path.dirname(__file__), "mat_process.py")


def read_mat_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None, reading: Reading
) -> tuple[Array, list[str], list[str]]:
    """Read columns of the arrays of a .mat file, their names, and no units."""
    file = os.fspath(path)
    if reading.begins_later or reading.encoding:
        given = reading.begins_later or f"{called('encoding')} is {reading.encoding!r}"
        raise ValueError(f"{given}, and {file} is a file of MATLAB without rows; leave it out")
    found = _columns(file)
    if not found:
        raise ValueError(f"{file} holds no real arrays; a curve is one point per row")
    names = list(found)
    chosen = [names[j] for j in choose_columns(file, names, len(names), columns)]
    for name in chosen:
        if len(found[name]) != len(found[chosen[0]]):
            raise ValueError(
                f"{file}: {chosen[0]} has {len(found[chosen[0]])} values and {name} has "
                f"{len(found[name])}; choose columns of one length"
            )
    values = np.column_stack([found[name] for name in chosen])
    finite = np.isfinite(values)
    wrong = np.flatnonzero(~finite.all(axis=1))
    if len(wrong) and not reading.skip_invalid:
        column = int(np.argmin(finite[wrong[0]]))
        raise ValueError(
            f"{file}: {chosen[column]}({wrong[0] + 1}) is {values[wrong[0], column]}; curves must "
            "be finite"
        )
    say_left_out(file, "row", (wrong + 1).tolist(), len(values))
    return np.delete(values, wrong, axis=0), chosen, [""] * len(chosen)


def _columns(file: str) -> dict[str, Array]:
    """Return all columns of a file, read in a separate process."""
    with extra("curves", f"to read {file}, curvewise needs scipy"):
        import_module("scipy")
    with open(file, "rb"):  # raises an error for a file that cannot be opened
        done = subprocess.run([sys.executable, _SCRIPT, file], capture_output=True, check=False)
    if done.returncode:
        raise ValueError(
            f"{file} is damaged: scipy's reader ended with status {done.returncode} on it; save it "
            "in MATLAB with save(..., '-v7')"
        )
    head, _, content = done.stdout.partition(b"\n")
    problem, lengths = json.loads(head)
    if problem:
        raise ValueError(f"{file} {problem}")
    ends = np.cumsum(list(lengths.values()), dtype=int)
    return dict(zip(lengths, np.split(np.frombuffer(content), ends), strict=False))
