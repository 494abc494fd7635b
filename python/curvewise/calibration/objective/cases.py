"""Several tests of different kinds in one identification: curves and single numbers.

A case is a test with a model of its own, a measure and a weight. What is minimised is the sum of
the cases, each in units of its noise if that is given: a case whose simulation is off by its sigma
everywhere counts 1. Cost: that of the models; cases with the same model share its runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np

from ...curves.several_curves import curve_list, points_of
from ..models.pool import Model, Outcome
from .criterion import Measure, criterion_of
from .objective import Objective
from .terms import CurveTerm, Label, NumberTerm, Term

__all__ = ["Case", "Cases"]


@dataclass(frozen=True, eq=False)
class Case:
    """One test, with what simulates it and how the two are compared.

    Parameters
    ----------
    name : str
        What messages and tables call it.
    model : callable
        ``model(parameters) -> curve`` or number. Cases with the same object share its runs.
    experiment : array_like, shape (n, d), or float
        The measured curve, or a number such as an ultimate strength.
    measure : str, callable or Criterion, default "area"
        As for :class:`Objective`; the options of a measure are given by a :class:`Criterion`. Of a
        number: "sum_of_squares" squares the difference, every other measure takes it as it is; in
        units of `sigma`, or else of the number itself.
    weight : float, default 1
        A factor.
    sigma : float, optional
        The standard deviation of the noise in y. The case then counts in its units:
        "sum_of_squares" is the sum of (difference / sigma)², every other measure is divided by
        what it is for a simulation that is off by sigma everywhere.
    response : callable, optional
        ``response(curve) -> curve`` or number: what of the model's curve is compared, e.g. its
        largest stress. It is given a list where the model returns several curves.

    Raises
    ------
    ValueError
        When the case is used: as for :class:`Objective`; a weight below 0, a sigma not above 0.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import Case, identify
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["a"] * x + p["b"]))
    >>> test = line({"a": 2.0, "b": 1.0})[:10]
    >>> cases = [
    ...     Case("line", line, test, response=lambda curve: curve[:10], sigma=0.1),
    ...     Case("end", line, 3.0, response=lambda curve: curve[-1, 1], sigma=0.05),
    ... ]
    >>> found = identify(cases, bounds={"a": (0, 10), "b": (-5, 5)}, progress=False)
    >>> round(found.parameters["a"], 2), round(found.parameters["b"], 2)
    (2.0, 1.0)
    """

    name: str
    model: Model
    experiment: Any
    _: KW_ONLY
    measure: Measure = "area"
    weight: float = 1.0
    sigma: float | None = None
    response: Callable[[Any], Any] | None = None

    def term(self) -> Term:
        """Return what the case adds to an objective."""
        called = f"case {self.name!r}"
        if not math.isfinite(self.weight) or self.weight < 0:
            raise ValueError(f"{called}: weight is {self.weight}; it must not be negative")
        if self.sigma is not None and not 0.0 < self.sigma < math.inf:
            raise ValueError(f"{called}: sigma is {self.sigma}; it must be above 0")
        try:
            criterion = criterion_of(self.measure, {})
        except ValueError as error:
            raise ValueError(f"{called}: {error}") from error
        if criterion.weights is not None:
            raise ValueError(f"{called}: its Criterion has weights; give the case a weight")
        label = Label(self.name, called, f"{called}: ")
        if np.ndim(self.experiment) == 0 or np.shape(self.experiment) == (1, 1):
            return NumberTerm(self.experiment, criterion, label, self.weight, self.sigma)
        (curve,) = curve_list(self.experiment)
        return CurveTerm(curve, criterion, label, self.weight, self.sigma)


class Cases:
    """Several cases: their objective, their models, and how the outcomes of these become one.

    Parameters
    ----------
    cases : sequence of Case
        At least one, with different names.
    """

    def __init__(self, cases: Sequence[Case]) -> None:
        names = [case.name for case in cases]
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"two cases are called {name!r}; rename one")
        self.cases = tuple(cases)
        models = {id(case.model): case.model for case in cases}
        self.models: list[Model] = list(models.values())
        self._places = [list(models).index(id(case.model)) for case in cases]

    def objective(self) -> Objective:
        """Return the weighted sum over the cases."""
        return Objective.of_terms([case.term() for case in self.cases])

    def assembled(self, outcomes: list[Outcome]) -> Outcome:
        """Return a simulation for every case; an exception in the place of one that failed."""
        seconds = sum(outcome.seconds for outcome in outcomes)
        simulations = [
            _response(case, outcomes[place])
            for case, place in zip(self.cases, self._places, strict=True)
        ]
        return Outcome(simulations, "", seconds)


def _response(case: Case, outcome: Outcome) -> Any:
    """Return what of an outcome a case compares, or why there is nothing."""
    if outcome.message:
        return RuntimeError(outcome.message)
    result = outcome.simulations
    if case.response is not None and result is not None:
        try:
            curves = points_of([[[result]]] if _is_number(result) else result)
            result = case.response(curves[0] if len(curves) == 1 else list(curves))
        except Exception as error:  # whatever the user's function stumbles over
            return RuntimeError(f"response: {type(error).__name__}: {error}")
    if result is None:
        return None
    if _is_number(result):
        return np.array([[float(result)]])
    curves = points_of(result)
    if len(curves) != 1:
        raise ValueError(
            f"case {case.name!r}: the model returned {len(curves)} curves; give a response that "
            "picks one, or a case for each"
        )
    return curves[0]


def _is_number(result: Any) -> bool:
    """Return whether a model or a response gave one number; a list holds curves, of any lengths."""
    return not isinstance(result, (list, tuple)) and np.ndim(result) == 0
