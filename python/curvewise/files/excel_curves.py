"""Curves from a sheet of a workbook, through pandas.

pandas reads the cells as they are; what is header and what is a number is decided by the rules for
text files (number_tables.py): texts that are numbers count, too. Time and memory are linear in the
number of cells.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from importlib import import_module
from typing import Any

from .._extras import extra, foreign_reader
from ..curves.inputs import Array
from .column_choice import choose_columns, choose_names, column_name
from .number_tables import NumberTable, Reading, find_header, refuse_no_numbers
from .number_texts import is_number

__all__ = ["read_sheet_columns"]


def read_sheet_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None, reading: Reading
) -> tuple[Array, list[str]]:
    """Read columns of a sheet, and their names."""
    file = os.fspath(path)
    title, rows = _cells(path, file, 1 if reading.sheet is None else reading.sheet)
    place = f"{file}, sheet {title!r}"
    # Texts that are numbers are no header only where nothing else is a number.
    numbers = [sum(is_number(cell) for cell in row if not isinstance(cell, str)) for row in rows]
    if not any(numbers):
        numbers = [sum(map(is_number, row)) for row in rows]
    if not any(numbers):
        cells = ((i, cell) for i, row in enumerate(rows, 1) for cell in row)
        refuse_no_numbers(place, "row", cells)
    first, begin = find_header(rows, numbers, columns)
    end = len(rows)
    if (until := reading.until) is not None:
        texts = (any(until in str(cell) for cell in row) for row in rows[first + 1 :])
        end = next((i for i, found in enumerate(texts, first + 1) if found), end)
    names = choose_names(rows[begin:first], columns)
    width = max(j + 1 for row in rows[:end] for j, cell in enumerate(row) if cell != "")
    chosen = choose_columns(place, names, width, columns)
    numbered = list(enumerate(rows[:end], 1))[first:]
    kept = [(i, row) for i, row in numbered if any(cell != "" for cell in row)]
    header = rows[begin:first]
    values = NumberTable(place, "row", names, lambda: kept, reading, header=header).read(chosen)
    return values, [column_name(names, j) for j in chosen]


def _cells(
    path: str | os.PathLike[str], file: str, sheet: str | int
) -> tuple[str, list[list[Any]]]:
    """Return a sheet's title, and its cells as they are, "" where they are empty."""
    advice = "open it in a spreadsheet program and save it again, or save the curve as CSV"
    others = ", for .xls also xlrd, for .ods odfpy"
    with extra("curves", f"to read {file}, curvewise needs pandas and openpyxl", others):
        pandas = import_module("pandas")
        with foreign_reader(file, "workbook", advice):
            book = pandas.ExcelFile(path)
        with book:
            title = _find_sheet(file, book.sheet_names, sheet)
            with foreign_reader(file, "workbook", advice):
                frame = pandas.read_excel(book, sheet_name=title, header=None, na_filter=False)
    rows = frame.to_numpy(dtype=object).tolist()
    return title, [[c.strip() if isinstance(c, str) else c for c in row] for row in rows]


def _find_sheet(file: str, titles: list[str], sheet: str | int) -> str:
    known: dict[str | int, str] = {title: title for title in titles}
    known |= enumerate(titles, 1)
    if isinstance(sheet, str) and sheet not in known and sheet.isdecimal():
        sheet = int(sheet)
    if sheet not in known:
        raise ValueError(
            f"{file} has no sheet {sheet!r}; its sheets are {', '.join(titles)}; "
            f"by number, give 1 to {len(titles)}"
        )
    return known[sheet]
