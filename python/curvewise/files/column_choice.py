"""Selects the columns of a file by name or by number, for every kind of file.

By default the first two columns are used, with a warning if the first is time or counts cycles.
"""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any

from .._names import did_you_mean
from .._option_names import called, with_values
from ..curves.column_roles import counts_cycles, is_time
from ..curves.foreign_curves import warn
from .column_units import TIMES, bare_name, unit_of

__all__ = [
    "TimeColumnWarning",
    "asked_names",
    "choose_columns",
    "choose_names",
    "column_name",
    "column_unit",
    "names_in",
]

_MOST_HINTS = 3
_DIGITS = 18  # of a number of a column; Python refuses to read numbers of thousands


class TimeColumnWarning(UserWarning):
    """The first two columns are taken, the first is time or counts cycles, and there are more.

    Attributes
    ----------
    found : str
        Which file, and which columns.
    wanted : list of str
        The columns called strain and stress, or the two columns after time.
    counter : str
        The first column if it counts cycles, else "".
    """

    def __init__(self, found: str, wanted: list[str], counter: str = "") -> None:
        super().__init__(
            f"{found}; name those wanted, for example {with_values('columns', wanted)}"
        )
        self.counter = counter
        self.found = found
        self.wanted = wanted


def choose_columns(
    file: str,
    names: list[str],
    width: int,
    columns: Sequence[str | int] | None,
    units: Sequence[str] = (),
) -> list[int]:
    """Return the indices of the chosen columns; by default the first two, or one.

    Parameters
    ----------
    file : str
        The name of the file in messages.
    names : list of str
        The names of the columns; blank or missing if a column lacks one.
    width : int
        The number of columns.
    columns : sequence of str or int, or None
        Names, or numbers from 1 (as int or str). If no column has exactly this name, capitals,
        spaces, hyphens, underscores and the unit are ignored.
    units : sequence of str
        The units of the columns, from a row of units.

    Raises
    ------
    TypeError
        If `columns` is a single text.
    ValueError
        If no column is chosen, a column does not exist, or several have the name.

    Warns
    -----
    TimeColumnWarning
        If the first two of several columns are used, and the first is time or counts cycles.
    """
    if columns is None:
        counter = names[0] if names and counts_cycles(names[0]) else ""
        is_other = names and (counter or is_time(names[0]) or _unit(names[0], units) in TIMES)
        if width > 2 and is_other:
            others = [column_name(names, column) for column in range(1, width)]
            found = f"the first two of the {width} columns of {file} are {names[0]} and {others[0]}"
            warn(TimeColumnWarning(found, _likely(others), counter))
        return list(range(min(2, width)))
    if isinstance(columns, str):
        raise TypeError(f"{called('columns')} is {columns!r}; give a list, even for one column")
    if len(columns) == 0:
        raise ValueError(f"{called('columns')} is empty; name at least one column")
    return [_find_column(file, names, width, column) for column in columns]


def _unit(name: str, units: Sequence[str]) -> str:
    """Return the unit of the first column, by its name or by a row of units."""
    return unit_of(name) or (units[0].casefold() if units else "")


def _likely(names: list[str]) -> list[str]:
    """Return the two columns that are likeliest wanted."""
    called = [
        next((name for name in names if word in name.lower()), "") for word in ("strain", "stress")
    ]
    return called if all(called) else names[:2]


def choose_names(header: Sequence[Sequence[Any]], columns: Sequence[str | int] | None) -> list[str]:
    """Return the row of a header that has the columns' names.

    It is the row with all requested names, if one exists, or the row with the most cells: the first
    of several.
    """
    rows = [[str(cell).strip() for cell in row] for row in header]
    asked = asked_names(columns)

    def rank(row: list[str]) -> tuple[bool, bool, int]:
        return names_in(row, asked, True), names_in(row, asked, False), sum(map(bool, row))

    return max(rows, key=rank, default=[])


def names_in(row: Sequence[Any], asked: set[str], to_the_letter: bool) -> bool:
    """Return whether a row has all requested names, exactly or approximately."""
    cells = {str(cell).strip() for cell in row}
    if to_the_letter:
        return asked <= cells
    return set(map(bare_name, asked)) <= set(map(bare_name, cells))


def asked_names(columns: Sequence[str | int] | None) -> set[str]:
    """Return the columns that match a requested name."""
    texts = {column.strip() for column in columns or () if isinstance(column, str)}
    return {text for text in texts if not text.isdecimal()}


def column_name(names: list[str], column: int) -> str:
    """Return the name of a column, given by index, or its number as a user counts."""
    return (names[column] if column < len(names) else "") or str(column + 1)


def column_unit(units: list[str], column: int) -> str:
    """Return the unit of a column, given by index, or nothing."""
    return units[column] if column < len(units) else ""


def _find_column(file: str, names: list[str], width: int, column: str | int) -> int:
    if isinstance(column, str) and column.strip() in filter(None, names):
        name = column.strip()
        if names.count(name) > 1:
            raise ValueError(f"{file} has several columns {name!r}; give its number, from 1")
        return names.index(name)
    if isinstance(column, str) and (not column.isdecimal() or len(column) > _DIGITS):
        return _near_column(file, names, width, column)
    number = int(column) if isinstance(column, str) else operator.index(column)
    if not 1 <= number <= width:
        raise ValueError(f"{file} has no column {column}; columns are numbered 1 to {width}")
    return number - 1


def _near_column(file: str, names: list[str], width: int, column: str) -> int:
    """Return the index of the only column with a close match of the name."""
    wanted = bare_name(column)
    found = [i for i, name in enumerate(names) if wanted and name and bare_name(name) == wanted]
    if len(found) == 1:
        return found[0]
    listed = ", ".join(filter(None, names))
    if found:
        several = " and ".join(repr(names[i]) for i in found)
        raise ValueError(
            f"{file} has several columns like {column!r}: {several}; give the whole name, or the "
            f"number, {' or '.join(str(i + 1) for i in found)}"
        )
    longer = [name for name in names if wanted and wanted in bare_name(name)]
    hint = (
        f"; did you mean {' or '.join(map(repr, longer[:_MOST_HINTS]))}?"
        if longer
        else did_you_mean([column], filter(None, names))
    )
    there_are = f"its columns are {listed}" if listed else "it has no header"
    numbers = f"by number, give 1 to {width}"
    said = f"{hint} ({there_are}; {numbers})" if hint else f"; {there_are}; {numbers}"
    raise ValueError(f"{file} has no column {column!r}{said}")
