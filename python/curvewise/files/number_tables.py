"""Rows of cells as numbers, whether they are lines of text or rows of a sheet.

A text is a number by one decimal sign or by the other, with the other one between thousands or
without: "1.234,5" by a comma alone, "1.234" by either. The first number read that leaves no doubt
decides for the file. Time is linear in the cells, some 5 s for 10^6 points; what is not in doubt is
read by faster parsers before it comes here.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from ..curves.foreign_curves import warn
from ..curves.inputs import Array

__all__ = [
    "NumberTable",
    "Reading",
    "count_cells",
    "find_header",
    "is_number",
    "refuse_no_numbers",
    "say_left_out",
]

_SIGNS = ".,"
_EXPONENT = r"(?:[eEdD][-+]?\d+)?"
_GROUPED = {
    ".": re.compile(rf"[-+]?[1-9]\d{{0,2}}(?:,\d{{3}})+(?:\.\d*)?{_EXPONENT}"),
    ",": re.compile(rf"[-+]?[1-9]\d{{0,2}}(?:\.\d{{3}})+(?:,\d*)?{_EXPONENT}"),
}
_FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d)")  # 1.5D-03


@dataclass(frozen=True)
class Reading:
    """How a file is read, besides its columns; the keywords of :func:`curvewise.read_curve`."""

    sheet: str | int | None = None
    decimal: str | None = None
    until: str | None = None
    skip_invalid: bool = False

    def __post_init__(self) -> None:
        if self.decimal not in (None, *_SIGNS):
            raise ValueError(f"decimal is {self.decimal!r}; choose from '.' and ','")
        if self.until == "":
            raise ValueError("until is empty; give a text of the row before which the curve ends")


@dataclass(frozen=True)
class NumberTable:
    """Where the rows of a curve are, and how messages call them."""

    file: str
    """With the sheet, of a workbook."""
    row: str
    """What a row is called: "line", or "row"."""
    names: list[str]
    """Of the columns, blank or missing where the header has none."""
    rows: Callable[[], Iterable[tuple[int, Sequence[Any]]]]
    """Yields the rows from the first with numbers on, each with its number as a user counts."""
    reading: Reading
    comma_separates: bool = False
    most: int | None = None
    """Cells that a row may have, if that is known. One more may come of a decimal comma."""

    def read(self, chosen: Sequence[int]) -> Array:
        """Return the columns, given by index; or say which cell is wrong, and why.

        Raises
        ------
        ValueError
            A cell is missing, not a number, or not finite, and such rows are not to be left out;
            there are two decimal signs; a row is too long; no row is left.

        Warns
        -----
        UserWarning
            Rows are left out.
        """
        decimal, groups = self._decimal(chosen)
        points, wrong = [], []
        for number, cells in self.rows():
            point, problem = [], ""
            for column in chosen:
                cell = cells[column] if column < len(cells) else ""
                value = _to_number(cell, decimal)
                self._check_decimal(cell, value, decimal, groups, chosen)
                if value is None or not math.isfinite(value):
                    problem = problem or f"{self._place(number, column)}: {_fault(cell, value)}"
                else:
                    point.append(value)
            if not problem:
                self._check_width(number, cells)
                points.append(point)
            elif self.reading.skip_invalid:
                wrong.append(number)
            else:
                raise ValueError(problem)
        say_left_out(self.file, self.row, wrong, len(points) + len(wrong))
        return np.array(points)

    def _place(self, number: int, column: int) -> str:
        name = self.names[column] if column < len(self.names) else ""
        return f"{self.file}, {self.row} {number}, column {column + 1}{name and f' ({name})'}"

    def _check_width(self, number: int, cells: Sequence[Any]) -> None:
        count = count_cells(cells)
        if self.most is not None and count > self.most:
            were = "is" if self.most == 1 else "are"
            raise ValueError(
                f"{self.file}, {self.row} {number} has {count} cells, and {self.most} {were} "
                "expected by the lines above; if its commas are decimal signs, separate cells by "
                "semicolons, and begin lines above that are no header with #"
            )

    def _decimal(self, chosen: Sequence[int]) -> tuple[str, bool]:
        """Return the decimal sign, and whether the other one may stand between thousands alone."""
        if self.reading.decimal is not None:
            return self.reading.decimal, True
        doubtful: dict[str, tuple[int, int, str]] = {}
        for number, column, cell, signs in self._texts(chosen):
            if len(signs) == 1:
                return signs[0], signs[0] == ","
            doubtful.setdefault("," if "," in cell else ".", (number, column, cell))
        if doubtful.keys() == {"."}:  # 1 or 1000: what do the columns say that are not read?
            found = next((signs for *_, signs in self._texts(None) if len(signs) == 1), ["."])
            return found[0], found[0] == ","
        if not doubtful:
            return ".", False
        if self.comma_separates and "," in doubtful:
            number, column, cell = doubtful[","]
            raise ValueError(
                f"{self._place(number, column)}: {cell!r} may be {cell.replace(',', '.')} or "
                f"{cell.replace(',', '')}; say which is the decimal sign (decimal)"
            )
        return next(iter(doubtful)), False

    def _texts(self, columns: Sequence[int] | None) -> Iterator[tuple[int, int, str, list[str]]]:
        """Yield row, column, text, and possible decimal signs, of numbers with a decimal sign."""
        for number, cells in self.rows():
            for column in range(len(cells)) if columns is None else columns:
                cell = cells[column] if column < len(cells) else ""
                if isinstance(cell, str) and ("," in cell or "." in cell):
                    signs = [sign for sign in _SIGNS if _to_number(cell, sign) is not None]
                    if signs:
                        yield number, column, cell, signs

    def _check_decimal(
        self, cell: Any, value: float | None, decimal: str, groups: bool, chosen: Sequence[int]
    ) -> None:
        """Refuse a second decimal sign: "1,234" beside "0.5" may be 1234 or 1.234."""
        other = "," if decimal == "." else "."
        if groups and (value is not None or self.reading.decimal is not None):
            return
        if not isinstance(cell, str) or other not in cell or _to_number(cell, other) is None:
            return
        lines = {}
        for sign in _SIGNS:
            lines[sign] = next(
                (line for line, _, text, _ in self._texts(chosen) if sign in text), 0
            )
        if not all(lines.values()):  # "1.000.000" and "0.5": points mean two things
            raise ValueError(f"{self.file}: {cell!r} has another decimal sign than a number above")
        raise ValueError(
            f"{self.file}: {self.row} {lines[',']} has a number with a comma and "
            f"{self.row} {lines['.']} one with a point; use one decimal sign, or say which it is "
            "(decimal)"
        )


def say_left_out(file: str, row: str, wrong: Sequence[int], count: int) -> None:
    """Warn of rows, given by their numbers, that are left out of so many, or of all."""
    if len(wrong) == count:
        raise ValueError(f"{file}: none of {count} {row}s is made of finite numbers")
    if wrong:
        warn(
            f"{file}: {len(wrong)} of {count} {row}s left out, not made of finite numbers; the "
            f"first is {row} {wrong[0]}"
        )


def count_cells(cells: Sequence[Any]) -> int:
    """Return how many cells a row has, without empty ones at its end."""
    count = len(cells)
    while count and cells[count - 1] == "":
        count -= 1
    return count


def is_number(cell: Any) -> bool:
    """Say whether a cell is a number by one decimal sign or the other, nan and inf included."""
    return any(_to_number(cell, sign) is not None for sign in _SIGNS)


def _to_number(cell: Any, decimal: str) -> float | None:
    """Return a cell as a number, nan and inf included, or None if it is not one."""
    if not isinstance(cell, str):
        if isinstance(cell, bool) or not isinstance(cell, (int, float, np.number)):
            return None
        try:
            return float(cell)
        except OverflowError:  # a whole number of hundreds of digits
            return math.inf
    if "_" in cell:  # float("1_000") is 1000.0: Python's syntax, not a measurement
        return None
    other = "," if decimal == "." else "."
    if other in cell:
        if not _GROUPED[decimal].fullmatch(cell):
            return None
        cell = cell.replace(other, "")
    cell = cell.replace(",", ".")
    try:
        return float(cell)
    except ValueError:
        pass
    try:
        return float(_FORTRAN.sub("e", cell))
    except ValueError:
        return None


def _fault(cell: Any, value: float | None) -> str:
    """Say what is wrong with a cell."""
    if value is not None:
        return f"{_shown(cell)} is {value}; curves must be finite"
    fault = "the cell is missing" if cell == "" else f"{_shown(cell)} is not a number"
    return f"{fault}; correct it, end the curve before it (until), or leave it out (skip_invalid)"


def _shown(cell: Any) -> str:
    """Return how messages write a cell, which may be long."""
    text = str(cell)
    return repr(cell if len(text) <= 40 else text[:37] + "...")


def find_header(rows: Sequence[Sequence[Any]], numbers: Sequence[int]) -> tuple[int, int]:
    """Return where the rows of numbers begin, and where the header above them does.

    Numbers begin at the first row that has any, except where a header stands below "Width", 12.5:
    rows that begin with a text and have one number, with a row of names between them and the first
    row of several numbers, which begins with one, describe the test.

    Parameters
    ----------
    rows : sequence of sequences
        Cells, "" where they are empty.
    numbers : sequence of int
        How many cells of each row are numbers; one row has some.
    """
    first = next(i for i, count in enumerate(numbers) if count)
    several = next((i for i, count in enumerate(numbers) if count > 1), first)
    described = [i for i in range(first, several) if numbers[i]]
    filled = [sum(cell != "" for cell in row) for row in rows[:several]]
    names = [i for i in range(first, several) if not numbers[i] and filled[i] > 1]
    begins = next((cell for cell in rows[several] if cell != ""), "")
    if (
        names
        and names[-1] > described[-1]
        and is_number(begins)
        and not any(is_number(rows[i][0]) for i in described)
    ):
        return several, described[-1] + 1
    return first, 0


def refuse_no_numbers(file: str, row: str, rows: Iterable[tuple[int, Any]]) -> NoReturn:
    """Say that a file has no numbers, or what looks like one and is none."""
    for number, text in rows:
        if any(character.isdigit() for character in str(text)):
            raise ValueError(
                f"{file}: no {row} is made of numbers; the first with a digit is {row} {number}, "
                f"{_shown(text)}"
            )
    raise ValueError(f"{file} holds no numbers; a curve is one point per {row}")
