"""Curves from text files as test machines, spreadsheets and solvers write them.

A file is decoded, cut into lines, and its layout (separator, header, number of columns) is taken
from its first lines; numpy's C parser then reads the numbers. Where that refuses, cells are quoted,
or a number is not finite, the lines are read one by one in Python. That is slower, knows the line
and column to report, and decides: numpy's parser is a short cut, not a second definition.
Time and memory are linear in the size of the file, about 2 s for 10^6 points (quoted: 5 s).
"""

from __future__ import annotations

import codecs
import csv
import math
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from .column_choice import choose_columns, column_name

__all__ = ["read_csv_columns"]

# Lines of nothing but separators, which spreadsheets append, and comments. Excel's error values
# are no comments: '#N/A,200' is a bad point.
_IGNORED = re.compile(r"[\s;,]*$|\s*(?:#(?!N/A|DIV/0!|VALUE!|REF!|NAME\?|NUM!|NULL!)|%|//)")
_BLANK_SEPARATED = re.compile(r'"([^"]*)"(?!\S)|(\S+)')
_BLANKS = None  # what str.split and numpy.loadtxt take as the separator "any run of blanks"
_LAYOUT_LINES = 200


def read_csv_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None = None
) -> tuple[npt.NDArray[np.float64], list[str]]:
    r"""Read the columns of a text file, and say which they are.

    Parameters
    ----------
    path, columns
        As for :func:`curvewise.read_curve`.

    Returns
    -------
    values : ndarray, shape (n, d)
        The curve.
    names : list of str
        Of each column its name in the header; its number, from 1, where it has none.

    Raises
    ------
    ValueError, OSError
        As for :func:`curvewise.read_curve`.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.files.csv_curves import read_csv_columns
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "loop.csv")
    ...     _ = path.write_text("time,strain,stress\n0,0,0\n1,0.001,199.5\n")
    ...     read_csv_columns(path, columns=["strain", 3])[1]
    ['strain', 'stress']
    """
    table = _find_layout(os.fspath(path), _read_lines(path))
    chosen = choose_columns(table.file, table.names, table.width, columns)
    values = _parse_fast(table, chosen)
    if values is None or not np.isfinite(values).all():
        values = _parse_cell_by_cell(table, chosen)
    return values, [column_name(table.names, column) for column in chosen]


@dataclass(frozen=True)
class _Table:
    """A file's lines and how to read them."""

    file: str
    lines: list[str]
    """All lines of the file in order, without their ends; "" for those to ignore."""
    first: int
    """Index of the first line of numbers."""
    separator: str | None
    names: list[str]
    """Column names, blank or missing where the header has none."""
    width: int
    """Number of columns."""
    most: int
    """Cells that a line may have: those of the header or of the first line of numbers. One more,
    further down, may come of a decimal comma."""

    def place(self, line: int, column: int) -> str:
        """Name a cell, given by indices, as a user counts."""
        name = self.names[column] if column < len(self.names) else ""
        return f"{self.file}, line {line + 1}, column {column + 1}{f' ({name})' if name else ''}"


def _read_lines(path: str | os.PathLike[str]) -> list[str]:
    text = _decode(Path(path).read_bytes())
    if "\0" in text:
        raise ValueError(f"{os.fspath(path)} is not a text file; save the curve as CSV")
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    return ["" if _IGNORED.match(line) else line for line in lines]


def _decode(data: bytes) -> str:
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _find_layout(file: str, lines: list[str]) -> _Table:
    """Choose the separator, and tell header from numbers, by the first lines of a file."""
    sample = [i for i, line in enumerate(lines) if line][:_LAYOUT_LINES]
    there_are = [sign for sign in (";", "\t", ",") if any(sign in lines[i] for i in sample)]
    scores: dict[str | None, float] = {sign: _score(lines, sample, sign) for sign in there_are}
    if scores.get("\t", 0.0) == 0.0:
        scores[_BLANKS] = _score(lines, sample, _BLANKS)
    separator = max(scores, key=scores.__getitem__)  # the first among equal scores
    if scores[separator] == 0.0:
        raise ValueError(f"{file} holds no numbers; a curve is one point per line")

    rows = [_cells(lines[i], separator) for i in sample]
    headers = 0
    while any(rows[headers]) and _numeric_fraction(rows[headers], separator) == 0.0:
        headers += 1
    names = max(rows[:headers], key=lambda row: sum(map(bool, row)), default=[])
    width = max(len(row) for row in rows[headers:])
    if separator is _BLANKS and len(names) != width:
        names = []  # "true strain  true stress": nobody can say which word belongs where
    most = max(len(rows[headers]), len(names))
    width = max(width, len(names))
    if width == 1:
        separator = ","  # no blank, tab or semicolon is expected, and none is then accepted
    return _Table(file, lines, sample[headers], separator, names, width, most)


def _score(lines: list[str], sample: list[int], separator: str | None) -> float:
    """Return how many of the lines are numbers, if they are separated so."""
    rows = [_cells(lines[i], separator) for i in sample]
    # What is not separated at all has no decimal comma: "1,5" is two cells, and "1," one of two.
    return sum(_numeric_fraction(row, separator if len(row) > 1 else ",") for row in rows)


def _numeric_fraction(cells: list[str], separator: str | None) -> float:
    return sum(_to_number(cell, separator) is not None for cell in cells) / len(cells)


def _cells(line: str, separator: str | None) -> list[str]:
    if '"' not in line:
        return [cell.strip() for cell in line.split(separator)]
    if separator is _BLANKS:
        return [(quoted or plain).strip() for quoted, plain in _BLANK_SEPARATED.findall(line)]
    try:
        row = next(csv.reader([line], delimiter=separator, skipinitialspace=True, strict=True))
    except csv.Error:  # an open quotation mark: it stays, and makes its cell no number
        row = line.split(separator)
    return [cell.strip() for cell in row]


def _count_cells(line: str, separator: str | None) -> int:
    """Return how many cells a line has, without empty ones at its end."""
    cells = _cells(line, separator)
    while cells and not cells[-1]:
        cells.pop()
    return len(cells)


def _to_number(cell: str, separator: str | None) -> float | None:
    """Return the cell as a number, nan and inf included, or None if it is not one."""
    if "_" in cell:  # float("1_000") is 1000.0: Python's syntax, not a measurement
        return None
    try:
        return float(cell if separator == "," else cell.replace(",", "."))
    except ValueError:
        return None


def _parse_fast(table: _Table, chosen: list[int]) -> npt.NDArray[np.float64] | None:
    """Return the numbers by numpy's parser, or None where it takes a closer look."""
    lines = table.lines[table.first :]
    if any('"' in line for line in lines):
        return None
    if table.separator != "," and any("," in line for line in lines):
        if any("." in line for line in lines):
            return None  # both decimal signs, or a date or text beside the numbers
        lines = [line.replace(",", ".") for line in lines]
    # Without usecols numpy insists that all lines have as many cells as the first.
    values = _loaded(lines, table.separator, None)
    if values is not None:
        return values[:, chosen] if values.shape[1] == table.width else None
    if table.width == 1 or any(_count_cells(line, table.separator) > table.most for line in lines):
        return None
    return _loaded(lines, table.separator, chosen)


def _loaded(
    lines: list[str], separator: str | None, columns: list[int] | None
) -> npt.NDArray[np.float64] | None:
    try:
        return np.loadtxt(
            lines,
            delimiter=separator,
            usecols=columns,
            comments=None,
            encoding=None,  # text as it is; numpy 1 would take it for bytes
            ndmin=2,
        )
    except ValueError:
        return None


def _parse_cell_by_cell(table: _Table, chosen: list[int]) -> npt.NDArray[np.float64]:
    """Return the numbers, or say which cell is wrong and why."""
    points: list[list[float]] = []
    decimal_signs: dict[str, int] = {}  # sign -> index of the first line with it
    for line in range(table.first, len(table.lines)):
        if not table.lines[line]:
            continue
        cells = _cells(table.lines[line], table.separator)
        if table.width == 1 and len(cells) > 1:
            raise ValueError(
                f"{table.file}, line {line + 1} has {len(cells)} columns; the first lines have 1"
            )
        points.append([_finite_number(table, line, column, cells) for column in chosen])
        count = _count_cells(table.lines[line], table.separator)
        if count > table.most:
            raise ValueError(
                f"{table.file}, line {line + 1} has {count} cells, and {table.most} are expected "
                "by the lines above; is a comma in it a decimal sign?"
            )
        if table.separator != ",":
            _check_decimal_sign(table, line, [cells[column] for column in chosen], decimal_signs)
    return np.array(points)


def _finite_number(table: _Table, line: int, column: int, cells: list[str]) -> float:
    if column >= len(cells) or not cells[column]:
        raise ValueError(f"{table.place(line, column)}: the cell is missing")
    cell = cells[column]
    shown = repr(cell if len(cell) <= 40 else cell[:37] + "...")
    number = _to_number(cell, table.separator)
    if number is None:
        raise ValueError(f"{table.place(line, column)}: {shown} is not a number")
    if not math.isfinite(number):
        raise ValueError(f"{table.place(line, column)}: {shown} is {number}; curves must be finite")
    return number


def _check_decimal_sign(
    table: _Table, line: int, cells: list[str], first_lines: dict[str, int]
) -> None:
    """Refuse a second decimal sign: "1,234" beside "0.5" may be 1234 or 1.234."""
    for cell in cells:
        for sign in ",.":
            if sign in cell:
                first_lines.setdefault(sign, line)
    if len(first_lines) == 2:
        raise ValueError(
            f"{table.file}: line {first_lines[','] + 1} has a number with a comma and "
            f"line {first_lines['.'] + 1} one with a point; use one decimal sign"
        )
