"""One run of the model for one set of parameters, and what the objective made of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from ...curves.inputs import Array

__all__ = ["Evaluation", "Point", "as_records"]

Point: TypeAlias = tuple[float, ...]
"""The parameters that are searched for, in the order of the bounds."""


@dataclass(frozen=True)
class Evaluation:
    """One run of the model and what the objective made of it."""

    number: int
    point: Point
    value: float
    failed: bool
    seconds: float
    message: str = ""
    simulations: tuple[Array, ...] | None = None


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
