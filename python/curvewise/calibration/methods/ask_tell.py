"""A search that somebody else drives: it is asked what to run, and told what came of it.

For queues, libEnsemble, optimagic and whatever else runs models by itself. Every method can be
driven so, since every method is a course: what is asked is a batch of the course, with what it is
known to ask for next, and once all of the batch has been told the course goes on. Evaluations count
in the order in which the course asks, so the answer depends neither on the order of arrival nor on
how many runs were out at once. Cost: that of the method.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ..models.pool import Outcome
from ..problem.ledger import Course, Finish, Ledger, SearchEndedError
from ..records.evaluation import Evaluation, Point, as_records
from .endings import judged_end

__all__ = ["Answer", "OpenSearch"]


@dataclass(frozen=True, eq=False)
class Answer:
    """What a search that was driven from outside has found.

    Attributes
    ----------
    parameters : dict of str to float
        The best parameters found.
    value : float
        The objective there.
    simulations : object
        What was told of them.
    converged : bool
        Whether the method met its tolerances, and no bound that was not meant stopped it.
    message : str
        How the search ended.
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
    """A search under way, driven by whoever asks and tells; made by a method's ``begin``.

    Attributes
    ----------
    ended : bool
        Whether the answer is there, and nothing more is asked.

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
        """Whether the answer is there, and nothing more is asked."""
        return self._finish is not None

    def ask(self) -> list[dict[str, float]]:
        """Return the parameter sets to run next, at the same time if you like.

        Each set is returned once. An empty list means that others are out, which have to be told
        before there is more to ask.
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
        """Tell what came of a run.

        Parameters
        ----------
        parameters : mapping of str to float
            As they were asked.
        simulations : array_like, shape (n, d), or sequence of such
            The curves, one for every experiment. None means that the run has failed.
        message : str, optional
            Why it has failed.
        seconds : float, optional
            How long it took, for the history.

        Raises
        ------
        ValueError
            Parameters that are not out; simulations that do not fit the experiments.
        RuntimeError
            No simulation of the first batch has succeeded.
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
        """Return what has been found.

        Raises
        ------
        RuntimeError
            The search has not ended.
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
            *self._finish,
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
        """Go on to the next batch of which something has not been told, or to the end."""
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
            self._end(Finish(False, str(end)))
            self._course.close()

    def _end(self, finish: Finish) -> None:
        self._finish = judged_end(finish, self._ledger, self._ledger.best_simulations())
