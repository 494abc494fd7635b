"""Which columns of a file a user asks for, by name or by number, whatever the kind of file."""

from __future__ import annotations

import operator
from collections.abc import Sequence

__all__ = ["choose_columns", "column_name"]


def choose_columns(
    file: str, names: list[str], width: int, columns: Sequence[str | int] | None
) -> list[int]:
    """Return the indices of the columns asked for; by default the first two, or the only one.

    Parameters
    ----------
    file : str
        What messages call the file.
    names : list of str
        Of the columns, blank or missing where one has none.
    width : int
        The number of columns.
    columns : sequence of str or int, or None
        Names, or numbers from 1 (as int or str).

    Raises
    ------
    TypeError
        A lone name.
    ValueError
        No column, or one that is not there, or a name that several have.
    """
    if columns is None:
        return list(range(min(2, width)))
    if isinstance(columns, str):
        raise TypeError(f"columns is {columns!r}; give a list, even for one column")
    if len(columns) == 0:
        raise ValueError("columns is empty; name at least one column")
    return [_find_column(file, names, width, column) for column in columns]


def column_name(names: list[str], column: int) -> str:
    """Return the name of a column, given by index, or its number as a user counts."""
    return (names[column] if column < len(names) else "") or str(column + 1)


def _find_column(file: str, names: list[str], width: int, column: str | int) -> int:
    if isinstance(column, str) and column.strip() in filter(None, names):
        name = column.strip()
        if names.count(name) > 1:
            raise ValueError(f"{file} has several columns {name!r}; give its number, from 1")
        return names.index(name)
    if isinstance(column, str) and not column.isdecimal():
        listed = ", ".join(filter(None, names))
        there_are = f"its columns are {listed}" if listed else "it has no header"
        raise ValueError(
            f"{file} has no column {column!r}; {there_are}; by number, give 1 to {width}"
        )
    number = int(column) if isinstance(column, str) else operator.index(column)
    if not 1 <= number <= width:
        raise ValueError(f"{file} has no column {column}; columns are numbered 1 to {width}")
    return number - 1
