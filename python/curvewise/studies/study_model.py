"""The model of a study: a CommandModel with values, tables and curves.

Values of formulas, and tables whose rows are formulas (a hardening curve from its law), replace the
few lines of Python that would otherwise connect parameters and deck.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..calibration import CommandModel
from ..curves.inputs import Array
from . import keys
from .curve_sources import CurveSource
from .formulas import Formula
from .keys import key, key_at
from .toml_source import KeyPath, Source

__all__ = ["DeckTable", "DeckValue", "OutputReader", "Picked", "StudyModel"]


@dataclass(frozen=True)
class DeckValue:
    """A number for the templates: a formula of the parameters."""

    name: str
    formula: Formula

    @property
    def uses(self) -> tuple[str, ...]:
        """The names that have to have a value."""
        return self.formula.names

    def value(self, values: Mapping[str, Any]) -> float:
        """Return the number."""
        return float(self.formula(values))


def _line(source: Source, path: KeyPath, value: Any) -> tuple[Formula, ...]:
    """Read a list of formulas; each invalid one is a separate error."""
    line = []
    for text in keys.texts(value):
        try:
            line.append(Formula(text))
        except ValueError as error:
            source.problem(path, str(error))
    return tuple(line)


def _number_format(value: Any) -> str:
    try:
        format(1.0, keys.text(value))
    except ValueError:
        raise ValueError(f"is {value!r}; give a format of numbers, such as '.8g'") from None
    return str(value)


_separator = keys.reader("a text, or nothing in quotes", lambda value: isinstance(value, str), str)


@dataclass(frozen=True)
class DeckTable:
    """Lines for the templates: formulas of the parameters and of a list of numbers.

    Parameters
    ----------
    name : str
        The name of its placeholder.
    over : str
        The name of the numbers in the formulas.
    points : tuple of float
        The numbers, one for each line.
    line : tuple of Formula
        The formulas of a line.
    format, separator : str
        The format of the numbers, and their separator.
    """

    name: str
    over: str = key(keys.name, "", required="what the formulas call the numbers")
    points: tuple[float, ...] = key(keys.numbers, (), required="a list of numbers, one a line")
    line: tuple[Formula, ...] = key_at(_line, (), required="a list of formulas")
    format: str = key(_number_format, ".8g")
    separator: str = key(_separator, ", ")

    @property
    def uses(self) -> tuple[str, ...]:
        """The names that have to have a value."""
        names = [name for formula in self.line for name in formula.names]
        return tuple(dict.fromkeys(name for name in names if name != self.over))

    def value(self, values: Mapping[str, Any]) -> str:
        """Return the lines."""
        known = {**values, self.over: np.array(self.points)}
        columns = [
            np.broadcast_to(np.asarray(formula(known), dtype=np.float64), len(self.points))
            for formula in self.line
        ]
        rows = zip(*(column.tolist() for column in columns), strict=True)
        return "\n".join(
            self.separator.join(format(number, self.format) for number in row) for row in rows
        )


class OutputReader:
    """Reads the curves of all tests of a model from a run's folder.

    Parameters
    ----------
    sources : tuple of CurveSource
        One for each test.
    success : (file, text) or None
        A text that the file must contain; otherwise the run has failed.
    """

    def __init__(
        self, sources: tuple[CurveSource, ...], success: tuple[str, str] | None = None
    ) -> None:
        self.sources, self.success = sources, success
        self.text = repr((sources, success))  # identifies the reader in a store

    def __call__(self, folder: Path) -> list[Array]:
        """Return the curves; raise where the run is not complete."""
        if self.success is not None:
            file, wanted = self.success
            path = folder / file
            if not path.is_file():
                raise FileNotFoundError(f"the run has written no {file}, which says how it ended")
            if wanted not in path.read_text(encoding="latin-1"):
                raise ValueError(f"{file} does not hold {wanted!r}: the run is not complete")
        return [source.read(folder) for source in self.sources]


class Picked:
    """The curve of one test among those that a model returns; a number for a test of one."""

    def __init__(self, place: int, is_number: bool) -> None:
        self.place, self.is_number = place, is_number

    def __call__(self, curves: Any) -> Any:
        """Return it."""
        curve = curves[self.place] if isinstance(curves, list) else curves
        return float(curve[0, 0]) if self.is_number else curve


class StudyModel:
    """The model of a study, a function of its parameters.

    Parameters
    ----------
    command_model : CommandModel
        Fills in the templates, runs the solver, reads the curves.
    values : tuple of (DeckValue or DeckTable)
        Further values for the templates; each formula may use the earlier ones.

    Attributes
    ----------
    identity : str
        The text that identifies its runs in a store.
    is_solver : bool
        True, as for a `CommandModel`.
    """

    is_solver = True

    def __init__(
        self, command_model: CommandModel, values: tuple[DeckValue | DeckTable, ...]
    ) -> None:
        self.command_model, self.values = command_model, values
        self.identity = command_model.identity
        if values:
            digest = hashlib.sha256(repr(values).encode()).hexdigest()[:16]
            self.identity += f", values {digest}"

    def __call__(self, parameters: Mapping[str, float]) -> Any:
        """Run the solver and return its curves."""
        known: dict[str, Any] = dict(parameters)
        for value in self.values:
            known[value.name] = value.value(known)
        wanted = {name: known[name] for name in self.command_model.parameters}
        return self.command_model(wanted)
