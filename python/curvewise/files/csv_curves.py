"""Curves from text files as test machines, spreadsheets and solvers write them.

A file is decoded, cut into lines, and its layout (separator, header, number of columns) is taken
from its first lines; numpy's C parser then reads the numbers. Where that refuses, cells are quoted,
a sign may group thousands, or a number is not finite, the lines are read one by one in Python
(number_tables.py). That is slower, knows the line and column to report, and decides: numpy's parser
is a short cut, not a second definition.
Time and memory are linear in the size of the file, about 2 s for 10^6 points (quoted: 5 s).
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np
import numpy.typing as npt

from .column_choice import choose_columns, choose_names, column_name, column_unit
from .column_units import units_row
from .encodings import UTF_16, decoded
from .file_options import Reading
from .number_tables import (
    NumberTable,
    begin_of_table,
    count_cells,
    find_header,
    refuse_no_numbers,
)
from .number_texts import is_number
from .regular_files import LARGEST_OF_PIPE
from .separators import BLANKS, cells_of, choose_separator, refuse_doubtful_cells

__all__ = ["read_csv_columns"]

# Comments, and lines of separators alone, which spreadsheets append. Excel's error values are not
# comments: '#N/A,200' is an invalid point.
_IGNORED = re.compile(r"[\s;,]*$|\s*(?:#(?!N/A|DIV/0!|VALUE!|REF!|NAME\?|NUM!|NULL!)|%|//)")
_COMMENT = re.compile(r"\s*(?:#+|%+|//)\s*")
_SEPARATOR = re.compile(r'\s*"?sep=([^\w\s]|\t)"?[\s;,|]*$')  # as Excel writes and reads it
_LAYOUT_LINES = 200
_HEAD = 2**16  # bytes in which a binary file has a zero byte, which ends the reading
_LONGEST = 2**20  # characters of a line


def read_csv_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None, reading: Reading
) -> tuple[npt.NDArray[np.float64], list[str], list[str]]:
    r"""Read the columns of a text file with their names and units.

    Parameters
    ----------
    path, columns
        As for :func:`curvewise.read_curve`.
    reading : Reading
        The other keywords of :func:`curvewise.read_curve`.

    Returns
    -------
    values : ndarray, shape (n, d)
        The curve.
    names : list of str
        The name of each column in the header; its number, from 1, if it lacks one.
    units : list of str
        The unit of each column from a row of units; "" if it lacks one.

    Raises
    ------
    ValueError, OSError
        As for :func:`curvewise.read_curve`.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.files.csv_curves import read_csv_columns
    >>> from curvewise.files.file_options import Reading
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "loop.csv")
    ...     _ = path.write_text("time,strain,stress\n0,0,0\n1,0.001,199.5\n")
    ...     read_csv_columns(path, ["strain", 3], Reading())[1]
    ['strain', 'stress']
    """
    lines = _read_lines(path, reading.encoding)
    table = _find_layout(os.fspath(path), lines, columns, reading)
    chosen = choose_columns(table.file, table.names, table.width, columns, table.units)
    values = _parse_fast(table, chosen)
    if values is None or not np.isfinite(values).all():
        values = _parse_cell_by_cell(table, chosen)
    names = [column_name(table.names, column) for column in chosen]
    return values, names, [column_unit(table.units, column) for column in chosen]


@dataclass(frozen=True)
class _Layout:
    """A file's lines and how to read them."""

    file: str
    lines: list[str]
    """The lines of the file in order, without their ends; "" for those to ignore."""
    first: int
    """Index of the first line of numbers."""
    separator: str | None
    names: list[str]
    """Column names, blank or missing where the header has none."""
    width: int
    """Number of columns."""
    most: int
    """Cells that a line may have: those of the header, or else of the first line of numbers."""
    header: list[list[str]]
    """The lines above the first one of numbers."""
    units: list[str]
    """What a row of units has, blank or missing where it has none."""
    reading: Reading

    def rows(self) -> Iterator[tuple[int, list[str]]]:
        """Yield the lines of numbers as cells, with their numbers from 1."""
        for line in range(self.first, len(self.lines)):
            if self.lines[line]:
                yield line + 1, cells_of(self.lines[line], self.separator)


def _rest_of(stream: BinaryIO, file: str) -> bytes:
    """Return the rest of a file, or of a pipe up to a limit."""
    if stream.seekable():
        return stream.read()
    rest = stream.read(LARGEST_OF_PIPE + 1)
    if len(rest) > LARGEST_OF_PIPE:
        raise ValueError(
            f"{file} is a pipe, and at most {LARGEST_OF_PIPE // 2**20} MiB are read; write it "
            "to a file"
        )
    return rest


def _read_lines(path: str | os.PathLike[str], encoding: str | None = None) -> list[str]:
    file = os.fspath(path)
    try:
        with Path(path).open("rb") as stream:
            data = stream.read(_HEAD)
            if encoding or data.startswith(UTF_16) or b"\0" not in data:
                data += _rest_of(stream, file)
    except OSError as error:  # one of reading does not name the file, as one of opening does
        error.filename = error.filename or file
        raise
    try:
        text = data.decode(encoding).removeprefix("\ufeff") if encoding else decoded(data)
    except UnicodeDecodeError as error:
        raise ValueError(f"{file} is not text in the encoding {encoding!r}: {error}") from None
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if "\0" in text:
        line = next(i for i, line in enumerate(lines, 1) if "\0" in line)
        raise ValueError(
            f"{file} is damaged, or not a text file: line {line} has a zero byte; save the curve "
            "as CSV"
        )
    if len(text) > _LONGEST and max(map(len, lines)) > _LONGEST:
        line = next(i for i, line in enumerate(lines, 1) if len(line) > _LONGEST)
        raise ValueError(
            f"{file}: line {line} has {len(lines[line - 1]):,} characters, and at most "
            f"{_LONGEST:,} are read; write one point per line"
        )
    return lines


def _find_layout(
    file: str, text: list[str], columns: Sequence[str | int] | None, reading: Reading
) -> _Layout:
    """Choose the separator, and tell header from numbers, by the first lines of a file."""
    lines = ["" if _IGNORED.match(line) else line for line in text]
    filled = [i for i, line in enumerate(lines) if line]
    given = _SEPARATOR.match(lines[filled[0]]) if filled else None
    if given:
        lines[filled.pop(0)] = ""
    start = begin_of_table(file, "line", list(enumerate(text, 1)), reading)
    if start or reading.begins_later:
        lines[:start] = [""] * start
        if reading.header_row is not None:  # the names may be in a comment
            lines[start] = _COMMENT.sub("", text[start])
        filled = [i for i in range(start, len(lines)) if lines[i]]
    count, separator, score = _LAYOUT_LINES, BLANKS, 0.0
    while score == 0.0:  # for a long header, read more lines
        if count >= 2 * max(len(filled), _LAYOUT_LINES):
            refuse_no_numbers(file, "line", enumerate(text[start:], start + 1))
        sample = filled[:count]
        separator, score = choose_separator(
            [lines[i] for i in sample], reading.decimal, given[1] if given else None
        )
        count *= 2

    rows = [cells_of(lines[i], separator) for i in sample]
    first, begin = find_header(rows, [sum(map(is_number, row)) for row in rows], columns, reading)
    if first == len(rows):
        refuse_no_numbers(file, "line", ((i + 1, text[i]) for i in sample[1:]))
    if (until := reading.until) is not None:
        below = range(sample[first] + 1, len(text))
        lines = lines[: next((i for i in below if until in text[i]), None)]
        rows = [row for i, row in zip(sample, rows, strict=True) if i < len(lines)]
    header = rows[begin:first]
    names = choose_names(header[:1] if reading.header_row else header, columns)
    width = max(map(len, rows[first:]))
    if separator is BLANKS and len(names) != width:
        names = []  # "true strain true stress": the assignment of words to columns is ambiguous
    is_title = sum(map(bool, names)) < 2
    most = max(len(names), len(rows[first]) if is_title else 0)
    width = max(width, len(names))
    if width == 1:
        # Spaces, tabs and semicolons are not expected, and not accepted.
        separator = ";" if reading.decimal == "," else ","
    place = f"{file}, line {sample[first] + 1}"
    numbers = [lines[i] for i in sample[first:] if i < len(lines)]
    refuse_doubtful_cells(place, numbers, separator, names, most, reading.decimal, columns)
    above = text[sample[begin] if begin else start : sample[first]]  # "%;MPa" is not a comment here
    kept = [line for line in above if line.lstrip().startswith("%") or not _IGNORED.match(line)]
    units = units_row([cells_of(line, separator) for line in kept], names)
    return _Layout(
        file, lines, sample[first], separator, names, width, most, header, units, reading
    )


def _parse_fast(table: _Layout, chosen: list[int]) -> npt.NDArray[np.float64] | None:
    """Return the numbers by numpy's parser, or None where it takes a closer look."""
    lines = table.lines[table.first :]
    if any('"' in line for line in lines):
        return None
    if table.separator is BLANKS and not all(map(str.isascii, lines)):
        return None  # numpy separates by blanks of any kind
    has_commas = table.separator != "," and any("," in line for line in lines)
    if has_commas or table.reading.decimal == ",":
        if table.reading.decimal == "." or any("." in line for line in lines):
            return None  # both signs: one groups thousands, or belongs to a date or a text
        lines = [line.replace(",", ".") for line in lines]
    # Without usecols numpy insists that all lines have as many cells as the first.
    values = _loaded(lines, table.separator, None)
    if values is not None and values.shape[1] <= table.most:
        return values[:, chosen] if values.shape[1] == table.width else None
    if any(count_cells(cells) > table.most for _, cells in table.rows()):
        return None
    return _loaded(lines, table.separator, chosen)


def _parse_cell_by_cell(table: _Layout, chosen: list[int]) -> npt.NDArray[np.float64]:
    """Return the numbers, or say which cell is wrong and why."""
    return NumberTable(
        table.file,
        "line",
        table.names,
        table.rows,
        table.reading,
        comma_separates=table.separator == ",",
        most=table.most,
        header=table.header,
    ).read(chosen)


def _loaded(
    lines: list[str], separator: str | None, columns: list[int] | None
) -> npt.NDArray[np.float64] | None:
    try:
        return np.loadtxt(
            lines,
            delimiter=separator,
            usecols=columns,
            comments=None,
            encoding=None,  # raw text; numpy 1 would read bytes
            ndmin=2,
        )
    except ValueError:
        return None
