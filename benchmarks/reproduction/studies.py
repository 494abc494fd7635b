"""One identification: what it is, and what its stages find.

An identification goes through the stages of its effort, each from the best point of those before:
SDRM, then differential evolution (in the place of the paper's genetic algorithm), then perhaps a
Nelder–Mead search. A cross-validation leaves out one experiment after the other, and has the first
stage of its effort alone. `stores.py` runs them by the dozen and stores what they find; what this
file does counts in the digest of every result.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, TypeAlias

import numpy as np
from problems import Array, Bounds

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
    best value after every generation of differential evolution is stored too. With `folds` it is a
    cross-validation, with `material` its model is a point of material.
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
    folds: bool = False
    material: bool = False

    def keywords(self) -> dict[str, Any]:
        """Return what `identify` and `cross_validate` are given, beside a stage's own."""
        return {
            "measure": Criterion(
                self.measure, preset=self.preset, min_coverage=0.0, **self.options
            ),
            "seed": self.seed,
            "progress": False,
        }

    def middle(self) -> dict[str, float]:
        """Return the middle of the bounds."""
        return {name: (low + high) / 2 for name, (low, high) in self.bounds.items()}

    def digest(self) -> str:
        """Return a name for all that is given to the search.

        Of the model it has the curves at the middle of the bounds; numbers count with nine
        digits, which other machines agree on.
        """
        simulated = self.model(self.middle())
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
    trace: list[float]


@dataclass(frozen=True)
class Found:
    """What was identified, stage by stage; a stage that found nothing better repeats the last."""

    stages: tuple[Stage, ...]

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


def found(task: Task) -> dict[str, Any]:
    """Return what a task finds, as it is stored."""
    return {"folds": _folds(task)} if task.folds else {"stages": _stages(task)}


def _stages(task: Task) -> list[dict[str, Any]]:
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
                "trace": trace if task.traced and method == "de" else [],
            }
        )
    return stages


def _folds(task: Task) -> list[dict[str, Any]]:
    method, options = next(iter(task.effort.items()))
    validation = cross_validate(
        task.model,
        task.experiments,
        task.bounds,
        method=searching(method, options),
        **task.keywords(),
    )
    return [
        {
            "value": fold.value,
            "others": fold.others,
            "parameters": fold.parameters,
            "evaluations": fold.identification.evaluations,
        }
        for fold in validation.folds
    ]
