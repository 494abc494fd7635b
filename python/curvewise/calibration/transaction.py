"""What is written to a store: all of it or nothing, and an error that says so."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["writing"]


@contextmanager
def writing(database: sqlite3.Connection, path: Path) -> Iterator[None]:
    """Make one transaction of a block that writes to the store in a file.

    Raises
    ------
    OSError
        The file cannot be written: a full disk, or another process that holds it for long.
    """
    try:
        database.execute("BEGIN IMMEDIATE")
        yield
        database.execute("COMMIT")
    except BaseException as error:  # Ctrl-C, too: whatever comes next begins anew
        if database.in_transaction:
            database.execute("ROLLBACK")
        if isinstance(error, sqlite3.Error):
            raise OSError(
                f"the store {path} cannot be written: {error}; what it held before is whole, and "
                "a search that is started again goes on from there"
            ) from error
        raise
