"""The problem of a search: objective, space and model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from inspect import signature
from typing import Any

from ..._bounds import Bounds
from ...curves.inputs import Array
from ..models.forward import ForwardModel
from ..models.pool import Model
from ..objective.criterion import Measure, criterion_of
from ..objective.objective import Objective
from .space import Space

__all__ = ["Problem"]


@dataclass(frozen=True)
class Problem:
    """Objective, space and model.

    Attributes
    ----------
    objective : Objective
        The function to minimise.
    space : Space
        The parameters.
    model : ForwardModel or None
        Simulates the experiments; None if the model runs elsewhere.
    """

    objective: Objective
    space: Space
    model: ForwardModel | None = None

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
        return cls(Objective(experiments, criterion), Space(bounds))

    @property
    def callables(self) -> Sequence[Model]:
        """The functions of the model; empty if it runs elsewhere."""
        return () if self.model is None else self.model.callables

    @property
    def has_slopes(self) -> bool:
        """Whether the model gives the derivatives of all its curves, by ``jacobian``."""
        return self.model is not None and self.model.has_slopes

    def slopes(self, unit: Array) -> list[Array] | None:
        """Return the derivatives of the simulations with respect to the unit cube.

        The shape is (n, d, k) for every experiment. The result is None if the derivatives at this
        place are unknown. Cost: one call of each ``jacobian``, in this process.

        Raises
        ------
        ValueError
            If a ``jacobian`` returns arrays of other shapes, or numbers that are not finite.
        """
        if self.model is None or not self.model.has_slopes:
            return None
        parameters = self.space.dictionary(self.space.point(unit))
        return self.model.slopes(parameters, self.space.rates(unit))
