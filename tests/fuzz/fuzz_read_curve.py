"""Any bytes as a file of a curve: read, or refused in one line that names the file.

    python tests/fuzz/fuzz_read_curve.py --seconds 60

Every input is read twice: by numpy's parser, if the reader takes that short cut, and cell by cell,
which decides. Both must give bitwise identical numbers. Seeds are in corpus/read_curve. An error
ends the run, and writes the bytes to crash-*.
"""

from __future__ import annotations

import contextlib
import random
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
from fuzz_bytes import FoundError, atheris, changed_bytes, run

READERS = [
    "curvewise.files.csv_curves",
    "curvewise.files.column_choice",
    "curvewise.files.curve_files",
    "curvewise.files.number_tables",
]
with atheris.instrument_imports(include=READERS) if atheris else contextlib.nullcontext():
    from curvewise import read_curve
    from curvewise.files import csv_curves
    from curvewise.files.column_choice import TimeColumnWarning
    from curvewise.files.file_options import Reading

SEEDS = Path(__file__).parent / "corpus" / "read_curve"
WORDS = (b"1,5", b"-0.5e3", b"nan", b"inf", b";", b"\t", b",", b'"', b"\r\n", b"\n", b"#", b"//")
WORDS += (b"\xff\xfe", b"\xef\xbb\xbf", b"strain [%]", b"#N/A", b"1_000", b"0x10", b"1e400")
WORDS += (
    "\u0661\u0662".encode(),
    "\u2028".encode(),
    b"\x0c",
    b"\x1c",
    b"\xa0",
    b"+1.",
    b".5d0",
    b"1.000",
    b"1.000,5",
    b'"1,234"',
)
COLUMNS = (None, [1], [2, 1], ["strain", "stress"], [1, 2, 3])


def make_check(folder: Path) -> Callable[[bytes], None]:
    """Return what writes bytes to a file, reads it, and holds the two parsers together."""
    path = folder / "curve.csv"

    def check(data: bytes) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", TimeColumnWarning)
            _check(data, path)

    return check


def _check(data: bytes, path: Path) -> None:
    columns = COLUMNS[data[0] % len(COLUMNS)] if data else None
    path.write_bytes(data[1:])
    try:
        curve = read_curve(path, columns)
    except ValueError as error:
        text = str(error)
        if "\n" in text or path.name not in text:
            raise FoundError(f"a message of one line that names the file: {text!r}") from error
        return
    if curve.ndim != 2 or curve.dtype != np.float64 or not np.isfinite(curve).all():
        raise FoundError(f"{curve.shape} numbers of {curve.dtype}")
    layout = csv_curves._find_layout(str(path), csv_curves._read_lines(path), columns, Reading())
    chosen = csv_curves.choose_columns(layout.file, layout.names, layout.width, columns)
    slowly = csv_curves._parse_cell_by_cell(layout, chosen)
    if slowly.shape != curve.shape or slowly.tobytes() != curve.tobytes():
        raise FoundError(f"numpy's parser reads {curve.tolist()}, cell by cell {slowly.tolist()}")


def change(data: bytes, choices: random.Random) -> bytes:
    """Return a file changed in some places."""
    return changed_bytes(data, choices, WORDS)


if __name__ == "__main__":
    run(__doc__.splitlines()[0], make_check, SEEDS, change)
