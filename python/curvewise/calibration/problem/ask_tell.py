"""Ask-and-tell interface: the caller runs the model and reports the results.

It serves queues, libEnsemble, optimagic and other programs that run models themselves. `ask`
returns the current batch of a method's course and the points that the course is known to request
next. The course continues when all runs of the batch have been reported. Evaluations are numbered
in the order in which the course requests them. The answer therefore depends neither on the order of
arrival nor on the number of pending runs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ..models.pool import Outcome
from ..records.evaluation import Evaluation, Point, as_records
from .endings import judged_end
from .ledger import Course, Finish, Ledger, SearchEndedError

__all__ = ["Answer", "OpenSearch"]


@dataclass(frozen=True, eq=False)
class Answer:
    """Result of an ask-and-tell search.

    Attributes
    ----------
    parameters : dict of str to float
        The best parameters found.
    value : float
        The objective there.
    simulations : object
        The simulations reported for these parameters.
    converged : bool
        True if the method met its tolerances and no unintended bound stopped it.
    message : str
        Reason why the search ended.
    history : numpy.recarray
        Every evaluation: its number, the parameters, value, failed and seconds.
    """

    parameters: dict[str, float]
    value: float
    simulations: Any = field(repr=False)
    converged: bool
    message: str
    history: np.recarray[Any, Any] = field(repr=False)


class OpenSearch:
    """A running search with ``ask`` and ``tell``, as ``begin`` of a method returns it.

    Attributes
    ----------
    ended : bool
        Whether the search has ended; if so, `answer` is available and nothing more is requested.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import Problem, TrustRegion
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x + p["intercept"]))
    >>> experiment = line({"slope": 2.0, "intercept": 1.0})
    >>> problem = Problem.of(experiment, {"slope": (0, 9), "intercept": (-5, 5)})
    >>> search = TrustRegion().begin(problem)
    >>> while not search.ended:
    ...     for parameters in reversed(search.ask()):  # in any order
    ...         search.tell(parameters, line(parameters))
    >>> round(search.answer().parameters["slope"], 3)
    2.0
    """

    def __init__(self, course: Course, ledger: Ledger) -> None:
        self._course, self._ledger = course, ledger
        self._units: Array | None = None
        self._batch: list[Point] = []
        self._out: set[Point] = set()
        self._told: dict[Point, tuple[Evaluation, Any]] = {}
        self._finish: Finish | None = None
        self._advance()

    @property
    def ended(self) -> bool:
        """Whether the answer is available, and nothing more is requested."""
        return self._finish is not None

    def ask(self) -> list[dict[str, float]]:
        """Return the parameter sets to run next, at the same time if you like.

        Each set is returned once. An empty list means that pending sets must be reported first.
        """
        new = [p for p in self._wanted if p not in self._out and p not in self._told]
        self._out.update(new)
        return [self._ledger.space.dictionary(point) for point in new]

    def out(self) -> list[dict[str, float]]:
        """Return the parameter sets that have been asked and not been told, to run them again."""
        return [self._ledger.space.dictionary(p) for p in self._wanted if p in self._out]

    def tell(
        self,
        parameters: Mapping[str, float],
        simulations: Any = None,
        *,
        message: str = "",
        seconds: float = 0.0,
    ) -> None:
        """Report the result of a run.

        Parameters
        ----------
        parameters : mapping of str to float
            The parameters as `ask` returned them.
        simulations : array_like, shape (n, d), or sequence of such
            The curves, one for each experiment. None marks a failed run.
        message : str, optional
            Reason for the failure.
        seconds : float, optional
            Run time, recorded in the history.

        Raises
        ------
        ValueError
            If the parameters have not been requested, or the simulations do not fit the
            experiments.
        RuntimeError
            If no simulation of the first batch has succeeded.
        """
        point = self._point(parameters)
        if point not in self._out:
            raise ValueError(
                f"{dict(parameters)} are not out: tell each set that ask() returns once, with the "
                "same numbers"
            )
        outcome = Outcome(simulations, message, seconds)
        place = self._wanted.index(point)
        self._told[point] = self._ledger.judged(place, point, outcome), simulations
        self._out.remove(point)
        self._advance()

    def answer(self) -> Answer:
        """Return the best result of an ended search.

        Raises
        ------
        RuntimeError
            If the search has not ended.
        """
        if self._finish is None:
            raise RuntimeError(
                "the search has not ended; ask() and tell() go on until `ended` is true"
            )
        ledger, best = self._ledger, self._ledger.best
        return Answer(
            ledger.space.dictionary(best.point),
            best.value,
            ledger.best_simulations(),
            self._finish.converged,
            self._finish.message,
            as_records(ledger.done, ledger.space.names),
        )

    def _point(self, parameters: Mapping[str, float]) -> Point:
        names = self._ledger.space.names
        if lacking := [name for name in names if name not in parameters]:
            raise ValueError(
                f"told of a run without {', '.join(lacking)}; tell what ask() returned"
            )
        return tuple(float(parameters[name]) for name in names)

    @property
    def _wanted(self) -> list[Point]:
        """The batch, and what the course will ask for after it, in the order of evaluations."""
        return list(dict.fromkeys((*self._batch, *self._ledger.expected)))

    def _advance(self) -> None:
        """Advance to the next batch with unreported runs, or to the end."""
        try:
            while all(point in self._told for point in self._batch):
                told, self._batch = [self._told.pop(point) for point in self._batch], []
                if told:
                    self._ledger.add(told)
                if self._units is None:
                    self._units = next(self._course)
                else:
                    self._units = self._course.send(self._ledger.known(self._units))
                self._batch = self._ledger.missing(self._units)
        except StopIteration as end:
            self._end(end.value)
        except SearchEndedError as end:
            self._end(Finish(False, str(end), reason=str(end)))
            self._course.close()

    def _end(self, finish: Finish) -> None:
        self._finish = judged_end(finish, self._ledger, self._ledger.best_simulations())
