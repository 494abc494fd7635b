"""The tables [[tests]] of a study file: a measured curve, and where a run has its simulation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..curves.inputs import Array
from ..files.column_units import factor_of
from ..files.file_options import CYCLE_COLUMN, PREPARATION, READING, Reading
from ..fitting import PreparedTest, prepare
from . import keys
from .curve_sources import FORMATS, CurveSource, Quantity, format_of
from .file_keys import said as said_of_file
from .formulas import Formula, undefined_names
from .keys import StudyTable, described, key, key_at, table
from .search_settings import ComparisonKeys
from .solver_models import SolverModel
from .toml_source import KeyPath, Source

__all__ = ["MeasuredTest", "Output", "read_test"]

_QUANTITIES = (
    'a table such as { ux = { component = "vx", set = "CORNER" } }, with x and y made of its names'
)


def _formula(value: Any) -> Formula:
    return Formula(keys.text(value))


def _factors(value: Any) -> tuple[float, ...]:
    """Read a list of numbers and units."""
    if not isinstance(value, list) or not any(isinstance(item, str) for item in value):
        return keys.numbers(value)
    try:
        return tuple(factor_of(i) if isinstance(i, str) else keys.number(i) for i in value)
    except ValueError as error:
        raise ValueError(f"cannot be used: {error}") from None


_PREPARATION = tuple(option.name for option in PREPARATION)
_PLAIN = CurveSource("", "columns")

_column = keys.name_or_number("the name of a column")


@dataclass(frozen=True)
class Columns:
    """The parts of a file that make a curve; shared keys of tests and results."""

    columns: Any = key(keys.as_it_is)
    x: Formula | None = key(_formula)
    y: Formula | None = key(_formula)
    factors: tuple[float, ...] = key(_factors, ())
    sheet: str | int | None = said_of_file("sheet")
    from_: str | None = said_of_file("from_")
    header_row: int | None = said_of_file("header_row")
    until: str | None = said_of_file("until")
    skip_invalid: bool = said_of_file("skip_invalid")
    decimal: str | None = said_of_file("decimal")
    encoding: str | None = said_of_file("encoding")
    value: Formula | None = None
    first_point: tuple[float, ...] = ()


@dataclass(frozen=True)
class Output(Columns):
    """A table [tests.output]: where a run has the simulation of a test."""

    file: str = key(keys.in_run, "", required="the file that the solver writes")
    format: str = key(keys.choice(tuple(FORMATS)), "")
    value: Formula | None = key(_formula)
    first_point: tuple[float, ...] = key(keys.numbers, ())


def _output(source: Source, path: KeyPath, values: Any) -> CurveSource | None:
    """Return where a test's simulation is, or None where something is wrong, or nothing given."""
    if values is None:  # for a material, which does not need one
        return None
    table = StudyTable(source, path, values)
    output = table.read(Output)
    chosen = output.format or (format_of(output.file) if output.file else "columns")
    if not chosen:
        table.problem(
            "file",
            f"is {output.file!r}, which may be CalculiX's, Abaqus' or plain columns; give format, "
            f"one of {', '.join(FORMATS)}",
        )
    found = _source(table, output, output.file, chosen or "columns")
    return found if table.is_right else None


@dataclass(frozen=True, eq=False)
class MeasuredTest(ComparisonKeys, Columns):
    """A table [[tests]].

    Attributes
    ----------
    experiment : ndarray, or float
        The measured curve, or a number.
    output : CurveSource
        The source of its simulation in a run's folder.
    prepared : PreparedTest, or None
        The measured curve with its preparation, if there was any.
    """

    file: Path | None = key_at(keys.path)
    number: float | None = key(keys.number)
    name: str = key(keys.text, "")
    area: float | None = said_of_file("area")
    gauge_length: float | None = said_of_file("gauge_length")
    zero: bool = said_of_file("zero")
    toe: bool | tuple[float, float] = said_of_file("toe")
    true: bool = said_of_file("true")
    cycle_column: str | int | None = said_of_file("cycle_column")
    rate: float | None = key(keys.positive)
    every: int = key(keys.at_least(1), 1)
    axes: tuple[str, ...] = key(keys.texts, ())
    weight: float = key(keys.not_negative, 1.0)
    sigma: float | None = key(keys.positive)
    model: str = key(keys.as_it_is, "")
    output: CurveSource = table(_output)
    experiment: Array | float = 0.0
    prepared: PreparedTest | None = None

    @property
    def is_number(self) -> bool:
        """Whether the test is a number, and no curve."""
        return self.number is not None

    @property
    def own(self) -> dict[str, Any]:
        """Settings that override those of [search], as arguments of `Case`."""
        return self.given("sigma", *described(ComparisonKeys))


def read_test(
    source: Source,
    index: int,
    values: Any,
    models: Mapping[str, SolverModel] | None,
) -> MeasuredTest | None:
    """Return a test, or None where something is wrong with it.

    `models` is None where a material takes the place of a solver.
    """
    table = StudyTable(source, ("tests", index), values)
    test = table.read(MeasuredTest)
    if ("file" in table.given) == ("number" in table.given):
        table.problem("", "needs a file with a curve, or a number, and not both")
    curve: tuple[Array | float | PreparedTest, tuple[str, ...]] | None
    curve = _read_curve(table, test) if test.number is None else (test.number, ("number",))
    about_files = {*described(Columns), *_PREPARATION, CYCLE_COLUMN.word}
    for name in about_files if test.is_number else ():
        if name in table.given:
            table.problem(name, "is about a file, and the test is a number")
    if models is None:
        _check_for_material(table)
    else:
        if "rate" in table.given:
            table.problem("rate", "is of a test that drives a material; remove it")
        _check_model(table, models)
    if models is not None and "output" not in table.given:
        _output(source, (*table.path, "output"), {})  # reports the missing keys
    if test.output is not None and test.output.is_number != test.is_number:
        if test.is_number:
            table.problem(
                "output", "gives a curve, and the test is a number; give value, a formula"
            )
        else:
            source.problem(
                (*table.path, "output", "value"),
                "gives a number, and the test is a curve; give x and y",
            )
    if curve is not None and test.axes and len(test.axes) != len(curve[1]):
        table.problem("axes", f"has {len(test.axes)} names for {len(curve[1])} coordinates")
    if not table.is_right or curve is None:
        return None
    return replace(
        test,
        name=test.name or (test.file.stem if test.file else f"test {index + 1}"),
        axes=test.axes or curve[1],
        model=test.model or next(iter(models or ()), ""),
        experiment=np.asarray(curve[0]) if isinstance(curve[0], PreparedTest) else curve[0],
        prepared=curve[0] if isinstance(curve[0], PreparedTest) else None,
    )


def _check_for_material(table: StudyTable) -> None:
    """Record keys of a test that are useless if it drives a material."""
    for name, why in (
        ("output", "is about what a solver writes, and [model] has a material"),
        ("model", "chooses one of several solvers, and [model] has a material"),
        ("number", "is a number, and a material is driven by a curve; give a file"),
    ):
        if name in table.given:
            table.problem(name, why)


def _prepared(table: StudyTable, test: MeasuredTest, curve: Array) -> Array | PreparedTest:
    """Return a measured curve, prepared as its keys require."""
    given = {name: getattr(test, name) for name in _PREPARATION}
    if test.cycle_column is None and not any(given.values()):
        return curve
    numbers = None
    if test.cycle_column is not None:
        column = replace(_PLAIN, file=str(test.file), columns=(test.cycle_column,))
        numbers = replace(column, reading=_reading_of(test)).read(Path())[:, 0]
    return prepare(curve, cycle_numbers=numbers, units=_units_of(table.source), **given)


def _units_of(source: Source) -> str:
    """Return the unit of stresses that a material of the study has."""
    model = source.values.get("model")
    units = model.get("units") if isinstance(model, Mapping) else None
    return units if isinstance(units, str) else "MPa"


def _check_model(table: StudyTable, models: Mapping[str, SolverModel]) -> None:
    if "model" in table.given:
        try:
            keys.choice(tuple(models))(table.given["model"])
        except ValueError as error:
            table.problem("model", str(error))
    elif len(models) > 1:
        table.problem("", f"needs a model: one of {', '.join(models)}")


def _read_curve(
    table: StudyTable, test: MeasuredTest
) -> tuple[Array | PreparedTest, tuple[str, ...]] | None:
    """Return the measured curve and its axes; its file's faults are those of a key."""
    problems = len(table.source.problems)
    measured = _source(table, test, str(test.file), "columns")
    wrong = table.wrong.intersection({*described(MeasuredTest)} - {"model", "output"})
    if wrong or test.file is None or len(table.source.problems) > problems:
        return None
    try:
        curve = _prepared(table, test, measured.read(Path()))
        kept = np.unique([*range(0, len(curve), test.every), len(curve) - 1])  # the last one, too
        return curve[kept], measured.axes(Path())
    except OSError as error:
        table.problem("file", f"{measured.file}: {error.strerror or error}")
    except ValueError as error:
        message = str(error)
        at = "columns" if "column" in message and "columns" in table.given else "file"
        table.problem(at, f"cannot be used: {message}")
    return None


def _source(table: StudyTable, said: Columns, file: str, format: str) -> CurveSource:
    """Return a file with columns, factors and formulas."""
    given = said.columns
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
    width = len(columns) or 2
    if said.factors and len(said.factors) != width:
        table.problem("factors", f"has {len(said.factors)} numbers for {width} columns")
    if 0.0 in said.factors:
        table.problem("factors", "has a 0, which leaves nothing of a column")
    formulas = _formulas(table, said, names)
    first = said.first_point
    if first and len(first) != (len(formulas) or width):
        table.problem("first_point", f"is {list(first)}; give a number for each coordinate")
    try:
        reading = _reading_of(said)
    except ValueError as error:
        table.problem("", f"cannot be read: {error}")
        reading = Reading()
    return CurveSource(file, format, names, columns, said.factors, formulas, first, reading)


def _reading_of(said: Columns) -> Reading:
    return Reading(**{option.name: getattr(said, option.name) for option in READING})


def _formulas(table: StudyTable, said: Columns, names: tuple[str, ...]) -> tuple[Formula, ...]:
    """Return x and y, or the value, as formulas of the columns' names."""
    x, y, value = said.x, said.y, said.value
    given = {"x": x, "y": y, "value": value}
    found = {key: formula for key, formula in given.items() if formula is not None}
    if not found:
        if names and not any(key in table.given for key in given):
            table.problem("columns", "is a table of names; give x and y, formulas of them")
        return ()
    if not names:
        table.problem(next(iter(found)), "is a formula; give columns as a table of the names in it")
        return ()
    for name, formula in found.items():
        for problem in undefined_names(formula, names):
            table.problem(name, problem)
    if value is not None and len(found) > 1:
        table.problem("value", "stands beside x or y; a curve has x and y, a number has a value")
    if value is None and len(found) == 1:
        table.problem(next(iter(found)), "stands alone; a curve has both x and y")
    return (value,) if value is not None else tuple(found.values())


def _named(
    table: StudyTable, given: Mapping[str, Any], format: str
) -> tuple[tuple[str, ...], tuple[Any, ...]]:
    """Return the names of columns, and where they are from."""
    path = (*table.path, "columns")
    found = {}
    for name, value in given.items():
        try:
            keys.name(name)
            if format == "columns":
                found[name] = _column(value)
            else:
                found[name] = _quantity(table.source, (*path, name), value)
        except ValueError as error:
            table.source.problem((*path, name), str(error))
    return tuple(found), tuple(found.values())


def _quantity(source: Source, path: KeyPath, value: Any) -> Quantity:
    """Return one number a time of a solver's output; a text alone is its component."""
    if isinstance(value, str):
        return Quantity(keys.text(value))
    table = StudyTable(source, path, value)
    quantity = table.read(Quantity)
    if quantity.node is not None and quantity.element is not None:
        table.problem("element", "stands beside node; a table has rows of one of them")
    return quantity
