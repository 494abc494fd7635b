"""Between an optimiser and the model: runs each point once, records it, and stops in time.

An optimiser asks for the values of a batch of points. Points that this search has already
evaluated are looked up; the others are run, in parallel if the pool has several processes, or come
out of a store. Numbers are given in the order in which the optimiser asked, so that
nothing that it sees depends on the number of processes or on what was run before an interruption.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...curves.inputs import Array
from ...curves.several_curves import as_points, curve_list
from ..models.pool import Outcome
from ..records.evaluation import Evaluation, Point
from ..records.recorder import Recorder
from ..surfaces.nearby_runs import Run
from .problem import Problem
from .simulator import Simulator

__all__ = ["Evaluations", "Finish", "Progress", "SearchEndedError"]

_PAUSE = 0.2  # seconds between two refreshes of the bar while nothing is run

_log = logging.getLogger("curvewise.calibration")


class Progress(NamedTuple):
    """What a callback is told after every batch.

    Attributes
    ----------
    evaluations : int
        How many parameter sets have been evaluated.
    parameters : dict of str to float
        The best of them.
    value : float
        Its value.
    """

    evaluations: int
    parameters: dict[str, float]
    value: float


class Finish(NamedTuple):
    """How a search, or a stage of it, ended."""

    converged: bool
    message: str


class SearchEndedError(Exception):
    """The search is over before its method has converged; the message says why."""


class Evaluations:
    """The objective as a function of points of the unit cube.

    Parameters
    ----------
    simulator, problem, recorder
        What runs the models, what scores them and names the parameters, and takes the search down.
    limit : int or None
        How many parameter sets to evaluate at most.
    callback : callable or None
        Told the progress after every batch; a true result ends the search.
    bar : object
        A tqdm progress bar.
    earlier_runs : sequence of (ndarray, Evaluation)
        Of the same models, by earlier searches, with their places in the unit cube.
    """

    def __init__(
        self,
        simulator: Simulator,
        problem: Problem,
        recorder: Recorder,
        *,
        limit: int | None,
        callback: Callable[[Progress], Any] | None,
        bar: Any,
        earlier_runs: Sequence[Run] = (),
    ) -> None:
        self.earlier_runs = earlier_runs
        self.objective, self._space = problem.objective, problem.space
        self._simulator, self._recorder = simulator, recorder
        self._limit, self._callback, self._bar = limit, callback, bar
        self._done: dict[Point, Evaluation] = {}
        self._units: dict[Point, Array] = {}
        self._best: Point | None = None
        self._best_simulations: Any = None
        self._shown, self._slowest = -np.inf, 0.0
        self._keeps_curves = False
        self._log_level = logging.WARNING  # of the first failure; all are kept anyway

    @property
    def dimensions(self) -> int:
        """How many parameters there are."""
        return len(self._space.names)

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
        """Where in the unit cube the best evaluation is."""
        assert self._best is not None
        return self._units[self._best]

    def settle(self, unit: Array) -> None:
        """Take a point that was evaluated for the best, where a method has a rule of its own."""
        self._best = self._space.point(unit)
        self._best_simulations = self._done[self._best].simulations

    def begin_stage(self, name: str, *, keeps_curves: bool) -> None:
        """Begin a stage of the search.

        Parameters
        ----------
        name : str
            Shown beside the progress.
        keeps_curves : bool
            Keep the curves of simulations that succeed, in the history file too.
        """
        self._bar.set_description(name)
        self._keeps_curves = keeps_curves

    def show_activity(self) -> None:
        """Show that a search is at work between runs, on what it predicts of them."""
        if time.monotonic() - self._shown > _PAUSE:
            self.show("choosing the next run")

    def show(self, doing: str = "", *, refresh: bool = True) -> None:
        """Say beside the progress what the best value is, and what the search is waiting for."""
        stored = self._simulator.looked_up
        parts = [
            f"{stored} of them from the store" if stored else "",
            "" if self._best is None else f"best value {self.best.value:.4g}",
            doing,
        ]
        self._bar.set_postfix_str(", ".join(filter(None, parts)), refresh=refresh)
        if refresh:
            self._shown = time.monotonic()

    def values(self, units: Array) -> Array:
        """Return the objective at points of the unit cube, shape (count, dimensions)."""
        return np.array([e.value for e in self.evaluated(units)])

    def value(self, unit: Array) -> float:
        """Return the objective at one point."""
        return self.evaluated(unit[np.newaxis])[0].value

    def best_simulations(self) -> Any:
        """Return the simulations at the best point; runs the model again if it has to."""
        if self._best_simulations is None:
            ((_, outcome),) = self._simulator.run([self._space.dictionary(self.best.point)])
            self._best_simulations = outcome.simulations
        return self._best_simulations

    def evaluated(self, units: Array) -> list[Evaluation]:
        """Return the evaluations of points; run those that are not known.

        Parameters
        ----------
        units : ndarray, shape (count, dimensions)
            Points of the unit cube.

        Raises
        ------
        SearchEndedError
            The limit is reached, or the callback asks for it.
        RuntimeError
            No simulation of the first batch has succeeded.
        """
        points = [self._space.point(unit) for unit in units]
        new = list(dict.fromkeys(p for p in points if p not in self._done))
        batch = new if self._limit is None else new[: self._limit - len(self._done)]
        for point, unit in zip(points, units, strict=True):
            self._units.setdefault(point, np.array(unit))
        if batch:
            is_first = not self._done
            self._run(batch)
            if is_first and all(e.failed for e in self._done.values()):
                raise RuntimeError(
                    f"no simulation succeeded, of {len(self._done)} that the search begins with; "
                    f"the first: {next(iter(self._done.values())).message}"
                )
            self._report()
        if len(batch) < len(new):
            raise SearchEndedError(f"max_runs = {self._limit} reached")
        return [self._done[point] for point in points]

    def _run(self, batch: list[Point]) -> None:
        first = len(self._done) + 1
        finished: dict[Point, Evaluation] = {}
        simulations: dict[Point, Any] = {}
        since = time.monotonic() - self._shown
        self._show_waiting(len(batch), refresh=max(since, self._slowest) > _PAUSE)
        for k, outcome in self._simulator.run([self._space.dictionary(p) for p in batch]):
            point = batch[k]
            finished[point] = self._judged(first + k, point, outcome)
            simulations[point] = outcome.simulations
            self._slowest = max(self._slowest, outcome.seconds)
            self._show_waiting(len(batch) - len(finished), refresh=False)
            self._bar.update()
        for point in batch:
            self._done[point] = finished[point]
            self._recorder.add(finished[point])
            if self._best is None or finished[point].value < self.best.value:
                self._best = point
                self._best_simulations = simulations.get(point)

    def _show_waiting(self, runs: int, *, refresh: bool) -> None:
        self.show(
            f"waiting for {runs} run{'s' if runs > 1 else ''}" if runs else "", refresh=refresh
        )

    def _judged(self, number: int, point: Point, outcome: Outcome) -> Evaluation:
        # Its message in full, as the objective would give it for an exception.
        simulations = None if outcome.message else outcome.simulations
        score = self.objective.score(simulations)
        message = outcome.message or "; ".join(score.failures)
        if message:
            _log.log(self._log_level, "evaluation %d failed: %s", number, message)
            self._log_level = logging.DEBUG
        curves = None
        if self._keeps_curves and not message:
            curves = tuple(as_points(curve, "Q").copy() for curve in curve_list(simulations))
        return Evaluation(
            number, point, score.value, bool(message), outcome.seconds, message, curves
        )

    def _report(self) -> None:
        best = self.best
        self.show(refresh=False)
        if self._callback is None:
            return
        parameters = self._space.dictionary(best.point)
        if self._callback(Progress(len(self._done), parameters, best.value)):
            raise SearchEndedError("the callback ended the search")
