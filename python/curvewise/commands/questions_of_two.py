"""What ``curvewise compare`` asks of two files: their units, and where their tests begin.

Columns in different units, or a force next to a stress, make every measure wrong: the command asks,
and ends with status 1. A column without a unit is asked about only if the unit of the other one
explains the difference of their extents. A test that begins beside the origin, next to one that
begins there, is a warning: the measures are right for the numbers, but perhaps not for the tests.
Cost: linear in the points.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from .._option_names import named_by
from ..curves.foreign_curves import warn
from ..curves.inputs import Array
from ..curves.named_curve import known_names
from ..files.column_units import FORCES, LENGTHS, STRAINS, STRESSES, TIMES, unit_of
from .reading import Said

__all__ = ["ask_about_units", "warn_of_beginning"]

_KINDS: dict[str, dict[str, float]] = {
    "strain": STRAINS,
    "stress": STRESSES,
    "force": FORCES,
    "length": LENGTHS,
    "time": TIMES,
}
# The options with the size of the specimen that turns one kind into the other.
_SIZES = {("force", "stress"): ("--area", "mm²"), ("length", "strain"): ("--gauge-length", "mm")}
_WORDS = {"strain": "strain", "dehnung": "strain", "stress": "stress", "spannung": "stress"}
# Extents that differ by less are those of one unit.
_ALIKE = 1.5


class _Column(NamedTuple):
    """A column of a file.

    Attributes
    ----------
    file, ending, name : str
        The file, the ending of its options, and the name of the column.
    extent : float
    kind : str
        The quantity, as far as the unit or the name tells it, else "".
    factor : float or None
        The unit over the basic one of its kind: None if the name has no unit.
    """

    file: str
    ending: str
    name: str
    extent: float
    kind: str
    factor: float | None

    def __str__(self) -> str:
        return f"{self.name!r} of {self.file}"


class _Answer(NamedTuple):
    """The conversion of a column: its size of the specimen, in words, or its factor."""

    column: _Column
    factor: float
    size: str = ""


def ask_about_units(files: Sequence[str], said: Sequence[Said], curves: Sequence[Any]) -> None:
    """Refuse two curves whose columns have different units, unless factors are given.

    Parameters
    ----------
    files : sequence of str
        The names of A and B.
    said : sequence of Said
        Their options.
    curves : sequence of array_like
        Their points; curves from files know the names of their columns.

    Raises
    ------
    ValueError
        If columns have different units or quantities; the message has the options that convert
        them.
    """
    if any(one.factors is not None for one in said):
        return
    a, b = (_columns(*one) for one in zip(files, said, curves, strict=True))
    if len(a) != len(b):
        return
    found = []
    sizes = []
    factors: dict[str, list[str]] = {}
    for place, pair in enumerate(zip(a, b, strict=True)):
        if (answer := _answer(*pair)) is None:
            continue
        found.append(f"{pair[0]} and {pair[1]}")
        if answer.size:
            sizes.append(answer.size)
        else:
            listed = factors.setdefault(answer.column.ending, ["1"] * len(a))
            listed[place] = f"{answer.factor:.7g}"
    if found:
        ways = [f"--factors{ending} {' '.join(listed)}" for ending, listed in factors.items()]
        raise ValueError(
            f"{', and '.join(found)} seem to be in different units; give "
            f"{' and '.join([*ways, *sizes])}, or --factors {' '.join(['1'] * len(a))} to compare "
            "the numbers as they are"
        )


def warn_of_beginning(said: Sequence[Said], curves: Sequence[Any]) -> None:
    """Warn if one of two tests begins at the origin, and the other one beside it.

    Parameters
    ----------
    said : sequence of Said
        The options of A and B.
    curves : sequence of array_like
        Their points; only strain and stress, by the names of their columns, are looked at.

    Warns
    -----
    UserWarning
        With the options that correct the zero, or cut the toe.
    """
    from ..fitting.beginnings import BeginningError, check_beginnings

    if not all(_is_test(curve) for curve in curves):
        return
    sentences = []
    for one, curve in zip(said, curves, strict=True):
        with named_by({"zero": f"--zero{one.ending}"}.get):  # a toe is cut from both
            try:
                sentences.append(check_beginnings([curve], "MPa", effect=""))
            except BeginningError as error:
                sentences.append(str(error))
            except ValueError:  # not a test of a material
                return
    if bool(sentences[0]) != bool(sentences[1]):
        warn(f"{sentences[0] or sentences[1]}. The other curve begins at zero")


def _is_test(curve: Any) -> bool:
    """Return whether the names of two columns say that they are strain and stress."""
    names = known_names(curve)
    return [_kind(name)[0] for name in names] == ["strain", "stress"]


def _columns(file: str, said: Said, curve: Any) -> list[_Column]:
    names, points = known_names(curve), np.asarray(curve)
    if len(names) != points.shape[-1]:
        return []
    extents: Array = np.ptp(points, axis=0)
    return [
        _Column(file, said.ending, name, extent, *_kind(name))
        for name, extent in zip(names, extents.tolist(), strict=True)
    ]


def _kind(name: str) -> tuple[str, float | None]:
    """Return the quantity of a column, and the factor of its unit."""
    unit = unit_of(name)
    for kind, factors in _KINDS.items():
        if unit in factors:
            return kind, factors[unit]
    text = name.casefold()
    return next((kind for word, kind in _WORDS.items() if word in text), ""), None


def _answer(a: _Column, b: _Column) -> _Answer | None:
    """Return how two columns come to one unit; None if nothing shows that they have two.

    B is converted to the unit of A if both are known, and the one that is known if not.
    """
    for one, other in ((b, a), (a, b)):
        if size := _SIZES.get((one.kind, other.kind)):
            return _Answer(one, 1.0, f"{size[0]}{one.ending}, in {size[1]}")
    if a.kind and b.kind and a.kind != b.kind:
        return None
    if a.factor is not None and b.factor is not None:
        return None if a.factor == b.factor else _Answer(b, b.factor / a.factor)
    known, other = (a, b) if b.factor is None else (b, a)
    if known.factor is None or _is_alike(known.extent, other.extent):
        return None
    converted = known.extent * known.factor
    is_explained = _is_alike(converted, other.extent)
    if a.kind == b.kind:  # by their names: tests of one quantity may have two amplitudes
        is_explained |= 2.0 * _distance(converted, other.extent) < _distance(
            known.extent, other.extent
        )
    return _Answer(known, known.factor) if is_explained else None


def _distance(p: float, q: float) -> float:
    """Return how far two extents are apart, as a logarithm of their ratio."""
    return abs(math.log(p / q))


def _is_alike(p: float, q: float) -> bool:
    """Return whether two extents are about the same; those of flat columns always are."""
    return min(p, q) <= 0.0 or max(p, q) <= _ALIKE * min(p, q)
