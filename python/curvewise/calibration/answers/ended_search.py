"""Runs a search and records its result in the store."""

from __future__ import annotations

import logging
from collections.abc import Sequence

from ...curves.several_curves import points_of
from ..methods.search import Plan, run_search
from ..problem.problem import Problem
from ..records.evaluation import as_records
from ..surfaces.nearby_runs import Run
from .identification import Identification

__all__ = ["identification_of"]

_log = logging.getLogger("curvewise.calibration")


def identification_of(
    problem: Problem, plan: Plan, earlier_runs: Sequence[Run] = ()
) -> Identification:
    """Run a search and return its result; the arguments are those of `run_search`."""
    ended = run_search(problem, plan, earlier_runs)
    evaluations, objective = ended.evaluations, problem.objective
    done, best = evaluations.done, evaluations.best
    found = Identification(
        parameters=problem.space.dictionary(best.point),
        value=best.value,
        measures=objective.by_measure(ended.simulations),
        simulations=points_of(ended.simulations),
        experiments=objective.experiments,
        history=as_records(done, problem.space.names),
        failures=tuple((e.number, e.message) for e in done if e.failed and not e.outside),
        converged=ended.finish.converged,
        message=ended.finish.message,
        method=str(plan.method),
        seed=plan.seed,
        bounds=problem.space.bounds,
        measure=objective.measure,
        preset=objective.preset,
        runs=ended.runs,
        problem=problem,
        execution=plan.execution,
        runs_with_curves=evaluations.runs_with_curves,
        part=objective.part,
        condition=objective.condition,
        recorder=ended.recorder,
        agreement=ended.finish.agreement,
        reason=ended.finish.reason,
    )
    if found.recorder.has_store:
        try:
            found.recorder.end(found.ending())
        except (OSError, ValueError) as error:  # an error here must not lose the result
            _log.warning("how the search ended could not be written down: %s", error)
    return found
