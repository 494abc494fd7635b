"""Reads a study: checks every key and reports all errors at once.

First each table is checked alone, then their relations: names in formulas, parameters in templates,
models of tests, measures of tests. The files of tests and the templates are read here, so that only
the solver itself can fail later. Cost: that of reading them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from unicodedata import normalize

from ..calibration.methods import method_of
from ..fitting.driven_tests import fit_method
from . import keys
from .contents import Contents
from .formulas import Formula
from .keys import StudyTable, key, key_at, table
from .material_models import drive, is_material, read_material
from .measured_tests import MeasuredTest, read_test
from .parameters import complete_start, read_parameters
from .result_files import file_name
from .search_settings import SearchSettings, read_search
from .solver_models import SolverModel, read_model
from .toml_source import KeyPath, Source

__all__ = ["ResultsFolder", "StudyFile", "read_contents"]


@dataclass(frozen=True)
class ResultsFolder:
    """The table [results]."""

    folder: Path | None = key_at(keys.path)


def _results(source: Source, path: KeyPath, values: Any) -> Path:
    found = StudyTable(source, path, values).read(ResultsFolder)
    return found.folder or source.folder / f"{source.path.stem}_results"


@dataclass(frozen=True)
class StudyFile:
    """The tables of the file; those without a type are read one after the other, of each other."""

    title: str = key(keys.text, "")
    tests: Any = key(keys.as_it_is)
    parameters: Any = key(keys.as_it_is)
    model: Any = key(keys.as_it_is)
    models: Any = key(keys.as_it_is)
    search: SearchSettings = table(read_search)
    results: Path = table(_results)


def read_contents(source: Source) -> Contents:
    """Return what a file says.

    Raises
    ------
    StudyError
        With all that is wrong in it.
    """
    file = StudyTable(source, (), source.values).read(StudyFile)
    if is_material(file.model) and file.models is None:
        return _of_material(source, file)
    before = len(source.problems)
    bounds, start = read_parameters(source, file.parameters)
    if len(source.problems) == before:
        start = complete_start(source, bounds, start)
    models, used = _models(source, file, tuple(bounds))
    if len(source.problems) == before:
        _refuse_unused(source, file.parameters, used)
    tests = _tests(source, file.tests, models)
    source.raise_problems()
    search = replace(file.search, start=start, measures=file.search.measures or ("area",))
    return Contents(source.path, file.title, tests, models, bounds, search, file.results)


def _of_material(source: Source, file: StudyFile) -> Contents:
    """Return the content of a file with a material instead of a command."""
    given, start = read_parameters(source, file.parameters) if file.parameters else ({}, {})
    model = read_material(source, ("model",), file.model)
    tests = _tests(source, file.tests, None)
    measures = file.search.measures or ("sum_of_squares",)
    if model is not None and model.cards and len(measures) > 1:
        source.problem(("model", "cards"), "are of one fit, and [search] has several measures")
    source.raise_problems()
    assert model is not None  # or there were problems
    model, tests, bounds = drive(source, model, tests, given)
    start = complete_start(source, bounds, start)
    source.raise_problems()
    method = file.search.method
    if method is None and len(measures) == 1:
        method = method_of(fit_method(measures[0]))
    search = replace(file.search, start=start, measures=measures, method=method)
    return Contents(source.path, file.title, tests, {"": model}, bounds, search, file.results)


def _models(
    source: Source, file: StudyFile, parameters: tuple[str, ...]
) -> tuple[dict[str, SolverModel], set[str]]:
    """Return the models by their names, and the parameters that they use."""
    if (file.model is None) == (file.models is None):
        source.problem((), "there must be a table [model], or [models.a_name] for each of several")
        return {}, set()
    tables: dict[str, tuple[KeyPath, Any]] = {"": (("model",), file.model)}
    if file.models is not None:
        named = StudyTable(source, ("models",), file.models).given
        tables = {name: (("models", name), values) for name, values in named.items()}
    models, used = {}, set()
    for name, (path, values) in tables.items():
        if is_material(values):
            source.problem(
                (*path, "material"), "is for all tests, in [model]; there are no several materials"
            )
            continue
        models[name], uses = read_model(source, path, name, values, parameters)
        used |= uses
    return models, used


def _refuse_unused(source: Source, parameters: Mapping[str, Any], used: set[str]) -> None:
    formulas = [given for given in parameters.values() if isinstance(given, str)]
    used = used.union(*(Formula(text).names for text in formulas))
    for name in parameters:
        if name not in used:
            source.problem(
                ("parameters", name),
                f"is used nowhere: no template has <<{name}>>, and no formula uses it",
            )


def _tests(
    source: Source, tables: Any, models: Mapping[str, SolverModel] | None
) -> tuple[MeasuredTest, ...]:
    if not isinstance(tables, list) or not tables:
        source.problem(("tests",), "is missing: give a table [[tests]] for every measured curve")
        return ()
    tests = [read_test(source, i, values, models) for i, values in enumerate(tables)]
    names = [test.name for test in tests if test is not None]
    for i, name in enumerate(names):
        if name in names[:i]:
            source.problem(("tests", i), f"is called {name!r}, as another test is; give it a name")
    files: dict[str, str] = {}
    for i, test in enumerate(tests):
        if test is None or test.is_number:
            continue
        written = f"simulation_{file_name(test.name)}.csv"
        # Some file systems ignore case, and how a letter is put together.
        first = files.setdefault(normalize("NFD", written).casefold(), test.name)
        if first != test.name:
            source.problem(
                ("tests", i),
                f"is called {test.name!r}, and its results would go to {written}, as those of "
                f"{first!r} would; rename one of them",
            )
    return tuple(test for test in tests if test is not None)
