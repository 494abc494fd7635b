"""The keys of a study file: described fields of dataclasses, with one reader.

A field made by `key`, `key_at` or `table` defines how its value is read, the default for a missing
or wrong value, and the advice for a missing required key. `StudyTable.read` creates the dataclass
of a table. It records every wrong key with its line and continues with the default, so that the
rest of the file is checked too. It refuses undescribed keys.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, fields
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from .._names import did_you_mean
from .toml_source import KeyPath, Source

__all__ = [
    "StudyTable",
    "as_it_is",
    "at_least",
    "choice",
    "described",
    "flag",
    "fraction",
    "in_run",
    "key",
    "key_at",
    "mapping",
    "name",
    "name_or_number",
    "not_negative",
    "number",
    "numbers",
    "path",
    "positive",
    "reader",
    "table",
    "text",
    "texts",
    "whole",
]

T = TypeVar("T")
D = TypeVar("D")
ReadAt: TypeAlias = "Callable[[Source, KeyPath, Any], Any]"

_NAME = re.compile(r"[A-Za-z_]\w*")


def key(read: Callable[[Any], Any], default: Any = None, *, required: str = "") -> Any:
    """Describe a key of a table.

    Parameters
    ----------
    read : callable
        Converts the file's value; raises ValueError with the rest of a sentence that begins with
        the key.
    default : object
        The value if the key is missing or wrong.
    required : str
        Advice for a missing required key.
    """
    return key_at(lambda source, path, value: read(value), default, required=required)


def key_at(read: ReadAt, default: Any = None, *, required: str = "") -> Any:
    """Describe a key whose value means something else in another file, such as a path."""
    return field(default=default, metadata={"read": read, "required": required, "is_table": False})


def table(read: ReadAt) -> Any:
    """Describe an inner table: where it is missing it is read as an empty one."""
    return field(default=None, metadata={"read": read, "required": "", "is_table": True})


def described(kind: type) -> dict[str, Mapping[str, Any]]:
    """Return the keys that a dataclass describes, with their descriptions.

    A final underscore of a field, which avoids a Python keyword, does not belong to the key.
    """
    found = {item.name: item.metadata for item in fields(kind) if "read" in item.metadata}
    return {name.rstrip("_"): {**how, "field": name} for name, how in found.items()}


class StudyTable:
    """One table of a study file.

    Parameters
    ----------
    source : Source
        The file; it collects the errors.
    path : tuple of str and int
        The place of the table.
    values : mapping, or None
        The content of the table; None if it is missing. Any other value is an error.

    Attributes
    ----------
    given : mapping
        The keys and values of the file, in order.
    wrong : set of str
        The keys with errors.
    """

    def __init__(self, source: Source, path: KeyPath, values: Any) -> None:
        self.source, self.path = source, path
        self.wrong: set[str] = set()
        self._taken: dict[str, Any] = {}
        self._problems = len(source.problems)
        if values is None:
            values = {}
        if not isinstance(values, Mapping):
            source.problem(path, f"is {values!r}; it is a table, [{path[-1]}]")
            values = {}
        self.given: Mapping[str, Any] = values

    @property
    def is_right(self) -> bool:
        """Whether nothing has been found wrong since the table was begun."""
        return len(self.source.problems) == self._problems

    def take(self, readers: Mapping[str, Callable[[Any], Any]]) -> dict[str, Any]:
        """Return the values of keys that no dataclass describes; `read` then knows them.

        Parameters
        ----------
        readers : mapping of str to callable
            As for `key`, by the name of the key.
        """
        self._taken |= readers
        found = {}
        for name, read in readers.items():
            if name in self.given:
                try:
                    found[name] = read(self.given[name])
                except ValueError as error:
                    self.problem(name, str(error))
        return found

    def read(self, kind: type[T], **known: Any) -> T:
        """Return the table as the dataclass that describes its keys.

        Parameters
        ----------
        kind : type
            The dataclass.
        **known : object
            The fields that are not keys.
        """
        keys = described(kind)
        for name, how in keys.items():
            if how["is_table"]:
                value = self.given.get(name)
                known[how["field"]] = how["read"](self.source, (*self.path, name), value)
            elif name in self.given:
                try:
                    value = self.given[name]
                    known[how["field"]] = how["read"](self.source, (*self.path, name), value)
                except ValueError as error:
                    self.problem(name, str(error))
            elif how["required"]:
                self.problem("", f"has no {name}; give {how['required']}")
        for name in self.given:
            if name not in keys and name not in self._taken:
                known_keys = [*keys, *self._taken]
                hint = did_you_mean([name], known_keys)
                hint = hint or f"; the keys here are {', '.join(known_keys)}"
                self.problem(name, f"is not a known key{hint}")
        return kind(**known)

    def problem(self, key: str, message: str) -> None:
        """Record an error of a key, or of the table itself if the key is empty."""
        self.wrong.add(key)
        self.source.problem((*self.path, key) if key else self.path, message)


def reader(wanted: str, fits: Callable[[Any], Any], made: Callable[[Any], T]) -> Callable[[Any], T]:
    """Return a reader of fitting values; others raise an error with advice."""

    def read(value: Any) -> T:
        if not fits(value):
            raise ValueError(f"is {value!r}; give {wanted}")
        return made(value)

    return read


def as_it_is(value: Any) -> Any:
    """Return the value unchanged; it is checked elsewhere."""
    return value


def path(source: Source, path: KeyPath, value: Any) -> Any:
    """Read a path, which is relative to the file's folder."""
    return source.resolved(value)


text = reader("a text", lambda value: isinstance(value, str) and value.strip(), str)
in_run = reader(
    "a path inside the run's folder, neither absolute nor with ..",
    lambda value: isinstance(value, str) and value.strip() and _stays_inside(value),
    str,
)
flag = reader("true or false", lambda value: isinstance(value, bool), bool)
whole = reader(
    "a whole number", lambda value: isinstance(value, int) and not isinstance(value, bool), int
)
mapping = reader("a table, { name = value }", lambda value: isinstance(value, Mapping), dict)


def _stays_inside(path: str) -> bool:
    return "\0" not in path and ".." not in (parts := Path(path)).parts and not parts.is_absolute()


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


positive = reader("a number above 0", lambda value: number(value) > 0, float)
not_negative = reader("a number that is not negative", lambda value: number(value) >= 0, float)
fraction = reader("a number from 0 to 1", lambda value: 0 <= number(value) <= 1, float)


def numbers(value: Any) -> tuple[float, ...]:
    """Read a list of numbers."""
    if not isinstance(value, list) or not value:
        raise ValueError(f"is {value!r}; give a list of numbers")
    return tuple(number(item) for item in value)


def name_or_number(wanted: str) -> Callable[[Any], Any]:
    """Return what reads a text, or a number from 1."""
    return reader(
        f"{wanted}, or its number from 1",
        lambda value: isinstance(value, (str, int)) and not isinstance(value, bool),
        as_it_is,
    )


def at_least(least: int) -> Callable[[Any], int]:
    """Return a reader of integers from a least one on."""
    return reader(f"at least {least}", lambda value: whole(value) >= least, int)


def choice(choices: Sequence[str]) -> Callable[[Any], str]:
    """Return what reads one of several words."""

    def read(value: Any) -> str:
        if value not in choices:
            hint = did_you_mean([str(value)], choices) or f"; choose from {', '.join(choices)}"
            raise ValueError(f"is {value!r}{hint}")
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
