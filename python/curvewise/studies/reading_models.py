"""The tables [model] of a study file: a command, templates, and what these need."""

from __future__ import annotations

import difflib
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..calibration.models.command import LOG
from ..calibration.models.templates import read_templates
from . import keys
from .entries import ModelEntry
from .formulas import Formula, undefined_name
from .keys import Table
from .study_model import DeckTable, DeckValue
from .toml_source import KeyPath, Source

__all__ = ["read_model"]

_TIMEOUT = 3600.0


def read_model(
    source: Source,
    path: KeyPath,
    name: str,
    values: Any,
    parameters: tuple[str, ...],
) -> tuple[ModelEntry, set[str]]:
    """Return a model, and the parameters that its templates and formulas use."""
    table = Table(source, path, values)

    def paths(value: Any) -> tuple[Path, ...]:
        return tuple(source.resolved(item) for item in keys.texts(value))

    command = table.take("command", _command(source), (), required='["ccx", "-i", "deck"], say')
    templates = table.take("templates", paths, (), required="the deck, or a list of files")
    timeout = table.take(
        "timeout", keys.positive, _TIMEOUT, required="the seconds that a run may take"
    )
    environment = tuple(
        (key, str(value))
        for key, value in table.take("environment", keys.mapping, dict[str, Any]()).items()
    )
    scratch = table.take("scratch", _scratch(source), None)
    keep = table.take("keep", keys.flag, False)
    success = _success(table)
    numbers = _values(table, parameters)
    tables = _tables(table, parameters, [value.name for value in numbers])
    made: tuple[DeckValue | DeckTable, ...] = (*numbers, *tables)
    table.refuse_unknown()
    used = _check_templates(table, templates, parameters, made) if templates else set()
    used |= {use for value in made for use in value.uses}
    entry = ModelEntry(name, command, templates, timeout, environment, scratch, keep, success, made)
    return entry, used


def _command(source: Source) -> Callable[[Any], tuple[str, ...]]:
    """Return what reads a command, a program with a path being relative to the file."""

    def read(value: Any) -> tuple[str, ...]:
        if isinstance(value, str):
            listed = ", ".join(f'"{word}"' for word in value.split())
            raise ValueError(f"is {value!r}; there is no shell: give a list, [{listed}]")
        program, *arguments = keys.texts(value)
        if os.sep in program:
            program = str(source.folder / program)
        if shutil.which(program) is None:
            raise ValueError(
                f"starts with {program!r}, and there is no such program on this machine"
            )
        return program, *arguments

    return read


def _scratch(source: Source) -> Callable[[Any], Path]:
    """Return what reads a folder that is there, or can be made when a run needs it."""

    def read(value: Any) -> Path:
        folder = source.resolved(value)
        if folder.exists() and not folder.is_dir():
            raise ValueError(f"is {folder}, which is no folder")
        return folder

    return read


def _success(table: Table) -> tuple[str, str] | None:
    """Return the file and the text by which a run says that it is complete."""
    given = table.raw("success")
    if given is None:
        return None
    if isinstance(given, str):
        return LOG, given
    inner = Table(table.source, (*table.path, "success"), given)
    found = (
        inner.take("file", keys.text, LOG),
        inner.take("text", keys.text, "", required="the text that a complete run writes"),
    )
    inner.refuse_unknown()
    return found


def _values(table: Table, parameters: tuple[str, ...]) -> list[DeckValue]:
    """Return the numbers that formulas make for the templates, in their order."""
    inner = Table(table.source, (*table.path, "values"), table.raw("values"))
    found: list[DeckValue] = []
    for name in inner.keys:
        given = inner.raw(name)
        known = [*parameters, *(value.name for value in found)]
        formula = Formula("0")  # for what is checked beside a formula that is none
        try:
            if keys.name(name) in known:
                raise ValueError("is a parameter, too; call one of them differently")
            formula = Formula(str(given) if isinstance(given, (int, float)) else keys.text(given))
            _check_uses(formula, known)
        except ValueError as error:
            inner.problem(name, str(error))
        found.append(DeckValue(name, formula))
    return found


def _tables(table: Table, parameters: tuple[str, ...], values: list[str]) -> list[DeckTable]:
    """Return the tables of lines that formulas make for the templates."""
    outer = Table(table.source, (*table.path, "tables"), table.raw("tables"))
    known = [*parameters, *values]
    found = []
    for name in outer.keys:
        inner = Table(table.source, (*outer.path, name), outer.raw(name))
        problems = len(table.source.problems)
        over = inner.take("over", keys.name, "", required="what the formulas call the numbers")
        points = inner.take("points", keys.numbers, (), required="a list of numbers, one a line")
        texts = inner.take("line", keys.texts, (), required="a list of formulas")
        format_ = inner.take("format", _number_format, ".8g")
        separator = inner.take("separator", _separator, ", ")
        inner.refuse_unknown()
        line = []
        for text in texts:
            try:
                line.append(Formula(text))
                _check_uses(line[-1], [*known, over])
            except ValueError as error:
                inner.problem("line", str(error))
        if name in known:
            inner.problem("", "is called as a parameter or a value is; rename one")
        if len(table.source.problems) == problems:
            found.append(DeckTable(name, over, points, tuple(line), format_, separator))
    return found


def _separator(value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError(f"is {value!r}; give a text, or nothing in quotes")
    return value


def _number_format(value: Any) -> str:
    try:
        format(1.0, keys.text(value))
    except ValueError:
        raise ValueError(f"is {value!r}; give a format of numbers, such as '.8g'") from None
    return str(value)


def _check_uses(formula: Formula, known: list[str]) -> None:
    for used in formula.names:
        if used not in known:
            raise ValueError(undefined_name(used, known))


def _check_templates(
    table: Table,
    templates: tuple[Path, ...],
    parameters: tuple[str, ...],
    values: tuple[DeckValue | DeckTable, ...],
) -> set[str]:
    """Return the placeholders of the templates; note those that nothing gives a value."""
    try:
        read = read_templates(templates, LOG)
    except (OSError, ValueError) as error:
        table.problem("templates", f"cannot be used: {error}")
        return set()
    made = [value.name for value in values]
    used = set()
    for placeholder in (p for template in read for p in template.placeholders):
        used.add(placeholder.name)
        if placeholder.name not in (*parameters, *made):
            near = difflib.get_close_matches(placeholder.name, (*parameters, *made), n=1)
            hint = f"; did you mean <<{near[0]}>>?" if near else ""
            table.problem(
                "templates",
                f"{placeholder.place}: nothing is called {placeholder.name}; there is "
                f"{', '.join((*parameters, *made))}{hint}",
            )
    for name in made:
        uses = {use for value in values for use in value.uses}
        if name not in used and name not in uses:
            table.problem("", f"has a value {name} that no template and no formula uses")
    return used
