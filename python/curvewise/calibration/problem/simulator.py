"""Runs the models of a problem, or reads their runs from a store.

A problem has one model, or several (one for each kind of test). Every set of parameters needs a run
of each model. Runs in the store are read from it, the others go to the pool. A set is complete when
all of its runs are. Cost: that of the models; reading a stored run takes about 50 microseconds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

from ..models.forward import ForwardModel
from ..models.identity import ModelIdentity, model_identity
from ..models.pool import Model, ModelPool, Outcome
from ..records.store import SimulationStore

__all__ = ["Dispatch", "Simulator"]

_Run: TypeAlias = tuple[int, tuple[float, ...]]  # a model's number, and its parameters


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
    """The models as a function of parameters; no run is repeated.

    Parameters
    ----------
    pool : ModelPool
        Runs a `Dispatch` of the model's functions.
    model : ForwardModel
        The functions, and the rule that combines their outcomes.
    store : SimulationStore, optional
        The store from which runs are read, and in which they are saved.

    Attributes
    ----------
    store
        As given.
    runs, looked_up : int
        The number of model runs made by this simulator, and the number of parameter sets read from
        the store.
    """

    def __init__(
        self,
        pool: ModelPool,
        model: ForwardModel,
        store: SimulationStore | None = None,
    ) -> None:
        self._pool, self._model, self.store = pool, model, store
        self._count = len(model.callables)
        self._identities: list[ModelIdentity] = []
        if store is not None:
            self._identities = [model_identity(one, store.version) for one in model.callables]
            for identity in self._identities:
                store.register(identity)
        self.runs = self.looked_up = 0
        # outcomes of early runs that no course has requested yet
        self._early: dict[_Run, Outcome] = {}

    @property
    def is_parallel(self) -> bool:
        """Whether several runs may be made at the same time."""
        return self._pool.is_parallel

    def begin(self, parameters: Sequence[dict[str, float]]) -> None:
        """Start runs that will be requested, if processes are free."""
        for values in parameters:
            known = self._known(values)
            self._early |= {_run(self._call(j, values)): known[j] for j in known}
            self._pool.begin(self._call(j, values) for j in range(self._count) if j not in known)

    def run(self, parameters: Sequence[dict[str, float]]) -> Iterator[tuple[int, Outcome]]:
        """Yield index and outcome of every dict, those that are known first."""
        found = [self._known(values) for values in parameters]
        missing: dict[_Run, list[int]] = {}
        calls = []
        for i, outcomes in enumerate(found):
            if len(outcomes) == self._count:
                yield i, self._assembled(outcomes)
            for j in range(self._count):
                if j not in outcomes:
                    calls.append(self._call(j, parameters[i]))
                    missing.setdefault(_run(calls[-1]), []).append(i)
        for call, outcome in self._pool.run(calls):
            self._keep(call, outcome)
            if waiting := missing.get(_run(call)):
                i = waiting.pop(0)
                found[i][call["model"]] = self._early.pop(_run(call))
                if len(found[i]) == self._count:
                    yield i, self._assembled(found[i])

    def keep_finished(self) -> None:
        """Save early runs that have finished but have not been requested yet."""
        for call, outcome in self._pool.finished():
            self._keep(call, outcome)

    def _keep(self, call: dict[str, Any], outcome: Outcome) -> None:
        self.runs += 1
        self._early[_run(call)] = outcome
        if self.store is not None:
            text = self._identities[call["model"]].text
            self.store.save(text, call["parameters"], outcome)

    def _call(self, j: int, parameters: dict[str, float]) -> dict[str, Any]:
        return {"model": j, "parameters": parameters}

    def _assembled(self, outcomes: dict[int, Outcome]) -> Outcome:
        return self._model.assembled([outcomes[j] for j in range(self._count)])

    def _known(self, values: dict[str, float]) -> dict[int, Outcome]:
        """Return the known outcomes for a set of parameters, by the model's number."""
        runs = {j: _run(self._call(j, values)) for j in range(self._count)}
        early = {j: self._early.pop(run) for j, run in runs.items() if run in self._early}
        if self.store is None or len(early) == self._count:
            return early
        texts = [identity.text for identity in self._identities]
        looked_up = ((j, self.store.look_up(text, values)) for j, text in enumerate(texts))
        stored = {j: outcome for j, outcome in looked_up if outcome is not None}
        self.looked_up += len(stored) == self._count
        return stored | early


def _run(call: dict[str, Any]) -> _Run:
    return call["model"], tuple(call["parameters"].values())
