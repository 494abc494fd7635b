"""The tables [[tests]] of a study file: a measured curve, and where a run has its simulation."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..calibration import MEASURES
from ..curves.inputs import Array
from ..measures.registry import PRESETS
from . import keys
from .curve_sources import FORMATS, CurveSource, Quantity, format_of
from .entries import ModelEntry, TestEntry
from .formulas import Formula, undefined_name
from .keys import Table
from .toml_source import KeyPath, Source

__all__ = ["read_test"]

_QUANTITIES = (
    'a table such as { ux = { component = "vx", set = "CORNER" } }, with x and y made of its names'
)


def read_test(
    source: Source,
    index: int,
    values: Any,
    models: Mapping[str, ModelEntry],
) -> TestEntry | None:
    """Return a test, or None where something is wrong with it."""
    problems = len(source.problems)
    table = Table(source, ("tests", index), values)
    path = table.take("file", source.resolved, None)
    number = table.take("number", keys.number, None)
    if (path is None) == (number is None) and len(source.problems) == problems:
        table.problem("", "needs a file with a curve, or a number, and not both")
    name = table.take("name", keys.text, path.stem if path else f"test {index + 1}")
    experiment: Array | float | None = number
    axes: tuple[str, ...] = ("number",)
    every = table.take("every", keys.at_least(1), 1)
    if number is None:
        measured = _source(table, str(path), "columns")
        if len(source.problems) == problems:
            experiment, axes = _read_curve(table, measured, every)
    output_table = Table(source, ("tests", index, "output"), table.raw("output"))
    output = _output(output_table)
    named = table.take("axes", keys.texts, ())
    model = table.take("model", keys.choice(tuple(models)), next(iter(models), ""))
    if len(models) > 1 and "model" not in table:
        table.problem("", f"needs a model: one of {', '.join(models)}")
    weight = table.take("weight", keys.not_negative, 1.0)
    own = {
        "sigma": table.take("sigma", keys.positive, None),
        "measure": table.take("measure", keys.choice(MEASURES), None),
        "preset": table.take("preset", keys.choice(tuple(PRESETS)), None),
        "part": table.take("part", keys.choice(("experiment", "simulation")), None),
        "min_coverage": table.take("min_coverage", keys.fraction, None),
        "options": table.take("options", keys.mapping, None),
    }
    table.refuse_unknown()
    if number is not None and output is not None and not output.is_number:
        output_table.problem("", "gives a curve, and the test is a number; give value, a formula")
    if number is None and output is not None and output.is_number:
        output_table.problem("value", "gives a number, and the test is a curve; give x and y")
    if named and len(named) != len(axes):
        table.problem("axes", f"has {len(named)} names for {len(axes)} coordinates")
    if len(source.problems) > problems or output is None or experiment is None:
        return None
    given = {key: value for key, value in own.items() if value is not None}
    return TestEntry(name, experiment, named or axes, str(path or ""), output, model, weight, given)


def _read_curve(
    table: Table, measured: CurveSource, every: int
) -> tuple[Array | None, tuple[str, ...]]:
    """Return the measured curve; what is wrong with its file is a problem of the key at fault."""
    try:
        curve = measured.read(Path())
        kept = np.unique([*range(0, len(curve), every), len(curve) - 1])  # the last one, too
        return curve[kept], measured.axes(Path())
    except OSError as error:
        table.problem("file", f"{measured.file}: {error.strerror or error}")
    except ValueError as error:
        message = str(error)
        at = "columns" if "column" in message and "columns" in table else "file"
        table.problem(at, f"cannot be used: {message}")
    return None, ()


def _output(table: Table) -> CurveSource | None:
    """Return where a test's simulation is, or None where something is wrong."""
    problems = len(table.source.problems)
    file = table.take("file", keys.text, "", required="the file that the solver writes")
    guessed = format_of(file) if file else "columns"
    chosen = table.take("format", keys.choice(tuple(FORMATS)), guessed)
    if not chosen:
        table.problem(
            "file",
            f"is {file!r}, which may be CalculiX's, Abaqus' or plain columns; give format, one of "
            f"{', '.join(FORMATS)}",
        )
    found = _source(table, file, chosen or "columns", has_number=True)
    table.refuse_unknown()
    return found if len(table.source.problems) == problems else None


def _source(table: Table, file: str, format: str, *, has_number: bool = False) -> CurveSource:
    """Return a file with columns, factors and formulas."""
    given = table.raw("columns")
    names: tuple[str, ...] = ()
    columns: tuple[Any, ...] = ()
    if isinstance(given, Mapping):
        names, columns = _named(table, given, format)
    elif format != "columns":
        table.problem("columns" if given is not None else "", f"needs columns, {_QUANTITIES}")
    elif given is not None:
        if isinstance(given, list) and given and all(isinstance(c, (str, int)) for c in given):
            columns = tuple(given)
        else:
            table.problem("columns", f"is {given!r}; give a list of names, or of numbers from 1")
    factors = table.take("factors", keys.numbers, ())
    if factors and len(factors) != (len(columns) or 2):
        table.problem("factors", f"has {len(factors)} numbers for {len(columns) or 2} columns")
    if 0.0 in factors:
        table.problem("factors", "has a 0, which leaves nothing of a column")
    formulas = _formulas(table, names, has_number=has_number)
    first = table.take("first_point", keys.numbers, ()) if has_number else ()
    if first and len(first) != (len(formulas) or len(columns) or 2):
        table.problem("first_point", f"is {list(first)}; give a number for each coordinate")
    sheet = table.raw("sheet")
    if sheet is not None and (isinstance(sheet, bool) or not isinstance(sheet, (str, int))):
        table.problem("sheet", f"is {sheet!r}; give its name, or its number from 1")
    return CurveSource(file, format, names, columns, factors, formulas, first, sheet)


def _formulas(table: Table, names: tuple[str, ...], *, has_number: bool) -> tuple[Formula, ...]:
    """Return x and y, or the value, as formulas of the columns' names."""
    x = table.take("x", _formula, None)
    y = table.take("y", _formula, None)
    value = table.take("value", _formula, None) if has_number else None
    given = {"x": x, "y": y, "value": value}
    found = {key: formula for key, formula in given.items() if formula is not None}
    if not found:
        if names and not any(key in table for key in given):
            table.problem("columns", "is a table of names; give x and y, formulas of them")
        return ()
    if not names:
        table.problem(next(iter(found)), "is a formula; give columns as a table of the names in it")
        return ()
    for key, formula in found.items():
        for name in formula.names:
            if name not in names:
                table.problem(key, undefined_name(name, names))
    if value is not None and (x is not None or y is not None):
        table.problem("value", "stands beside x or y; a curve has x and y, a number has a value")
    if value is None and (x is None or y is None):
        table.problem("x" if x is not None else "y", "stands alone; a curve has both x and y")
    return (value,) if value is not None else tuple(f for f in (x, y) if f is not None)


def _formula(value: Any) -> Formula:
    return Formula(keys.text(value))


def _named(
    table: Table, given: Mapping[str, Any], format: str
) -> tuple[tuple[str, ...], tuple[Any, ...]]:
    """Return the names of columns, and where they are from."""
    named = Table(table.source, (*table.path, "columns"), given)
    names, columns = [], []
    for name in given:
        value = named.raw(name)
        try:
            keys.name(name)
            columns.append(_column(value) if format == "columns" else _quantity(named, name, value))
            names.append(name)
        except ValueError as error:
            named.problem(name, str(error))
    return tuple(names), tuple(columns)


def _column(value: Any) -> str | int:
    if isinstance(value, bool) or not isinstance(value, (str, int)):
        raise ValueError(f"is {value!r}; give the name of a column, or its number from 1")
    return value


def _quantity(named: Table, name: str, value: Any) -> Quantity:
    """Return one number a time of a solver's output; a text alone is its component."""
    if isinstance(value, str):
        return Quantity(keys.text(value))
    path: KeyPath = (*named.path, name)
    table = Table(named.source, path, value)
    component = table.take("component", keys.text, "", required='its component, such as "vx"')
    variable = table.take("variable", keys.text, None)
    set_name = table.take("set", keys.text, None)
    node = table.take("node", keys.whole, None)
    element = table.take("element", keys.whole, None)
    point = table.take("point", keys.whole, None)
    combine = table.take("combine", keys.choice(("sum", "mean", "max", "min")), None)
    table.refuse_unknown()
    if node is not None and element is not None:
        table.problem("element", "stands beside node; a table has rows of one of them")
    number = node if node is not None else element
    return Quantity(component, variable, set_name, number, point, combine)
