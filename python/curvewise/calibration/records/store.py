"""A store of simulations: every run's curves, by the model and its parameters.

An SQLite database. A run is found again by the identity of its model (see `model_identity`) and
by what the model was called with, to the last bit; which measure, method, weights or loops it was
made for does not matter. Beside the runs it has the searches that made them (search_table.py), for
reports. A run is written when it ends, in a transaction of its own, or together
with others that ended within a fifth of a second. So a process that is killed loses what was
under way and a fifth of a second of what was not, and several processes may use one store at once.

Cost: a transaction takes 20 milliseconds on a slow disk, a look-up some 50 microseconds; the
file has 8 bytes for every number of every curve. The format is that of https://sqlite.org,
through Python's own sqlite3.
"""

from __future__ import annotations

import json
import os
import sqlite3
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from ...curves.inputs import Array
from ...curves.several_curves import as_points, curve_list
from ..models.identity import ModelIdentity
from ..models.pool import Outcome
from .evaluation import Evaluation
from .search_table import SearchTable
from .transactions import transaction

__all__ = ["SimulationStore", "StoredRun"]

StorePath: TypeAlias = str | os.PathLike[str]

_FORMAT = 1
_PATIENCE = 60.0  # seconds to wait for another process's transaction
_PAUSE = (
    0.2  # seconds between transactions: models that take a millisecond should not wait for them
)
_TABLES = """
CREATE TABLE IF NOT EXISTS models (identity TEXT PRIMARY KEY, fingerprint TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS runs (
    identity TEXT NOT NULL, parameters TEXT NOT NULL, seconds REAL NOT NULL,
    message TEXT NOT NULL, shapes TEXT NOT NULL, curves BLOB NOT NULL,
    PRIMARY KEY (identity, parameters)
);
"""


class StoredRun(NamedTuple):
    """One run of a model.

    Attributes
    ----------
    parameters : dict of str to float
        What the model was called with.
    simulations : list of ndarray, or None
        What it returned, with None for a curve that it did not return; None if it failed.
    message : str
        Why it failed; empty if it did not.
    seconds : float
        How long it took.
    """

    parameters: dict[str, Any]
    simulations: list[Array | None] | None
    message: str
    seconds: float


class SimulationStore:
    """A file that holds the curves of every run of one or several models.

    Parameters
    ----------
    path : path-like
        The file; it is made if it does not exist.

    Raises
    ------
    ValueError
        The file is something else than a store.
    OSError
        It cannot be made.

    Notes
    -----
    A context manager, which closes it. Not for several threads at once; several processes, each
    with a `SimulationStore` of its own, may use one file.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from curvewise.calibration import SimulationStore, identify
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x))
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = Path(folder.name, "lines.db")
    >>> keywords = {"method": "sdrm", "store": file, "version": "1", "progress": False}
    >>> found = identify(line, line({"slope": 2.0}), {"slope": (0, 10)}, **keywords)
    >>> with SimulationStore(file) as store:
    ...     len(store) == found.evaluations, store.models()
    (True, ['line, version 1'])
    >>> folder.cleanup()
    """

    def __init__(self, path: StorePath) -> None:
        self.path = Path(path)
        self._unwritten: dict[tuple[str, str], tuple[Any, ...]] = {}
        self._written = 0.0
        try:
            self._database = sqlite3.connect(self.path, timeout=_PATIENCE, isolation_level=None)
        except sqlite3.OperationalError as error:
            raise OSError(f"the store {self.path} cannot be opened: {error}") from error
        try:
            (format_,) = self._database.execute("PRAGMA user_version").fetchone()
            tables = self._database.execute("SELECT count(*) FROM sqlite_master").fetchone()
            if format_ not in (0, _FORMAT) or (format_ == 0 and tables != (0,)):
                raise ValueError(f"{self.path} is not a store of this version; give another file")
            if format_ == 0:
                self._database.executescript(
                    f"BEGIN IMMEDIATE; {_TABLES} PRAGMA user_version = {_FORMAT}; COMMIT;"
                )
        except sqlite3.DatabaseError as error:
            self._database.close()
            if "not a database" not in str(error):
                raise OSError(f"the store {self.path} cannot be used: {error}") from error
            raise ValueError(f"{self.path} is not a store; give the name of a file") from error
        except ValueError:
            self._database.close()
            raise
        self.searches = SearchTable(self._database)

    def __enter__(self) -> SimulationStore:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __len__(self) -> int:
        """How many runs there are, of all models."""
        self._write()
        (count,) = self._database.execute("SELECT count(*) FROM runs").fetchone()
        return int(count)

    def close(self) -> None:
        """Write what is not written yet, and close the file."""
        try:
            self._write()
        finally:
            self._database.close()

    def models(self) -> list[str]:
        """Return the identities of the models that have runs here, in the order of their first."""
        rows = self._database.execute("SELECT identity FROM models ORDER BY rowid")
        return [identity for (identity,) in rows]

    def runs(self, identity: str) -> Iterator[StoredRun]:
        """Yield the runs of a model, in the order in which they were stored."""
        self._write()
        rows = self._database.execute(
            "SELECT parameters, seconds, message, shapes, curves FROM runs "
            "WHERE identity = ? ORDER BY rowid",
            (identity,),
        )
        for parameters, *rest in rows:
            outcome = _decoded(*rest)
            values = {name: _number(text) for name, text in json.loads(parameters).items()}
            yield StoredRun(values, outcome.simulations, outcome.message, outcome.seconds)

    def forget_failures(self) -> int:
        """Delete the runs that failed, say for want of a licence; return how many there were."""
        self._write()
        return self._database.execute("DELETE FROM runs WHERE message != ''").rowcount

    def register(self, model: ModelIdentity) -> None:
        """Make a model known, or refuse one whose code is not that of its runs.

        Raises
        ------
        ValueError
            The store has runs under this identity and another fingerprint.
        """
        with transaction(self._database):
            self._database.execute("INSERT OR IGNORE INTO models VALUES (?, ?)", model)
        (stored,) = self._database.execute(
            "SELECT fingerprint FROM models WHERE identity = ?", (model.text,)
        ).fetchone()
        # Another Python compiles the same code to other bytes, of which nothing can be said.
        same_python = stored.partition(":")[0] == model.fingerprint.partition(":")[0]
        if same_python and stored != model.fingerprint:
            raise ValueError(
                f"{self.path} has runs of {model.text}, whose code or data were others; give "
                "another version, as its curves may differ"
            )

    def look_up(self, identity: str, parameters: Mapping[str, Any]) -> Outcome | None:
        """Return what came of a run, or None if there is none."""
        unwritten = self._unwritten.get((identity, _key(parameters)))
        if unwritten is not None:
            return _decoded(*unwritten[2:])
        row = self._database.execute(
            "SELECT seconds, message, shapes, curves FROM runs "
            "WHERE identity = ? AND parameters = ?",
            (identity, _key(parameters)),
        ).fetchone()
        return None if row is None else _decoded(*row)

    def save(self, identity: str, parameters: Mapping[str, Any], outcome: Outcome) -> None:
        """Store a run; what the model should not have returned is left out, to be run again."""
        try:
            shapes, numbers = _encoded(outcome)
        except (TypeError, ValueError):  # the objective says what is wrong with it
            return
        key = _key(parameters)
        row = (identity, key, outcome.seconds, outcome.message, shapes, numbers)
        self._unwritten[identity, key] = row
        if time.monotonic() - self._written > _PAUSE:
            self._write()

    def note(self, search: int, evaluation: Evaluation) -> None:
        """Take down an evaluation of a search; see ``SearchTable``."""
        self.searches.note(search, evaluation)
        if time.monotonic() - self._written > _PAUSE:
            self._write()

    def _write(self) -> None:
        if not self._unwritten and not self.searches.has_unwritten:
            return
        with transaction(self._database):
            rows = self._unwritten.values()
            self._database.executemany("INSERT OR IGNORE INTO runs VALUES (?, ?, ?, ?, ?, ?)", rows)
            self.searches.write()
        self._unwritten.clear()
        self.searches.committed()
        self._written = time.monotonic()


def _key(parameters: Mapping[str, Any]) -> str:
    """Return parameters as a text that is the same for the same numbers, bit for bit."""
    texts = {
        name: value if isinstance(value, str) else float(value).hex()
        for name, value in parameters.items()
    }
    return json.dumps(texts, sort_keys=True)


def _number(text: str) -> Any:
    try:
        return float.fromhex(text)
    except ValueError:
        return text


def _encoded(outcome: Outcome) -> tuple[str, bytes]:
    """Return the shapes of the curves as JSON, null for one that is missing, and their numbers."""
    if outcome.message:
        return "null", b""
    if outcome.simulations is None:
        return "[null]", b""
    shapes: list[tuple[int, ...] | None] = []
    numbers = []
    for curve in curve_list(outcome.simulations):
        if curve is None:
            shapes.append(None)
            continue
        if isinstance(curve, BaseException) or np.iscomplexobj(curve):
            raise TypeError("not a curve of real numbers")
        points = as_points([[curve]] if np.ndim(curve) == 0 else curve, "Q")
        shapes.append(points.shape)
        numbers.append(points.tobytes())
    return json.dumps(shapes), b"".join(numbers)


def _decoded(seconds: float, message: str, shapes: str, numbers: bytes) -> Outcome:
    if message:
        return Outcome(None, message, seconds)
    flat = np.frombuffer(numbers)
    curves: list[Array | None] = []
    for shape in json.loads(shapes):
        if shape is None:
            curves.append(None)
            continue
        size = int(np.prod(shape))
        curves.append(flat[:size].reshape(shape).copy())
        flat = flat[size:]
    is_missing = all(curve is None for curve in curves)
    return Outcome(None if is_missing else curves, message, seconds)
