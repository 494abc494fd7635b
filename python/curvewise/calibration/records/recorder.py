"""Records a search while it runs, in memory and in its store, if it has one.

The record can be read as a :class:`SearchRecord`, equal from either place.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import replace
from typing import Any

from .evaluation import Evaluation
from .search_record import Ending, SearchRecord, as_json
from .store import SimulationStore

__all__ = ["Recorder"]


class Recorder:
    """The record of a search, from its first evaluation to its end.

    Parameters
    ----------
    settings, details
        As for a :class:`SearchRecord`.
    store : SimulationStore or None
        The open store of the search. After it has been closed only `end` may be called.
    """

    def __init__(
        self,
        settings: Mapping[str, Any],
        details: Mapping[str, Any],
        store: SimulationStore | None,
    ) -> None:
        self._settings, self._details = as_json(settings), as_json(details)
        self._evaluations: list[Evaluation] = []
        self._store = store
        self._number = 0 if store is None else store.begin_search(self._settings, self._details)
        self.ending: Ending | None = None

    @property
    def has_store(self) -> bool:
        """Whether the record outlives the process."""
        return self._store is not None

    @property
    def evaluations(self) -> tuple[Evaluation, ...]:
        """The evaluations recorded so far, in order."""
        return tuple(self._evaluations)

    def with_evaluations(self, evaluations: Iterable[Evaluation]) -> Recorder:
        """Return a copy without a store that has these evaluations, numbered in their order."""
        other = copy(self)
        other._store = None
        other._evaluations = [replace(one, number=n) for n, one in enumerate(evaluations, 1)]
        return other

    def add(self, evaluation: Evaluation) -> None:
        """Take down an evaluation."""
        self._evaluations.append(evaluation)
        if self._store is not None:
            self._store.add_evaluation(self._number, evaluation)

    def end(self, ending: Ending) -> None:
        """Record how the search ended, or later findings about its end.

        A store that has been removed, such as the temporary one of `identify_each`, is not created
        again.

        Raises
        ------
        OSError, ValueError
            If the store cannot be written, or another file has replaced it.
        """
        self.ending = ending
        if self._store is not None and self._store.path.is_file():
            with SimulationStore(self._store) as store:
                store.end_search(self._number, ending)

    def record(self) -> SearchRecord:
        """Return the record, equal to the one that a store returns."""
        settings, details = json.loads(self._settings), json.loads(self._details)
        ending = self.ending and Ending.from_json(self.ending.to_json())
        return SearchRecord(settings, details, tuple(self._evaluations), ending)
