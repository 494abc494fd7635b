"""Copies the readable part of a damaged store into a new one.

The first page of a store lists its tables and where they begin. It is the same in every store, and
is taken from the new one. Then the tables are read from both ends until the damage. Each page of
rows is also read as if a table began there. This finds rows to which only damaged pages lead. A row
counts if its checksum is right; deleted rows may reappear. Cost: some seconds for each 100 MB.
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

# Constants of SQLite's format. Two offsets: the page size, and the change counter for which the
# stored file length is valid (zeros make SQLite compute the length). The first byte of a page of
# rows.
_SIZE, _VALID_FOR, _HAS_ROWS = slice(16, 18), slice(92, 96), 13


def rescue(damaged: Path, new: Path) -> dict[str, int]:
    """Copy the readable part of a store into a new one.

    Parameters
    ----------
    damaged : Path
        The store; it is not changed.
    new : Path
        The file to create.

    Returns
    -------
    dict of str to int
        The number of rows in each of the tables of the new store.

    Raises
    ------
    OSError
        If the damaged store cannot be read at all. If the new one cannot be written, or exists.
    ValueError
        If nothing can be read.
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
    """Replace the first page by a new store's; return the pages that have rows."""
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
