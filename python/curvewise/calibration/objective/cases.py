"""Several tests of different kinds in one identification: curves and single numbers.

A case is a test with its own model, measure and weight. The objective is the sum of the cases, each
in units of its noise if that is given: a case whose simulation deviates by its sigma everywhere
counts 1. Cost: that of the models; cases with the same model share its runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ...curves.several_curves import curve_list, points_of
from ..models.forward import ForwardModel, curve_slopes
from ..models.pool import Model, Outcome
from .criterion import Measure, criterion_of
from .objective import Objective
from .terms import CurveTerm, Label, NumberTerm, Term

__all__ = ["Case", "Cases"]

# Steps along the derivatives of a model's curves, as parts of the bounds' ranges. A response that
# changes by the wide one alone is a step function (the strain of the highest point, say), whose
# derivative is of no use.
_DIFFERENCE, _WIDE = 1e-6, 0.1


@dataclass(frozen=True, eq=False)
class Case:
    """One test with its model, measure and weight.

    Parameters
    ----------
    name : str
        The name in messages and tables.
    model : callable
        ``model(parameters) -> curve`` or number. Cases with the same object share its runs. If
        every case's model has a ``jacobian(parameters)``, the search uses its derivatives instead
        of runs.
    experiment : array_like, shape (n, d), or float
        The measured curve, or a number such as an ultimate strength.
    measure : str, callable or Criterion, default "area"
        As for :class:`Objective`; use a :class:`Criterion` to set options of a measure. For a
        number, "sum_of_squares" squares the difference, and every other measure takes its absolute
        value; in units of `sigma`, or else of the number itself.
    weight : float, default 1
        A factor of the term.
    sigma : float, optional
        The standard deviation of the noise in y, as the unit of the case. "sum_of_squares" becomes
        the sum of (difference / sigma)². Every other measure is divided by its value for a
        simulation that deviates by sigma everywhere.
    response : callable, optional
        ``response(curve) -> curve`` or number: the quantity to compare, computed from the model's
        curve, e.g. its largest stress. The argument is a list if the model returns several curves.

    Raises
    ------
    ValueError
        If the weight is negative, or sigma is not positive; when the case is used, as for
        :class:`Objective`.

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


class Cases(ForwardModel):
    """Several cases: their objective, their models, and how the outcomes of these become one.

    Derivatives go through a response by differences along the derivatives of the model's curves,
    from one more call of the model, in this process.

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
        self._models = tuple(models.values())
        self._places = [list(models).index(id(case.model)) for case in cases]

    @property
    def callables(self) -> Sequence[Model]:
        """The models, each of them once."""
        return self._models

    def objective(self) -> Objective:
        """Return the weighted sum over the cases."""
        return Objective.of_terms([case.term() for case in self.cases])

    def assembled(self, outcomes: list[Outcome]) -> Outcome:
        """Return a simulation for every case; an exception replaces a failed one."""
        seconds = sum(outcome.seconds for outcome in outcomes)
        simulations = [
            _response(case, outcomes[place])
            for case, place in zip(self.cases, self._places, strict=True)
        ]
        return Outcome(simulations, "", seconds)

    def slopes(self, parameters: Mapping[str, float], rates: Array) -> list[Array] | None:
        """Return the derivatives of all cases' simulations; None if one is unknown."""
        places = range(len(self._models))
        by_model = [self._slopes_of_model(place, parameters, rates) for place in places]
        pairs = zip(self.cases, self._places, strict=True)
        found = [_slopes_of_case(case, *by_model[place]) for case, place in pairs]
        known = [slopes for slopes in found if slopes is not None]
        return known if len(known) == len(found) else None

    def _slopes_of_model(
        self, place: int, parameters: Mapping[str, float], rates: Array
    ) -> tuple[Sequence[Array], list[Array] | None]:
        """Return a model's curves, if a response needs them, and derivatives."""
        model, count = self._models[place], 1
        curves: Sequence[Array] = ()
        asking = zip(self.cases, self._places, strict=True)
        if any(case.response is not None and at == place for case, at in asking):
            try:
                curves = _curves(model(dict(parameters)))
            except Exception:  # a failed run does not have derivatives
                return (), None
            count = len(curves)
        return curves, curve_slopes(model, parameters, rates, count) if count else None


def _response(case: Case, outcome: Outcome) -> Any:
    """Return the part of an outcome that a case compares, or the error."""
    if outcome.message:
        return RuntimeError(outcome.message)
    result = outcome.simulations
    if case.response is not None and result is not None:
        try:
            curves = _curves(result)
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


def _slopes_of_case(
    case: Case, curves: Sequence[Array], slopes: list[Array] | None
) -> Array | None:
    """Return the derivatives of what a case compares, by those of its model's curves."""
    if slopes is None:
        return None
    if case.response is None:
        return slopes[0]
    if [one.shape[:2] for one in slopes] != [curve.shape for curve in curves]:
        return None
    found = _differences(case, curves, slopes, _DIFFERENCE)
    if found is None or found.any():
        return found
    wide = _differences(case, curves, slopes, _WIDE)
    return None if wide is None or wide.any() else found


def _differences(
    case: Case, curves: Sequence[Array], slopes: Sequence[Array], step: float
) -> Array | None:
    """Return the derivatives of a response; None if its value is missing."""
    columns = []
    for move in zip(*(np.moveaxis(one, -1, 0) for one in slopes), strict=True):
        ahead, behind = (
            _response(case, Outcome([c + by * m for c, m in zip(curves, move, strict=True)], "", 0))
            for by in (step, -step)
        )
        if np.shape(ahead) != np.shape(behind) or not np.shape(ahead):  # an exception, or None
            return None
        columns.append((ahead - behind) / (2.0 * step))
    alike = all(column.shape == columns[0].shape for column in columns)
    return np.stack(columns, axis=-1) if alike else None


def _curves(result: Any) -> tuple[Array, ...]:
    """Return what a model gave as curves; a number as one of one point."""
    return points_of([[[result]]] if _is_number(result) else result)


def _is_number(result: Any) -> bool:
    """Return whether a model or a response gave one number; a list holds curves, of any lengths."""
    return not isinstance(result, (list, tuple)) and np.ndim(result) == 0
