"""One search from its start to its end: records, processes, progress, and whatever ends it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from ..._extras import required
from ..._names import did_you_mean
from ...curves.inputs import Array
from ..objective.criterion import LEAST_SQUARES, Measure
from ..problem.details import details_of
from ..problem.evaluations import Evaluations, Finish, Progress, SearchEndedError
from ..problem.problem import Problem
from ..records.evaluation import Evaluation
from ..records.recorder import Recorder
from .registry import METHODS, options_of, search

__all__ = ["Ended", "Plan", "run_search"]


@dataclass(frozen=True)
class Plan:
    """How to search: as the arguments of `identify` of the same names."""

    method: str
    method_options: Mapping[str, Any]
    seed: int
    start: Mapping[str, float] | None
    progress: bool
    callback: Callable[[Progress], Any] | None
    max_evaluations: int | None

    def check(self, measure: Measure) -> None:
        """Refuse a method that does not exist or does not go with a measure."""
        if self.method not in METHODS:
            raise ValueError(
                f"unknown method {self.method!r}; choose from {', '.join(METHODS)}"
                f"{did_you_mean([self.method], METHODS)}"
            )
        if self.method == "least_squares" and measure not in LEAST_SQUARES:
            raise ValueError(
                f"measure {measure!r} is not a sum of squares; method 'least_squares' needs "
                f"measure={' or '.join(map(repr, LEAST_SQUARES))}"
            )
        stages = METHODS[self.method]
        if len(stages) > 1 and not set(self.method_options) <= set(stages):
            raise ValueError(
                f"method_options has {', '.join(self.method_options)}; "
                f"method {self.method!r} takes a dict for each of {', '.join(stages)}"
                f"{did_you_mean(self.method_options, stages)}"
            )
        for name, stage in stages.items():
            chosen = self.method_options if len(stages) == 1 else self.method_options.get(name, {})
            _check_options(name, stage, chosen)
        if self.max_evaluations is not None and self.max_evaluations < 1:
            raise ValueError(f"max_evaluations is {self.max_evaluations}; give at least 1")


def _check_options(method: str, stage: Callable[..., Finish], options: Mapping[str, Any]) -> None:
    """Refuse options that neither a method has nor, where it passes them on, scipy."""
    known = options_of(method, stage)
    if unknown := set(options) - set(known):
        raise ValueError(
            f"method {method!r} has no option {', '.join(sorted(unknown))}; "
            f"it has {', '.join(known)}{did_you_mean(sorted(unknown), known)}"
        )


class Ended(NamedTuple):
    """What is left of a search: evaluations, how it ended, the best curves, runs made, records."""

    evaluations: Evaluations
    finish: Finish
    simulations: Any
    runs: int
    recorder: Recorder


def run_search(
    problem: Problem, plan: Plan, known: Sequence[tuple[Array, Evaluation]] = ()
) -> Ended:
    """Search, or go on with what a store has.

    Parameters
    ----------
    problem, plan
        What to search for, and how.
    known : sequence of (ndarray, Evaluation)
        Runs of earlier searches, from which some methods begin.
    """
    start = None if plan.start is None else problem.space.unit(plan.start)
    required("scipy.optimize")
    tqdm = required("tqdm.auto").tqdm
    settings, details = _settings(problem, plan), details_of(problem, plan.max_evaluations)
    with problem.simulator() as simulator:
        recorder = Recorder(settings, details, simulator.store)
        with tqdm(total=plan.max_evaluations, unit="run", disable=not plan.progress) as bar:
            evaluations = Evaluations(
                simulator,
                problem.objective,
                problem.space,
                recorder,
                limit=plan.max_evaluations,
                callback=plan.callback,
                bar=bar,
                known=known,
            )
            try:
                finish = search(evaluations, plan.method, start, plan.seed, plan.method_options)
            except SearchEndedError as end:
                finish = Finish(False, str(end))
        simulations = evaluations.best_simulations()
    return Ended(evaluations, finish, simulations, simulator.runs, recorder)


def _settings(problem: Problem, plan: Plan) -> dict[str, Any]:
    """Return what decides the value of a simulation and the course of the search."""
    settings = {
        **problem.objective.settings,
        "bounds": problem.space.settings,
        "method": plan.method,
        "method_options": dict(plan.method_options),
        "seed": plan.seed,
        "start": None if plan.start is None else dict(plan.start),
    }
    if (identities := problem.identities()) is not None:
        settings["model"] = identities
    return settings
