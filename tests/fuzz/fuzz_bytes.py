"""Inputs for a reader of files: bytes changed at random, or steered by libFuzzer.

A target (`fuzz_read_curve.py`, `fuzz_study.py`) has seeds, a way to change them, and a function
that raises if the reader misbehaves. With atheris (pip install atheris), libFuzzer steers by the
coverage of the reader. It ends the process at once, so that the files stay in TMPDIR. Without
atheris, or with --at-random, seeds are changed again and again.
"""

from __future__ import annotations

import argparse
import hashlib
import random
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

try:
    import atheris
except ImportError:
    atheris = None

__all__ = ["FoundError", "atheris", "changed_bytes", "run"]

Check = Callable[[bytes], None]
Change = Callable[[bytes, random.Random], bytes]
_LONGEST = 8000  # bytes


class FoundError(Exception):
    """A reader misbehaved."""


def changed_bytes(data: bytes, choices: random.Random, words: Sequence[bytes]) -> bytes:
    """Return bytes changed in some places, as fuzzers do; `words` are put in whole."""
    result = bytearray(data)
    for _ in range(choices.randint(1, 6)):
        at = choices.randint(0, len(result))
        what = choices.randint(0, 4)
        if what == 0:
            result[at:at] = choices.choice(words)
        elif what == 1:
            result[at : at + choices.randint(1, 8)] = b""
        elif what == 2:
            result[at : at + 1] = bytes([choices.randint(0, 255)])
        elif what == 3:
            begin = choices.randint(0, len(result))
            result[at:at] = result[begin : begin + choices.randint(1, 40)]
        else:
            result[at : at + 1] = choices.choice(b"0123456789.,;-+eE\"'\n\t ").to_bytes(1, "big")
    return bytes(result[:_LONGEST])


def run(description: str, make_check: Callable[[Path], Check], seeds: Path, change: Change) -> None:
    """Read the arguments of the command line and try inputs.

    Parameters
    ----------
    description : str
        Of the target, for --help.
    make_check : callable
        Returns the check, given a folder for its files, which is empty at first.
    seeds : Path
        The folder of seeds.
    change : callable
        Returns what a seed is changed to, given a generator of random numbers.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at-random", action="store_true", help="without atheris")
    parser.add_argument("--file", type=Path, help="these bytes alone")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        check = make_check(Path(folder))
        if args.file:
            check(args.file.read_bytes())
        elif atheris is None or args.at_random:
            _try_at_random(check, seeds, change, args)
        else:
            _try_steered(check, seeds, change, args)


def _try_at_random(check: Check, seeds: Path, change: Change, args: argparse.Namespace) -> None:
    choices = random.Random(args.seed)
    given = [seed.read_bytes() for seed in sorted(seeds.iterdir())]
    pool = list(given)  # drifts away from the seeds, so that every other input starts from one
    tried, end = 0, time.monotonic() + args.seconds
    while time.monotonic() < end:
        data = change(choices.choice(choices.choice((given, pool))), choices)
        tried += 1
        try:
            check(data)
        except Exception:
            name = f"crash-{hashlib.sha1(data).hexdigest()[:12]}"
            Path(name).write_bytes(data)
            print(f"the bytes are in {name}")
            raise
        if choices.random() < 0.02:
            pool[choices.randrange(len(pool))] = data
    print(f"{tried} inputs, no failure")


def _try_steered(check: Check, seeds: Path, change: Change, args: argparse.Namespace) -> None:
    def mutate(data: bytes, longest: int, seed: int) -> bytes:
        choices = random.Random(seed)
        by_libfuzzer: Any = atheris.Mutate
        if choices.random() < 0.3:
            return bytes(by_libfuzzer(data, longest))
        return change(data, choices)[:longest]

    options = [f"-max_total_time={args.seconds}", f"-seed={args.seed}", f"-max_len={_LONGEST}"]
    with tempfile.TemporaryDirectory() as found:  # new inputs go to the first folder
        folders = [found, str(seeds)]
        arguments = [sys.argv[0], *options, "-print_final_stats=1", "-timeout=20", *folders]
        atheris.Setup(arguments, check, custom_mutator=mutate)
        atheris.Fuzz()
