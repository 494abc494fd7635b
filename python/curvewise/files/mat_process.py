"""Reads a .mat file by scipy and writes its columns to stdout.

    python mat_process.py test.mat

It is a separate process, because scipy's reader can crash on a damaged file. It writes a line of
JSON (an error of the file, and the lengths of the columns by name), then the columns as doubles.
mat_curves.py starts it. It does not import any other module of curvewise. Cost: linear in the file,
and 0.4 s to start Python and scipy.
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

# Limits of a file's unpacked size: bytes, and a multiple of its packed size.
_MEMORY, _TIMES = 2**32, 20
_SAVE = "save it in MATLAB with save(..., '-v7')"


def main(file: str) -> None:
    """Write the columns of a file, or its error."""
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
    """Let Python raise MemoryError beyond `most` bytes, if supported."""
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
