"""Tables of a solver at successive times, and the history of one number.

A table has a variable ("displacements"), a set of nodes or elements if the deck named one, and the
names of its components ("vx"). It has a row for every node, or for every element and integration
point. Readers add rows line by line; a history selects one component of one row, or combines rows.
Time and memory are linear in the output, about 3 s for 10⁶ rows.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .._names import did_you_mean
from ..curves.inputs import Array

__all__ = ["Row", "SolverOutput", "as_number", "as_whole", "lines_of"]

_COMBINED: dict[str, Callable[[list[float]], float]] = {
    "sum": math.fsum,
    "mean": lambda values: math.fsum(values) / len(values),
    "max": max,
    "min": min,
}
# Fortran leaves out the E where the exponent has three digits.
_WITHOUT_E = re.compile(r"(?<=[\d.])([-+]\d{3})$")
_LISTED = 8  # numbers and tables in a message


@dataclass(frozen=True)
class Row:
    """A row's key: a node or an element, and its integration point; 0 if missing."""

    number: int
    point: int = 0


@dataclass
class _Table:
    """The rows of one variable for one set."""

    variable: str
    set_name: str
    components: tuple[str, ...]
    times: list[float] = field(default_factory=list)
    rows: list[dict[Row, list[float]]] = field(default_factory=list)

    def __str__(self) -> str:
        of = f" of set {self.set_name}" if self.set_name else ""
        return f"{self.variable}{of} ({', '.join(self.components)})"

    def names(self, what: str) -> list[str]:
        """Return the table's variable, its set, or its components."""
        if what == "component":
            return [*self.components, "time"]
        return [self.variable if what == "variable" else self.set_name]

    def at(self, time: float) -> dict[Row, list[float]]:
        """Return the rows of a time, which is the last one or a new one."""
        if not self.times or self.times[-1] != time:
            self.times.append(time)
            self.rows.append({})
        return self.rows[-1]


class SolverOutput:
    r"""A solver's output file: tables of numbers at successive times.

    The readers of :mod:`curvewise.solvers` create it; it prints as a list of its contents.

    Parameters
    ----------
    file : path-like
        The file's name in messages.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.solvers import read_calculix_dat
    >>> text = " displacements (vx,vy,vz) for set TIP and time  0.5000000E+00\n\n 7  1E-3 0. 0.\n"
    >>> text += text.replace("0.5000000E+00", "0.1000000E+01").replace("1E-3", "2E-3")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "deck.dat")
    ...     _ = path.write_text(text)
    ...     output = read_calculix_dat(path)
    >>> print(output)
    displacements of set TIP (vx, vy, vz): 2 times from 0.5 to 1, 1 row
    >>> output.history("vx", set_name="TIP", number=7)
    array([0.001, 0.002])
    """

    def __init__(self, file: str | os.PathLike[str]) -> None:
        self.file = os.fspath(file)
        self._tables: dict[tuple[str, str, tuple[str, ...]], _Table] = {}

    def add(
        self, variable: str, set_name: str, components: Sequence[str], time: float
    ) -> dict[Row, list[float]]:
        """Return the rows of a table at a time, for a reader to fill."""
        key = (variable, set_name, tuple(components))
        if key not in self._tables:
            self._tables[key] = _Table(*key)
        return self._tables[key].at(time)

    def __str__(self) -> str:
        lines = []
        for table in self._tables.values():
            count = max(map(len, table.rows))
            rows = f"{count} row{'s' if count > 1 else ''}"
            first, last = table.times[0], table.times[-1]
            lines.append(f"{table}: {len(table.times)} times from {first:g} to {last:g}, {rows}")
        return "\n".join(lines) or "nothing that can be read as a table"

    def history(
        self,
        component: str,
        *,
        variable: str | None = None,
        set_name: str | None = None,
        number: int | None = None,
        point: int | None = None,
        combine: str | None = None,
    ) -> Array:
        """Return one number at every time.

        Parameters
        ----------
        component : str
            Its name in the file, such as "vx", "RF2" or "sig-xx"; "time" for the times themselves.
        variable, set_name : str, optional
            The table, if several have the component. Capitals do not matter.
        number : int, optional
            The node or the element, if the table has several.
        point : int, optional
            The integration point, if the element has several.
        combine : {"sum", "mean", "max", "min"}, optional
            How to combine all rows that `number` and `point` leave: reaction forces are a sum.

        Returns
        -------
        ndarray, shape (times,)
            The history, in the units of the file.

        Raises
        ------
        ValueError
            If the component, variable, set, node or point does not exist, or the choice is
            ambiguous; the message lists the existing ones.

        Notes
        -----
        Linear in the number of rows.

        Examples
        --------
        As for the class.
        """
        if combine is not None and combine not in _COMBINED:
            raise ValueError(f"combine is {combine!r}; choose from {', '.join(_COMBINED)}")
        table = self._table(component, variable, set_name)
        if component.lower() == "time":
            return np.array(table.times)
        column = [name.lower() for name in table.components].index(component.lower())
        values = np.empty(len(table.times))
        for i, (time, rows) in enumerate(zip(table.times, table.rows, strict=True)):
            found = [
                row for row in rows if number in (None, row.number) and point in (None, row.point)
            ]
            for row in found:
                if len(rows[row]) <= column:
                    raise ValueError(
                        f"{self.file}, {table} at time {time:g}: the row of {row.number} has "
                        f"{len(rows[row])} values; was the run cut short?"
                    )
            chosen = [rows[row][column] for row in found]
            if len(chosen) != 1 and (combine is None or not chosen):
                raise ValueError(self._unclear(table, time, rows, number, point))
            values[i] = chosen[0] if combine is None else _COMBINED[combine](chosen)
        return values

    def _table(self, component: str, variable: str | None, set_name: str | None) -> _Table:
        """Return the only table with these names."""
        found = list(self._tables.values())
        if not found:
            raise ValueError(f"{self.file} holds no results that can be read; did the run end?")
        given = {"variable": variable, "set": set_name, "component": component}
        for what, wanted in given.items():
            if wanted is None:
                continue
            kept = [t for t in found if wanted.lower() in map(str.lower, t.names(what))]
            if not kept:
                known = list(dict.fromkeys(name for table in found for name in table.names(what)))
                raise ValueError(f"{self.file} has no {what} {wanted!r}{_instead(wanted, known)}")
            found = kept
        if len(found) > 1 and component.lower() != "time":
            of_one = len({(table.variable, table.set_name) for table in found}) == 1
            advice = "is the file damaged?" if of_one else "say which variable, or which set"
            raise ValueError(
                f"{self.file} has {component!r} in several tables: {_listed(found)}; {advice}"
            )
        return found[0]

    def _unclear(
        self,
        table: _Table,
        time: float,
        rows: dict[Row, list[float]],
        number: int | None,
        point: int | None,
    ) -> str:
        """Say why there is not exactly one row at a time."""
        place = f"{self.file}, {table} at time {time:g}"
        if not rows:
            return f"{place}: there are no rows; was the run cut short?"
        numbers = sorted({row.number for row in rows})
        if number is not None and number not in numbers:
            return f"{place}: there is no {number}; there is {_listed(numbers)}"
        if number is None and len(numbers) > 1:
            return (
                f"{place}: there are {len(numbers)} rows ({_listed(numbers)}); give the number of "
                "a node or an element, or combine them by sum, mean, max or min"
            )
        points = sorted({row.point for row in rows if number in (None, row.number)})
        if point is None:
            return (
                f"{place}: there are {len(points)} integration points ({_listed(points)}); give "
                "one, or combine them by mean"
            )
        return f"{place}: there is no point {point}; there is {_listed(points)}"


def _instead(wanted: str, known: list[str]) -> str:
    named = [name for name in known if name and name != "time"]
    listed = f": there is {_listed(named)}" if named else ""
    return f"{listed or ': its tables have no names of sets'}{did_you_mean([wanted], named)}"


def _listed(items: Sequence[object]) -> str:
    shown = ", ".join(map(str, items[:_LISTED]))
    return shown if len(items) <= _LISTED else f"{shown} and {len(items) - _LISTED} more"


def as_number(text: str, place: str) -> float:
    """Return a number in Fortran's format.

    Raises
    ------
    ValueError
        If it is not a number; `place` names its position.
    """
    try:
        return float(text)
    except ValueError:
        pass
    text = text.strip()
    try:
        return float(_WITHOUT_E.sub(r"E\1", text).replace("D", "E"))
    except ValueError:
        fault = f"{text[:40]!r} is no number" if text else "a number is missing"
        raise ValueError(f"{place}: {fault}; was the run cut short?") from None


def as_whole(text: str, place: str) -> int:
    """Return the number of a node or an element, as :func:`as_number` does."""
    number = as_number(text, place)
    if not number.is_integer():
        fault = f"{text.strip()[:40]!r} is not an integer"
        raise ValueError(f"{place}: {fault}; was the run cut short?")
    return int(number)


def lines_of(path: str | os.PathLike[str]) -> Iterator[tuple[str, str]]:
    """Yield each line of a text file with what messages call its place: the file and a number."""
    with Path(path).open(encoding="latin-1") as file:
        for number, line in enumerate(file, 1):
            yield f"{os.fspath(path)}, line {number}", line
