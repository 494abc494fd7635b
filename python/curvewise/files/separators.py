"""The separator of the cells of a text file, and whether it is unambiguous.

The separator is the one that turns most of the first lines into numbers. Where a line may as well
be one number ("1 000,5"), or its commas decimal signs without anything to tell so ("0,05,1,25"),
nothing is guessed. Cost: linear in the lines.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence

from .._option_names import called, with_values
from .number_texts import BLANKS_IN_NUMBERS, SIGNS, is_grouped, plain, to_number

__all__ = ["BLANKS", "cells_of", "choose_separator", "refuse_doubtful_cells"]

BLANKS = None  # what str.split and numpy.loadtxt take as the separator "any run of blanks"

_BLANK_SEPARATED = re.compile(r'"([^"]*)"(?!\S)|(\S+)')
# Blanks, without a narrow or no-break one between thousands.
_BLANK = re.compile(rf"(?:(?!(?<=\d)[{BLANKS_IN_NUMBERS}]\d{{3}}(?!\d))\s)+")
_LEADING_ZERO = re.compile(r"[-+]?0\d+(?:[eEdD][-+]?\d+)?")
_GROUPS = {
    BLANKS: re.compile(r"(?<![\d.,])[1-9]\d{0,2}(?: \d{3})+(?!\d)"),
    ",": re.compile(r"(?<![\d.])[1-9]\d{0,2}(?:,\d{3})+(?=\.\d)"),
}
_GROUP_OF_ZERO = re.compile(r"(?<!\d)[1-9]\d{0,2} 0\d\d(?!\d)")
_WHOLE = re.compile(r"[-+]?\d+(?:[eEdD][-+]?\d+)?")
_DIGITS = re.compile(r"\d+(?:[eEdD][-+]?\d+)?")


def cells_of(line: str, separator: str | None) -> list[str]:
    """Return the cells of a line, without blanks around them."""
    if '"' not in line:
        if separator is BLANKS and not line.isascii():
            return [cell for cell in _BLANK.split(line) if cell]
        return [cell.strip() for cell in line.split(separator)]
    if separator is BLANKS:
        return [(quoted or word).strip() for quoted, word in _BLANK_SEPARATED.findall(line)]
    try:
        row = next(csv.reader([line], delimiter=separator, skipinitialspace=True, strict=True))
    except csv.Error:  # an open quotation mark: it stays, and makes its cell no number
        row = line.split(separator)
    return [cell.strip() for cell in row]


def choose_separator(
    lines: list[str], decimal: str | None, given: str | None
) -> tuple[str | None, float]:
    """Return what turns lines into numbers best, the first among equals, and how many it does.

    `given` is what the file itself says, as Excel's first line "sep=;" does.
    """
    there_are = [sign for sign in (";", "\t", "|", ",") if any(sign in line for line in lines)]
    if decimal == "," and not any('"' in line for line in lines) and "," in there_are:
        there_are.remove(",")
    if given is not None:
        there_are = [given]
    scores: dict[str | None, float] = {sign: _score(lines, sign, decimal) for sign in there_are}
    if given is None and scores.get("\t", 0.0) == 0.0:
        scores[BLANKS] = _score(lines, BLANKS, decimal)
    separator = max(scores, key=scores.__getitem__)
    if "," in there_are:
        grouped = _score(lines, ",", decimal, grouped=True)
        if grouped > scores[separator]:
            return ",", grouped
    return separator, scores[separator]


def _score(
    lines: list[str], separator: str | None, decimal: str | None, *, grouped: bool = False
) -> float:
    """Return how many of the lines are numbers with a given separator.

    Next to commas, spaces separate thousands only if `grouped`: cells that are separated by spaces
    may have decimal commas.
    """
    score = 0.0
    no_blanks = separator == "," and not grouped
    for cells in (cells_of(line, separator) for line in lines):
        # A line without separators does not have a decimal comma: "1,5" is two cells.
        if separator == "," or decimal == "," or len(cells) > 1 or "," not in cells[0]:
            numbers = (_is_number(c, decimal) for c in cells if not (no_blanks and " " in c))
            score += sum(numbers) / len(cells)
    return score


def _is_number(cell: str, decimal: str | None) -> bool:
    return any(to_number(cell, sign) is not None for sign in decimal or SIGNS)


def refuse_doubtful_cells(
    place: str,
    lines: Sequence[str],
    separator: str | None,
    names: Sequence[str],
    most: int,
    decimal: str | None,
    columns: Sequence[str | int] | None,
) -> None:
    """Refuse lines of numbers whose division into cells is ambiguous.

    Parameters
    ----------
    place : str
        The file, and the first of the lines.
    lines : sequence of str
        The first lines of numbers.
    separator : str or None
        The separator of their cells.
    names : sequence of str
        The names of the columns.
    most : int
        Maximum number of cells of a line; longer lines are refused elsewhere.
    decimal, columns
        As for :func:`curvewise.read_curve`.

    Raises
    ------
    ValueError
        If the cells are ambiguous, and neither a header nor the user decides.
    """
    rows = [cells_of(line, separator) for line in lines]
    counts = [sum(map(bool, row)) for row in rows]
    named = max((i for i, name in enumerate(names, 1) if name), default=0) >= max(2, *counts)
    if not 2 <= max(counts) <= most or (
        named and (separator is not BLANKS or len(set(counts)) == 1)
    ):
        return
    # A column that there would not be says that these are cells.
    last = max((int(column) for column in columns or () if str(column).isdecimal()), default=0)
    zeros = any(map(_GROUP_OF_ZERO.search, lines))
    if separator is BLANKS and (zeros or _may_be_joined(lines, counts, BLANKS, last)):
        what = "blanks of {} may stand between thousands or between cells; write numbers without "
        what += "blanks, or name the columns in the line above"
        if not zeros:
            what += f", or give {with_values('columns', [1, max(counts)])} if they are cells"
    elif (separator, decimal) == (",", None) and (
        _may_be_joined(lines, counts, ",", last)
        or (2 * last <= max(counts) + 1 and _may_be_split(rows, names))
    ):
        what = "commas of {} may separate cells or stand in numbers; say which is the decimal sign "
        what += f"({called('decimal')}), or name the columns in the line above"
    else:
        return
    raise ValueError(f"{place}: the {what.format(_shown(lines[0].strip()))}")


def _may_be_joined(
    lines: Sequence[str],
    counts: list[int],
    separator: str | None,
    last: int,
) -> bool:
    """Return whether the separator may also separate thousands: "1 000", "1,000"."""
    group = _GROUPS[separator]
    joined = [sum(map(bool, cells_of(group.sub("0", line), separator))) for line in lines]
    if sum(joined) == sum(counts):
        return False
    return last <= max(joined) and (
        len(set(counts)) > 1 or (len(set(joined)) == 1 and joined[0] < counts[0])
    )


def _may_be_split(rows: Sequence[list[str]], names: Sequence[str]) -> bool:
    """Return whether the commas between cells may be decimal signs: no cell has a point."""
    filled = [[cell for cell in row if cell] for row in rows]
    cells = [cell for row in filled for cell in row]
    if any("." in cell and to_number(cell, ",") is None for cell in cells):
        return False
    if any(map(_LEADING_ZERO.fullmatch, cells)):
        return True
    whole = all(_WHOLE.fullmatch(plain(cell).replace(".", "")) for cell in cells)
    fractions = [any(map(_DIGITS.fullmatch, row[1:])) for row in filled]
    widths = set(map(len, filled))
    odd = max(widths) > 2 or any(names) or any(map(is_grouped, cells))
    vary = len(widths) > 1 and max(widths) > 2
    return whole and odd and (all(fractions) or (vary and any(fractions)))


def _shown(line: str) -> str:
    return repr(line if len(line) <= 40 else line[:37] + "...")
