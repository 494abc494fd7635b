"""The options of all materials that commands and studies offer, from the materials' fields."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any, get_args, get_type_hints

from .material import Material

__all__ = ["MaterialOption", "material_options"]

_NOT_OFFERED = ("rtol", "rate")  # a tolerance, and an option of each test


@dataclass(frozen=True)
class MaterialOption:
    """An option of one or several materials.

    Attributes
    ----------
    name : str
    default : str, int or float
    choices : tuple of str
        The words to choose from; empty if the option is a number.
    materials : tuple of str
        The names of the materials that have it.
    """

    name: str
    default: Any
    choices: tuple[str, ...]
    materials: tuple[str, ...]


def material_options(kinds: Iterable[type[Material]]) -> dict[str, MaterialOption]:
    """Return the options of some materials that are words or numbers, by name.

    Parameters
    ----------
    kinds : iterable of subclasses of Material
        Options of the same name have the same choices.

    Returns
    -------
    dict of str to MaterialOption
        In the order of the materials and their fields.
    """
    found: dict[str, MaterialOption] = {}
    for kind in kinds:
        hints = get_type_hints(kind)
        for one in fields(kind):
            if one.name in _NOT_OFFERED:
                continue
            choices = get_args(hints[one.name])
            before = found[one.name].materials if one.name in found else ()
            found[one.name] = MaterialOption(one.name, one.default, choices, (*before, kind.name))
    return found
