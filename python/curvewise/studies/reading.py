"""From the tables of a study file to a study: every key checked, all problems named at once.

First each table alone, then what they say of each other: formulas of names, templates of
parameters, tests of models, measures of tests. Files of tests and templates are read here, so that
nothing but the solver itself is left to fail when a search begins. Cost: that of reading them.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..calibration import Below, Log, Tied
from ..calibration.problem.space import Space
from . import keys
from .entries import ModelEntry, SearchEntry, TestEntry
from .formulas import Formula, undefined_name
from .keys import Table
from .reading_models import read_model
from .reading_search import read_search
from .reading_tests import read_test
from .study_model import FormulaOfParameters
from .toml_source import KeyPath, Source

__all__ = ["Contents", "read_contents"]


class Contents(NamedTuple):
    """All that a study file says."""

    title: str
    tests: tuple[TestEntry, ...]
    models: Mapping[str, ModelEntry]
    bounds: Mapping[str, Any]
    search: SearchEntry
    results: Path


def read_contents(source: Source) -> Contents:
    """Return what a file says.

    Raises
    ------
    StudyError
        With all that is wrong in it.
    """
    top = Table(source, (), source.values)
    title = top.take("title", keys.text, "")
    bounds, start = _parameters(source, top.raw("parameters"))
    models = _models(source, top, tuple(bounds))
    tests = _tests(source, top.raw("tests"), models)
    search = read_search(source, top.raw("search"), start, _beside(source, ".db"))
    results = Table(source, ("results",), top.raw("results"))
    folder = results.take("folder", source.resolved, _beside(source, ""))
    results.refuse_unknown()
    top.refuse_unknown()
    source.raise_problems()
    return Contents(title, tests, models, bounds, search, folder)


def _beside(source: Source, ending: str) -> Path:
    stem = source.path.stem
    return source.folder / (f"{stem}{ending}" if ending else f"{stem}_results")


def _models(source: Source, top: Table, parameters: tuple[str, ...]) -> dict[str, ModelEntry]:
    one, several = top.raw("model"), top.raw("models")
    if (one is None) == (several is None):
        source.problem((), "there must be a table [model], or [models.a_name] for each of several")
        return {}
    tables: dict[str, tuple[KeyPath, Any]]
    if several is None:
        tables = {"": (("model",), one)}
    else:
        named = Table(source, ("models",), several)
        tables = {name: (("models", name), named.raw(name)) for name in named.keys}
    found = {
        name: read_model(source, path, name, values, parameters)
        for name, (path, values) in tables.items()
    }
    used = {name for _, uses in found.values() for name in uses}
    if not source.problems:
        _refuse_unused(source, parameters, used)
    return {name: entry for name, (entry, _) in found.items()}


def _refuse_unused(source: Source, parameters: tuple[str, ...], used: set[str]) -> None:
    given = source.values["parameters"]
    tied = {name: _formula_text(given[name]) for name in parameters if _formula_text(given[name])}
    used = used | {name for text in tied.values() for name in Formula(text).names}
    for name in parameters:
        if name not in used:
            source.problem(
                ("parameters", name),
                f"is used nowhere: no template has <<{name}>>, and no formula uses it",
            )


def _tests(source: Source, tables: Any, models: Mapping[str, ModelEntry]) -> tuple[TestEntry, ...]:
    if not isinstance(tables, list) or not tables:
        source.problem(("tests",), "is missing: give a table [[tests]] for every measured curve")
        return ()
    tests = [read_test(source, i, values, models) for i, values in enumerate(tables)]
    names = [test.name for test in tests if test is not None]
    for i, name in enumerate(names):
        if name in names[:i]:
            source.problem(("tests", i), f"is called {name!r}, as another test is; give it a name")
    return tuple(test for test in tests if test is not None)


def _formula_text(given: Any) -> str:
    """Return the formula of a tied parameter, or nothing."""
    return given if isinstance(given, str) else ""


def _parameters(source: Source, given: Any) -> tuple[dict[str, Any], dict[str, float]]:
    """Return the parameters as `identify` takes them, and where the search begins."""
    path: KeyPath = ("parameters",)
    if not isinstance(given, Mapping) or not given:
        source.problem(path, "is missing: give a table [parameters] with lines E = [low, high]")
        return {}, {}
    bounds: dict[str, Any] = {}
    start: dict[str, float] = {}
    problems = len(source.problems)
    for parameter, value in given.items():
        try:
            keys.name(parameter)
            bounds[parameter] = _bounds(source, parameter, value, list(bounds), start)
        except ValueError as error:
            source.problem((*path, parameter), str(error))
            bounds[parameter] = (0.0, 1.0)  # for what is checked beside it
            continue
        _check_parameter(source, bounds, parameter)
    if len(source.problems) == problems:
        start = _complete_start(source, bounds, start)
    return bounds, start


def _bounds(
    source: Source, parameter: str, value: Any, before: list[str], start: dict[str, float]
) -> Any:
    if isinstance(value, str):
        tied = FormulaOfParameters(value)
        for name in tied.formula.names:
            if name not in before:
                raise ValueError(f"{undefined_name(name, before)}; list those it uses before it")
        return Tied(tied)
    if isinstance(value, list):
        return _pair(value)
    if not isinstance(value, Mapping):
        return keys.number(value)
    table = Table(source, ("parameters", parameter), value)
    pair = table.take("bounds", _pair, (0.0, 1.0), required="bounds = [low, high]")
    scale = table.take("scale", keys.choice(("linear", "log")), "linear")
    below = table.take("below", keys.text, "")
    begin = table.take("start", keys.number, None)
    table.refuse_unknown()
    if begin is not None:
        start[parameter] = begin
    if below and scale == "log":
        raise ValueError("has both below and scale = 'log'; give one of them")
    if below:
        if below not in before:
            raise ValueError(f"stays below {below!r}, which is no parameter listed before it")
        return Below(below, *pair)
    return Log(*pair) if scale == "log" else pair


def _pair(value: Any) -> tuple[float, float]:
    pair = keys.numbers(value)
    if len(pair) != 2 or pair[0] > pair[1]:
        raise ValueError(f"is {value!r}; give [low, high], low below high")
    return pair[0], pair[1]


def _check_parameter(source: Source, bounds: dict[str, Any], parameter: str) -> None:
    """Have the space say what is wrong with a parameter among those before it."""
    try:
        Space({"_another": (0.0, 1.0), **bounds})
    except ValueError as error:
        message = str(error).replace(f"bounds[{parameter!r}] ", "")
        source.problem(("parameters", parameter), message)
        bounds[parameter] = (0.0, 1.0)


def _complete_start(
    source: Source, bounds: dict[str, Any], start: dict[str, float]
) -> dict[str, float]:
    """Return a start for every parameter that is searched for, or none at all."""
    try:
        space = Space(bounds)
        if not start:
            return {}
        for name in start:
            if name not in space.bounds:
                source.problem(("parameters", name, "start"), "is of a parameter that is fixed")
                return {}
        middle = space.dictionary(space.point(np.full(len(space.names), 0.5)))
        complete = {name: start.get(name, middle[name]) for name in space.names}
        space.unit(complete)
    except ValueError as error:
        source.problem(("parameters",), str(error))
        return {}
    return complete
