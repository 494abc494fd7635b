"""Checks that a path is a regular file of acceptable size.

A device such as /dev/zero does not end. The size of a pipe, such as a shell's <(command), is
unknown. If pipes are allowed, their reader has a limit. Cost: one system call.
"""

from __future__ import annotations

import os
import stat

__all__ = ["LARGEST_OF_PIPE", "check_file"]

_LARGEST = 2**32  # bytes of a file with a curve; 50 times that of a table of 10^6 points
LARGEST_OF_PIPE = 2**28
"""Bytes that are read from a pipe."""


def check_file(
    path: str | os.PathLike[str], largest: int = _LARGEST, *, pipe: bool = False
) -> None:
    """Refuse a path that leads to a device or a socket, or to a file that is too large.

    Parameters
    ----------
    path : path-like
        The path.
    largest : int
        Size in bytes up to which a file is read.
    pipe : bool
        Allow a pipe.

    Raises
    ------
    ValueError
        It does.
    OSError
        It leads nowhere.
    """
    found = os.stat(path)
    if pipe and stat.S_ISFIFO(found.st_mode):
        return
    if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):  # open refuses a folder
        raise ValueError(f"{os.fspath(path)} is a device or a pipe; give a regular file")
    if found.st_size > largest:
        raise ValueError(
            f"{os.fspath(path)} has {found.st_size / 2**20:,.0f} MiB, and at most "
            f"{largest // 2**20:,} MiB are read; give a part of it"
        )
