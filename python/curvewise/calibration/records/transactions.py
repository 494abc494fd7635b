"""One transaction of a store: all of it, or, whatever happens inside, nothing.

Ctrl-C may come between any two statements, and the disk may be full at any of them: what comes
next must find the database as it was, not inside a transaction that nobody ends.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["transaction"]


@contextmanager
def transaction(database: sqlite3.Connection) -> Iterator[None]:
    """Begin, and commit what the block has written.

    Raises
    ------
    OSError
        It cannot be written.
    """
    try:
        database.execute("BEGIN IMMEDIATE")
        yield
        database.execute("COMMIT")
    except BaseException as error:
        if database.in_transaction:
            database.execute("ROLLBACK")
        if not isinstance(error, sqlite3.Error):
            raise
        file = database.execute("PRAGMA database_list").fetchone()[2]
        raise OSError(
            f"the store {file} cannot be written: {error}; what it held before is whole, and a "
            "search that is started again goes on from there"
        ) from error
