"""One run of the model for one set of parameters, with its objective value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from ..._bounds import OutsideModelError
from ...curves.inputs import Array

__all__ = ["Evaluation", "Point", "Run", "as_records", "is_outside"]

_OUTSIDE = f"{OutsideModelError.__name__}: "

Point: TypeAlias = tuple[float, ...]
"""The parameters that are searched for, in the order of the bounds."""


@dataclass(frozen=True)
class Evaluation:
    """One run of the model, and its objective value."""

    number: int
    point: Point
    value: float
    failed: bool
    seconds: float
    message: str = ""
    simulations: tuple[Array, ...] | None = None

    @property
    def outside(self) -> bool:
        """Whether the parameters are outside of the model's own bounds; `failed` is then true."""
        return is_outside(self.message)


Run: TypeAlias = tuple[Array, Evaluation]
"""A run with its place in the unit cube."""


def is_outside(message: str) -> bool:
    """Return whether a run has the message of an `OutsideModelError`."""
    return message.startswith(_OUTSIDE)


def as_records(evaluations: list[Evaluation], names: tuple[str, ...]) -> np.recarray[Any, Any]:
    """Return evaluations as a numpy record array with a field for every parameter."""
    fields = [
        ("evaluation", np.int64),
        *((name, np.float64) for name in names),
        ("value", np.float64),
        ("failed", np.bool_),
        ("seconds", np.float64),
    ]
    rows = [(e.number, *e.point, e.value, e.failed, e.seconds) for e in evaluations]
    return np.array(rows, dtype=fields).view(np.recarray)
