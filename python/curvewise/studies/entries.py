"""What the tables of a study file say once they are checked: plain data, in the file's words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..curves.inputs import Array
from .curve_sources import CurveSource
from .study_model import DeckTable, DeckValue

__all__ = ["ModelEntry", "SearchEntry", "TestEntry"]


@dataclass(frozen=True, eq=False)
class TestEntry:
    """A table [[tests]].

    Attributes
    ----------
    name : str
        What tables and files of results call it.
    experiment : ndarray, or float
        The measured curve, or a number.
    axes : tuple of str
        What its coordinates are called.
    file : str
        Where it is from.
    output : CurveSource
        Where its simulation is in a run's folder.
    model : str
        The name of the model that simulates it.
    weight : float
        A factor.
    own : mapping
        What it has of its own in the place of [search]'s, as arguments of `Case`.
    """

    __test__ = False  # no class of tests, though pytest may meet it

    name: str
    experiment: Array | float
    axes: tuple[str, ...]
    file: str
    output: CurveSource
    model: str
    weight: float = 1.0
    own: Mapping[str, Any] = field(default_factory=dict)

    @property
    def is_number(self) -> bool:
        """Whether the test is a number, and no curve."""
        return isinstance(self.experiment, float)


@dataclass(frozen=True)
class ModelEntry:
    """A table [model], or one of [models]: as the arguments of `CommandModel`."""

    name: str
    command: tuple[str, ...]
    templates: tuple[Path, ...]
    timeout: float
    environment: tuple[tuple[str, str], ...] = ()
    scratch: Path | None = None
    keep: bool = False
    success: tuple[str, str] | None = None
    values: tuple[DeckValue | DeckTable, ...] = ()


@dataclass(frozen=True)
class SearchEntry:
    """The table [search]: as the arguments of `identify`, those that are given."""

    measures: tuple[str, ...] = ("area",)
    objective: Mapping[str, Any] = field(default_factory=dict)
    search: Mapping[str, Any] = field(default_factory=dict)
    start: Mapping[str, float] = field(default_factory=dict)
    store: Path = Path("study.db")
    uncertainty: int = 1000  # how often the noise is drawn; 0 for none
