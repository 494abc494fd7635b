"""The execution of models: processes and store."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass

from ..models.forward import ForwardModel
from ..models.identity import model_identity
from ..models.pool import Model, ModelPool
from ..records.store import SimulationStore, StoreOrPath
from .simulator import Dispatch, Simulator

__all__ = ["Execution"]


@dataclass(frozen=True)
class Execution:
    """The store, the processes and the executor of a search, and of what comes after it.

    Attributes
    ----------
    store, workers, executor
        As for `identify`.
    """

    store: StoreOrPath | None = None
    workers: int = 1
    executor: Executor | None = None

    @contextmanager
    def simulator(self, model: ForwardModel | None) -> Iterator[Simulator]:
        """Start what runs a model, and stop it at the end.

        Raises
        ------
        ValueError
            If `model` is None, because it runs elsewhere; as for `ModelPool` and `SimulationStore`.
        """
        if model is None:
            raise ValueError(
                "the problem has no model: its search is driven by ask() and tell() (docs: other "
                "optimisers)"
            )
        pool = ModelPool(Dispatch(model.callables), self.workers, self.executor)
        opened = nullcontext() if self.store is None else SimulationStore(self.store)
        with pool, opened as store:
            simulator = Simulator(pool, model, store)
            try:
                yield simulator
            finally:
                simulator.keep_finished()

    def identities(self, models: Sequence[Model]) -> list[str] | None:
        """Return the identities of the models, or None if they are not known."""
        known = all(isinstance(getattr(model, "identity", None), str) for model in models)
        if self.store is None and not known:
            return None
        version = None if self.store is None else SimulationStore(self.store).version
        return [model_identity(model, version).text for model in models]
