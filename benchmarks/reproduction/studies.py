"""Identifications by the dozen: each in a process of its own, stored, with a progress bar.

An identification goes through the stages of its effort, each from the best point of those before:
SDRM, then differential evolution (in the place of the paper's genetic algorithm), then perhaps a
Nelder–Mead search. The models here take a millisecond, so whole identifications run side by side,
not the simulations of one. What every stage found is stored as JSON, and tables and pictures are
drawn from that: a run that was interrupted is started again, and repeats nothing that is stored
for the same task. A task that has changed in any way is done anew.
"""

from __future__ import annotations

import hashlib
import json
import logging
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from problems import Array, Bounds
from tqdm.auto import tqdm

from curvewise.calibration import (
    SDRM,
    Criterion,
    DifferentialEvolution,
    NelderMead,
    cross_validate,
    identify,
)

Model: TypeAlias = Callable[[Mapping[str, float]], Any]
Effort: TypeAlias = Mapping[str, Mapping[str, Any]]
"""The options of each stage, by its method, in the order in which they run."""

STALL = (0.001, 100)  # the paper's rule, section 3.3


def evolution(popsize: int, generations: int, **options: Any) -> dict[str, Any]:
    """Return options of differential evolution: members per parameter, generations at most.

    The parameters depend on each other: trial points had better differ in most of them. Of
    scipy's own tolerance the paper has nothing: `generations` or `stall` ends the search.
    """
    return {
        "popsize": popsize,
        "maxiter": generations,
        "recombination": 0.9,
        "tol": 0.0,
        "stall": None,
        **options,
    }


def searching(name: str, options: Mapping[str, Any]) -> Any:
    """Return the method of a stage; what is no option of its own is scipy's."""
    method = {"de": DifferentialEvolution, "nelder-mead": NelderMead, "sdrm": SDRM}[name]
    own = {option.name for option in fields(method)} & options.keys()
    passed_on = {option: options[option] for option in options.keys() - own}
    given = {"options": passed_on} if passed_on else {}
    return method(**{option: options[option] for option in own}, **given)


@dataclass(frozen=True)
class Task:
    """What to identify, under which name it is stored.

    The guard against simulations that are too short for PCM is off, as in the paper: noise
    lengthens a test so much that the true simulation would count as too short. With `traced` the
    best value after every generation of differential evolution is stored too.
    """

    name: str
    model: Model
    experiments: Sequence[Array]
    bounds: Bounds
    measure: str | Callable[..., float]
    effort: Effort
    seed: int = 0
    preset: str = "paper"
    options: Mapping[str, Any] = field(default_factory=dict)
    traced: bool = False

    def keywords(self) -> dict[str, Any]:
        """Return what `identify` and `cross_validate` are given, beside a stage's own."""
        return {
            "measure": Criterion(
                self.measure, preset=self.preset, min_coverage=0.0, **self.options
            ),
            "seed": self.seed,
            "progress": False,
        }

    def digest(self) -> str:
        """Return a name for all that the result depends on.

        Of the model it has the curves at the middle of the bounds; numbers count with nine
        digits, which other machines agree on.
        """
        middle = {name: (low + high) / 2 for name, (low, high) in self.bounds.items()}
        simulated = self.model(middle)
        curves = [*self.experiments, *(simulated if isinstance(simulated, list) else [simulated])]
        numbers = " ".join(f"{value:.9g}" for curve in curves for value in np.ravel(curve))
        measure = getattr(self.measure, "__name__", self.measure)
        settings = (measure, self.preset, dict(self.options), self.bounds, self.seed, self.traced)
        effort = {method: dict(options) for method, options in self.effort.items()}
        return hashlib.sha256(f"{settings} {effort} {numbers}".encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Stage:
    """What one stage found, after how many evaluations, and how it ended."""

    method: str
    parameters: dict[str, float]
    value: float
    measures: dict[str, float]
    evaluations: int
    message: str
    trace: list[float]


@dataclass(frozen=True)
class Found:
    """What was identified, stage by stage; a stage that found nothing better repeats the last."""

    stages: tuple[Stage, ...]
    seconds: float

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters of the last stage."""
        return self.stages[-1].parameters

    @property
    def value(self) -> float:
        """Their value."""
        return self.stages[-1].value

    @property
    def measures(self) -> dict[str, float]:
        """Their value under every measure."""
        return self.stages[-1].measures

    @property
    def evaluations(self) -> int:
        """The model's runs, in all stages."""
        return sum(stage.evaluations for stage in self.stages)


@dataclass(frozen=True)
class Fold:
    """A loop left out: its value and that of the others at the parameters these gave."""

    value: float
    others: float
    parameters: dict[str, float]
    evaluations: int


def identify_all(tasks: Sequence[Task], store: Path, workers: int = 1) -> dict[str, Found]:
    """Return what every task finds, by its name; `workers` of them at a time."""
    stored = _all(_found, tasks, store, workers)
    return {
        name: Found(tuple(Stage(**stage) for stage in one["stages"]), one["seconds"])
        for name, one in stored.items()
    }


def cross_validate_all(
    tasks: Sequence[Task], store: Path, workers: int = 1
) -> dict[str, list[Fold]]:
    """Return the folds of every task, by its name, with the first stage of its effort alone."""
    stored = _all(_folds, tasks, store, workers)
    return {name: [Fold(**fold) for fold in one["folds"]] for name, one in stored.items()}


def _all(
    function: Callable[[Task], dict[str, Any]], tasks: Sequence[Task], store: Path, workers: int
) -> dict[str, dict[str, Any]]:
    stored: dict[str, dict[str, Any]] = json.loads(store.read_text()) if store.exists() else {}
    digests = {task.name: task.digest() for task in tasks}
    missing = [t for t in tasks if stored.get(t.name, {}).get("digest") != digests[t.name]]
    if missing:
        with (
            ProcessPoolExecutor(workers, initializer=_quiet) as pool,
            tqdm(total=len(missing), unit="task", desc=store.stem) as bar,
        ):
            running = {pool.submit(function, task): task.name for task in missing}
            try:
                for future in as_completed(running):
                    name = running[future]
                    stored[name] = {"digest": digests[name], **future.result()}
                    _write(store, stored)
                    bar.update()
            except BaseException:  # Ctrl-C above all: the pool would finish what is queued
                pool.shutdown(cancel_futures=True)
                raise
    return {name: stored[name] for name in digests}


def _write(store: Path, stored: dict[str, dict[str, Any]]) -> None:
    """Write the store, a line for every task, so that no interruption leaves half of it."""
    lines = (f"{json.dumps(name)}: {json.dumps(stored[name])}" for name in sorted(stored))
    store.parent.mkdir(parents=True, exist_ok=True)
    unfinished = store.with_suffix(".part")
    unfinished.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    unfinished.replace(store)


def _quiet() -> None:
    """Do not log failed simulations: a search of wide bounds always has some."""
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)


def _found(task: Task) -> dict[str, Any]:
    began = time.perf_counter()
    stages: list[dict[str, Any]] = []
    for method, options in task.effort.items():
        start = stages[-1]["parameters"] if stages else None
        trace: list[float] = []  # "de" evaluates a generation at a time
        result = identify(
            task.model,
            task.experiments,
            task.bounds,
            method=searching(method, options),
            start=start,
            callback=lambda progress, trace=trace: trace.append(float(f"{progress.value:.6g}")),
            **task.keywords(),
        )
        better = not stages or result.value < stages[-1]["value"]
        best = result if better else None
        stages.append(
            {
                "method": method,
                "parameters": best.parameters if best else stages[-1]["parameters"],
                "value": best.value if best else stages[-1]["value"],
                "measures": best.measures if best else stages[-1]["measures"],
                "evaluations": result.evaluations,
                "message": result.message,
                "trace": trace if task.traced and method == "de" else [],
            }
        )
    return {"stages": stages, "seconds": round(time.perf_counter() - began, 1)}


def _folds(task: Task) -> dict[str, Any]:
    began = time.perf_counter()
    method, options = next(iter(task.effort.items()))
    validation = cross_validate(
        task.model,
        task.experiments,
        task.bounds,
        method=searching(method, options),
        **task.keywords(),
    )
    folds = [
        {
            "value": fold.value,
            "others": fold.others,
            "parameters": fold.parameters,
            "evaluations": fold.identification.evaluations,
        }
        for fold in validation.folds
    ]
    return {"folds": folds, "seconds": round(time.perf_counter() - began, 1)}
