"""Several tests of different kinds in one identification: curves and single numbers.

A case is a test with a model of its own, a measure and a weight. What is minimised is the sum of
the cases, each in units of its noise if that is given: a case whose simulation is off by its sigma
everywhere counts 1. Cost: that of the models; cases with the same model share its runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..._options import Preset
from ...curves.inputs import Array
from ...curves.several_curves import as_points, curve_list, points_of
from ..models.pool import Model, Outcome
from .loop import FailedSimulationError, Loop
from .loop_measure import Measure, Part, check_part, condition_of, measure_name
from .objective import LEAST_SQUARES, MEASURES, Objective

__all__ = ["Case", "CaseObjective", "Cases"]


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
    measure : str or callable, default "area"
        As for :class:`Objective`. Of a number: "sum_of_squares" squares the difference, every
        other measure takes it as it is; in units of `sigma`, or else of the number itself.
    weight : float, default 1
        A factor.
    sigma : float, optional
        The standard deviation of the noise in y. The case then counts in its units:
        "sum_of_squares" is the sum of (difference / sigma)², every other measure is divided by
        what it is for a simulation that is off by sigma everywhere.
    response : callable, optional
        ``response(curve) -> curve`` or number: what of the model's curve is compared, e.g. its
        largest stress. It is given a list where the model returns several curves.
    preset, min_coverage, part, options
        As for :class:`Objective`; options as a mapping.

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
    measure: Measure = "area"
    weight: float = 1.0
    sigma: float | None = None
    response: Callable[[Any], Any] | None = None
    preset: Preset = "scaled"
    min_coverage: float = 0.5
    part: Part = "experiment"
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def is_number(self) -> bool:
        """Whether the experiment is a number, and no curve."""
        return np.ndim(self.experiment) == 0 or np.shape(self.experiment) == (1, 1)


class Cases:
    """The models of several cases, and how their outcomes become one.

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
        self.models: list[Model] = []
        self._places = []
        for case in cases:
            known = [i for i, model in enumerate(self.models) if model is case.model]
            if not known:
                self.models.append(case.model)
            self._places.append(known[0] if known else len(self.models) - 1)

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


class CaseObjective(Objective):
    """The weighted sum over cases, with a measure for each; see :class:`Objective`.

    Parameters
    ----------
    cases : sequence of Case
    """

    def __init__(self, cases: Sequence[Case]) -> None:
        self.cases = tuple(cases)
        names = list(dict.fromkeys(measure_name(case.measure) for case in cases))
        self.measure = " + ".join(names)
        self.preset: Preset = "scaled"
        self.options: dict[str, Any] = {}
        self.min_coverage, self.part = 0.0, "experiment"
        self.condition = None  # there is one for each case
        self.failures = 0
        self._loops = [_loop(case) for case in cases]
        self._has_residuals = all(case.measure in LEAST_SQUARES for case in cases)
        self.experiments = tuple(loop.experiment for loop in self._loops)
        self.weights = np.array(
            [_weight(case, loop) for case, loop in zip(cases, self._loops, strict=True)]
        )
        self.scales = np.array([loop.scale for loop in self._loops])
        self.failure_value = 1e6 * self.scales

    @property
    def is_least_squares(self) -> bool:
        """Whether the value is a sum of squares of `residuals`."""
        return all(case.measure == "sum_of_squares" for case in self.cases)

    @property
    def titles(self) -> list[str]:
        """What the loops are called: the names of the cases."""
        return [case.name for case in self.cases]

    @property
    def sigmas(self) -> list[float | None]:
        """The noise of each case, where it is given."""
        return [case.sigma for case in self.cases]

    def of_other_tests(self, experiments: Sequence[Array]) -> CaseObjective:
        """Return the same objective of other experiments, one for each case."""
        pairs = zip(self.cases, experiments, strict=True)
        return CaseObjective([replace(case, experiment=other) for case, other in pairs])

    def by_measure(self, simulations: Any) -> dict[str, float]:
        """Return the term of every case, by its name and with its weight; nan where it failed."""
        score = self.predicted(simulations)
        failed = score.terms >= self.failure_value
        values = np.where(failed, np.nan, self.weights * score.terms)
        return dict(zip([case.name for case in self.cases], values.tolist(), strict=True))

    def _located(self, message: str, i: int) -> str:
        return f"case {self.cases[i].name!r}: {message}"


def _loop(case: Case) -> Any:
    if not math.isfinite(case.weight) or case.weight < 0:
        raise ValueError(f"case {case.name!r}: weight is {case.weight}; it must not be negative")
    if case.sigma is not None and not 0.0 < case.sigma < math.inf:
        raise ValueError(f"case {case.name!r}: sigma is {case.sigma}; it must be above 0")
    if case.is_number:
        return _Number(case)
    if not callable(case.measure) and case.measure not in MEASURES:
        raise ValueError(
            f"case {case.name!r}: unknown measure {case.measure!r}; "
            f"choose from {', '.join(MEASURES)}"
        )
    condition = condition_of(case.preset, case.measure)
    options = {**condition.options, **case.options}
    check_part(case.part, case.measure, options)
    (curve,) = curve_list(case.experiment)
    name = f"case {case.name!r}"
    return Loop(curve, name, case.measure, condition.scaled, options, case.part, case.min_coverage)


def _weight(case: Case, loop: Any) -> float:
    """Return the factor of a case: in units of its noise, if that is given."""
    if case.sigma is None or isinstance(loop, _Number):
        return case.weight
    if case.measure == "sum_of_squares":
        return case.weight * float(loop.height / case.sigma) ** 2
    return case.weight / float(loop.of_move(case.sigma))


class _Number:
    """A number as an experiment: a loop of one point."""

    residual_count = 1
    scale = 1.0
    y = 0
    names: tuple[str, ...] = ()
    has_gradient = can_be_thinned = True

    def __init__(self, case: Case) -> None:
        self.experiment = np.array(case.experiment, dtype=np.float64).reshape(1, 1)
        self._target = float(self.experiment[0, 0])
        if not math.isfinite(self._target):
            raise ValueError(f"case {case.name!r}: the experiment is {self._target}")
        self._unit = case.sigma or abs(self._target) or 1.0
        self.height = self._unit
        self.extent = np.array([abs(self._target) or 1.0])
        self._is_squared = case.measure == "sum_of_squares"

    def value(self, simulation: Any) -> float:
        """Return the difference, or its square, in units of sigma or of the number."""
        difference = float(self.residuals(simulation)[0])
        return difference**2 if self._is_squared else abs(difference)

    def value_and_gradient(self, simulation: Any) -> tuple[float, Array]:
        """Return the value and its derivative by the number."""
        difference = float(self.residuals(simulation)[0])
        if self._is_squared:
            return difference**2, np.array([[2.0 * difference / self._unit]])
        return abs(difference), np.array([[np.sign(difference) / self._unit]])

    def residuals(self, simulation: Any) -> Array:
        """Return the difference."""
        if simulation is None or isinstance(simulation, BaseException):
            raise FailedSimulationError(str(simulation) if simulation else "no simulation")
        value = as_points(simulation, "Q")
        if value.size != 1:
            raise ValueError(
                f"a simulation has shape {value.shape} and its experiment is a number; "
                "give the case a response"
            )
        if not np.isfinite(value).all():
            raise FailedSimulationError(f"the simulation is {value[0, 0]}")
        return np.array([(float(value[0, 0]) - self._target) / self._unit])
