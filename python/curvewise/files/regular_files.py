"""Whether a path is that of a file that can be read whole: no device, no pipe, not too large.

A device such as /dev/zero has no end, and a pipe may never begin. Cost: one look at the path.
"""

from __future__ import annotations

import os
import stat

__all__ = ["LARGEST", "check_file"]

LARGEST = 2**32  # bytes of a file with a curve; 50 times that of a table of 10^6 points


def check_file(path: str | os.PathLike[str], largest: int = LARGEST) -> None:
    """Refuse a path that leads to a device, a pipe or a socket, or to a file that is too large.

    Raises
    ------
    ValueError
        It does.
    OSError
        It leads nowhere.
    """
    found = os.stat(path)
    if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):  # open refuses a folder
        raise ValueError(f"{os.fspath(path)} is a device or a pipe; give a regular file")
    if found.st_size > largest:
        raise ValueError(
            f"{os.fspath(path)} has {found.st_size / 2**20:,.0f} MiB, and at most "
            f"{largest // 2**20:,} MiB are read; give a part of it"
        )
