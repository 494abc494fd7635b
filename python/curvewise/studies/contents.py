"""The checked content of a study file, and its models, cases and objective.

`Study` adds the actions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from ..calibration import Case, CommandModel, Criterion, Objective, SimulationStore
from ..calibration.models.command import LOG
from ..calibration.models.identity import ModelIdentity, model_identity
from ..calibration.models.templates import read_templates
from ..calibration.objective.cases import Cases
from ..fitting.driven_tests import fit_criterion
from ..materials import DrivenModel
from .material_models import MaterialModel
from .measured_tests import MeasuredTest
from .search_settings import SearchSettings
from .solver_models import SolverModel
from .study_model import OutputReader, Picked, StudyModel

__all__ = ["AnyModel", "Contents"]

AnyModel: TypeAlias = StudyModel | DrivenModel[Any]


@dataclass(frozen=True)
class Contents:
    """All that a study file says; see `Study`."""

    path: Path
    title: str
    tests: tuple[MeasuredTest, ...]
    models: Mapping[str, SolverModel | MaterialModel]
    bounds: Mapping[str, Any]
    search: SearchSettings
    results: Path

    @property
    def material(self) -> MaterialModel | None:
        """The material that replaces a solver, if there is one."""
        model = next(iter(self.models.values()), None)
        return model if isinstance(model, MaterialModel) else None

    def identity(self, model: AnyModel) -> ModelIdentity:
        """Return what the store knows the runs of a model by."""
        return model_identity(model, self.search.version)

    @property
    def store(self) -> SimulationStore:
        """The runs of the study, with what the file calls the present state of the models."""
        return SimulationStore(self.search.store, version=self.search.version)

    def study_models(self, kept_in: Path | None = None) -> dict[str, AnyModel]:
        """Return the models as functions of the parameters.

        Parameters
        ----------
        kept_in : Path, optional
            The parent of the runs' folders, which are kept, whatever the file says. It is created
            if it does not exist.
        """
        made: dict[str, AnyModel] = {}
        for name, entry in self.models.items():
            if isinstance(entry, MaterialModel):
                assert entry.driven is not None
                made[name] = entry.driven
                continue
            sources = tuple(test.output for test in self.tests if test.model == name)
            scratch = kept_in or entry.scratch
            if scratch is not None and not scratch.is_dir():
                scratch.mkdir(parents=True, exist_ok=True)
            given = [value.name for value in entry.made]
            command_model = CommandModel(
                entry.templates,
                entry.command,
                OutputReader(sources, entry.success),
                parameters=_placeholders(entry, (*self.bounds, *given)),
                timeout=entry.timeout,
                environment=dict(entry.environment),
                scratch=scratch,
                keep=kept_in is not None or entry.keep,
            )
            made[name] = StudyModel(command_model, entry.made)
        return made

    @property
    def has_cases(self) -> bool:
        """Whether the tests differ in more than their weights."""
        own = any(test.own or test.is_number for test in self.tests)
        return own or len(self.models) > 1

    def cases(self, models: Mapping[str, AnyModel]) -> list[Case]:
        """Return the tests as cases of an identification."""
        cases = []
        for test in self.tests:
            place = [t.name for t in self.tests if t.model == test.model].index(test.name)
            settings = {**self.search.comparison, "measure": self.search.measures[0], **test.own}
            for name in ("failure_value", *(("part", "options") if test.is_number else ())):
                settings.pop(name, None)
            sigma = settings.pop("sigma", None)
            cases.append(
                Case(
                    test.name,
                    models[test.model],
                    test.experiment,
                    measure=self._criterion(settings),
                    weight=test.weight,
                    sigma=sigma,
                    response=Picked(place, test.is_number),
                )
            )
        return cases

    def objective(self, models: Mapping[str, AnyModel], measure: str) -> Objective:
        """Return the objective to minimise."""
        if self.has_cases:
            return Cases(self.cases(models)).objective()
        return Objective([test.experiment for test in self.tests], self.criterion(measure))

    def criterion(self, measure: str) -> Criterion:
        """Return how all tests are compared by a measure."""
        weights = [test.weight for test in self.tests]
        return self._criterion({**self.search.comparison, "measure": measure, "weights": weights})

    def _criterion(self, settings: Mapping[str, Any]) -> Criterion:
        """Return a criterion of a file's keys, among which the measure's options are a table."""
        options = settings.get("options", {})
        others = {name: value for name, value in settings.items() if name != "options"}
        return (Criterion if self.material is None else fit_criterion)(**others, **options)


def _placeholders(entry: SolverModel, known: tuple[str, ...]) -> list[str]:
    """Return the names that the templates have placeholders of."""
    used = {
        p.name for template in read_templates(entry.templates, LOG) for p in template.placeholders
    }
    return [name for name in known if name in used]
