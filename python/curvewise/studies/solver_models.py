"""The tables [model] of a study file: a command, templates, and what these need."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .._names import did_you_mean
from ..calibration.models.command import LOG
from ..calibration.models.templates import read_templates
from . import keys
from .formulas import Formula, undefined_names
from .keys import StudyTable, key, key_at, table
from .study_model import DeckTable, DeckValue
from .toml_source import KeyPath, Source

__all__ = ["SolverModel", "Success", "read_model"]


def _command(source: Source, path: KeyPath, value: Any) -> tuple[str, ...]:
    """Read a command; a program with a path is relative to the file."""
    if isinstance(value, str):
        listed = ", ".join(f'"{word}"' for word in value.split())
        raise ValueError(f"is {value!r}; commands run without a shell: give a list, [{listed}]")
    program, *arguments = keys.texts(value)
    if os.sep in program:
        program = str(source.folder / program)
    if shutil.which(program) is None:
        raise ValueError(f"starts with {program!r}, which does not exist on this machine")
    return program, *arguments


def _paths(source: Source, path: KeyPath, value: Any) -> tuple[Path, ...]:
    return tuple(source.resolved(item) for item in keys.texts(value))


def _environment(value: Any) -> tuple[tuple[str, str], ...]:
    return tuple((name, str(item)) for name, item in keys.mapping(value).items())


def _scratch(source: Source, path: KeyPath, value: Any) -> Path:
    """Read a folder that is there, or can be made when a run needs it."""
    folder = source.resolved(value)
    if folder.exists() and not folder.is_dir():
        raise ValueError(f"is {folder}, which is not a folder")
    return folder


@dataclass(frozen=True)
class Success:
    """The sign of a complete run: a text in a file."""

    file: str = key(keys.in_run, LOG)
    text: str = key(keys.text, "", required="the text that a complete run writes")


def _success(source: Source, path: KeyPath, value: Any) -> tuple[str, str]:
    if isinstance(value, str):
        return LOG, value
    found = StudyTable(source, path, value).read(Success)
    return found.file, found.text


def _values(source: Source, path: KeyPath, given: Any) -> tuple[DeckValue, ...]:
    """Read the numbers that formulas make for the templates, in their order."""
    values = StudyTable(source, path, given)
    found = []
    for name, value in values.given.items():
        # a placeholder, so that the other checks of an invalid formula continue
        formula = Formula("0")
        try:
            keys.name(name)
            formula = Formula(str(value) if isinstance(value, (int, float)) else keys.text(value))
        except ValueError as error:
            values.problem(name, str(error))
        found.append(DeckValue(name, formula))
    return tuple(found)


def _tables(source: Source, path: KeyPath, given: Any) -> tuple[DeckTable, ...]:
    """Read the tables of lines that formulas make for the templates."""
    tables = StudyTable(source, path, given).given
    return tuple(
        StudyTable(source, (*path, name), inner).read(DeckTable, name=name)
        for name, inner in tables.items()
    )


@dataclass(frozen=True)
class SolverModel:
    """A table [model], or one of [models]: as the arguments of `CommandModel`."""

    name: str
    command: tuple[str, ...] = key_at(
        _command, (), required='["ccx", "-i", "deck"], say, or a material in its place'
    )
    templates: tuple[Path, ...] = key_at(_paths, (), required="the deck, or a list of files")
    timeout: float = key(keys.positive, 3600.0, required="the seconds that a run may take")
    environment: tuple[tuple[str, str], ...] = key(_environment, ())
    scratch: Path | None = key_at(_scratch)
    keep: bool = key(keys.flag, False)
    success: tuple[str, str] | None = key_at(_success)
    values: tuple[DeckValue, ...] = table(_values)
    tables: tuple[DeckTable, ...] = table(_tables)

    @property
    def made(self) -> tuple[DeckValue | DeckTable, ...]:
        """Values that formulas compute for the templates."""
        return (*self.values, *self.tables)


def read_model(
    source: Source, path: KeyPath, name: str, values: Any, parameters: tuple[str, ...]
) -> tuple[SolverModel, set[str]]:
    """Return a model, and the parameters that its templates and formulas use."""
    given = StudyTable(source, path, values)
    model = given.read(SolverModel, name=name)
    _check_formulas(given, model, parameters)
    used = _check_templates(given, model, parameters) if model.templates else set()
    return model, used | {use for value in model.made for use in value.uses}


def _check_formulas(given: StudyTable, model: SolverModel, parameters: tuple[str, ...]) -> None:
    """Note the names in formulas that have no value, and those that are there twice."""
    known = [*parameters]
    for value in model.values:
        problems = undefined_names(value.formula, known)
        if value.name in known:
            problems = ["is a parameter, too; call one of them differently"]
        for problem in problems:
            given.source.problem((*given.path, "values", value.name), problem)
        known.append(value.name)
    for lines in model.tables:
        place = (*given.path, "tables", lines.name)
        for formula in lines.line:
            for problem in undefined_names(formula, [*known, lines.over]):
                given.source.problem((*place, "line"), problem)
        if lines.name in known:
            given.source.problem(place, "is called as a parameter or a value is; rename one")


def _check_templates(
    given: StudyTable, model: SolverModel, parameters: tuple[str, ...]
) -> set[str]:
    """Return the placeholders of the templates; note those that nothing gives a value."""
    try:
        read = read_templates(model.templates, LOG)
    except (OSError, ValueError) as error:
        given.problem("templates", f"cannot be used: {error}")
        return set()
    made = [value.name for value in model.made]
    known = (*parameters, *made)
    placeholders = [placeholder for template in read for placeholder in template.placeholders]
    for placeholder in placeholders:
        if placeholder.name not in known:
            hint = did_you_mean([placeholder.name], known, shown="<<{}>>".format)
            given.problem(
                "templates",
                f"{placeholder.place}: nothing is called {placeholder.name}; there is "
                f"{', '.join(known) or 'no parameter'}{hint}",
            )
    used = {placeholder.name for placeholder in placeholders}
    uses = used.union(*(value.uses for value in model.made))
    for name in made:
        if name not in uses:
            given.problem("", f"has a value {name} that no template and no formula uses")
    return used
