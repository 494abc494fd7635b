"""A study: an identification as a file describes it, ready to be checked, run and run again.

`Study.read` checks the whole file; `check` runs the solver once; `run` searches. Every run of the
solver goes into the study's store at once, so that the same call after an interruption goes on
where it was, and ends with the same bits.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from ..calibration import (
    Case,
    CommandModel,
    Identification,
    Objective,
    Progress,
    SeveralMeasures,
    SimulationStore,
    Uncertainty,
    identify,
    identify_each,
)
from ..calibration.models.command import LOG
from ..calibration.models.identity import model_identity
from ..calibration.models.templates import read_templates
from ..calibration.objective.cases import Cases
from ..calibration.objective.criterion import Criterion
from ..drawing import figures as drawing
from .compatibility import check_together
from .dry_run import DryRun, dry_run
from .entries import ModelEntry, SearchEntry, TestEntry
from .reading import Contents, read_contents
from .result_files import write_results
from .study_model import OutputReader, Picked, StudyModel
from .toml_source import Source

__all__ = ["Found", "Study"]


@dataclass(frozen=True)
class Found:
    """What a study has found.

    Attributes
    ----------
    identifications : dict of str to Identification
        By measure; one, unless the study asks for several.
    uncertainties : dict of str to Uncertainty
        Of each; empty where the study has ``uncertainty = false``.
    several : SeveralMeasures or None
        The same together, where there are several.
    """

    identifications: dict[str, Identification]
    uncertainties: dict[str, Uncertainty]
    several: SeveralMeasures | None = None

    def __str__(self) -> str:
        parts = [str(self.several)] if self.several is not None else []
        for measure, found in self.identifications.items():
            if self.several is None:
                parts.append(str(found))
            if measure in self.uncertainties:
                title = f"by {measure}\n" if self.several is not None else ""
                parts.append(f"{title}{self.uncertainties[measure]}")
        return "\n\n".join(parts)


@dataclass(frozen=True)
class Study:
    r"""An identification that a file describes.

    Made by :meth:`read`.

    Attributes
    ----------
    path : Path
        The file.
    title : str
        What it calls itself.
    tests : tuple of TestEntry
        The measured curves.
    models : mapping of str to ModelEntry
        What simulates them.
    bounds : mapping
        The parameters, as :func:`curvewise.calibration.identify` takes them.
    search : SearchEntry
        How to search.
    results : Path
        The folder for results.

    Examples
    --------
    >>> import sys, tempfile
    >>> from pathlib import Path
    >>> from curvewise.studies import Study
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "test.csv").write_text("x,y\n0,0\n1,2\n2,4\n3,6\n")
    ...     deck = "print('x,y', '0,0', '3,%r' % (3 * <<E>>), sep='\\n', file=open('out.csv', 'w'))"
    ...     _ = Path(folder, "deck.py").write_text(deck)
    ...     file = Path(folder, "study.toml")
    ...     _ = file.write_text(f'''
    ... [[tests]]
    ... file = "test.csv"
    ... output = {{ file = "out.csv" }}
    ... [model]
    ... command = ['{sys.executable}', "deck.py"]
    ... templates = "deck.py"
    ... timeout = 60
    ... [parameters]
    ... E = [0, 10]
    ... [search]
    ... uncertainty = false
    ... ''')
    ...     found = Study.read(file).run(progress=False)
    >>> round(found.identifications["area"].parameters["E"], 3)
    2.0
    """

    path: Path
    title: str
    tests: tuple[TestEntry, ...]
    models: Mapping[str, ModelEntry]
    bounds: Mapping[str, Any]
    search: SearchEntry
    results: Path

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Study:
        """Read a study file, the curves of its tests and its templates, and check all of it.

        Parameters
        ----------
        path : path-like
            The file; paths in it are relative to its own folder.

        Returns
        -------
        Study
            Ready to be checked and run.

        Raises
        ------
        StudyError
            Something is wrong; the message names every problem with its line and key.
        OSError
            The file cannot be read.
        ImportError
            With Python 3.10 tomli is missing: ``pip install "curvewise[calibration]"``.

        Notes
        -----
        The time is that of reading the curves. Nothing is run.

        Examples
        --------
        As for the class.
        """
        source = Source(path)
        contents: Contents = read_contents(source)
        study = cls(source.path, *contents)
        check_together(study, source)
        source.raise_problems()
        return study

    def check(self) -> DryRun:
        """Run every model once, at the start of the search, and say what was read.

        Returns
        -------
        DryRun
            The decks, which are kept, what was read of them, the value of the measure, and how
            long the study takes at least; prints as a table.

        Raises
        ------
        SolverError
            The run failed, or its output cannot be read.

        Notes
        -----
        The run is stored: the search does not repeat it.

        Examples
        --------
        >>> from curvewise.studies import Study
        >>> print(Study.read("study.toml").check())  # doctest: +SKIP
        """
        return dry_run(self)

    def run(
        self, *, progress: bool = True, callback: Callable[[Progress], Any] | None = None
    ) -> Found:
        """Search, or go on with a search that was interrupted, and write the results.

        Parameters
        ----------
        progress : bool, default True
            Show a bar (tqdm).
        callback : callable, optional
            As for :func:`curvewise.calibration.identify`; not with several measures.

        Returns
        -------
        Found
            The identifications with their uncertainties; the folder `results` has them as files.

        Raises
        ------
        RuntimeError
            No run of the first batch has succeeded; the message has the first reason.
        ImportError
            scipy, tqdm or matplotlib is missing: ``pip install "curvewise[calibration,plot]"``.
        KeyboardInterrupt
            Ctrl-C, after the solvers have been stopped. The store holds what was finished.

        Notes
        -----
        The time is the solver's. Resumed with the same file, decks and program it gives the same
        result, bit for bit.

        Examples
        --------
        As for the class.
        """
        with drawing.matplotlib_required():  # before the work rather than after it
            import_module("matplotlib.figure")
        self.results.mkdir(parents=True, exist_ok=True)
        found = self._searched(progress, callback)
        uncertainties = {}
        if self.search.uncertainty:
            samples = self.search.uncertainty
            uncertainties = {n: one.uncertainty(samples=samples) for n, one in found[0].items()}
        results = Found(found[0], uncertainties, found[1])
        write_results(self, results)
        return results

    def stored_runs(self) -> int:
        """Return how many runs of the study's models its store holds."""
        if not self.search.store.exists():
            return 0
        with self.store as store:
            names = [self.identity(model) for model in self.study_models().values()]
            return sum(1 for name in names for _ in store.runs(name))

    def identity(self, model: StudyModel) -> str:
        """Return what the store knows the runs of a model by."""
        return model_identity(model, self.store.version).text

    @property
    def store(self) -> SimulationStore:
        """The runs of the study, with what the file calls the present state of the models."""
        return SimulationStore(self.search.store, version=self.search.search.get("version"))

    def study_models(self, kept_in: Path | None = None) -> dict[str, StudyModel]:
        """Return the models as functions of the parameters.

        Parameters
        ----------
        kept_in : Path, optional
            Where the folders of runs are made and kept, whatever the file says. The folder that
            is used is made if it is not there.
        """
        made = {}
        for name, entry in self.models.items():
            sources = tuple(test.output for test in self.tests if test.model == name)
            scratch = kept_in or entry.scratch
            if scratch is not None and not scratch.is_dir():
                scratch.mkdir(parents=True, exist_ok=True)
            given = [value.name for value in entry.values]
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
            made[name] = StudyModel(command_model, entry.values)
        return made

    @property
    def has_cases(self) -> bool:
        """Whether the tests differ in more than their weights."""
        own = any(test.own or test.is_number for test in self.tests)
        return own or len(self.models) > 1

    def cases(self, models: Mapping[str, StudyModel]) -> list[Case]:
        """Return the tests as cases of an identification."""
        cases = []
        for test in self.tests:
            place = [t.name for t in self.tests if t.model == test.model].index(test.name)
            settings = {**self.search.objective, "measure": self.search.measures[0], **test.own}
            for name in ("failure_value", *(("part", "options") if test.is_number else ())):
                settings.pop(name, None)
            sigma = settings.pop("sigma", None)
            cases.append(
                Case(
                    test.name,
                    models[test.model],
                    test.experiment,
                    measure=_criterion(settings),
                    weight=test.weight,
                    sigma=sigma,
                    response=Picked(place, test.is_number),
                )
            )
        return cases

    def objective(self, models: Mapping[str, StudyModel], measure: str) -> Objective:
        """Return what is minimised."""
        if self.has_cases:
            return Cases(self.cases(models)).objective()
        return Objective([test.experiment for test in self.tests], self._criterion(measure))

    def _criterion(self, measure: str) -> Criterion:
        weights = [test.weight for test in self.tests]
        return _criterion({**self.search.objective, "measure": measure, "weights": weights})

    def _searched(
        self, progress: bool, callback: Callable[[Progress], Any] | None
    ) -> tuple[dict[str, Identification], SeveralMeasures | None]:
        keywords: dict[str, Any] = {
            **{key: value for key, value in self.search.search.items() if key != "version"},
            "store": self.store,
            "progress": progress,
            "start": self.search.start or None,
        }
        models = self.study_models()
        if self.has_cases:
            found = identify(self.cases(models), bounds=self.bounds, callback=callback, **keywords)
            return {found.measure: found}, None
        (model,) = models.values()
        tests = [test.experiment for test in self.tests]
        measures = [self._criterion(measure) for measure in self.search.measures]
        if len(measures) > 1:
            several = identify_each(model, tests, self.bounds, measures=measures, **keywords)
            return dict(several), several
        (measure,) = measures
        found = identify(model, tests, self.bounds, measure=measure, callback=callback, **keywords)
        return {found.measure: found}, None


def _criterion(settings: Mapping[str, Any]) -> Criterion:
    """Return a criterion of a file's keys, among which the measure's options are a table."""
    options = settings.get("options", {})
    others = {name: value for name, value in settings.items() if name != "options"}
    return Criterion(**others, **options)


def _placeholders(entry: ModelEntry, known: tuple[str, ...]) -> list[str]:
    """Return the names that the templates have placeholders of."""
    used = {
        p.name for template in read_templates(entry.templates, LOG) for p in template.placeholders
    }
    return [name for name in known if name in used]
