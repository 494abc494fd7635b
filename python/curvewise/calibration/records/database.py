"""The file of a store: an SQLite database with a checksum in every row.

Ctrl-C may interrupt between any two statements, and the disk may be full at any of them. The next
statement must find the database in its earlier state, not inside an open transaction. SQLite
detects damage to the structure of its file, but not to the contents of a row. Each row therefore
ends with a checksum of its other columns (CRC-32). All reading and writing uses `Database`, which
turns every fault of the file into one kind of error. The format is that of https://sqlite.org,
through Python's own sqlite3.

Cost: half a millisecond to open a store. The checksum of a row takes about 10 microseconds, and
another 10 for every 500 points of its curves.
"""

from __future__ import annotations

import shlex
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

__all__ = ["TABLES", "Database", "StoreError", "checksum"]

Row: TypeAlias = tuple[Any, ...]

_FORMAT = 2
_PATIENCE = 60.0  # seconds to wait for another process's transaction
TABLES = {
    "models": "identity TEXT PRIMARY KEY, fingerprint TEXT NOT NULL, checksum INTEGER NOT NULL",
    "runs": "identity TEXT NOT NULL, parameters TEXT NOT NULL, seconds REAL NOT NULL, "
    "message TEXT NOT NULL, shapes TEXT NOT NULL, curves BLOB NOT NULL, "
    "checksum INTEGER NOT NULL, PRIMARY KEY (identity, parameters)",
    "searches": "number INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, settings TEXT NOT NULL, "
    "details TEXT NOT NULL, ending TEXT NOT NULL, checksum INTEGER NOT NULL",
    "evaluations": "search INTEGER NOT NULL, number INTEGER NOT NULL, point TEXT NOT NULL, "
    "value REAL NOT NULL, failed INTEGER NOT NULL, seconds REAL NOT NULL, message TEXT NOT NULL, "
    "checksum INTEGER NOT NULL, PRIMARY KEY (search, number)",
}
# SQLite's words for faults outside an intact file.
_AROUND = ("locked", "unable to open", "readonly", "disk I/O error", "is full")
# SQLite's words may contain bytes of the file that are not valid text.
_ERRORS = (sqlite3.Error, UnicodeDecodeError)
_SCHEMA = "type, name, tbl_name, rootpage, sql"


class StoreError(OSError):
    """The file of a store is damaged, locked, or cannot be written.

    The message names the file, the fault and the remedy.
    """


class Database:
    """An open store; created if its file does not exist or is empty.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    ValueError
        If the file is not a store.
    StoreError
        If it cannot be created, or is damaged. Every method may raise this.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._connection = sqlite3.connect(path, timeout=_PATIENCE, isolation_level=None)
        except sqlite3.OperationalError as error:
            raise StoreError(f"the store {path} cannot be opened: {error}") from error
        try:
            self._make_or_check_tables()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the file."""
        self._connection.close()

    @contextmanager
    def transaction(self) -> Iterator[None]:
        """Begin, and commit what the block has written."""
        try:
            self._connection.execute("BEGIN IMMEDIATE")
            yield
            self._connection.execute("COMMIT")
        except BaseException as error:
            if self._connection.in_transaction:
                with suppress(sqlite3.Error):  # the first error says more
                    self._connection.execute("ROLLBACK")
            if not isinstance(error, _ERRORS):
                raise
            raise self._error(
                error,
                "written",
                "; what it held before is whole, and a search that is started again goes on from "
                "there",
            ) from error

    def write(self, table: str, rows: Iterable[Row], *, replace: bool = False) -> None:
        """Write rows without their checksums, within a transaction.

        Rows with an existing key are ignored, unless `replace` is true.
        """
        how = "REPLACE" if replace else "IGNORE"
        for row in rows:
            marks = ", ".join("?" * (len(row) + 1))
            query = f"INSERT OR {how} INTO {table} VALUES ({marks})"
            self._connection.execute(query, (*row, checksum(row)))

    def delete(self, table: str, condition: str, values: Row = ()) -> int:
        """Delete rows, within a transaction; return how many."""
        query = f"DELETE FROM {table} WHERE {condition}"
        return self._connection.execute(query, values).rowcount

    def rows(self, table: str, order: str = "rowid", **equal: Any) -> Iterator[Row]:
        """Yield rows without their checksums, after checking these.

        Parameters
        ----------
        table : str
            The table.
        order : str, default "rowid"
            The sort column; by default the order of writing.
        **equal : object
            Required values of columns. A damaged index would lead to other rows.
        """
        condition = " AND ".join(["TRUE", *(f"{name} = ?" for name in equal)])
        query = f"SELECT {', '.join([*equal, '*'])} FROM {table} WHERE {condition} ORDER BY {order}"
        values = tuple(equal.values())
        for found in self._asked(query, values):
            *row, expected = found[len(values) :]
            if checksum(row) != expected or found[: len(values)] != values:
                raise self._damaged(f"a row of its table {table} is not as it was written")
            yield tuple(row)

    def number(self, query: str) -> int:
        """Return the only number that a query gives."""
        ((value,),) = self._asked(query)
        return int(value)

    def check(self, table: str) -> None:
        """See to it that no row of a table is hidden; reads all of it."""
        if list(self._asked(f"PRAGMA integrity_check({table})")) != [("ok",)]:
            raise self._damaged(f"its table {table} is not whole")

    def _make_or_check_tables(self) -> None:
        # One statement, as another process may be making the tables.
        found = list(
            self._asked(
                f"SELECT user_version, {_SCHEMA} FROM pragma_user_version LEFT JOIN sqlite_master"
            )
        )
        number, is_empty = found[0][0], found[0][1] is None
        if number == 0 and is_empty:
            with self.transaction():
                _make_tables(self._connection)
                self._connection.execute(f"PRAGMA user_version = {_FORMAT}")
            return
        is_right = [row[1:] for row in found] == _right_schema()
        if number != _FORMAT and not is_right:
            raise ValueError(f"{self.path} is not a store of this version; give another file")
        if number != _FORMAT or not is_right:
            raise self._damaged("its tables are not those of a store")

    def _asked(self, query: str, values: Row = ()) -> Iterator[Row]:
        try:
            yield from self._connection.execute(query, values)
        except _ERRORS as error:
            raise self._error(error, "used") from error

    def _error(self, error: Exception, done: str, comfort: str = "") -> Exception:
        text = str(error).partition(" with text ")[0]  # which may be pages long
        if any(words in text for words in _AROUND):
            return StoreError(f"the store {self.path} cannot be {done}: {text}{comfort}")
        if "not a database" in text and not _has_been_store(self.path):
            return ValueError(f"{self.path} is not a store; give the name of a file")
        return self._damaged(text)

    def _damaged(self, what: str) -> StoreError:
        return StoreError(
            f"the store {self.path} is damaged: {what}; the runs that can still be read are kept, "
            f"and curvewise report {shlex.quote(str(self.path))} --rescue NEW.db copies them into "
            "a new store, with which the search goes on"
        )


def checksum(row: Sequence[Any]) -> int:
    """Return the checksum of a row, equal before writing and after reading."""
    total = 0
    for value in row:
        if isinstance(value, (int, float)):  # SQLite makes one of the other
            value = float(value)
        part = value if isinstance(value, bytes) else str(value).encode("utf-8", "surrogatepass")
        total = zlib.crc32(part, zlib.crc32(b"%d " % len(part), total))
    return total


def _make_tables(connection: sqlite3.Connection) -> None:
    for name, columns in TABLES.items():
        connection.execute(f"CREATE TABLE IF NOT EXISTS {name} ({columns})")


@cache
def _right_schema() -> list[Row]:
    """Return SQLite's schema of the tables, which is equal in every store."""
    connection = sqlite3.connect(":memory:")
    _make_tables(connection)
    schema = connection.execute(f"SELECT {_SCHEMA} FROM sqlite_master").fetchall()
    connection.close()
    return schema


def _has_been_store(path: Path) -> bool:
    """Return whether the beginning of a file has what makes a store of it, or is SQLite's."""
    with path.open("rb") as file:
        page = file.read(4096)
    return page.startswith(b"SQLite format 3") or b"CREATE TABLE runs" in page
