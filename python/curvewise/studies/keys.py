"""The keys of one table of a study file: taken one by one, checked, and the rest refused.

A key that is wrong is noted with its line and replaced by its default, so that the rest of the
file is checked too.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from .toml_source import KeyPath, Source

__all__ = [
    "Table",
    "at_least",
    "choice",
    "flag",
    "fraction",
    "mapping",
    "name",
    "not_negative",
    "number",
    "numbers",
    "positive",
    "text",
    "texts",
    "whole",
]

T = TypeVar("T")
D = TypeVar("D")

_NAME = re.compile(r"[A-Za-z_]\w*")


class Table:
    """One table of a study file.

    Parameters
    ----------
    source : Source
        The file, where problems are noted.
    path : tuple of str and int
        Where the table is.
    values : mapping, or None
        What is in it, None where the table is missing; anything else is a problem.
    """

    def __init__(self, source: Source, path: KeyPath, values: Any) -> None:
        self.source, self.path = source, path
        self._known: list[str] = []
        if values is None:
            values = {}
        if not isinstance(values, Mapping):
            source.problem(path, f"is {values!r}; it is a table, [{path[-1]}]")
            values = {}
        self._values = values

    def __contains__(self, key: str) -> bool:
        return key in self._values

    @property
    def keys(self) -> list[str]:
        """The keys that the file gives, in its order."""
        return list(self._values)

    def take(self, key: str, read: Callable[[Any], T], default: D, *, required: str = "") -> T | D:
        """Return a key's value as `read` gives it; the default where it is missing or wrong.

        Parameters
        ----------
        key : str
            Which.
        read : callable
            Raises ValueError with the rest of a sentence that begins with the key.
        default : object
            In the place of what is missing or wrong.
        required : str
            What to write, where the key must be there.
        """
        self._known.append(key)
        if key not in self._values:
            if required:
                self.problem("", f"has no {key}; give {required}")
            return default
        try:
            return read(self._values[key])
        except ValueError as error:
            self.problem(key, str(error))
            return default

    def raw(self, key: str) -> Any:
        """Return a key's value as it is, None if it is missing."""
        self._known.append(key)
        return self._values.get(key)

    def problem(self, key: str, message: str) -> None:
        """Note what is wrong with a key; with the table itself if the key is empty."""
        self.source.problem((*self.path, key) if key else self.path, message)

    def refuse_unknown(self) -> None:
        """Note the keys that nobody has taken."""
        for key in self._values:
            if key not in self._known:
                near = difflib.get_close_matches(key, self._known, n=1, cutoff=0.6)
                hint = (
                    f"did you mean {near[0]!r}?" if near else f"there is {', '.join(self._known)}"
                )
                self.problem(key, f"is no key of a study; {hint}")


def text(value: Any) -> str:
    """Read a text that is not empty."""
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"is {value!r}; give a text")
    return value


def name(value: Any) -> str:
    """Read a name as formulas and templates have them."""
    if not isinstance(value, str) or not _NAME.fullmatch(value):
        raise ValueError(f"is {value!r}; a name has letters, digits and _, and no digit first")
    return value


def texts(value: Any) -> tuple[str, ...]:
    """Read a list of texts; a text alone is a list of one."""
    items = [value] if isinstance(value, str) else value
    if not isinstance(items, list) or not items or not all(isinstance(i, str) for i in items):
        raise ValueError(f"is {value!r}; give a list of texts")
    return tuple(items)


def number(value: Any) -> float:
    """Read a finite number."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ValueError(f"is {value!r}; give a number{_unquoted(value)}")
    return float(value)


def positive(value: Any) -> float:
    """Read a number above 0."""
    if number(value) <= 0:
        raise ValueError(f"is {value!r}; give a number above 0")
    return float(value)


def not_negative(value: Any) -> float:
    """Read a number that is 0 or above."""
    if number(value) < 0:
        raise ValueError(f"is {value!r}; give a number that is not negative")
    return float(value)


def fraction(value: Any) -> float:
    """Read a number from 0 to 1."""
    if not 0 <= number(value) <= 1:
        raise ValueError(f"is {value!r}; give a number from 0 to 1")
    return float(value)


def numbers(value: Any) -> tuple[float, ...]:
    """Read a list of numbers."""
    if not isinstance(value, list) or not value:
        raise ValueError(f"is {value!r}; give a list of numbers")
    return tuple(number(item) for item in value)


def whole(value: Any) -> int:
    """Read a whole number."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"is {value!r}; give a whole number")
    return value


def at_least(least: int) -> Callable[[Any], int]:
    """Return what reads a whole number from a least one on."""

    def read(value: Any) -> int:
        if whole(value) < least:
            raise ValueError(f"is {value}; give at least {least}")
        return int(value)

    return read


def flag(value: Any) -> bool:
    """Read true or false."""
    if not isinstance(value, bool):
        raise ValueError(f"is {value!r}; give true or false")
    return value


def mapping(value: Any) -> dict[str, Any]:
    """Read a table whose keys are checked elsewhere."""
    if not isinstance(value, Mapping):
        raise ValueError(f"is {value!r}; give a table, {{ name = value }}")
    return dict(value)


def choice(choices: Sequence[str]) -> Callable[[Any], str]:
    """Return what reads one of several words."""

    def read(value: Any) -> str:
        if value not in choices:
            near = difflib.get_close_matches(str(value), choices, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"choose from {', '.join(choices)}"
            raise ValueError(f"is {value!r}; {hint}")
        return str(value)

    return read


def _unquoted(value: Any) -> str:
    """Say so where a number is written in quotes."""
    if isinstance(value, str):
        try:
            float(value)
        except ValueError:
            return ""
        return ", without quotes"
    return ""
