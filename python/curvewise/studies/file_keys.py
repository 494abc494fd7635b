"""The keys of a study that say how a file is read: made from the declarations of these options."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..files.file_options import READING
from ..files.number_texts import SIGNS
from . import keys
from .keys import key

__all__ = ["said"]

_READERS: dict[str, Callable[[Any], Any]] = {
    "text": keys.text,
    "name": keys.name_or_number("its name"),
    "row": keys.at_least(1),
    "flag": keys.flag,
    "sign": keys.choice(tuple(SIGNS)),
}
_KINDS = {option.name: option.kind for option in READING}


def said(option: str) -> Any:
    """Return the key of an option that is said of a file."""
    kind = _KINDS[option]
    return key(_READERS[kind], False if kind == "flag" else None)
