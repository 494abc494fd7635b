"""The options for reading a file and preparing its test, each declared once.

`curvewise.read_curve` and `curvewise.fitting.prepare` have them as keywords, the commands as
``--options``, and a study as keys of a test. One row of `READING` or `PREPARATION` holds the name,
values and effect of an option. Commands and studies are made from these rows.
"""

from __future__ import annotations

import codecs
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, TypeAlias

from .._option_names import called
from .number_texts import SIGNS

__all__ = ["CYCLE_COLUMN", "PREPARATION", "READING", "FileOption", "Kind", "Reading"]

Kind: TypeAlias = Literal[
    "text", "name", "names", "row", "flag", "sign", "factors", "size", "stresses"
]


class FileOption(NamedTuple):
    """An option of a file.

    Attributes
    ----------
    name : str
        The keyword in Python; ``from_`` is ``from`` elsewhere.
    kind : str
        The kind of its values. Texts: a text, a decimal sign. Columns and rows: one or several
        column names or numbers from 1, a row number. Numbers: numbers or units, a number above 0,
        two stresses or None. Also a flag.
    help : str
        The help text of the command line.
    metavar : str
        The name of its value in help texts.
    """

    name: str
    kind: Kind
    help: str
    metavar: str = ""

    @property
    def word(self) -> str:
        """Its name in a study."""
        return self.name.rstrip("_")

    @property
    def flag(self) -> str:
        """Its name on the command line."""
        return f"--{self.word.replace('_', '-')}"


READING = (
    FileOption("sheet", "name", "name of the sheet, or its number from 1 (default: 1)", "SHEET"),
    FileOption(
        "from_",
        "text",
        "begin at the first row that contains TEXT: the title or the names of the second table",
        "TEXT",
    ),
    FileOption(
        "header_row", "row", "take the names of the columns from row N of the file, from 1", "N"
    ),
    FileOption(
        "until",
        "text",
        "end before the first row that contains TEXT below the first numbers: statistics, or the "
        "next table",
        "TEXT",
    ),
    FileOption("skip_invalid", "flag", "leave out rows that are not numbers, and say how many"),
    FileOption("decimal", "sign", "decimal sign of numbers that are text (default: read off them)"),
    FileOption(
        "encoding",
        "text",
        "encoding of a text file, such as gbk or cp1251 (default: read off its bytes)",
        "NAME",
    ),
)

PREPARATION = (
    FileOption(
        "area",
        "size",
        "divide the force by this cross section, in mm² if the column names a unit of force",
        "A",
    ),
    FileOption(
        "gauge_length",
        "size",
        "divide the extension by this length, in mm if the column names a unit of length",
        "L",
    ),
    FileOption(
        "zero", "flag", "make the first point the origin, if strain or stress was not zeroed"
    ),
    FileOption(
        "toe",
        "stresses",
        "cut the toe: the straight part, between two stresses (default: read off the test), goes "
        "through the origin",
        "STRESS",
    ),
    FileOption("true", "flag", "turn engineering strain and stress into true ones"),
)
CYCLE_COLUMN = FileOption(
    "cycle_column",
    "name",
    "column with the number of the cycle, of a record that leaves out cycles: the material runs "
    "through these",
    "COLUMN",
)


@dataclass(frozen=True)
class Reading:
    """Options for reading a file, except its columns."""

    sheet: str | int | None = None
    from_: str | None = None
    header_row: int | None = None
    until: str | None = None
    skip_invalid: bool = False
    decimal: str | None = None
    encoding: str | None = None

    def __post_init__(self) -> None:
        if self.decimal not in (None, *SIGNS):
            raise ValueError(f"{called('decimal')} is {self.decimal!r}; choose from '.' and ','")
        if self.until == "":
            raise ValueError(
                f"{called('until')} is empty; give a text of the row before which the curve ends"
            )
        if self.from_ == "":
            raise ValueError(
                f"{called('from_')} is empty; give a text of the row with which the table begins"
            )
        if self.header_row is not None and self.header_row < 1:
            raise ValueError(
                f"{called('header_row')} is {self.header_row}; rows are numbered from 1"
            )
        if self.from_ is not None and self.header_row is not None:
            raise ValueError(
                f"{called('from_')} is {self.from_!r} and {called('header_row')} is "
                f"{self.header_row}; give one of them"
            )
        if self.encoding is not None:
            _check_encoding(self.encoding)

    @property
    def begins_later(self) -> str:
        """The option that says where the table begins, with its value, or ""."""
        if self.from_ is not None:
            return f"{called('from_')} is {self.from_!r}"
        return "" if self.header_row is None else f"{called('header_row')} is {self.header_row}"


def _check_encoding(name: Any) -> None:
    """Raise an error if a name is not that of a text encoding."""
    try:
        codecs.lookup(name)
        "".encode(name)
    except (LookupError, TypeError, ValueError):
        raise ValueError(
            f"{called('encoding')} is {name!r}, which Python does not know; give one such as 'gbk' "
            "or 'cp1251'"
        ) from None
