"""What the tests of the commands ask of a run: its status, its numbers, its one line of error."""

from __future__ import annotations

import re
import subprocess
import sys

MEASURES = ["area", "pcm", "frechet", "dtw", "curve_length"]
USAGE = 2
PNG = b"\x89PNG\r\n\x1a\n"


def python(*arguments, **options):
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
    return subprocess.run([sys.executable, *arguments], text=True, timeout=60, **options)


def numbers(text):
    """Return the values that a printed table gives, by name."""
    return {name: float(value) for name, value in re.findall(r"^(\w+) {2,}(\S+)$", text, re.M)}


def assert_failed(result, *parts):
    """Status 1, nothing but one line on standard error, which holds all `parts`."""
    status, _, error = result
    assert status == 1
    assert error.startswith("curvewise: ")
    assert error.count("\n") == 1
    for part in parts:
        assert part in error
