"""One search from its start to its end: records, processes, progress, and whatever ends it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from ..._extras import required
from ..problem.details import details_of
from ..problem.evaluations import Evaluations, Progress
from ..problem.execution import Execution
from ..problem.ledger import Finish, SearchEndedError
from ..problem.problem import Problem
from ..records.recorder import Recorder
from ..surfaces.nearby_runs import Run
from .endings import judged_end
from .method import Method

__all__ = ["EndedSearch", "Plan", "run_search"]


@dataclass(frozen=True)
class Plan:
    """The settings of a search, named as in `identify`; the runner of models."""

    method: Method
    seed: int
    start: Mapping[str, float] | None
    progress: bool
    callback: Callable[[Progress], Any] | None
    max_runs: int | None
    execution: Execution

    def __post_init__(self) -> None:
        if self.max_runs is not None and self.max_runs < 1:
            raise ValueError(f"max_runs is {self.max_runs}; give at least 1")


class EndedSearch(NamedTuple):
    """Result of a search: evaluations, ending, best curves, number of runs, records."""

    evaluations: Evaluations
    finish: Finish
    simulations: Any
    runs: int
    recorder: Recorder


def run_search(problem: Problem, plan: Plan, earlier_runs: Sequence[Run] = ()) -> EndedSearch:
    """Search, or go on with what a store has.

    Parameters
    ----------
    problem, plan
        The problem, and the settings of the search.
    earlier_runs : sequence of (ndarray, Evaluation)
        The runs of earlier searches, at which some methods begin.
    """
    start = None if plan.start is None else problem.space.unit(plan.start)
    required("scipy")
    tqdm = required("tqdm").tqdm  # a line of text, in a notebook too: widgets may be missing there
    settings = _settings(problem, plan)
    details = details_of(problem, plan.execution, plan.max_runs)
    with plan.execution.simulator(problem.model) as simulator:
        recorder = Recorder(settings, details, simulator.store)
        most = "" if plan.max_runs is None else " of at most {total_fmt}"
        line = f"{{desc}}{{elapsed}}, {{n_fmt}}{most} runs{{postfix}}"
        with tqdm(total=plan.max_runs, bar_format=line, disable=not plan.progress) as bar:
            evaluations = Evaluations(
                simulator,
                problem,
                recorder,
                limit=plan.max_runs,
                callback=plan.callback,
                bar=bar,
                earlier_runs=earlier_runs,
            )
            try:
                finish = evaluations.driven(plan.method.staged(evaluations, start, plan.seed))
            except SearchEndedError as end:
                finish = Finish(False, str(end), reason=str(end))
            evaluations.show()
        simulations = evaluations.best_simulations()
    finish = judged_end(finish, evaluations, simulations)
    return EndedSearch(evaluations, finish, simulations, simulator.runs, recorder)


def _settings(problem: Problem, plan: Plan) -> dict[str, Any]:
    """Return what decides the value of a simulation and the course of the search."""
    settings = {
        **problem.objective.settings,
        "bounds": problem.space.settings,
        "method": str(plan.method),
        "method_call": repr(plan.method),
        "seed": plan.seed,
        "start": None if plan.start is None else dict(plan.start),
    }
    if (identities := plan.execution.identities(problem.callables)) is not None:
        settings["model"] = identities
    return settings
