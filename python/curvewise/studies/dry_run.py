"""One run of every model of a study before the search, and its report.

It reveals most errors of a study: a deck that the solver refuses, a wrong name of a set, wrong
units. Cost: one run of every model.
"""

from __future__ import annotations

import math
import shutil
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..calibration.methods import method_of
from ..calibration.models.pool import Outcome
from ..calibration.problem.space import Space
from ..comparing.units import unlike_its_test
from ..curves.inputs import Array
from ..curves.several_curves import points_of
from .contents import AnyModel, Contents
from .measured_tests import MeasuredTest

__all__ = ["DryRun", "dry_run"]


@dataclass(frozen=True)
class Read:
    """The data read from a run for one test.

    Attributes
    ----------
    test : MeasuredTest
        The test.
    simulation : ndarray
        The curve that was read; shape (1, 1) for a number.
    """

    test: MeasuredTest
    simulation: Array

    def __str__(self) -> str:
        test = self.test
        if test.is_number:
            measured = float(np.asarray(test.experiment))
            return f"{test.name}: measured {measured:g}, simulated {self.simulation[0, 0]:g}"
        experiment = np.asarray(test.experiment)
        lines = [f"{test.name}: {test.file}"]
        for what, curve in (("measured", experiment), ("simulated", self.simulation)):
            ranges = ", ".join(
                f"{axis} {low:.4g} to {high:.4g}"
                for axis, low, high in zip(
                    test.axes, curve.min(axis=0), curve.max(axis=0), strict=False
                )
            )
            lines.append(f"  {what:<9}  {len(curve):>6} points, {ranges}")
        return "\n".join([*lines, *(f"  {hint}" for hint in self.hints())])

    def hints(self) -> list[str]:
        """Return what looks wrong: swapped columns, other units, another sign."""
        if self.test.is_number:
            return []
        test = np.asarray(self.test.experiment)
        doubts = unlike_its_test(test, self.simulation, self.test.axes)
        return [f"look: {doubt}{_key_to_see(doubt)}" for doubt in doubts]


def _key_to_see(doubt: str) -> str:
    """Return which key of the file answers a question."""
    keys = {
        "different units?": "factors",
        "swapped columns?": "columns",
        "direction?": "y",
        "quantity?": "columns",
    }
    return next((f" see {key}" for end, key in keys.items() if doubt.endswith(end)), "")


@dataclass(frozen=True)
class DryRun:
    """Result of one run of every model of a study.

    Attributes
    ----------
    parameters : dict of str to float
        The parameters of the runs.
    folders : tuple of Path
        The folders of the runs, with the deck, the log, and the solver's files.
    read : tuple of Read
        The data that were read for every test.
    values : dict of str to float
        The objective by measure.
    seconds : float
        The time of one set of parameters.
    runs : int
        The least number of parameter sets of the study.
    workers : int
        The number of parallel runs.
    """

    parameters: dict[str, float]
    folders: tuple[Path, ...]
    read: tuple[Read, ...]
    values: dict[str, float]
    seconds: float
    runs: int
    workers: int

    @property
    def least_seconds(self) -> float:
        """The least duration of the study."""
        return math.ceil(self.runs / self.workers) * self.seconds

    def __str__(self) -> str:
        given = ", ".join(f"{name} = {value:.6g}" for name, value in self.parameters.items())
        values = ", ".join(f"{value:.6g} by {name}" for name, value in self.values.items())
        lines = [f"one run with {given}", *(f"kept in {folder}" for folder in self.folders), ""]
        lines += [str(read) for read in self.read]
        at_a_time = f", {self.workers} at a time" if self.workers > 1 else ""
        lines += [
            "",
            f"objective: {values}",
            f"{self.seconds:.2g} s a run; the study takes at least {self.runs} runs{at_a_time}: "
            f"{duration(self.least_seconds)}, and often several times that",
        ]
        return "\n".join(lines)


def duration(seconds: float) -> str:
    """Return a time as people say it."""
    if seconds < 100:
        return f"{seconds:.2g} s"
    if seconds < 6000:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"


def dry_run(study: Contents) -> DryRun:
    """Run every model of a study once; see `Study.check`."""
    space = Space(study.bounds)
    middle = space.point(np.full(len(space.names), 0.5))
    start = study.search.start
    point = tuple(start[name] for name in space.names) if start else middle
    parameters = space.dictionary(point)
    place = study.results.parent / f"{study.path.stem}_check"
    shutil.rmtree(place, ignore_errors=True)  # of an earlier check
    models = study.study_models(kept_in=place)
    began = time.perf_counter()
    made = {name: _run(model, parameters, study, place) for name, model in models.items()}
    seconds = time.perf_counter() - began
    curves = {name: iter(simulated) for name, (_, simulated) in made.items()}
    read = tuple(Read(test, next(curves[test.model])) for test in study.tests)
    values = {}
    for name in study.search.measures:
        score = study.objective(models, name).predicted([one.simulation for one in read])
        if score.failures:
            raise ValueError(f"the run has no value by {name}: {'; '.join(score.failures)}")
        values[name] = score.value
    method = method_of(study.search.method or "auto")
    runs = method.fewest_runs(len(space.names), has_start=bool(start))
    return DryRun(
        parameters,
        tuple(folder for folder, _ in made.values() if folder is not None),
        read,
        values,
        seconds,
        min(runs, study.search.max_runs or runs),
        max(1, study.search.workers or 1),
    )


def _run(
    model: AnyModel, parameters: dict[str, float], study: Contents, place: Path
) -> tuple[Path | None, tuple[Array, ...]]:
    """Run a model, store what comes, and return its folder, if it has one, and its curves."""
    before = set(place.iterdir()) if place.is_dir() else set()
    began = time.perf_counter()
    result = model(parameters)
    seconds = time.perf_counter() - began
    made = set(place.iterdir()) - before if place.is_dir() else ()
    identity = study.identity(model)
    with study.store as store:
        store.register(identity)
        store.save(identity.text, parameters, Outcome(result, "", seconds))
    return next(iter(made), None), points_of(result)
