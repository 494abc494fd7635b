"""Rows of cells as numbers, for lines of text and rows of a sheet.

number_texts.py recognises numbers. The first number with an unambiguous decimal sign decides for
the file. Time is linear in the cells, about 5 s for 10^6 points; faster parsers read unambiguous
files without this module.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from .._option_names import called
from ..curves.foreign_curves import warn
from ..curves.inputs import Array
from .column_choice import asked_names, names_in
from .file_options import Reading
from .number_texts import SIGNS, is_number, may_be_number, to_number

__all__ = [
    "NumberTable",
    "begin_of_table",
    "count_cells",
    "find_header",
    "refuse_no_numbers",
    "say_left_out",
]


@dataclass(frozen=True)
class NumberTable:
    """The place of a curve's rows, and their name in messages."""

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
    header: Sequence[Sequence[Any]] = ()
    """The rows of the header, which may be repeated among the numbers."""

    def read(self, chosen: Sequence[int]) -> Array:
        """Return the columns with the given indices; raise an error for a wrong cell.

        Raises
        ------
        ValueError
            If a cell is missing, not a number, or not finite, and such rows are not omitted. If
            there are two decimal signs, a row is too long, or no row remains.

        Warns
        -----
        UserWarning
            If rows are omitted.
        """
        decimal, groups = self._decimal(chosen)
        points: list[list[float]] = []
        wrong: list[int] = []
        empty, first_gap = [], ""
        for number, cells in self.rows():
            point, problem = [], ""
            for column in chosen:
                cell = cells[column] if column < len(cells) else ""
                value = to_number(cell, decimal)
                self._check_decimal(cell, value, decimal, groups, chosen)
                if value is None or not math.isfinite(value):
                    is_first = not points and not wrong
                    fault = _fault(cell, value, len(_filled(cells)) == 1, is_first)
                    problem = problem or f"{self._place(number, column)}: {fault}"
                else:
                    point.append(value)
            if all(column >= len(cells) or cells[column] == "" for column in chosen):
                # Below the last row of a curve may be further rows of a longer one next to it.
                empty.append(number)
                first_gap = first_gap or problem
                continue
            if first_gap and not self.reading.skip_invalid:
                raise ValueError(first_gap)
            if not problem:
                self._check_width(number, cells)
                points.append(point)
            else:
                self._check_table(number, cells)
                if not self.reading.skip_invalid:
                    raise ValueError(problem)
                wrong.append(number)
            wrong += empty
            empty = []
        if not points and not wrong:
            raise ValueError(first_gap)
        say_left_out(self.file, self.row, sorted(wrong), len(points) + len(wrong))
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

    def _check_table(self, number: int, cells: Sequence[Any]) -> None:
        """Refuse a row of names outside the header: a second table begins there."""
        filled = _filled(cells)
        words = [cell for cell in filled if isinstance(cell, str) and not may_be_number(cell)]
        if (
            len(set(words)) < 2
            or len(words) < len(filled)
            or not all(any(map(str.isalpha, word)) for word in words)
            or filled in [_filled(row) for row in self.header]
        ):
            return
        raise ValueError(
            f"{self.file}, {self.row} {number}: {_shown(', '.join(words))} seems to be the header "
            f"of a second table; begin with it ({called('from_')}), end the curve before it "
            f"({called('until')}), or name the columns of the one that is meant "
            f"({called('columns')})"
        )

    def _decimal(self, chosen: Sequence[int]) -> tuple[str, bool]:
        """Return the decimal sign, and whether the other one may separate thousands."""
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
                f"{cell.replace(',', '')}; say which is the decimal sign "
                f"({called('decimal')})"
            )
        return next(iter(doubtful)), False

    def _texts(self, columns: Sequence[int] | None) -> Iterator[tuple[int, int, str, list[str]]]:
        """Yield row, column, text, and possible decimal signs, of numbers with a decimal sign."""
        for number, cells in self.rows():
            for column in range(len(cells)) if columns is None else columns:
                cell = cells[column] if column < len(cells) else ""
                if isinstance(cell, str) and ("," in cell or "." in cell):
                    signs = [sign for sign in SIGNS if to_number(cell, sign) is not None]
                    if signs:
                        yield number, column, cell, signs

    def _check_decimal(
        self, cell: Any, value: float | None, decimal: str, groups: bool, chosen: Sequence[int]
    ) -> None:
        """Refuse a second decimal sign: "1,234" next to "0.5" may be 1234 or 1.234."""
        other = "," if decimal == "." else "."
        if groups and (value is not None or self.reading.decimal is not None):
            return
        if not isinstance(cell, str) or other not in cell or to_number(cell, other) is None:
            return
        lines = {}
        for sign in SIGNS:
            lines[sign] = next(
                (line for line, _, text, _ in self._texts(chosen) if sign in text), 0
            )
        if not all(lines.values()):  # "1.000.000" and "0.5": points mean two things
            raise ValueError(f"{self.file}: {cell!r} has another decimal sign than a number above")
        raise ValueError(
            f"{self.file}: {self.row} {lines[',']} has a number with a comma and "
            f"{self.row} {lines['.']} one with a point; use one decimal sign, or say which it is "
            f"({called('decimal')})"
        )


def say_left_out(file: str, row: str, wrong: Sequence[int], count: int) -> None:
    """Warn of omitted rows, given by their numbers, out of `count` rows."""
    if len(wrong) == count:
        raise ValueError(f"{file}: no {row} of {count} consists of finite numbers")
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


def _fault(cell: Any, value: float | None, is_alone: bool, is_first: bool) -> str:
    """Describe the fault of a cell: of the only filled one of its row, or of the first row."""
    if value is not None:
        return f"{_shown(cell)} is {value}; curves must be finite"
    fault = "the cell is missing" if cell == "" else f"{_shown(cell)} is not a number"
    if is_alone and re.search(r"[^\W\d_]{2}", str(cell)) and not may_be_number(cell):
        return (
            f"{fault}; if a second table begins here, begin with it ({called('from_')}) or end the "
            f"curve before it ({called('until')}); if not, leave the row out "
            f"({called('skip_invalid')})"
        )
    columns = f"name other columns ({called('columns')}), " if is_first else ""
    return (
        f"{fault}; correct it, {columns}end the curve before it ({called('until')}), or leave it "
        f"out ({called('skip_invalid')})"
    )


def _shown(cell: Any) -> str:
    """Return how messages write a cell, which may be long."""
    text = str(cell)
    return repr(cell if len(text) <= 40 else text[:37] + "...")


def begin_of_table(file: str, row: str, rows: Sequence[tuple[int, str]], reading: Reading) -> int:
    """Return the index of the row with which the table begins, by `from_` or `header_row`.

    Parameters
    ----------
    file, row : str
        The names of the file and of a row in messages.
    rows : sequence of tuple
        The number of each row, as a user counts, and its text.
    reading : Reading
        The options; without them the table begins with the first row.
    """
    if (text := reading.from_) is not None:
        found = next((i for i, (_, line) in enumerate(rows) if text in line), None)
        if found is None:
            raise ValueError(
                f"{file} has no {row} that contains {text!r}; give a text of the {row} with which "
                f"the table begins ({called('from_')})"
            )
        return found
    if (number := reading.header_row) is not None:
        found = next((i for i, (n, line) in enumerate(rows) if n == number and line.strip()), None)
        if found is None:
            raise ValueError(
                f"{file}: {row} {number} is empty, or below the end; give the number of the {row} "
                f"that has the names of the columns ({called('header_row')})"
            )
        return found
    return 0


def find_header(
    rows: Sequence[Sequence[Any]],
    numbers: Sequence[int],
    columns: Sequence[str | int] | None,
    reading: Reading,
) -> tuple[int, int]:
    """Return the first row of numbers, and the first row of the header above.

    Numbers begin at the first row that has any, with two exceptions. Rows that begin with a text
    and have one number, such as "Width", 12.5, describe the test if a row of names follows them.
    The first row of several numbers must then begin with a number. If a row further down has all
    requested names, the rows above it are another table. A row that may hold numbers, in all
    columns that have them, does not count as a header.

    Parameters
    ----------
    rows : sequence of sequences
        The cells; "" for empty ones.
    numbers : sequence of int
        The number of numeric cells in each row; at least one row has some.
    columns : sequence of str or int, or None
        The requested columns.
    reading : Reading
        With a `header_row` the first row has the names, whatever its content.
    """
    if reading.header_row is not None:
        first, begin = next((i for i, count in enumerate(numbers) if count and i), len(rows)), 1
    else:
        first, begin = _first_numbers(rows, numbers)
        if asked := asked_names(columns):
            begin = _begin_of_asked(rows, numbers, asked, begin, first)
            first = next(i for i in range(max(begin, first), len(rows)) if numbers[i])
    filled = [j for j, cell in enumerate(rows[first]) if is_number(cell)] if rows[first:] else []
    for i in range(begin, first):
        if filled and all(j < len(rows[i]) and may_be_number(rows[i][j]) for j in filled):
            first = i
            break
    return first, 0 if reading.header_row is not None else begin


def _begin_of_asked(
    rows: Sequence[Sequence[Any]], numbers: Sequence[int], asked: set[str], begin: int, first: int
) -> int:
    """Return the place of the header with all requested names, exact or close."""
    for to_the_letter in (True, False):
        if any(names_in(row, asked, to_the_letter) for row in rows[begin:first]):
            return begin
        for i in range(first, len(rows)):
            if not numbers[i] and names_in(rows[i], asked, to_the_letter) and any(numbers[i:]):
                return i
    return begin


def _filled(row: Sequence[Any]) -> list[Any]:
    return [cell for cell in row if cell != ""]


def _first_numbers(rows: Sequence[Sequence[Any]], numbers: Sequence[int]) -> tuple[int, int]:
    """Return where numbers begin, and the header, in what looks like a single table."""
    first = next(i for i, count in enumerate(numbers) if count)
    several = next((i for i, count in enumerate(numbers) if count > 1), first)
    described = [i for i in range(first, several) if numbers[i]]
    filled = [len(_filled(row)) for row in rows[:several]]
    names = [i for i in range(first, several) if not numbers[i] and filled[i] > 1]
    begins = next((cell for cell in rows[several] if cell != ""), "")
    if (
        names
        and names[-1] > described[-1]
        and is_number(begins)
        and not any(may_be_number(rows[i][0]) for i in described)
    ):
        return several, described[-1] + 1
    return first, 0


def refuse_no_numbers(file: str, row: str, rows: Iterable[tuple[int, Any]]) -> NoReturn:
    """Raise an error for a file without numbers; show a text that resembles one."""
    for number, text in rows:
        if any(character.isdigit() for character in str(text)):
            raise ValueError(
                f"{file}: no {row} is made of numbers; the first with a digit is {row} {number}, "
                f"{_shown(text)}"
            )
    raise ValueError(f"{file} holds no numbers; a curve is one point per {row}")
