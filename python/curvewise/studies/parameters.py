"""The table [parameters] of a study file: bounds, formulas of other parameters, and a start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..calibration import Below, Log, Tied
from ..calibration.problem.space import Space
from . import keys
from .formulas import Formula, undefined_names
from .keys import StudyTable, key
from .toml_source import KeyPath, Source

__all__ = ["SearchedParameter", "complete_start", "read_parameters"]


def _pair(value: Any) -> tuple[float, float]:
    pair = keys.numbers(value)
    if len(pair) != 2 or pair[0] > pair[1]:
        raise ValueError(f"is {value!r}; give [low, high], low below high")
    return pair[0], pair[1]


@dataclass(frozen=True)
class SearchedParameter:
    """A parameter with further keys in addition to its bounds."""

    bounds: tuple[float, float] = key(_pair, (0.0, 1.0), required="bounds = [low, high]")
    scale: str = key(keys.choice(("linear", "log")), "linear")
    below: str = key(keys.text, "")
    start: float | None = key(keys.number)


def read_parameters(source: Source, given: Any) -> tuple[dict[str, Any], dict[str, float]]:
    """Return the parameters as `identify` takes them, and the starts that are given."""
    path: KeyPath = ("parameters",)
    if not isinstance(given, Mapping) or not given:
        source.problem(path, "is missing: give a table [parameters] with lines E = [low, high]")
        return {}, {}
    bounds: dict[str, Any] = {}
    start: dict[str, float] = {}
    table = StudyTable(source, path, given)
    for parameter, value in given.items():
        try:
            keys.name(parameter)
            bounds[parameter] = _bounds(source, parameter, value, list(bounds), start)
            Space({"_another": (0.0, 1.0), **bounds})  # which may not be of fixed ones alone
        except ValueError as error:
            table.problem(parameter, str(error).replace(f"bounds[{parameter!r}] ", ""))
            bounds[parameter] = (0.0, 1.0)  # for the checks that follow
    return bounds, start


def _bounds(
    source: Source, parameter: str, value: Any, before: list[str], start: dict[str, float]
) -> Any:
    if isinstance(value, str):
        formula = Formula(value)
        for message in undefined_names(formula, before):
            raise ValueError(f"{message}; list those it uses before it")
        return Tied(formula)
    if isinstance(value, list):
        return _pair(value)
    if not isinstance(value, Mapping):
        return keys.number(value)
    said = StudyTable(source, ("parameters", parameter), value).read(SearchedParameter)
    if said.start is not None:
        start[parameter] = said.start
    if said.below and said.scale == "log":
        raise ValueError("has both below and scale = 'log'; give one of them")
    if said.below:
        if said.below not in before:
            raise ValueError(
                f"stays below {said.below!r}, which is not a parameter listed before it"
            )
        return Below(said.below, *said.bounds)
    return Log(*said.bounds) if said.scale == "log" else said.bounds


def complete_start(
    source: Source, bounds: dict[str, Any], start: dict[str, float]
) -> dict[str, float]:
    """Return a start for every searched parameter, or None."""
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
