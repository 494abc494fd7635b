"""One search from its start to its end: records, processes, progress, and whatever ends it."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..._extras import required
from ...curves.several_curves import points_of
from ..methods.method import Method
from ..problem.details import details_of
from ..problem.endings import judged_end
from ..problem.evaluations import Evaluations, Progress
from ..problem.execution import Execution
from ..problem.ledger import Finish, SearchEndedError
from ..problem.problem import Problem
from ..records.evaluation import Run, as_records
from ..records.recorder import Recorder
from .identification import Identification

__all__ = ["Plan", "identification_of"]

_log = logging.getLogger("curvewise.calibration")


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


def identification_of(
    problem: Problem, plan: Plan, earlier_runs: Sequence[Run] = ()
) -> Identification:
    """Search, or continue with what a store has, and return the result.

    Some methods begin at the runs of earlier searches.
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
    finish = judged_end(finish, evaluations, evaluations.best_simulations())
    return _recorded(problem, plan, evaluations, finish, recorder, simulator.runs)


def _recorded(
    problem: Problem,
    plan: Plan,
    evaluations: Evaluations,
    finish: Finish,
    recorder: Recorder,
    runs: int,
) -> Identification:
    """Return the result of an ended search, and write the ending down in the store."""
    objective, simulations = problem.objective, evaluations.best_simulations()
    done, best = evaluations.done, evaluations.best
    found = Identification(
        parameters=problem.space.dictionary(best.point),
        value=best.value,
        measures=objective.by_measure(simulations),
        simulations=points_of(simulations),
        experiments=objective.experiments,
        history=as_records(done, problem.space.names),
        failures=tuple((e.number, e.message) for e in done if e.failed and not e.outside),
        converged=finish.converged,
        message=finish.message,
        method=str(plan.method),
        seed=plan.seed,
        bounds=problem.space.bounds,
        measure=objective.measure,
        preset=objective.preset,
        runs=runs,
        problem=problem,
        execution=plan.execution,
        runs_with_curves=evaluations.runs_with_curves,
        part=objective.part,
        condition=objective.condition,
        recorder=recorder,
        agreement=finish.agreement,
        reason=finish.reason,
    )
    if found.recorder.has_store:
        try:
            found.recorder.end(found.ending())
        except (OSError, ValueError) as error:  # an error here must not lose the result
            _log.warning("how the search ended could not be written down: %s", error)
    return found


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
