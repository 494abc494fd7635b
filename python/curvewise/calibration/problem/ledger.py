"""The ledger of a search: its evaluated points, and the best one.

A method is a course (`Course`): it yields a batch of points and receives their evaluations, in the
same order. In between, the models are run by this package (`evaluations`) or by the caller of an
ask-and-tell search (`ask_tell`). Both write into this ledger, which numbers evaluations in
the order of the batches. Nothing that a method sees therefore depends on who ran which point, or on
which run finished first.
"""

from __future__ import annotations

import logging
from collections.abc import Generator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from ...curves.inputs import Array
from ...curves.several_curves import as_points, curve_list
from ..models.pool import Outcome
from ..objective.first_run import warn_of_first_run
from ..records.evaluation import Evaluation, Point, Run, is_outside
from ..records.search_record import Agreement
from .problem import Problem

__all__ = ["STARTS_AT_ONCE", "Course", "Finish", "Ledger", "SearchEndedError"]

STARTS_AT_ONCE = 3  # with several workers, whatever their number, so that it changes no bits

_log = logging.getLogger("curvewise.calibration")


class Finish(NamedTuple):
    """The ending of a search, or of one of its stages.

    Attributes
    ----------
    converged : bool
    message : str
        What the method says of it.
    agreement : Agreement, optional
        How many starts agree, of a search from several.
    reason : str, default ""
        Why it has not converged, and what to do, for readers who do not know the method.
    """

    converged: bool
    message: str
    agreement: Agreement | None = None
    reason: str = ""


class SearchEndedError(Exception):
    """The search is over before its method has converged; the message says why."""


Course: TypeAlias = Generator[Array, list[Evaluation], Finish]
"""Yields points of the unit cube, shape (count, k), that may be run at the same time; is sent their
evaluations in the same order."""


class Ledger:
    """Every evaluation of a search.

    Parameters
    ----------
    problem : Problem
        The problem, which scores simulations and names the parameters.
    limit : int or None
        Maximum number of parameter sets to evaluate.
    earlier_runs : sequence of (ndarray, Evaluation)
        Runs of the same models in earlier searches, with their places in the unit cube.

    Attributes
    ----------
    expected : list of tuple of float
        Points that the course will ask for, and that are not done.
    """

    def __init__(
        self, problem: Problem, *, limit: int | None, earlier_runs: Sequence[Run] = ()
    ) -> None:
        self.earlier_runs = earlier_runs
        self.objective, self.space = problem.objective, problem.space
        self.has_slopes, self.slopes = problem.has_slopes, problem.slopes
        self._limit = limit
        self._done: dict[Point, Evaluation] = {}
        self.expected: list[Point] = []
        self._units: dict[Point, Array] = {}
        self._best: Point | None = None
        self._best_simulations: Any = None
        self._keeps_curves = False
        self._has_looked = not any(getattr(one, "is_solver", False) for one in problem.callables)
        self._log_level = logging.WARNING  # of the first failure; all are kept anyway

    @property
    def dimensions(self) -> int:
        """Number of parameters."""
        return len(self.space.names)

    @property
    def starts_at_once(self) -> int:
        """Number of parallel starts: three, because the caller can run all of them."""
        return STARTS_AT_ONCE

    @property
    def negligible(self) -> float:
        """Differences of the objective below this do not count."""
        return self.objective.negligible

    @property
    def done(self) -> list[Evaluation]:
        """Every evaluation so far, in order."""
        return list(self._done.values())

    @property
    def runs_with_curves(self) -> tuple[Run, ...]:
        """Every evaluation whose curves are known, earlier searches' too, with its place."""
        own = [(self._units[point], e) for point, e in self._done.items() if e.simulations]
        return (*self.earlier_runs, *own)

    @property
    def best(self) -> Evaluation:
        """The evaluation with the smallest value, the first among equals."""
        assert self._best is not None
        return self._done[self._best]

    @property
    def best_unit(self) -> Array:
        """The place of the best evaluation in the unit cube."""
        assert self._best is not None
        return self._units[self._best]

    def best_simulations(self) -> Any:
        """Return the simulations at the best point, or None if they were not kept."""
        return self._best_simulations

    def settle(self, unit: Array) -> None:
        """Make an evaluated point the best one, if a method has a separate rule."""
        self._best = self.space.point(unit)
        self._best_simulations = self._done[self._best].simulations

    def begin_stage(self, name: str, *, keeps_curves: bool) -> None:
        """Begin a stage of the search.

        Parameters
        ----------
        name : str
            Shown next to the progress, if progress is displayed.
        keeps_curves : bool
            Keep the curves of simulations that succeed.
        """
        self._keeps_curves = keeps_curves

    def show_activity(self) -> None:
        """Show that a search is at work between runs, where somebody looks."""

    def missing(self, units: Array) -> list[Point]:
        """Return the points of a batch that must be run, within the limit of runs."""
        points = [self.space.point(unit) for unit in units]
        for point, unit in zip(points, units, strict=True):
            self._units.setdefault(point, np.array(unit))
        new = list(dict.fromkeys(p for p in points if p not in self._done))
        return new if self._limit is None else new[: self._limit - len(self._done)]

    def expect(self, units: Array) -> list[Point]:
        """Register points that a course will request; return the new ones.

        They are registered in order. They can be run early, within the limit of runs. Nothing that
        a method sees depends on this.
        """
        points = dict.fromkeys(self.space.point(unit) for unit in units)
        new = [p for p in points if p not in self._done and p not in self.expected]
        if self._limit is not None:
            new = new[: max(0, self._limit - len(self._done) - len(self.expected))]
        self.expected += new
        return new

    def judged(self, ahead: int, point: Point, outcome: Outcome) -> Evaluation:
        """Return the evaluation of a point; `ahead` others are added before it."""
        # Its message in full, as the objective would give it for an exception.
        number = len(self._done) + 1 + ahead
        simulations = None if outcome.message else outcome.simulations
        score = self.objective.score(simulations)
        message = outcome.message or "; ".join(score.failures)
        if message and not is_outside(message):
            _log.log(self._log_level, "evaluation %d failed: %s", number, message)
            self._log_level = logging.DEBUG
        if not (message or self._has_looked):
            self._has_looked = True
            warn_of_first_run(self.objective.experiments, self.objective.axes(), simulations)
        curves = None
        if self._keeps_curves and not message:
            curves = tuple(as_points(curve, "Q").copy() for curve in curve_list(simulations))
        return Evaluation(
            number, point, score.value, bool(message), outcome.seconds, message, curves
        )

    def add(self, batch: Sequence[tuple[Evaluation, Any]]) -> None:
        """Write down a batch: evaluations, and the simulations that they are of.

        Raises
        ------
        RuntimeError
            If no simulation of the first batch has succeeded.
        """
        is_first = not self._done
        for evaluation, simulations in batch:
            self._done[evaluation.point] = evaluation
            if self._best is None or evaluation.value < self.best.value:
                self._best = evaluation.point
                self._best_simulations = simulations
        self.expected = [point for point in self.expected if point not in self._done]
        if is_first and all(e.failed for e, _ in batch):
            raise RuntimeError(
                f"no simulation succeeded, of {len(batch)} that the search begins with; "
                f"the first: {batch[0][0].message}"
            )

    def known(self, units: Array) -> list[Evaluation]:
        """Return the evaluations of a batch of points.

        Raises
        ------
        SearchEndedError
            If one of them is beyond the limit.
        """
        points = [self.space.point(unit) for unit in units]
        if any(point not in self._done for point in points):
            raise SearchEndedError(f"max_runs = {self._limit} reached")
        return [self._done[point] for point in points]
