"""A table that is known, written in many ways: its numbers are read, or there is a word.

Never are other numbers read, or fewer rows, without an error or a warning.
"""

from __future__ import annotations

import random
import warnings
from collections.abc import Callable
from pathlib import Path

import openpyxl

from curvewise import read_curve

Table = list[list[str]]

SEPARATORS = (";", "\t", ",", "|", " ", "   ")
MINUS = ("-", "-", "\u2212", "\u2013", "\u2010")
THOUSANDS = ("", "", "", ".", ",", " ", "\u00a0", "\u202f", "\u2009", "'", "\u2019")
EXPONENTS = ("", "", "", "e", "E", "D")
SIGNS = (".", ",")  # alone between thousands, as in 1.234, they are decimal signs
HEADERS = ("none", "none", "names", "units", "title", "described", "results", "sep")
ODD_CELLS = (
    "{} %",
    "{} MPa",
    "{}%",
    "({})",
    "'{}",
    "~{}",
    "{}*",
    "= {}",
    "{} kN/mm2",
    "n/a",
    "#N/A",
)
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "cp1252", "latin-1")


def numbers(chance: random.Random, least: int) -> Table:
    """Return rows of two numbers as texts with a point and at least `least` digits behind it."""
    digits = max(least, chance.choice((0, 1, 3)))
    size = chance.choice((2, 60, 3_000, 2_000_000))
    table: Table = []
    for _ in range(chance.choice((1, 2, 3, 8))):
        row = []
        for _ in range(2):
            value = (
                chance.uniform(-size, size) if chance.random() < 0.7 else chance.uniform(0, size)
            )
            row.append(
                f"{value:.{digits if chance.random() < 0.9 else least}f}".replace("-0.0", "0.0")
            )
        table.append(row)
    return table


class Dialect:
    """How numbers and tables are written."""

    def __init__(self, chance: random.Random) -> None:
        self.chance = chance
        self.separator = chance.choice(SEPARATORS)
        self.decimal = chance.choice(".,")
        self.thousands = chance.choice([t for t in THOUSANDS if t != self.decimal])
        self.minus = chance.choice(MINUS)
        self.exponent = chance.choice(EXPONENTS)
        self.header = chance.choice(HEADERS)
        self.quoted = chance.random() < 0.2
        self.odd = chance.choice(ODD_CELLS) if chance.random() < 0.25 else "{}"
        self.odd_rows = chance.choice((1, 2))

    def __repr__(self) -> str:
        return ", ".join(f"{k}={v!r}" for k, v in vars(self).items() if k != "chance")

    def number(self, text: str) -> str:
        """Write a number; the text has a point and a hyphen."""
        sign, text = (self.minus, text[1:]) if text.startswith("-") else ("", text)
        whole, _, fraction = text.partition(".")
        if self.exponent and not self.thousands:
            # The same number, to the digit: the point goes three places to the left.
            whole, fraction = whole.zfill(4)[:-3], whole.zfill(4)[-3:] + fraction
            return f"{sign}{whole}{self.decimal}{fraction}{self.exponent}+03"
        head = len(whole) % 3 or 3
        groups = [whole[:head], *(whole[i : i + 3] for i in range(head, len(whole), 3))]
        return sign + self.thousands.join(groups) + (self.decimal + fraction if fraction else "")

    def cells(self, table: Table) -> Table:
        """Write a table, with something odd about its first rows."""
        written = [[self.number(text) for text in row] for row in table]
        for row in written[: self.odd_rows]:
            row[:] = [self.odd.format(cell) for cell in row]
        return written

    def line(self, cells: list[str]) -> str:
        """Write the cells of a line."""
        inside = any(self.separator.strip() or " " in cell for cell in cells)
        quote = '"' if self.quoted and inside else ""
        return self.separator.join(f"{quote}{cell}{quote}" for cell in cells)

    def above(self) -> list[list[str]]:
        """Return the rows above the numbers."""
        names = ["strain", "stress"]
        some = [self.number("20.81"), self.number("205432")]
        return {
            "none": [],
            "names": [names],
            "units": [names, ["%", "MPa"]],
            "title": [["Test of a new sheet of steel"]],
            "described": [["Width", some[0]], ["Operator", "Smith"], [], names, ["-", "MPa"]],
            "results": [["Load", "Modulus"], some, [], names],
            "sep": [[f"sep={self.separator}"], names],
        }[self.header]

    def text(self, table: Table) -> str:
        """Return the whole file."""
        lines = [self.line(row) for row in self.above()]
        lines += [self.line(row) for row in self.cells(table)]
        if self.chance.random() < 0.1:
            lines = [line + self.separator.strip() for line in lines]
        if self.chance.random() < 0.2:
            lines.insert(self.chance.randrange(len(lines) + 1), "")
        if self.chance.random() < 0.2:
            lines.insert(self.chance.randrange(len(lines) + 1), "# pause, 1; 2")
        return self.chance.choice(("\n", "\r\n")).join([*lines, ""])


def outcome(file: Path, table: Table, columns: list[int] | None = None) -> str:
    """Return "right", "said", or the numbers that were read without a message."""
    expected = [[float(text) for text in row] for row in table]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for skip in (False, True):
            try:
                read = read_curve(file, columns, skip_invalid=skip).tolist()
            except (ValueError, UserWarning) as error:
                found = "said" if str(file) in str(error) else f"said {error}"
            else:
                if read != expected:
                    return f"read {read}, not {expected}"
                found = "right"
    return found


def sweep(count: int, write: Callable[[random.Random], tuple[Path, Table, str]]) -> float:
    """Return the share of tables that are read right; the others are refused in words."""
    right = 0
    for seed in range(count):
        file, table, content = write(random.Random(seed))
        found = outcome(file, table, [1, 2] if seed % 3 == 0 else None)
        assert found in ("right", "said"), f"seed {seed}: {found}\n{content}"
        right += found == "right"
    return right / count


def test_texts_are_read_right_or_with_a_word(tmp_path: Path, rounds) -> None:
    file = tmp_path / "table.csv"

    def write(chance: random.Random) -> tuple[Path, Table, str]:
        dialect = Dialect(chance)
        table = numbers(chance, least=1 if dialect.thousands in SIGNS else 0)
        text = dialect.text(table)
        data = text.encode(chance.choice(ENCODINGS), errors="replace")
        if b"?" in data:
            data = text.encode()
        file.write_bytes(data)
        return file, table, f"{dialect}\n{text!r}"

    assert sweep(rounds(1000), write) > 0.4


def test_sheets_are_read_right_or_with_a_word(tmp_path: Path, rounds) -> None:
    file = tmp_path / "table.xlsx"

    def write(chance: random.Random) -> tuple[Path, Table, str]:
        dialect = Dialect(chance)
        table = numbers(chance, least=1)
        as_texts = dialect.cells(table)
        share = chance.choice((0.0, 0.5, 1.0))
        rows: list[list[str | float]] = [*dialect.above()]
        for texts, row in zip(as_texts, table, strict=True):
            pairs = zip(texts, row, strict=True)
            rows.append([text if chance.random() < share else float(one) for text, one in pairs])
        book = openpyxl.Workbook()
        for row in rows:
            book.active.append(row)
        book.save(file)
        return file, table, f"{dialect}\n{rows!r}"

    assert sweep(rounds(100), write) > 0.4
