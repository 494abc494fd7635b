"""What a search is about: models, objective and space, and where and how the models are run.

A search runs a problem, and so does what comes after it (the runs of `Identification.uncertainty`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from inspect import signature
from operator import itemgetter
from typing import Any

from ..._bounds import Bounds
from ...curves.inputs import Array
from ..models.identity import model_identity
from ..models.pool import Model, ModelPool
from ..objective.cases import Cases
from ..objective.criterion import Measure, criterion_of
from ..objective.objective import Objective
from ..records.store import SimulationStore, StoreOrPath
from .selection import Selection
from .simulator import Assemble, Dispatch, Simulator
from .slopes import checked_slopes
from .space import Space

__all__ = ["Problem", "models_of"]

_ONLY_OUTCOME = itemgetter(0)  # of a problem with one model, which simulates every experiment


@dataclass(frozen=True)
class Problem:
    """Models, objective and space.

    Attributes
    ----------
    models : sequence of callable
        Each is run for every set of parameters.
    assemble : callable
        Makes the simulations of the objective of what the models gave.
    objective : Objective
        What is minimised.
    space : Space
        The parameters.
    store, workers, executor
        As for `identify`.
    """

    models: Sequence[Model]
    assemble: Assemble
    objective: Objective
    space: Space
    store: StoreOrPath | None = None
    workers: int = 1
    executor: Executor | None = None

    @classmethod
    def of(
        cls, experiments: Any, bounds: Bounds, *, measure: Measure = "area", **options: Any
    ) -> Problem:
        """Return a problem whose model runs elsewhere, for a method's ``begin``.

        Parameters
        ----------
        experiments, bounds, measure, **options
            As those of :func:`curvewise.calibration.identify`.
        """
        criterion = criterion_of(measure, options, signature(cls.of).parameters)
        return cls((), _ONLY_OUTCOME, Objective(experiments, criterion), Space(bounds))

    @contextmanager
    def simulator(self) -> Iterator[Simulator]:
        """Start what runs the models, and end it."""
        if not self.models:
            raise ValueError(
                "the problem has no model: its search is driven by ask() and tell() (docs: other "
                "optimisers)"
            )
        pool = ModelPool(Dispatch(self.models), self.workers, self.executor)
        opened = nullcontext() if self.store is None else SimulationStore(self.store)
        with pool, opened as store:
            simulator = Simulator(pool, self.models, self.assemble, store)
            try:
                yield simulator
            finally:
                simulator.keep_finished()

    @property
    def has_slopes(self) -> bool:
        """Whether a model says what the derivatives of all its curves are, by its ``jacobian``."""
        return self._jacobian is not None

    @property
    def _jacobian(self) -> Callable[[dict[str, float]], Any] | None:
        is_one = bool(self.models) and self.assemble is _ONLY_OUTCOME
        found = getattr(self.models[0], "jacobian", None) if is_one else None
        return found if callable(found) else None

    def slopes(self, unit: Array) -> list[Array] | None:
        """Return the derivatives of the simulations by the place in the unit cube.

        Of shape (n, d, k), one for every experiment; None where the model has no ``jacobian``.
        Cost: one call of it, in this process.

        Raises
        ------
        ValueError
            What it returned has not the shape of such derivatives.
        """
        jacobian = self._jacobian
        if jacobian is None:
            return None
        rates = self.space.rates(unit)
        parameters = self.space.dictionary(self.space.point(unit))
        found = checked_slopes(jacobian(parameters), len(self.objective.experiments), len(rates))
        return [slopes @ rates for slopes in found]

    def identities(self) -> list[str] | None:
        """Return what the models are known by, or None where nobody has said it."""
        known = all(isinstance(getattr(model, "identity", None), str) for model in self.models)
        if self.store is None and not known:
            return None
        version = None if self.store is None else SimulationStore(self.store).version
        return [model_identity(model, version).text for model in self.models]


def models_of(model: Any) -> tuple[Sequence[Model], Assemble]:
    """Return the models behind what a user, or a cross-validation, calls the model."""
    if isinstance(model, Cases):
        return model.models, model.assembled
    if isinstance(model, Selection):
        return (model.whole,), model.assembled
    return (model,), _ONLY_OUTCOME
