"""What the commands say of the files that they read: columns, units, decimal signs, sheets."""

from __future__ import annotations

import argparse
import contextlib
import shlex
import sys
import warnings
from collections.abc import Iterator

from ..curves.inputs import Array
from ..files.column_choice import TimeColumnWarning
from ..files.curve_files import read_named_columns
from ..files.number_tables import Reading

__all__ = ["add_factors", "add_reading", "add_sheet", "read_file", "warnings_printed"]


def add_reading(command: argparse.ArgumentParser) -> None:
    """Add the options that all files of a command have alike."""
    command.add_argument(
        "--columns",
        nargs="+",
        metavar="COLUMN",
        help="names from the header, or numbers from 1; by default the first two",
    )
    command.add_argument(
        "--decimal",
        choices=[".", ","],
        help="the decimal sign of numbers that are text; by default told from the numbers",
    )
    command.add_argument(
        "--until",
        metavar="TEXT",
        help="a curve ends before the first row of its file that contains TEXT below the first "
        "numbers: statistics, or a second table",
    )
    command.add_argument(
        "--skip-invalid",
        action="store_true",
        help="leave out rows that are not made of numbers, and say how many",
    )


def add_factors(command: argparse.ArgumentParser, ending: str = "", of: str = "") -> None:
    """Add --factors, with an ending for one of several files."""
    command.add_argument(
        f"--factors{ending}",
        nargs="+",
        type=float,
        metavar="F",
        help=f"what the columns{of} are multiplied by, to change units: 0.01 1e-6",
    )


def add_sheet(command: argparse.ArgumentParser, ending: str = "", of: str = "") -> None:
    """Add --sheet, with an ending for one of several files."""
    command.add_argument(
        f"--sheet{ending}",
        metavar="SHEET",
        help=f"of the workbook{of}: its name, or its number from 1; by default the first",
    )


@contextlib.contextmanager
def warnings_printed() -> Iterator[None]:
    """Print what is warned of, once each, where no error says more."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", UserWarning)
        yield
    for words in dict.fromkeys(str(warning.message) for warning in said):
        print("curvewise:", words, file=sys.stderr)


def read_file(
    file: str, columns: list[str] | None, reading: Reading, factors: list[float] | None
) -> tuple[Array, list[str]]:
    """Read the columns of a file; refuse to guess them where the first of several is time."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", TimeColumnWarning)
        try:
            return read_named_columns(file, columns, reading, factors=factors)
        except TimeColumnWarning as guessed:
            wanted = shlex.join(guessed.wanted)
            raise ValueError(f"{guessed.found}; name those wanted: --columns {wanted}") from None
