"""The keys of a study about files and the preparation of tests, made from their declarations."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..files.file_options import CYCLE_COLUMN, PREPARATION, READING
from ..files.number_texts import SIGNS
from . import keys
from .keys import key

__all__ = ["said"]


def _stresses(value: Any) -> bool | tuple[float, ...]:
    """Read true, or two stresses."""
    if isinstance(value, bool):
        return value
    try:
        low, high = keys.numbers(value)
    except ValueError:
        raise ValueError(f"is {value!r}; give true, or [low, high], two stresses") from None
    return low, high


_READERS: dict[str, Callable[[Any], Any]] = {
    "text": keys.text,
    "name": keys.name_or_number("its name"),
    "row": keys.at_least(1),
    "flag": keys.flag,
    "sign": keys.choice(tuple(SIGNS)),
    "size": keys.positive,
    "stresses": _stresses,
}
_OPTIONS = (*READING, *PREPARATION, CYCLE_COLUMN)
_KINDS = {option.name: option.kind for option in _OPTIONS}


def said(option: str) -> Any:
    """Return the key of a file option."""
    kind = _KINDS[option]
    return key(_READERS[kind], False if kind in ("flag", "stresses") else None)
