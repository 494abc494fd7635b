"""Runs the models of a problem, or looks their runs up in a store.

A problem has one model, or several (one for each kind of test). Every set of parameters asks each
of them for a run; those that the store holds are looked up, the others go to the pool, and a set
is done when all of its runs are. Cost: that of the models; a look-up takes some 50 microseconds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeAlias

from ..models.identity import ModelIdentity, model_identity
from ..models.pool import Model, ModelPool, Outcome
from ..records.store import SimulationStore

__all__ = ["Assemble", "Dispatch", "Simulator"]

Assemble: TypeAlias = Callable[[list[Outcome]], Outcome]
"""Makes one outcome of those of all models."""


class Dispatch:
    """Several models as one, which the pool can send to its processes."""

    def __init__(self, models: Sequence[Model]) -> None:
        for model in models:
            if not callable(model):
                raise TypeError(f"the model is {type(model).__name__}; it must be callable")
        self.models = tuple(models)

    def __call__(self, call: dict[str, Any]) -> Any:
        """Call the model of a number with parameters."""
        return self.models[call["model"]](dict(call["parameters"]))


class Simulator:
    """The models as a function of parameters that runs nothing twice.

    Parameters
    ----------
    pool : ModelPool
        Runs a `Dispatch` of the models.
    models : sequence of callable
        The same models.
    assemble : callable
        Makes one outcome of those of all models.
    store : SimulationStore, optional
        Where runs are looked up and saved.

    Attributes
    ----------
    store
        As given.
    runs, looked_up : int
        How many runs of models this simulator has made, and how many sets of parameters it has
        looked up.
    """

    def __init__(
        self,
        pool: ModelPool,
        models: Sequence[Model],
        assemble: Assemble,
        store: SimulationStore | None = None,
    ) -> None:
        self._pool, self._assemble, self.store = pool, assemble, store
        self._count = len(models)
        self._identities: list[ModelIdentity] = []
        if store is not None:
            self._identities = [model_identity(model, store.version) for model in models]
            for identity in self._identities:
                store.register(identity)
        self.runs = self.looked_up = 0

    def run(self, parameters: Sequence[dict[str, float]]) -> Iterator[tuple[int, Outcome]]:
        """Yield index and outcome of every dict, those that are stored first."""
        found = [self._stored(values) for values in parameters]
        missing = []
        for i, outcomes in enumerate(found):
            if len(outcomes) == self._count:
                self.looked_up += 1
                yield i, self._assembled(outcomes)
            missing += [(i, j) for j in range(self._count) if j not in outcomes]
        calls = [{"model": j, "parameters": parameters[i]} for i, j in missing]
        for k, outcome in self._pool.run(calls):
            i, j = missing[k]
            self.runs += 1
            if self.store is not None:
                self.store.save(self._identities[j].text, parameters[i], outcome)
            found[i][j] = outcome
            if len(found[i]) == self._count:
                yield i, self._assembled(found[i])

    def _assembled(self, outcomes: dict[int, Outcome]) -> Outcome:
        return self._assemble([outcomes[j] for j in range(self._count)])

    def _stored(self, values: dict[str, float]) -> dict[int, Outcome]:
        """Return what the store has of a set of parameters, by the model's number."""
        if self.store is None:
            return {}
        texts = [identity.text for identity in self._identities]
        looked_up = ((j, self.store.look_up(text, values)) for j, text in enumerate(texts))
        return {j: outcome for j, outcome in looked_up if outcome is not None}
