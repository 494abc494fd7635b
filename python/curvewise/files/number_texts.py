"""Recognises numbers in texts of machines, spreadsheets and people.

A number uses one decimal sign; the other sign may separate thousands. "1.234,5" is valid with a
decimal comma alone, "1.234" with either sign. Spaces of any width and apostrophes may also separate
thousands. Typographic minus signs are accepted. A text that people would read as a number ("0,1 %",
"(5)") is distinguished from words. Time is linear in the text.
"""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np

__all__ = [
    "BLANKS_IN_NUMBERS",
    "SIGNS",
    "is_grouped",
    "is_number",
    "may_be_number",
    "plain",
    "to_number",
]

SIGNS = ".,"
# U+2212 and the dashes that replace it: hyphens, figure dash, en dash.
_MINUS = dict.fromkeys(map(ord, "\u2212\u2010\u2011\u2012\u2013\ufe63\uff0d"), "-")
# No-break, figure, thin and narrow no-break spaces: they never separate cells.
BLANKS_IN_NUMBERS = "\u00a0\u2007\u2009\u202f"
_EXPONENT = r"(?:[eEdD][-+]?\d+)?"
_GROUPED = {
    ".": re.compile(rf"[-+]?[1-9]\d{{0,2}}(?:,\d{{3}})+(?:\.\d*)?{_EXPONENT}"),
    ",": re.compile(rf"[-+]?[1-9]\d{{0,2}}(?:\.\d{{3}})+(?:,\d*)?{_EXPONENT}"),
}
_APART = re.compile(
    rf"[-+]?[1-9]\d{{0,2}}([ '\u2019{BLANKS_IN_NUMBERS}])\d{{3}}(?:\1\d{{3}})*"
    rf"(?:[.,]\d*)?{_EXPONENT}"
)
_FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d)")  # 1.5D-03
# A number with something odd around it, such as a unit, a bracket or a quotation mark.
_LIKE_A_NUMBER = re.compile(
    rf"[^\w\s]{{0,3}}\s?[-+]?\s?[\d.,][\d.,'\u2019 {BLANKS_IN_NUMBERS}]*{_EXPONENT}"
    r"\s*(?![-:/]\s*\d)\S{0,12}"
)
_NO_NUMBER = re.compile(r"\d{1,4}([-./])\d{1,2}\1\d{1,4}|\d+\.\s+[^\W\d]|\D*$")  # dates, "1. Test"
_MISSING = re.compile(r"(?i)#(?:n/a|div/0!|value!|ref!|name\?|num!|null!)|n/?a|null|none|missing")


def is_number(cell: Any) -> bool:
    """Return whether a cell is a number by one decimal sign or the other, nan and inf included."""
    return any(to_number(cell, sign) is not None for sign in SIGNS)


def may_be_number(cell: Any) -> bool:
    """Return whether a person would read a cell as a number, or as one that is missing."""
    if not isinstance(cell, str):
        return is_number(cell)
    if is_number(cell) or _MISSING.fullmatch(cell) or cell.startswith("="):  # a formula
        return True
    text = cell.translate(_MINUS)
    return _LIKE_A_NUMBER.fullmatch(text) is not None and _NO_NUMBER.match(text) is None


def is_grouped(text: str) -> bool:
    """Return whether a text is a number with blanks or apostrophes between thousands."""
    return _APART.fullmatch(text.translate(_MINUS)) is not None


def plain(text: str) -> str:
    """Return a text with the minus sign of computers, and without blanks between thousands."""
    text = text.translate(_MINUS)
    grouped = _APART.fullmatch(text)
    return text.replace(grouped[1], "") if grouped else text


def to_number(cell: Any, decimal: str) -> float | None:
    """Return a cell as a number, nan and inf included, or None if it is not one."""
    if not isinstance(cell, str):
        if isinstance(cell, bool) or not isinstance(cell, (int, float, np.number)):
            return None
        try:
            return float(cell)
        except OverflowError:  # an integer of hundreds of digits
            return math.inf
    if "_" in cell:  # float("1_000") is 1000.0: Python's syntax, not a measurement
        return None
    if not cell.isascii() or " " in cell or "'" in cell:
        cell = plain(cell)
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
