"""The base of what the richer functions return: a record that prints its numbers and no arrays."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

__all__ = ["Curves", "Record", "printed"]

Curves: TypeAlias = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None


@dataclass(frozen=True, repr=False)
class Record:
    """A record that does not print its arrays."""

    def __repr__(self) -> str:
        names = [one.name for one in fields(self) if one.repr]
        return printed(self, [(name, getattr(self, name)) for name in names])

    def __str__(self) -> str:
        return repr(self)


def printed(record: object, items: Iterable[tuple[str, Any]]) -> str:
    """Return the name of a record with its values, and of arrays the shapes."""
    parts = [f"{name}={_short(value)}" for name, value in items]
    return f"{type(record).__name__}({', '.join(parts)})"


def _short(value: Any) -> str:
    return f"<array of shape {value.shape}>" if isinstance(value, np.ndarray) else repr(value)
