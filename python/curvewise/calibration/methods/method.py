"""The base record of all search methods.

A method is a frozen dataclass of its options, checked when it is made. Python refuses a class
without one of the record's keywords, and an object of a class without one of its functions.
"""

from __future__ import annotations

import inspect
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, TypeVar

import numpy as np

from ..._names import did_you_mean
from ...curves.inputs import Array
from ..objective.criterion import LEAST_SQUARES, Measure
from ..objective.objective import Objective
from ..problem.ask_tell import OpenSearch
from ..problem.ledger import Course, Ledger
from ..problem.problem import Problem

__all__ = [
    "NEAR",
    "Method",
    "check_passed_on",
    "options_of",
    "refuse_unknown",
    "taken_by",
    "with_other_defaults",
]

NEAR = 0.1  # size of the first region for a start near the optimum, of the bounds' range


@dataclass(frozen=True, kw_only=True, repr=False)
class Method(ABC):
    """A way to search; each class is a frozen dataclass of options, which all have defaults."""

    name: ClassVar[str]  # in texts, such as "trust-region"
    keeps_curves: ClassVar[bool]  # whether it learns from the curves of its runs, not values alone
    needs_squares: ClassVar[bool]  # whether it takes only measures that are sums of squares

    def __init_subclass__(cls, *, name: str, keeps_curves: bool, needs_squares: bool) -> None:
        super().__init_subclass__()
        cls.name, cls.keeps_curves, cls.needs_squares = name, keeps_curves, needs_squares

    @abstractmethod
    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Yield batches of points of the unit cube and take their evaluations; return the end.

        The ledger has the evaluations so far and the objective. The start, shape (k,), is a point
        of the unit cube if one is given.
        """

    @abstractmethod
    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return how many runs the search takes at least: its first designs, and one step."""

    def near_optimum(self) -> Method:
        """Return the same method for a start near the optimum, where another measure has ended."""
        return self

    def closer(self) -> Method | None:
        """Return this method with smaller tolerances, to continue from its end; None if useless."""
        return None

    def staged(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Return the course as a stage of a search, with its name and settings."""
        ledger.begin_stage(self.name, keeps_curves=self.keeps_curves)
        return self.course(ledger, start, seed)

    def begin(
        self,
        problem: Problem,
        *,
        seed: int = 0,
        start: Mapping[str, float] | None = None,
        max_runs: int | None = None,
    ) -> OpenSearch:
        """Begin an ask-and-tell search, driven by the caller.

        Parameters
        ----------
        problem : Problem
            The problem, with experiments and bounds; its models, if any, are not run.
        seed, start, max_runs
            As those of :func:`curvewise.calibration.identify`.

        Raises
        ------
        ValueError
            If the start lies outside the bounds, or the method does not support the measure.
        """
        for measure in problem.objective.measures:
            self.check(measure)
        unit = None if start is None else problem.space.unit(start)
        ledger = Ledger(problem, limit=max_runs)
        return OpenSearch(self.staged(ledger, unit, seed), ledger)

    def chosen_for(self, objective: Objective) -> Method:
        """Return the method itself; :class:`Auto` returns the method that it chooses."""
        return self

    def check(self, measure: Measure) -> None:
        """Refuse a measure with which the method does not go."""
        if self.needs_squares and measure not in LEAST_SQUARES:
            raise ValueError(
                f"measure {measure!r} is not a sum of squares; method {str(self)!r} needs "
                f"measure={' or '.join(map(repr, LEAST_SQUARES))}"
            )

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        """Return the call that creates it, equal in every process."""
        given = [f"{name}={_code(getattr(self, name))}" for name in _changed(self)]
        return f"{type(self).__name__}({', '.join(given)})"


M = TypeVar("M", bound=Method)


def with_other_defaults(method: M, **options: Any) -> M:
    """Return the method with other options, except for user-defined ones."""
    changed = _changed(method)
    return replace(method, **{n: v for n, v in options.items() if n not in changed})


def options_of(method: Method) -> list[str]:
    """Return the names of a method's options."""
    return [field.name for field in fields(method)]


def _changed(method: Method) -> list[str]:
    """Return the options that differ from their defaults."""
    plain = type(method)()
    return [name for name in options_of(method) if getattr(method, name) != getattr(plain, name)]


def _code(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key!r}: {_code(item)}" for key, item in value.items()) + "}"
    if isinstance(value, np.ndarray):  # whose own text leaves out the middle
        value = value.tolist()
    return str(getattr(value, "__qualname__", None) or repr(value))


def refuse_unknown(method: str, given: Iterable[str], known: Collection[str]) -> None:
    """Refuse unknown options of a method, with close matches."""
    if unknown := sorted(set(given) - set(known)):
        raise ValueError(
            f"method {method!r} has no option {', '.join(unknown)}; "
            f"it has {', '.join(known)}{did_you_mean(unknown, known)}"
        )


def check_passed_on(method: Method, options: Mapping[str, Any], known: Iterable[str]) -> None:
    """Refuse what the library that a method passes options on to does not have."""
    own = [name for name in options_of(method) if name != "options"]
    if misplaced := [name for name in own if name in options]:
        raise ValueError(
            f"options has {', '.join(misplaced)}; give it to {type(method).__name__} itself"
        )
    refuse_unknown(method.name, options, [*own, *known])


def taken_by(function: Callable[..., Any], but: Collection[str] = ()) -> list[str]:
    """Return the names of a function's parameters, except for some."""
    return [name for name in inspect.signature(function).parameters if name not in but]
