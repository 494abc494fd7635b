"""Takes out of a damaged store what can still be read of it, into a new one.

The first page of a store, which says what tables there are and where they begin, is the same in
every store, and is taken from the new one. Then the tables are read from both ends, until where
the damage is; and so is each page of rows, as if a table began there, which finds those to which no
damaged page leads any more. A row counts where its checksum is right; one that had been deleted may
come back. Cost: some seconds for each 100 MB.
"""

from __future__ import annotations

import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from .database import TABLES, Database, Row, checksum

__all__ = ["rescue"]

# Of SQLite's format: where a page has its size and for which count of changes the length in it
# is valid (zeros let SQLite look how long the file is), and how a page of rows begins.
_SIZE, _VALID_FOR, _HAS_ROWS = slice(16, 18), slice(92, 96), 13


def rescue(damaged: Path, new: Path) -> dict[str, int]:
    """Copy what can still be read of a store into a new one.

    Parameters
    ----------
    damaged : Path
        The store, which is left as it is.
    new : Path
        The file to make.

    Returns
    -------
    dict of str to int
        How many rows the new store has in each of its tables.

    Raises
    ------
    OSError
        The damaged store cannot be read at all, or the new one not be written; or there is one.
    ValueError
        Nothing can be read.
    """
    with tempfile.TemporaryDirectory() as folder:
        copy, made = Path(folder, "copy.db"), Path(folder, "new.db")
        shutil.copyfile(damaged, copy)
        with closing(Database(made)) as target:
            pages = _mend_first_page(copy, made)
            with closing(sqlite3.connect(copy, isolation_level=None)) as source:
                source.execute("PRAGMA journal_mode = OFF")
                with target.transaction():
                    _copy_rows(source, target)
                    for page in pages:
                        _begin_tables_at(source, page)
                        _copy_rows(source, target)
                    _name_models(target)
            counts = {table: target.number(f"SELECT count(*) FROM {table}") for table in TABLES}
        if not any(counts.values()):
            raise ValueError(f"nothing in {damaged} can be read as a part of a store")
        with made.open("rb") as content, new.open("xb") as file:
            shutil.copyfileobj(content, file)
    return counts


def _mend_first_page(copy: Path, made: Path) -> list[int]:
    """Put a new store's first page in the place of the old; return the pages that have rows."""
    content = bytearray(made.read_bytes())
    size = int.from_bytes(content[_SIZE], "big")
    content[_VALID_FOR] = bytes(4)
    with copy.open("r+b") as file:
        file.write(content[:size])
        # A file that was cut off is longer again: where a table would begin there are zeros now.
        length = max(len(content), -(-copy.stat().st_size // size) * size)
        file.truncate(length)
        found = []
        for begin in range(size, length, size):
            file.seek(begin)
            if file.read(1)[0] == _HAS_ROWS:
                found.append(begin // size + 1)
    return found


def _begin_tables_at(source: sqlite3.Connection, page: int) -> None:
    source.execute("PRAGMA writable_schema = ON")
    source.execute("UPDATE sqlite_master SET rootpage = ? WHERE type = 'table'", (page,))
    source.execute("PRAGMA writable_schema = RESET")  # reads it again


def _copy_rows(source: sqlite3.Connection, target: Database) -> None:
    for table in TABLES:
        for order in ("ASC", "DESC"):
            target.write(table, _readable(source, f"SELECT * FROM {table} ORDER BY rowid {order}"))


def _readable(source: sqlite3.Connection, query: str) -> Iterator[Row]:
    """Yield the rows that are right, as far as one comes."""
    try:
        for *row, expected in source.execute(query):
            if checksum(row) == expected:
                yield tuple(row)
    except (sqlite3.Error, UnicodeDecodeError):  # the damage
        return


def _name_models(target: Database) -> None:
    """Make those models known whose row is lost: without a fingerprint, any code is theirs."""
    known = {identity for identity, _ in target.rows("models")}
    identities = dict.fromkeys(run[0] for run in target.rows("runs"))
    target.write("models", [(name, "") for name in identities if name not in known])
