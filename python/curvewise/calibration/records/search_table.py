"""The searches that a store knows: two tables beside that of the runs.

A search is found again by the digest of its settings, so that one that is resumed, or made again,
takes the place of its former self and keeps its number. Its evaluations are written as runs are,
a few at a time, and its ending when it has ended. Stores from before these tables have none; they
are made when the first search begins. Cost: a row of some hundred bytes an evaluation.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Mapping
from typing import Any

from .evaluation import Evaluation
from .search_record import Ending, SearchRecord, as_json
from .transactions import transaction

__all__ = ["SearchTable"]

_TABLES = (
    """
CREATE TABLE IF NOT EXISTS searches (
    number INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE,
    settings TEXT NOT NULL, details TEXT NOT NULL, ending TEXT NOT NULL
)""",
    """
CREATE TABLE IF NOT EXISTS evaluations (
    search INTEGER NOT NULL, number INTEGER NOT NULL, point TEXT NOT NULL, value REAL NOT NULL,
    failed INTEGER NOT NULL, seconds REAL NOT NULL, message TEXT NOT NULL,
    PRIMARY KEY (search, number)
) WITHOUT ROWID""",
)


class SearchTable:
    """The searches of a store.

    Parameters
    ----------
    database : sqlite3.Connection
        That of the store.
    """

    def __init__(self, database: sqlite3.Connection) -> None:
        self._database = database
        self._unwritten: list[tuple[Any, ...]] = []

    def begin(self, settings: Mapping[str, Any], details: Mapping[str, Any]) -> int:
        """Make a search known, without evaluations or ending, and return its number."""
        text = as_json(settings)
        key = hashlib.sha256(as_json(json.loads(text)).encode()).hexdigest()
        with transaction(self._database):
            for table in _TABLES:
                self._database.execute(table)
            self._database.execute(
                "INSERT INTO searches (key, settings, details, ending) VALUES (?, ?, ?, '') "
                "ON CONFLICT (key) DO UPDATE SET details = excluded.details, ending = ''",
                (key, text, as_json(details)),
            )
            (number,) = self._database.execute(
                "SELECT number FROM searches WHERE key = ?", (key,)
            ).fetchone()
            self._database.execute("DELETE FROM evaluations WHERE search = ?", (number,))
        return int(number)

    def note(self, search: int, evaluation: Evaluation) -> None:
        """Take an evaluation down, to be written with the next runs."""
        point = json.dumps([value.hex() for value in evaluation.point])
        row = (search, evaluation.number, point, evaluation.value, evaluation.failed)
        self._unwritten.append((*row, evaluation.seconds, evaluation.message))

    def write(self) -> None:
        """Write what has been noted; within a transaction, after which `committed` is called."""
        if self._unwritten:  # else there may be no table: runs are stored without a search, too
            self._database.executemany(
                "INSERT OR REPLACE INTO evaluations VALUES (?, ?, ?, ?, ?, ?, ?)", self._unwritten
            )

    def committed(self) -> None:
        """Forget what has been written."""
        self._unwritten.clear()

    @property
    def has_unwritten(self) -> bool:
        """Whether there is anything to write."""
        return bool(self._unwritten)

    def end(self, search: int, ending: Ending) -> None:
        """Write how a search ended."""
        with transaction(self._database):
            self._database.execute(
                "UPDATE searches SET ending = ? WHERE number = ?", (ending.to_json(), search)
            )

    def records(self) -> dict[int, SearchRecord]:
        """Return all searches by their numbers, in the order in which they were begun."""
        exists = "SELECT count(*) FROM sqlite_master WHERE name = 'searches'"
        if self._database.execute(exists).fetchone() == (0,):
            return {}
        rows = self._database.execute(
            "SELECT number, settings, details, ending FROM searches ORDER BY number"
        ).fetchall()
        return {
            number: SearchRecord(
                json.loads(settings),
                json.loads(details),
                self._evaluations(number),
                Ending.from_json(ending) if ending else None,
            )
            for number, settings, details, ending in rows
        }

    def _evaluations(self, search: int) -> tuple[Evaluation, ...]:
        rows = self._database.execute(
            "SELECT number, point, value, failed, seconds, message FROM evaluations "
            "WHERE search = ? ORDER BY number",
            (search,),
        )
        return tuple(
            Evaluation(
                number,
                tuple(map(float.fromhex, json.loads(point))),
                value,
                bool(failed),
                seconds,
                message,
            )
            for number, point, value, failed, seconds, message in rows
        )
