"""The file of a store: an SQLite database, its tables, and transactions that are whole or nothing.

Ctrl-C may come between any two statements, and the disk may be full at any of them: what comes
next must find the database as it was, not inside a transaction that nobody ends. The format is that
of https://sqlite.org, through Python's own sqlite3.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["make_tables", "opened", "transaction"]

_FORMAT = 1
_PATIENCE = 60.0  # seconds to wait for another process's transaction
# Stores from before there were searches have the first two.
_TABLES = (
    "models (identity TEXT PRIMARY KEY, fingerprint TEXT NOT NULL)",
    "runs (identity TEXT NOT NULL, parameters TEXT NOT NULL, seconds REAL NOT NULL, "
    "message TEXT NOT NULL, shapes TEXT NOT NULL, curves BLOB NOT NULL, "
    "PRIMARY KEY (identity, parameters))",
    "searches (number INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, "
    "settings TEXT NOT NULL, details TEXT NOT NULL, ending TEXT NOT NULL)",
    "evaluations (search INTEGER NOT NULL, number INTEGER NOT NULL, point TEXT NOT NULL, "
    "value REAL NOT NULL, failed INTEGER NOT NULL, seconds REAL NOT NULL, message TEXT NOT NULL, "
    "PRIMARY KEY (search, number)) WITHOUT ROWID",
)


def opened(path: Path) -> sqlite3.Connection:
    """Open the database of a store, or make it.

    Raises
    ------
    ValueError
        The file is something else than a store.
    OSError
        It cannot be made.
    """
    try:
        database = sqlite3.connect(path, timeout=_PATIENCE, isolation_level=None)
    except sqlite3.OperationalError as error:
        raise OSError(f"the store {path} cannot be opened: {error}") from error
    try:
        (format_,) = database.execute("PRAGMA user_version").fetchone()
        tables = database.execute("SELECT count(*) FROM sqlite_master").fetchone()
        if format_ not in (0, _FORMAT) or (format_ == 0 and tables != (0,)):
            raise ValueError(f"{path} is not a store of this version; give another file")
        if format_ == 0:
            with transaction(database):
                make_tables(database)
                database.execute(f"PRAGMA user_version = {_FORMAT}")
    except BaseException as error:
        database.close()
        if not isinstance(error, sqlite3.DatabaseError):
            raise
        if "not a database" not in str(error):
            raise OSError(f"the store {path} cannot be used: {error}") from error
        raise ValueError(f"{path} is not a store; give the name of a file") from error
    return database


def make_tables(database: sqlite3.Connection) -> None:
    """Make the tables that are not there; within a transaction."""
    for table in _TABLES:
        database.execute(f"CREATE TABLE IF NOT EXISTS {table}")


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
