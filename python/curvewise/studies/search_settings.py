"""The table [search] of a study file: measures, method, workers, store."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from ..calibration import MEASURES
from ..calibration.methods import METHODS, method_with
from ..calibration.methods.method import Method
from ..measures.registry import PRESETS
from . import keys
from .keys import StudyTable, key, key_at
from .toml_source import KeyPath, Source

__all__ = ["ComparisonKeys", "SearchSettings", "read_search"]

_FEWEST_SAMPLES = 20


@dataclass(frozen=True)
class ComparisonKeys:
    """Settings of the comparison: for all tests, or for one that differs."""

    measure: str | None = key(keys.choice(MEASURES))
    preset: str | None = key(keys.choice(tuple(PRESETS)))
    part: str | None = key(keys.choice(("experiment", "simulation")))
    min_coverage: float | None = key(keys.fraction)
    options: Mapping[str, Any] | None = key(keys.mapping)

    def given(self, *names: str) -> dict[str, Any]:
        """Return those of some settings that the file gives."""
        return {name: value for name in names if (value := getattr(self, name)) is not None}


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


def _samples(value: Any) -> int | None:
    """Read the number of noise samples: true is 0 samples, false is None."""
    if isinstance(value, bool):
        return 0 if value else None
    wanted = f"true, false, or the number of samples, {_FEWEST_SAMPLES} or more"
    return keys.reader(wanted, lambda count: keys.whole(count) >= _FEWEST_SAMPLES, int)(value)


_workers = keys.reader(
    "at least 1, or -1 for one for each core",
    lambda count: keys.whole(count) >= -1 and count != 0,
    int,
)


def _store(source: Source, path: KeyPath, value: Any) -> Path:
    return source.folder / keys.text(value)


@dataclass(frozen=True)
class SearchSettings(ComparisonKeys):
    """The table [search], with its measure and the start of the parameters.

    `measures` includes the measure, and `start` is that of the parameters. The number of noise
    samples for the uncertainty is None if the uncertainty is switched off.
    """

    measures: tuple[str, ...] = key(_measures, ())
    failure_value: float | None = key(keys.positive)
    method: Method | None = key(_method)
    seed: int | None = key(keys.whole)
    max_runs: int | None = key(keys.at_least(1))
    workers: int | None = key(_workers)
    store: Path = key_at(_store, Path())
    version: str | None = key(keys.text)
    uncertainty: int | None = key(_samples, 0)
    start: Mapping[str, float] = field(default_factory=dict)

    @property
    def comparison(self) -> dict[str, Any]:
        """The given settings for the comparison of all tests, except the measure."""
        return self.given("preset", "part", "min_coverage", "failure_value", "options")

    @property
    def keywords(self) -> dict[str, Any]:
        """The given settings of the search, as arguments of `identify`."""
        return self.given("method", "seed", "workers", "max_runs")


def read_search(source: Source, path: KeyPath, values: Any) -> SearchSettings:
    """Return how to search; every key has a default."""
    table = StudyTable(source, path, values)
    search = table.read(SearchSettings)
    if "measure" in table.given and "measures" in table.given:
        table.problem("measures", "stands beside measure; give one of them")
    if len(search.measures) > 1 and search.options is not None:
        table.problem("options", "are those of one measure; several measures take none")
    if search.store == Path():
        search = replace(search, store=source.folder / f"{source.path.stem}.db")
    folder = search.store.parent
    if not folder.is_dir():
        table.problem("store", f"is in {folder}, and there is no such folder; make it")
    alone = () if search.measure is None else (search.measure,)
    return replace(search, measures=search.measures or alone)
