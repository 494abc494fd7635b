"""Any bytes as a file of a curve: read, or refused in one line that names the file.

    python tests/fuzz/fuzz_read_curve.py --seconds 60

With atheris (pip install atheris) libFuzzer steers by the coverage of the reader; without it bytes
are changed at random. Every input is read twice: by numpy's parser where the reader takes that
short cut, and cell by cell, which decides; both must give the same numbers to the last bit. Seeds
stand in corpus/read_curve. Ends with 1, and the bytes in crash-*, where anything was wrong.
"""

from __future__ import annotations

import argparse
import hashlib
import random
import sys
import tempfile
import time
import warnings
from pathlib import Path

import numpy as np

try:
    import atheris
except ImportError:
    atheris = None

if atheris is not None:
    with atheris.instrument_imports(include=["curvewise"]):
        from curvewise import csv_curves, read_curve
else:
    from curvewise import csv_curves, read_curve

from curvewise.column_choice import TimeColumnWarning

SEEDS = Path(__file__).parent / "corpus" / "read_curve"
WORDS = (b"1,5", b"-0.5e3", b"nan", b"inf", b";", b"\t", b",", b'"', b"\r\n", b"\n", b"#", b"//")
WORDS += (b"\xff\xfe", b"\xef\xbb\xbf", b"strain [%]", b"#N/A", b"1_000", b"0x10", b"1e400")
WORDS += ("\u0661\u0662".encode(), "\u2028".encode(), b"\x0c", b"\x1c", b"\xa0", b"+1.", b".5d0")
COLUMNS = (None, [1], [2, 1], ["strain", "stress"], [1, 2, 3])


class ReadingError(Exception):
    """What was read is not what it should be."""


def check(data: bytes, path: Path) -> None:
    """Write bytes to a file, read it, and hold the two parsers against each other."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TimeColumnWarning)
        _check(data, path)


def _check(data: bytes, path: Path) -> None:
    columns = COLUMNS[data[0] % len(COLUMNS)] if data else None
    path.write_bytes(data[1:])
    try:
        curve = read_curve(path, columns)
    except ValueError as error:
        text = str(error)
        if "\n" in text or path.name not in text:
            raise ReadingError(f"a message of one line that names the file: {text!r}") from error
        return
    if curve.ndim != 2 or curve.dtype != np.float64 or not np.isfinite(curve).all():
        raise ReadingError(f"{curve.shape} numbers of {curve.dtype}")
    table = csv_curves._find_layout(str(path), csv_curves._read_lines(path))
    chosen = csv_curves.choose_columns(table.file, table.names, table.width, columns)
    slowly = csv_curves._parse_cell_by_cell(table, chosen)
    if slowly.shape != curve.shape or slowly.tobytes() != curve.tobytes():
        raise ReadingError(f"numpy's parser reads {curve.tolist()}, cell by cell {slowly.tolist()}")


def changed(data: bytes, choices: random.Random) -> bytes:
    """Return bytes changed in some places, as fuzzers do."""
    result = bytearray(data)
    for _ in range(choices.randint(1, 6)):
        at = choices.randint(0, len(result))
        what = choices.randint(0, 4)
        if what == 0:
            result[at:at] = choices.choice(WORDS)
        elif what == 1:
            result[at : at + choices.randint(1, 8)] = b""
        elif what == 2:
            result[at : at + 1] = bytes([choices.randint(0, 255)])
        elif what == 3:
            begin = choices.randint(0, len(result))
            result[at:at] = result[begin : begin + choices.randint(1, 40)]
        else:
            result[at : at + 1] = choices.choice(b"0123456789.,;-+eE\"'\n\t ").to_bytes(1, "big")
    return bytes(result[:4000])


def mutate_at_random(path: Path, seconds: float, seed: int) -> int:
    """Try so long; return how many inputs were tried."""
    choices = random.Random(seed)
    pool = [seed_file.read_bytes() for seed_file in sorted(SEEDS.iterdir())]
    tried, end = 0, time.monotonic() + seconds
    while time.monotonic() < end:
        data = changed(choices.choice(pool), choices)
        tried += 1
        try:
            check(data, path)
        except Exception:
            name = f"crash-{hashlib.sha1(data).hexdigest()[:12]}"
            Path(name).write_bytes(data)
            print(f"the bytes are in {name}")
            raise
        if choices.random() < 0.02:
            pool[choices.randrange(len(pool))] = data
    return tried


def main() -> None:
    """Run as the module's documentation says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at-random", action="store_true", help="without atheris")
    parser.add_argument("--file", type=Path, help="these bytes alone")
    args = parser.parse_args()
    folder = Path("/dev/shm") if Path("/dev/shm").is_dir() else Path()
    path = folder / f"fuzz_read_curve_{args.seed}.csv"
    if args.file:
        check(args.file.read_bytes(), path)
    elif atheris is None or args.at_random:
        print(f"{mutate_at_random(path, args.seconds, args.seed)} inputs, no failure")
    else:
        options = [f"-max_total_time={args.seconds}", f"-seed={args.seed}", "-max_len=2000"]
        with tempfile.TemporaryDirectory() as found:  # what is new goes to the first folder
            folders = [found, str(SEEDS)]
            atheris.Setup([sys.argv[0], *options, *folders], lambda data: check(data, path))
            atheris.Fuzz()


if __name__ == "__main__":
    main()
