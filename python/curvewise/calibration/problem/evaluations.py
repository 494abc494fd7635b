"""Between a method and the model: runs each point once, records it, and stops in time.

A method yields batches of points. Points that this search has already evaluated are read from the
ledger. The others are run, in parallel if the pool has several processes, or read from a store.
Evaluations are numbered in the order in which the method requests them. Nothing that the method
sees therefore depends on the number of processes or on runs before an interruption.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import closing
from typing import Any, NamedTuple

import numpy as np

from ...curves.inputs import Array
from ..records.evaluation import Evaluation, Point, Run
from ..records.recorder import Recorder
from .ledger import STARTS_AT_ONCE, Course, Finish, Ledger, SearchEndedError
from .problem import Problem
from .simulator import Simulator

__all__ = ["Evaluations", "Progress"]

_PAUSE = 0.2  # seconds between two refreshes of the bar while nothing is run


class Progress(NamedTuple):
    """The argument of a callback after every batch.

    Attributes
    ----------
    evaluations : int
        Number of evaluated parameter sets.
    parameters : dict of str to float
        The best of them.
    value : float
        Its value.
    """

    evaluations: int
    parameters: dict[str, float]
    value: float


class Evaluations(Ledger):
    """A ledger whose points are run by the models of the problem.

    Parameters
    ----------
    simulator, problem, recorder
        The runner of the models; the problem, which scores simulations and names the parameters;
        and the recorder of the search.
    limit : int or None
        Maximum number of parameter sets to evaluate.
    callback : callable or None
        Called with the progress after every batch; a true result ends the search.
    bar : object
        A tqdm progress bar.
    earlier_runs : sequence of (ndarray, Evaluation)
        Runs of the same models in earlier searches, with their places in the unit cube.
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
        super().__init__(problem, limit=limit, earlier_runs=earlier_runs)
        self._simulator, self._recorder = simulator, recorder
        self._callback, self._bar = callback, bar
        self._shown, self._slowest = -np.inf, 0.0

    @property
    def starts_at_once(self) -> int:
        """Number of parallel starts: three if there are several workers."""
        return STARTS_AT_ONCE if self._simulator.is_parallel else 1

    def begin_stage(self, name: str, *, keeps_curves: bool) -> None:
        """Begin a stage of the search, under its name."""
        super().begin_stage(name, keeps_curves=keeps_curves)
        self._bar.set_description(name)

    def show_activity(self) -> None:
        """Show that a search is computing on predictions between runs."""
        if time.monotonic() - self._shown > _PAUSE:
            self.show("choosing the next run")

    def show(self, doing: str = "", *, refresh: bool = True) -> None:
        """Display the best value and the current activity next to the progress."""
        stored = self._simulator.looked_up
        parts = [
            f"{stored} of them from the store" if stored else "",
            "" if self._best is None else f"best value {self.best.value:.4g}",
            doing,
        ]
        self._bar.set_postfix_str(", ".join(filter(None, parts)), refresh=refresh)
        if refresh:
            self._shown = time.monotonic()

    def best_simulations(self) -> Any:
        """Return the simulations at the best point; runs the model again if it has to."""
        if self._best_simulations is None:
            ((_, outcome),) = self._simulator.run([self.space.dictionary(self.best.point)])
            self._best_simulations = outcome.simulations
        return self._best_simulations

    def driven(self, course: Course) -> Finish:
        """Run the points that a course requests, to its end."""
        with closing(course):
            try:
                units = next(course)
                while True:
                    units = course.send(self.evaluated(units))
            except StopIteration as end:
                finish: Finish = end.value
                return finish

    def evaluated(self, units: Array) -> list[Evaluation]:
        """Return the evaluations of points; run those that are not known.

        Parameters
        ----------
        units : ndarray, shape (count, dimensions)
            Points of the unit cube.

        Raises
        ------
        SearchEndedError
            If the limit is reached, or the callback requests it.
        RuntimeError
            If no simulation of the first batch has succeeded.
        """
        if batch := self.missing(units):
            self._run(batch)
            self._report()
        return self.known(units)

    def expect(self, units: Array) -> list[Point]:
        """Start runs that a course will request, if processes are free."""
        new = super().expect(units)
        self._simulator.begin([self.space.dictionary(point) for point in new])
        return new

    def _run(self, batch: list[Point]) -> None:
        finished: dict[Point, tuple[Evaluation, Any]] = {}
        since = time.monotonic() - self._shown
        self._show_waiting(len(batch), refresh=max(since, self._slowest) > _PAUSE)
        for k, outcome in self._simulator.run([self.space.dictionary(p) for p in batch]):
            point = batch[k]
            finished[point] = self.judged(k, point, outcome), outcome.simulations
            self._slowest = max(self._slowest, outcome.seconds)
            self._show_waiting(len(batch) - len(finished), refresh=False)
            self._bar.update()
        for point in batch:
            self._recorder.add(finished[point][0])
        self.add([finished[point] for point in batch])

    def _show_waiting(self, runs: int, *, refresh: bool) -> None:
        self.show(
            f"waiting for {runs} run{'s' if runs > 1 else ''}" if runs else "", refresh=refresh
        )

    def _report(self) -> None:
        best = self.best
        self.show(refresh=False)
        if self._callback is None:
            return
        parameters = self.space.dictionary(best.point)
        if self._callback(Progress(len(self._done), parameters, best.value)):
            raise SearchEndedError("the callback ended the search")
