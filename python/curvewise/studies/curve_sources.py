"""The source of a curve: a test's file, or a solver's result file.

A solver's result file is in the folder of a run. A source selects whole columns of a file, times
factors; or named quantities, from which formulas compute x and y. curvewise.read_curve reads text,
Excel and MATLAB; curvewise.solvers reads solvers' files.
"""

from __future__ import annotations

import glob
import json
import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .. import solvers
from ..curves.inputs import Array
from ..files.column_choice import TimeColumnWarning
from ..files.curve_files import read_named_columns
from ..files.file_options import Reading
from ..solvers import SolverOutput
from . import keys
from .formulas import Formula
from .keys import key

__all__ = ["FORMATS", "CurveSource", "Quantity", "format_of"]

FORMATS: dict[str, Callable[[Path], SolverOutput] | None] = {
    "columns": None,
    "calculix-dat": solvers.read_calculix_dat,
    "calculix-frd": solvers.read_calculix_frd,
    "abaqus-dat": solvers.read_abaqus_dat,
    "ls-dyna-nodout": solvers.read_ls_dyna_nodout,
    "ls-dyna-elout": solvers.read_ls_dyna_elout,
    "ls-dyna-binout": solvers.read_ls_dyna_binout,
}


@dataclass(frozen=True)
class Quantity:
    """One number a time of a solver's output: the arguments of `SolverOutput.history`."""

    component: str = key(keys.text, "", required='its component, such as "vx"')
    variable: str | None = key(keys.text)
    set: str | None = key(keys.text)
    node: int | None = key(keys.whole)
    element: int | None = key(keys.whole)
    point: int | None = key(keys.whole)
    combine: str | None = key(keys.choice(("sum", "mean", "max", "min")))

    def of(self, output: SolverOutput) -> Array:
        """Return the history."""
        return output.history(
            self.component,
            variable=self.variable,
            set_name=self.set,
            number=self.element if self.node is None else self.node,
            point=self.point,
            combine=self.combine,
        )


@dataclass(frozen=True)
class CurveSource:
    """A file, the selected data, and their conversion to a curve.

    Parameters
    ----------
    file : str
        The absolute path, or a path in the folder that `read` receives.
    format : str
        One of `FORMATS`.
    names : tuple of str
        The names of the columns or quantities in formulas.
    columns : tuple of (str or int), or of Quantity
        The source of each of them; empty for the first two columns of a file.
    factors : tuple of float
        Their factors; empty for 1.
    formulas : tuple of Formula
        Formulas of the names: x and y, or one whose value is a number; empty for the raw columns.
    first_point : tuple of float
        A point that is put before the others, or ().
    reading : Reading
        The sheet of a workbook, and other options for reading the file.
    """

    file: str
    format: str
    names: tuple[str, ...] = ()
    columns: tuple[Any, ...] = ()
    factors: tuple[float, ...] = ()
    formulas: tuple[Formula, ...] = ()
    first_point: tuple[float, ...] = ()
    reading: Reading = field(default_factory=Reading)

    @property
    def is_number(self) -> bool:
        """Whether it gives a number, and no curve."""
        return len(self.formulas) == 1

    def axes(self, folder: Path) -> tuple[str, ...]:
        """Return what the coordinates are called, for tables and pictures."""
        if self.formulas:
            return tuple(formula.text for formula in self.formulas)
        if self.format != "columns":
            return self.names
        found = read_named_columns(folder / self.file, self.columns or None, self.reading)[1]
        return tuple(name if not name.isdecimal() else f"column {name}" for name in found)

    def read(self, folder: Path) -> Array:
        """Return the curve, shape (n, d); (1, 1) for a number.

        Raises
        ------
        ValueError, OSError
            If the file cannot be read or lacks the requested data, or the value of a formula is
            undefined.
        """
        columns = self._columns(folder)
        if self.factors:
            columns = columns * np.array(self.factors)
        if not self.formulas:
            curve = columns
        else:
            values = dict(zip(self.names, columns.T, strict=True))
            made = [np.asarray(formula(values), dtype=np.float64) for formula in self.formulas]
            if self.is_number:
                return self._single(made[0])
            curve = np.column_stack([np.broadcast_to(m, len(columns)) for m in made])
        if self.first_point:
            curve = np.vstack((self.first_point, curve))
        return curve

    def _columns(self, folder: Path) -> Array:
        """Return the data, one column for each name."""
        path = folder / self.file
        if folder.name and not glob.glob(os.fspath(path)):
            there_are = sorted(item.name for item in folder.iterdir()) if folder.is_dir() else []
            raise FileNotFoundError(
                f"the run has written no {self.file}; it has written {', '.join(there_are)}"
            )
        if self.format == "columns":
            with warnings.catch_warnings():
                warnings.simplefilter("error", TimeColumnWarning)
                try:
                    return read_named_columns(path, self.columns or None, self.reading)[0]
                except TimeColumnWarning as guessed:
                    wanted = json.dumps(guessed.wanted, ensure_ascii=False)
                    message = f"{guessed.found}; name those wanted: columns = {wanted}"
                    raise ValueError(message) from None
        reader = FORMATS[self.format]
        assert reader is not None
        output = reader(path)
        histories = [quantity.of(output) for quantity in self.columns]
        lengths = {name: len(h) for name, h in zip(self.names, histories, strict=True)}
        if len(set(lengths.values())) > 1:
            counts = ", ".join(f"{name} {count}" for name, count in lengths.items())
            raise ValueError(
                f"{self.file} has different numbers of times: {counts}; print all of them at the "
                "same increments, or was the run cut short?"
            )
        return np.column_stack(histories)

    def _single(self, value: Array) -> Array:
        if value.size != 1:
            raise ValueError(
                f"{self.formulas[0].text!r} gives {value.size} numbers; one is wanted: use max, "
                "min, mean, sum, first or last"
            )
        return value.reshape(1, 1)


def format_of(file: str) -> str:
    """Return the format that a file's name says; empty for a .dat, which several solvers write."""
    name = Path(file).name.lower()
    for known in ("nodout", "elout", "binout"):
        if name.startswith(known):
            return f"ls-dyna-{known}"
    if name.endswith(".frd"):
        return "calculix-frd"
    return "" if name.endswith(".dat") else "columns"
