"""Writes a search down as it goes: into its store, into its history, or just into memory.

What it has written can be read again as a :class:`SearchRecord`; a search with neither store nor
history has one all the same, as long as the process lives.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .evaluation import Evaluation
from .history import append_ending
from .search_record import Ending, SearchRecord, as_json, canonical
from .store import SimulationStore, StorePath

__all__ = ["Recorder"]


@dataclass
class Recorder:
    """Where a search is written down.

    Parameters
    ----------
    settings, details
        As those of a :class:`SearchRecord`.
    store, history : path-like or None
        The files of the search.

    Attributes
    ----------
    number : int or None
        That of the search in its store.
    """

    settings: Mapping[str, Any]
    details: Mapping[str, Any]
    store: StorePath | None
    history: StorePath | None
    number: int | None = None
    ending: Ending | None = None
    _open_store: SimulationStore | None = field(default=None, repr=False)
    _evaluations: list[Evaluation] = field(default_factory=list, repr=False)

    def begin(self, store: SimulationStore | None) -> None:
        """Take down what is searched for, in a store that is open until the search ends."""
        self._open_store = store
        if store is not None:
            self.number = store.searches.begin(self.settings, self.details)

    def note(self, evaluation: Evaluation) -> None:
        """Take down an evaluation; the history has a line of its own for it."""
        noted = canonical(evaluation)
        self._evaluations.append(noted)
        if self._open_store is not None and self.number is not None:
            self._open_store.note(self.number, noted)

    def stop(self) -> None:
        """Let go of the store, which is about to be closed."""
        self._open_store = None

    def end(self, ending: Ending) -> None:
        """Take down how the search ended, or what has become known of it since."""
        self.ending = ending
        if self.number is not None and self.store_exists:
            with SimulationStore(self.store or "") as store:
                store.searches.end(self.number, ending)
        if self.history is not None:
            append_ending(self.history, ending.to_json())

    def record(self) -> SearchRecord:
        """Return what has been taken down, as any of the files gives it."""
        settings, details = (json.loads(as_json(part)) for part in (self.settings, self.details))
        ending = None if self.ending is None else Ending.from_json(self.ending.to_json())
        return SearchRecord(settings, details, tuple(self._evaluations), ending)

    @property
    def has_file(self) -> bool:
        """Whether anything outlives the process."""
        return self.store is not None or self.history is not None

    @property
    def store_exists(self) -> bool:
        """Whether there is a store; that of `identify_each` without one was temporary."""
        return self.store is not None and Path(self.store).is_file()
