"""Curves from a sheet of a workbook, through pandas.

pandas reads the cells as they are; what is header and what is a number is decided here, by the
rules for text files: numbers begin at the first row that holds one, and the names are the row above
with the most cells. Time and memory are linear in the number of cells.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from importlib import import_module
from typing import Any

import numpy as np

from .._extras import extra
from ..curves.inputs import Array
from .column_choice import choose_columns, column_name

__all__ = ["read_sheet_columns"]


def read_sheet_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None, sheet: str | int
) -> tuple[Array, list[str]]:
    """Read columns of a sheet, which is given by its name or its number from 1, and their names."""
    file = os.fspath(path)
    title, rows = _cells(path, file, sheet)
    first = next((i for i, row in enumerate(rows) if any(map(_is_number, row))), None)
    if first is None:
        raise ValueError(f"{file}, sheet {title!r} holds no numbers; a curve is one point per row")
    header = max(rows[:first], key=lambda row: sum(map(bool, row)), default=[])
    names = [str(cell).strip() for cell in header]
    width = max(j + 1 for row in rows for j, cell in enumerate(row) if cell != "")
    chosen = choose_columns(f"{file}, sheet {title!r}", names, width, columns)
    points = []
    for i, row in enumerate(rows[first:], first):
        if all(row[j] == "" for j in chosen):
            continue
        for j in chosen:
            if not _is_number(row[j]) or not math.isfinite(row[j]):
                wrong = "the cell is missing" if row[j] == "" else f"{row[j]!r} is not a number"
                name = column_name(names, j)
                raise ValueError(
                    f"{file}, sheet {title!r}, row {i + 1}, column {j + 1} ({name}): {wrong}"
                )
        points.append([float(row[j]) for j in chosen])
    return np.array(points), [column_name(names, j) for j in chosen]


def _cells(
    path: str | os.PathLike[str], file: str, sheet: str | int
) -> tuple[str, list[list[Any]]]:
    """Return a sheet's title, and its cells as they are, "" where they are empty."""
    with extra("curves", f"to read {file}, curvewise needs pandas and openpyxl"):
        pandas = import_module("pandas")
        with pandas.ExcelFile(path) as book:
            titles: list[str] = book.sheet_names
            known: dict[str | int, str] = {title: title for title in titles}
            known |= enumerate(titles, 1)
            if isinstance(sheet, str) and sheet not in known and sheet.isdecimal():
                sheet = int(sheet)
            if sheet not in known:
                listed = ", ".join(map(str, titles))
                raise ValueError(
                    f"{file} has no sheet {sheet!r}; its sheets are {listed}; "
                    f"by number, give 1 to {len(titles)}"
                )
            title = known[sheet]
            frame = pandas.read_excel(book, sheet_name=title, header=None, na_filter=False)
    return title, frame.to_numpy(dtype=object).tolist()


def _is_number(cell: Any) -> bool:
    return isinstance(cell, (int, float, np.number)) and not isinstance(cell, bool)
