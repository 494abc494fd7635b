"""Identifications by the dozen: each in a process of its own, resumable, with a progress bar.

One identification is a global search, SDRM and differential evolution as in the paper (with
differential evolution in the place of its genetic algorithm), and a Nelder–Mead search from its
result. The models here take a millisecond, so whole identifications run side by side, not the
simulations of one. Their histories are files: what was interrupted is started again and looks up
what it has computed.
"""

from __future__ import annotations

import dataclasses
import logging
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from problems import Array, Bounds
from tqdm.auto import tqdm

from curvewise.calibration import CrossValidation, cross_validate, identify


@dataclass(frozen=True)
class Effort:
    """How long to search: the global method, its population per parameter and generations; how
    often the local search is begun anew, and its evaluations each time."""

    method: str = "sdrm+de"
    popsize: int = 15
    generations: int = 300
    restarts: int = 5
    evaluations: int | None = None

    @property
    def methods(self) -> dict[str, dict[str, Any]]:
        """Return the global and the local search of an identification, with their options."""
        # The parameters depend on each other: trial points had better differ in most of them.
        # Noise keeps values away from 0: a spread of 1 % among them does not mean that the
        # population is in one place.
        de = {"popsize": self.popsize, "maxiter": self.generations}
        de |= {"recombination": 0.9, "tol": 1e-4}
        local = {"restarts": self.restarts}
        if self.evaluations is not None:
            local["maxfev"] = self.evaluations
        options = {"sdrm+de": {"de": de}, "de": de, "sdrm": {}}
        return {self.method: options[self.method], "nelder-mead": local}


@dataclass(frozen=True)
class Task:
    """What to identify; the name is that of its history files.

    The guard against simulations that are too short for PCM is off, as in the paper: noise
    lengthens a test so much that the true simulation would count as too short.
    """

    name: str
    model: Callable[[Mapping[str, float]], Any]
    experiments: Sequence[Array]
    bounds: Bounds
    measure: str
    seed: int = 0
    effort: Effort = Effort()
    options: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Found:
    """What was identified: the optimum, and its value under every measure."""

    parameters: dict[str, float]
    value: float
    measures: dict[str, float]
    simulations: tuple[Array, ...]
    evaluations: int


def identify_all(tasks: Sequence[Task], histories: Path, workers: int) -> dict[str, Found]:
    """Return what every task finds, by its name; `workers` of them at a time."""
    return _all(_found, tasks, histories, workers)


def cross_validate_all(
    tasks: Sequence[Task], histories: Path, workers: int
) -> dict[str, CrossValidation]:
    """Return the cross-validation of every task, by its name, with the global search alone."""
    return _all(_cross_validated, tasks, histories, workers)


def _all(
    function: Callable[[Task, Path], Any], tasks: Sequence[Task], histories: Path, workers: int
) -> dict[str, Any]:
    done = {}
    with (
        ProcessPoolExecutor(workers, initializer=_quiet) as pool,
        tqdm(total=len(tasks), unit="task") as bar,
    ):
        running = {pool.submit(function, task, histories): task.name for task in tasks}
        try:
            for future in as_completed(running):
                done[running[future]] = future.result()
                bar.update()
        except BaseException:  # Ctrl-C above all: the pool would finish what is queued
            pool.shutdown(cancel_futures=True)
            raise
    return {task.name: done[task.name] for task in tasks}


def _cross_validated(task: Task, histories: Path) -> CrossValidation:
    method, method_options = next(iter(task.effort.methods.items()))
    return cross_validate(
        task.model,
        task.experiments,
        task.bounds,
        measure=task.measure,
        preset="paper",
        min_coverage=0.0,
        method=method,
        method_options=method_options,
        seed=task.seed,
        history=histories / f"{task.name}_{method}.csv",
        progress=False,
        **task.options,
    )


def _quiet() -> None:
    """Keep failed simulations to the histories: a search of wide bounds always has some."""
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)


def _found(task: Task, histories: Path) -> Found:
    start, evaluations, best = None, 0, None
    for method, method_options in task.effort.methods.items():
        result = identify(
            task.model,
            task.experiments,
            task.bounds,
            measure=task.measure,
            preset="paper",
            min_coverage=0.0,
            method=method,
            method_options=method_options,
            seed=task.seed,
            start=start,
            history=histories / f"{task.name}_{method}.csv",
            progress=False,
            **task.options,
        )
        evaluations += result.evaluations
        if best is None or result.value < best.value:
            best = Found(
                result.parameters, result.value, result.measures, result.simulations, evaluations
            )
        start = best.parameters
    assert best is not None
    return dataclasses.replace(best, evaluations=evaluations)
