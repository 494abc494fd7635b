"""A store of simulations: the curves of every run, and the searches.

The store is an SQLite database (database.py). A run is identified by the identity of its model (see
`model_identity`) and by the bitwise values of its parameters. The measure, method, weights and
loops of the search do not matter. A search is identified by the digest of its settings. A resumed
or repeated search therefore replaces its earlier record and keeps its number. Runs and evaluations
that arrive within a fifth of a second are written in one transaction. A killed process thus loses
its unfinished runs and at most a fifth of a second of finished ones. Several processes may use one
store at once.

Cost: a transaction takes 20 milliseconds on a slow disk, reading a run about 50 microseconds. The
file has 8 bytes for every number of every curve, and some hundred bytes for every evaluation.
Operations on all runs, or on all searches, first let SQLite check their tables, at about 1 GB/s.
"""

from __future__ import annotations

import csv
import hashlib
import json
import os
import time
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any, TypeAlias

from ...curves.inputs import Array
from ..models.identity import ModelIdentity
from ..models.pool import Outcome
from .database import Database
from .evaluation import Evaluation
from .search_record import Ending, SearchRecord
from .stored_run import StoredRun, decoded, encoded, key_of, parameters_of

__all__ = ["SimulationStore", "StoreOrPath"]

# Seconds between transactions: models that take a millisecond should not wait for them.
_PAUSE = 0.2


class SimulationStore:
    """A file with the curves of every run of one or several models, and searches.

    Parameters
    ----------
    path : path-like, or SimulationStore
        The file, created at its first use if it does not exist. Given another store, its file and
        version are used with a separate connection.
    version : str, optional
        A name for the present state of the models; runs are stored under it. A Python function
        needs one. :class:`CommandModel`, and any model with an attribute `identity`, does not.

    Raises
    ------
    ValueError
        If the version is not a text; at the first use, if the file is not a store.
    StoreError
        If the file cannot be created, read or written, or is damaged; raised when it is used.

    Notes
    -----
    A context manager that closes the store. It is not thread-safe. Several processes may use one
    file, each with its own `SimulationStore`; every search opens its own.

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
    >>> lines = SimulationStore(Path(folder.name, "lines.db"), version="1")
    >>> keywords = {"method": "sdrm", "store": lines, "progress": False}
    >>> found = identify(line, line({"slope": 2.0}), {"slope": (0, 10)}, **keywords)
    >>> with lines as store:
    ...     len(store) == found.evaluations, store.models()
    (True, ['line, version 1'])
    >>> folder.cleanup()
    """

    def __init__(self, path: StoreOrPath, *, version: str | None = None) -> None:
        if version is not None and (not isinstance(version, str) or not version):
            raise ValueError(f"version is {version!r}; give a text, such as '1'")
        self.path: Path
        self.version: str | None
        if isinstance(path, SimulationStore):
            self.path, self.version = path.path, version or path.version
        else:
            self.path, self.version = Path(path), version
        self._new_runs: dict[tuple[str, str], tuple[Any, ...]] = {}
        self._new_evaluations: list[tuple[Any, ...]] = []
        self._written = 0.0

    @cached_property
    def _database(self) -> Database:
        return Database(self.path)

    def __repr__(self) -> str:
        version = "" if self.version is None else f", version={self.version!r}"
        return f"SimulationStore({str(self.path)!r}{version})"

    def __enter__(self) -> SimulationStore:
        _ = self._database  # opens it
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __len__(self) -> int:
        """Return the number of runs of all models."""
        self._write()
        self._database.check("runs")
        return self._database.number("SELECT count(*) FROM runs")

    def close(self) -> None:
        """Write all pending data and close the file; the next use opens it again."""
        try:
            self._write()
        finally:
            if (database := self.__dict__.pop("_database", None)) is not None:
                database.close()

    # Runs of models.

    def models(self) -> list[str]:
        """Return the identities of the models that have runs here, in the order of their first."""
        self._database.check("models")
        return [identity for identity, _ in self._database.rows("models")]

    def runs(self, identity: str) -> Iterator[StoredRun]:
        """Yield the runs of a model, in the order in which they were stored."""
        self._write()
        self._database.check("runs")
        for _, parameters, *outcome in self._database.rows("runs", identity=identity):
            yield StoredRun(parameters_of(parameters), *decoded(*outcome))

    def forget_failures(self) -> int:
        """Delete failed runs, e.g. for lack of a licence; return their number."""
        self._write()
        with self._database.transaction():
            return self._database.delete("runs", "message != ''")

    def register(self, model: ModelIdentity) -> None:
        """Make a model known, or refuse one whose code is not that of its runs.

        Raises
        ------
        ValueError
            If the store has runs under this identity and another fingerprint.
        """
        with self._database.transaction():
            self._database.write("models", [model])
        ((_, stored),) = self._database.rows("models", identity=model.text)
        # Another Python compiles the same code to other bytes, so the fingerprints cannot be
        # compared.
        same_python = stored.partition(":")[0] == model.fingerprint.partition(":")[0]
        if same_python and stored != model.fingerprint:
            raise ValueError(
                f"{self.path} has runs of {model.text}, whose code or data were others; give "
                "another version, as its curves may differ"
            )

    def look_up(self, identity: str, parameters: Mapping[str, Any]) -> Outcome | None:
        """Return the stored outcome of a run, or None."""
        key = identity, key_of(parameters)
        if (row := self._new_runs.get(key)) is not None:
            return decoded(*row[2:])
        found = self._database.rows("runs", identity=identity, parameters=key[1])
        return next((decoded(*outcome) for _, _, *outcome in found), None)

    def save(self, identity: str, parameters: Mapping[str, Any], outcome: Outcome) -> None:
        """Store a run; what the model should not have returned is left out, to be run again."""
        try:
            shapes, numbers = encoded(outcome)
        except (TypeError, ValueError):  # the objective reports the error
            return
        key = identity, key_of(parameters)
        self._new_runs[key] = (*key, outcome.seconds, outcome.message, shapes, numbers)
        self._write_after_pause()

    # Searches.

    def begin_search(self, settings: str, details: str) -> int:
        """Make a search known, without evaluations or ending, and return its number.

        Parameters
        ----------
        settings, details : str
            Settings and details of a `SearchRecord`, as JSON.
        """
        key = hashlib.sha256(settings.encode()).hexdigest()
        with self._database.transaction():
            known = [row[0] for row in self._database.rows("searches", key=key)]
            last = "SELECT coalesce(max(number), 0) FROM searches"
            number: int = known[0] if known else 1 + self._database.number(last)
            self._database.write("searches", [(number, key, settings, details, "")], replace=True)
            self._database.delete("evaluations", "search = ?", (number,))
        return number

    def add_evaluation(self, search: int, evaluation: Evaluation) -> None:
        """Take down an evaluation of a search, whose curves are in the runs."""
        point = json.dumps([value.hex() for value in evaluation.point])
        row = (search, evaluation.number, point, evaluation.value, evaluation.failed)
        self._new_evaluations.append((*row, evaluation.seconds, evaluation.message))
        self._write_after_pause()

    def end_search(self, search: int, ending: Ending) -> None:
        """Write how a search ended."""
        with self._database.transaction():
            rows = list(self._database.rows("searches", number=search))
            ended = [(*row, ending.to_json()) for *row, _ in rows]
            self._database.write("searches", ended, replace=True)

    def searches(self) -> dict[int, SearchRecord]:
        """Return all searches by their numbers, in the order of their beginnings."""
        self._write()
        self._database.check("searches")
        self._database.check("evaluations")
        records = {}
        for number, _, settings, details, ending in self._database.rows("searches"):
            record = SearchRecord(
                json.loads(settings),
                json.loads(details),
                self._evaluations(number),
                Ending.from_json(ending) if ending else None,
            )
            records[number] = record if ending else replace(record, simulations=self._best(record))
        return records

    def to_csv(self, path: str | os.PathLike[str], search: int | None = None) -> None:
        """Write the evaluations of a search to a table, for other programs.

        A line for each: its number, the parameters, the objective's value, whether it failed, how
        many seconds it took and why it failed. Numbers are written so that they read back with the
        same bits (%.17g).

        Parameters
        ----------
        path : path-like
            The file; an existing file is replaced.
        search : int, optional
            The number of the search; required if the store has several.

        Raises
        ------
        ValueError
            If the store lacks this search, or has several and the number is not given.
        OSError
            If the file cannot be written.
        """
        records = self.searches()
        number = next(iter(records), None) if search is None else search
        if number not in records or (search is None and len(records) > 1):
            known = ", ".join(map(str, records)) or "none"
            wanted = "one search" if search is None else f"search {search}"
            raise ValueError(f"{self.path} has not {wanted}; name one of its searches: {known}")
        record = records[number]
        with open(path, "w", encoding="utf-8", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(["evaluation", *record.names, "value", "failed", "seconds", "message"])
            for one in record.evaluations:
                numbers = [f"{value:.17g}" for value in (*one.point, one.value)]
                row = [one.number, *numbers, int(one.failed), f"{one.seconds:.17g}", one.message]
                table.writerow(row)

    def _evaluations(self, search: int) -> tuple[Evaluation, ...]:
        rows = self._database.rows("evaluations", "number", search=search)
        return tuple(
            Evaluation(
                number,
                tuple(map(float.fromhex, json.loads(point))),
                value,
                bool(failed),
                seconds,
                message,
            )
            for _, number, point, value, failed, seconds, message in rows
        )

    def _best(self, record: SearchRecord) -> tuple[Array, ...]:
        """Return the curves of the best run so far, if it is one run that has all of them."""
        best, models = record.best, record.details["model"]
        if best is None or best.failed or len(models) != 1:
            return ()
        wanted = dict(zip(record.names, best.point, strict=True))
        for run in self.runs(models[0]):
            if all(run.parameters.get(name) == value for name, value in wanted.items()):
                curves = tuple(curve for curve in run.simulations or () if curve is not None)
                return curves if len(curves) == len(record.experiments) else ()
        return ()

    def _write_after_pause(self) -> None:
        if time.monotonic() - self._written > _PAUSE:
            self._write()

    def _write(self) -> None:
        if not self._new_runs and not self._new_evaluations:
            return
        with self._database.transaction():
            self._database.write("runs", self._new_runs.values())
            self._database.write("evaluations", self._new_evaluations, replace=True)
        self._new_runs.clear()
        self._new_evaluations.clear()
        self._written = time.monotonic()


StoreOrPath: TypeAlias = SimulationStore | str | os.PathLike[str]
"""A store of simulations as it is given: the file, or a `SimulationStore`, with a version."""
