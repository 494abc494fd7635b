"""What reads a .mat file by scipy and writes its columns to standard output.

    python mat_process.py test.mat

A process of its own, since scipy's reader can crash on a damaged file. It writes a line of JSON
(what is wrong with the file, and the lengths of the columns by name); then the columns, as doubles.
Started by mat_curves.py, and imports nothing of curvewise. Cost: linear in the file, and 0.4 s for
Python and scipy to begin.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import warnings
from collections.abc import Iterator, Mapping
from textwrap import shorten
from typing import Any

import numpy as np
from scipy.io import loadmat  # type: ignore[import-untyped]

# Bytes that a file may take unpacked: some, and so many times its own.
_MEMORY, _TIMES = 2**32, 20
_SAVE = "save it in MATLAB with save(..., '-v7')"


def main(file: str) -> None:
    """Write the columns of a file, or what is wrong with it."""
    found: dict[str, Any] = {}
    problem = ""
    warnings.simplefilter("ignore")
    try:
        found = dict(_columns(loadmat(file, appendmat=False, simplify_cells=True)))
    except NotImplementedError:
        problem = f"is a .mat file of version 7.3; {_SAVE}"
    except Exception as error:  # whatever scipy's reader comes upon
        said = shorten(str(error), 90, placeholder=" ...")
        said = f"{type(error).__name__}: {said}"
        problem = f"is damaged, or not a .mat file that scipy reads ({said}); {_SAVE}"
    lengths = {name: len(column) for name, column in found.items()}
    sys.stdout.buffer.write(json.dumps([problem, lengths]).encode() + b"\n")
    for column in found.values():
        sys.stdout.buffer.write(np.ascontiguousarray(column).tobytes())


def _limit_memory(most: int) -> None:
    """Have Python raise MemoryError beyond so many bytes, where the system can do that."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        soft, hard = resource.getrlimit(resource.RLIMIT_AS)
        if soft == resource.RLIM_INFINITY or soft > most:
            resource.setrlimit(resource.RLIMIT_AS, (most, hard))


def _columns(content: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the names and values of all columns, those of structures inside too."""
    for variable, value in content.items():
        name = prefix + variable
        if isinstance(value, Mapping):
            yield from _columns(value, f"{name}.")
        elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub" and value.size:
            if value.ndim == 1:
                yield name, value.astype(np.float64)
            elif value.ndim == 2:
                for k, column in enumerate(value.T, 1):
                    yield f"{name}(:,{k})", column.astype(np.float64)


if __name__ == "__main__":
    _limit_memory(_MEMORY + _TIMES * os.path.getsize(sys.argv[1]))
    main(sys.argv[1])
