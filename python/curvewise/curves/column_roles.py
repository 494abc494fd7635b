"""Recognises time, row numbers and coordinates by the names of columns.

In a table of three columns or more, rarely all columns are coordinates. A logger writes time, a row
number or a temperature next to strain and stress, and each would count as a coordinate. Such a
table is accepted if its names show that all columns are coordinates of one point;
docs/reference/accepted_inputs.md has the rule. The cost is that of some comparisons of short texts.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise, takewhile
from typing import Any

__all__ = ["are_coordinates", "are_names", "coordinates_among", "counts_cycles", "is_time"]

# "time", "Time [s]", "t (s)", "time_s", "Step Time", "Zeit/s"; not "T" (temperature), "timeout".
_TIME = re.compile(
    r"(?:(?i:(?:\w+[ _])?(?:time|zeit|temps|tiempo|tempo)|timestamp)|t)"
    r"(?:[ _]*[\[(/,].*|[ _](?i:s|sec|seconds?|ms|min|minutes?|h|hours?))?"
)
# "id", "track_id", "Point No"; and what pandas calls an index that it read from a file.
_COUNT = re.compile(
    r"(?i)(?:.*[ _])?(?:id|index|no|nr|number|frame|sample|row|point|step)|unnamed: \d+|level_\d+"
)
# "Cycle", "Total Cycles", "cycle_no", "Zyklus", "Zyklen [-]".
_CYCLE = re.compile(
    r"(?i)(?:\w+[ _])?(?:cycles?|zykl(?:us|en))(?:[ _](?:no\.?|nr\.?|number|count))?"
)
_COMPONENT = re.compile(r"[xyz]{2}|[xyz]?\d+")
_ON_EARTH = {
    *("x", "y", "z", "lon", "long", "lng", "longitude", "lat", "latitude", "easting", "northing"),
    *("east", "north", "up", "alt", "altitude", "ele", "elev", "elevation", "height", "depth"),
}


def is_time(name: Any) -> bool:
    """Return whether a column is time by its name, with or without a unit."""
    return isinstance(name, str) and _TIME.fullmatch(name.strip()) is not None


def counts_cycles(name: Any) -> bool:
    """Return whether a column counts cycles by its name, with or without a unit in brackets."""
    if not isinstance(name, str):
        return False
    return _CYCLE.fullmatch(re.split(r"[\[(/,]", name)[0].strip()) is not None


def are_coordinates(names: Sequence[Any]) -> bool:
    """Return whether names are those of the coordinates of one point.

    Accepted names are numbers, consecutive letters (x, y, z), or components (xx, yy, xy). They may
    be alone or the part in which longer names differ. A place on the Earth is accepted too. Units
    in brackets or behind a comma or slash, and capitals, are ignored.
    """
    plain = [re.split(r"[\[(/,]", _text(name))[0].strip().lower() for name in names]
    if len(set(plain)) < len(plain):
        return False
    if set(plain) <= _ON_EARTH or all(name.isdigit() for name in plain):
        return True
    before = _alike_at_the_start(plain)
    behind = _alike_at_the_start([name[before:][::-1] for name in plain])
    differing = [name[before : len(name) - behind] for name in plain]
    letters = sorted(differing)
    if all(len(letter) == 1 and letter.isalpha() for letter in letters) and "t" not in letters:
        return all(ord(b) - ord(a) == 1 for a, b in pairwise(letters))
    return all(_COMPONENT.fullmatch(one) for one in differing)


def are_names(columns: Sequence[Any]) -> bool:
    """Return whether columns have names, and not the numbers that pandas and polars give them."""
    return not all(re.fullmatch(r"(column_)?\d+", _text(column)) for column in columns)


def coordinates_among(names: Sequence[Any]) -> list[Any]:
    """Return those of many columns that are probably meant: without time, counts and a third."""
    others = [name for name in names if not is_time(name) and not _COUNT.fullmatch(_text(name))]
    if not others:
        return list(names[:2])
    return others if are_coordinates(others) else others[:2]


def _alike_at_the_start(names: list[str]) -> int:
    """Return how many of their first letters all names share."""
    places = zip(*names, strict=False)
    return sum(1 for _ in takewhile(lambda letters: len(set(letters)) == 1, places))


def _text(name: Any) -> str:
    return " ".join(map(str, name)) if isinstance(name, tuple) else str(name)
