"""The searches that a store holds, for a report."""

from __future__ import annotations

import os

from ..records.search_record import SearchRecord
from ..records.store import SimulationStore

__all__ = ["records_of"]


def records_of(path: str | os.PathLike[str]) -> dict[int, SearchRecord]:
    """Return the searches that a store holds, by their numbers.

    Raises
    ------
    ValueError
        If the file is not a store, or does not contain searches.
    OSError
        If the file does not exist, or cannot be read.
    """
    os.stat(path)  # a missing store would be created
    with SimulationStore(path) as store:
        if records := store.searches():
            return records
        models = "; ".join(store.models()) or "no model"
        raise ValueError(
            f"{path} holds {len(store)} runs (of {models}) and no search; call "
            "identify(..., store=...) with this file: the runs are looked up, and none is made "
            "again"
        )
