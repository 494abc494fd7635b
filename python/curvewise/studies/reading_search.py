"""The table [search] of a study file: measures, method, workers, store."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..calibration import MEASURES
from ..calibration.methods import METHODS, method_with
from ..calibration.methods.method import Method
from ..measures.registry import PRESETS
from . import keys
from .entries import SearchEntry
from .keys import Table
from .toml_source import Source

__all__ = ["read_search"]

_SAMPLES, _FEWEST_SAMPLES = 1000, 20


def read_search(
    source: Source, values: Any, start: Mapping[str, float], store: Path
) -> SearchEntry:
    """Return how to search; every key has a default."""
    table = Table(source, ("search",), values)
    measure = table.take("measure", keys.choice(MEASURES), "area")
    measures = table.take("measures", _measures, (measure,))
    if "measure" in table and "measures" in table:
        table.problem("measures", "stands beside measure; give one of them")
    objective: dict[str, tuple[Callable[[Any], Any], Any]] = {
        "preset": (keys.choice(tuple(PRESETS)), None),
        "part": (keys.choice(("experiment", "simulation")), None),
        "min_coverage": (keys.fraction, None),
        "failure_value": (keys.positive, None),
        "options": (keys.mapping, None),
    }
    search: dict[str, tuple[Callable[[Any], Any], Any]] = {
        "method": (_method, None),
        "seed": (keys.whole, None),
        "workers": (_workers, None),
        "max_runs": (keys.at_least(1), None),
        "version": (keys.text, None),
    }
    chosen = {key: table.take(key, *rest) for key, rest in {**objective, **search}.items()}
    given = {key: value for key, value in chosen.items() if value is not None}
    if len(measures) > 1 and "options" in given:
        table.problem("options", "are those of one measure; several measures take none")
    path = table.take("store", lambda value: source.folder / keys.text(value), store)
    if not path.parent.is_dir():
        table.problem("store", f"is in {path.parent}, and there is no such folder; make it")
    uncertainty = table.take("uncertainty", _samples, _SAMPLES)
    table.refuse_unknown()
    return SearchEntry(
        measures,
        {key: given[key] for key in objective if key in given},
        {key: given[key] for key in search if key in given},
        start,
        path,
        uncertainty,
    )


def _method(value: Any) -> Method:
    """Read a method: its name, or a table of its name and options."""
    if not isinstance(value, Mapping):
        return METHODS[keys.choice(tuple(METHODS))(value)]
    try:
        return method_with(value)
    except (TypeError, ValueError) as error:
        raise ValueError(f"cannot be: {error}") from None


def _measures(value: Any) -> tuple[str, ...]:
    names = keys.texts(value)
    for name in names:
        keys.choice(MEASURES)(name)
    if len(set(names)) != len(names):
        raise ValueError(f"is {list(names)}; give each measure once")
    return names


def _samples(value: Any) -> int:
    """Read how often the noise is drawn: true for the usual number, false for not at all."""
    if isinstance(value, bool):
        return _SAMPLES if value else 0
    if keys.whole(value) < _FEWEST_SAMPLES:
        raise ValueError(
            f"is {value}; give true, false, or the number of samples, {_FEWEST_SAMPLES} or more"
        )
    return int(value)


def _workers(value: Any) -> int:
    if keys.whole(value) == 0 or value < -1:
        raise ValueError(f"is {value}; give at least 1, or -1 for one for each core")
    return int(value)
