"""The searches that a file holds: a store, or the history of one search."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from ...curves.inputs import Array
from ..records.history import read_history
from ..records.search_record import Ending, SearchRecord, canonical
from ..records.store import SimulationStore

__all__ = ["history_record", "records_of"]

_SQLITE = b"SQLite format 3\0"


def records_of(path: str | os.PathLike[str]) -> dict[int, SearchRecord]:
    """Return the searches that a store or a history holds, by their numbers.

    Raises
    ------
    ValueError
        The file is neither; a store without searches; a history from before reports.
    OSError
        The file cannot be read.
    """
    with open(path, "rb") as file:
        is_store = file.read(len(_SQLITE)) == _SQLITE
    if not is_store:
        return {1: history_record(path)}
    with SimulationStore(path) as store:
        records = store.searches.records()
        if not records:
            models = "; ".join(store.models()) or "no model"
            raise ValueError(
                f"{path} holds {len(store)} runs (of {models}) and no search: they are from a "
                "curvewise that did not write searches down. Call identify(..., store=...) once "
                "more with this file: the runs are looked up, and none is made again"
            )
        return {
            number: record if record.ending else replace(record, simulations=_best(store, record))
            for number, record in records.items()
        }


def history_record(path: str | os.PathLike[str]) -> SearchRecord:
    """Return the search that a history holds."""
    settings, details, evaluations, ending = read_history(Path(path))
    evaluations.sort(key=lambda one: one.number)
    curves = min(evaluations, key=lambda one: one.value).simulations if evaluations else None
    return SearchRecord(
        settings,
        details,
        tuple(map(canonical, evaluations)),
        Ending.from_json(ending) if ending else None,
        () if ending else curves or (),
    )


def _best(store: SimulationStore, record: SearchRecord) -> tuple[Array, ...]:
    """Return the curves of the best run so far, if it is one run that has all of them."""
    best, models = record.best, record.details["model"]
    if best is None or best.failed or len(models) != 1:
        return ()
    wanted = dict(zip(record.names, best.point, strict=True))
    for run in store.runs(models[0]):
        if all(run.parameters.get(name) == value for name, value in wanted.items()):
            curves = tuple(curve for curve in run.simulations or () if curve is not None)
            return curves if len(curves) == len(record.experiments) else ()
    return ()
