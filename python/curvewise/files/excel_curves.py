"""Curves from a sheet of a workbook, through pandas and openpyxl.

pandas and openpyxl read the raw cells. The rules for text files (number_tables.py) decide which
cells are header and numbers; texts that are numbers count, too. Rows are kept up to their last
cell, so that a stray cell far away costs nothing. Time and memory are linear in the number of
cells. A sheet with too many cells is refused while it is read.
"""

from __future__ import annotations

import io
import math
import os
import re
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from typing import Any

from .._extras import extra, foreign_reader
from .._option_names import called
from ..curves.inputs import Array
from .column_choice import choose_columns, choose_names, column_name, column_unit
from .column_units import units_row
from .file_options import Reading
from .number_tables import NumberTable, begin_of_table, find_header, refuse_no_numbers
from .number_texts import is_number
from .strict_workbooks import transitional

__all__ = ["read_sheet_columns"]

_FORMULA = re.compile(rb"<(?:\w{1,8}:)?f[\s/>]")
_MOST_ROWS = 2**20  # of a sheet
_MOST_CELLS = 32 * _MOST_ROWS
# Bytes of a workbook's parts, unpacked: beyond the first only if packed no tighter than the second.
_MOST_BYTES, _MOST_PACKED, _SMALL = 2**31, 200, 2**26


def read_sheet_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None, reading: Reading
) -> tuple[Array, list[str], list[str]]:
    """Read columns of a sheet, their names, and the units that a row of the header gives them."""
    file = os.fspath(path)
    if reading.encoding is not None:
        raise ValueError(
            f"{called('encoding')} is {reading.encoding!r}, and {file} is a workbook; leave "
            f"{called('encoding')} out"
        )
    sheet = 1 if reading.sheet is None else reading.sheet
    title, titles, numbered = _numbered_rows(path, file, sheet)
    try:
        return _columns_of(f"{file}, sheet {title!r}", numbered, columns, reading)
    except ValueError as error:
        if reading.sheet is not None or len(titles) == 1:
            raise
        raise ValueError(
            f"{error}; the sheets of the workbook are {', '.join(map(repr, titles))}: name the one "
            f"with the curve ({called('sheet')})"
        ) from None


def _columns_of(
    place: str,
    numbered: list[tuple[int, list[Any]]],
    columns: Sequence[str | int] | None,
    reading: Reading,
) -> tuple[Array, list[str], list[str]]:
    """Return the columns of the rows of a sheet, with their names and units."""
    if reading.begins_later:
        lines = [(i, "\t".join(map(str, row))) for i, row in numbered]
        numbered = numbered[begin_of_table(place, "row", lines, reading) :]
    rows = [row for _, row in numbered]
    # Texts that are numbers do not count as header only if the sheet lacks other numbers.
    numbers = [sum(is_number(cell) for cell in row if not isinstance(cell, str)) for row in rows]
    if not any(numbers):
        numbers = [sum(map(is_number, row)) for row in rows]
    if not any(numbers):
        refuse_no_numbers(place, "row", ((i, cell) for i, row in numbered for cell in row))
    first, begin = find_header(rows, numbers, columns, reading)
    if first == len(rows):
        refuse_no_numbers(place, "row", ((i, cell) for i, row in numbered[1:] for cell in row))
    end = len(rows)
    if (until := reading.until) is not None:
        texts = (any(until in str(cell) for cell in row) for row in rows[first + 1 :])
        end = next((i for i, found in enumerate(texts, first + 1) if found), end)
    header = rows[begin:first]
    names = choose_names(header[:1] if reading.header_row else header, columns)
    units = units_row(header, names)
    chosen = choose_columns(place, names, max(map(len, rows[:end])), columns, units)
    kept = numbered[first:end]
    values = NumberTable(place, "row", names, lambda: kept, reading, header=header).read(chosen)
    return values, [column_name(names, j) for j in chosen], [column_unit(units, j) for j in chosen]


def _numbered_rows(
    path: str | os.PathLike[str], file: str, sheet: str | int
) -> tuple[str, list[str], list[tuple[int, list[Any]]]]:
    """Return a sheet's title, all titles, and its rows that are not empty, numbered from 1.

    Each has its cells up to the last one that is filled, "" where they are empty.
    """
    advice = "open it in a spreadsheet program and save it again, or save the curve as CSV"
    others = ", for .xls also xlrd, for .ods odfpy"
    with extra("curves", f"to read {file}, curvewise needs pandas and openpyxl", others):
        pandas = import_module("pandas")
        _refuse_bomb(file)
        with foreign_reader(file, "workbook", advice):
            readable = transitional(file)
            book = pandas.ExcelFile(readable)
        with book:
            titles = list(book.sheet_names)
            title = _find_sheet(file, titles, sheet)
            with foreign_reader(file, "workbook", advice):
                if book.engine == "openpyxl":
                    formulas = _with_formulas(readable)
                    rows = _filled(_openpyxl_rows(book.book[title], formulas and formulas[title]))
                else:
                    frame = pandas.read_excel(book, sheet_name=title, header=None, na_filter=False)
                    rows = _filled(frame.to_numpy(dtype=object).tolist())
    if rows is None:
        raise ValueError(
            f"{file}, sheet {title!r} has more than {_MOST_ROWS:,} rows or {_MOST_CELLS:,} cells; "
            "delete those that are far from the curve, or save the curve as CSV"
        )
    return title, titles, rows


def _refuse_bomb(file: str) -> None:
    """Refuse a workbook whose parts are far larger than the file."""
    try:
        with zipfile.ZipFile(file) as parts:
            size = sum(part.file_size for part in parts.infolist())
    except zipfile.BadZipFile:  # of another kind, or damaged; its reader says so
        return
    if size > _MOST_BYTES or (size > _SMALL and size > _MOST_PACKED * os.path.getsize(file)):
        raise ValueError(
            f"{file} unpacks to {size / 2**20:,.0f} MiB, which no workbook with a curve has; save "
            "the curve as CSV"
        )


def _with_formulas(file: str | io.BytesIO) -> Any:
    """Return a workbook with its formulas from openpyxl, or None if it lacks any."""
    with zipfile.ZipFile(file) as parts:
        for name in parts.namelist():
            if name.startswith("xl/worksheets/") and name.endswith(".xml"):
                with parts.open(name) as part:
                    end = b""
                    while chunk := part.read(2**20):
                        if _FORMULA.search(end + chunk):
                            return import_module("openpyxl").load_workbook(file, read_only=True)
                        end = chunk[-16:]
    return None


def _openpyxl_rows(sheet: Any, formulas: Any) -> Iterator[list[Any]]:
    """Yield the rows of a sheet as pandas reads them, up to their last cells.

    A formula without a value, from programs that do not compute, is returned itself.
    """
    sheet.reset_dimensions()  # what the file says of its size may be wrong
    if formulas is None:
        for cells in sheet.rows:
            yield [_value(cell) for cell in cells] if cells else []
        return
    formulas.reset_dimensions()
    for pairs in map(zip, sheet.rows, formulas.rows):
        yield [
            f"={formula.value}".replace("==", "=", 1)
            if cell.value is None and formula.data_type == "f"
            else _value(cell)
            for cell, formula in pairs
        ]
    formulas.parent.close()


def _filled(rows: Iterable[list[Any]]) -> list[tuple[int, list[Any]]] | None:
    """Return rows that are not empty, with their numbers; None if they have too many cells."""
    found: list[tuple[int, list[Any]]] = []
    count = 0
    for number, row in enumerate(rows, 1):
        count += len(row) + 1
        if number > _MOST_ROWS or count > _MOST_CELLS:
            return None
        cells = [cell.strip() if isinstance(cell, str) else cell for cell in row]
        while cells and cells[-1] == "":
            cells.pop()
        if cells:
            found.append((number, cells))
    return found


def _value(cell: Any) -> Any:
    """Return what a cell holds as pandas does: "" where it is empty, nan where it is an error."""
    value = cell.value
    if value is None:
        return ""
    if cell.data_type == "e":
        return math.nan
    return int(value) if isinstance(value, float) and value.is_integer() else value


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
