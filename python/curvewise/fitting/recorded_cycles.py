"""Records of some cycles alone, such as 1, 2, 5, 10 and 20: those between are run through.

A record is cut where the number of the cycle rises by more than one. Each cycle that is left out
repeats the first point and the reversals of the cycle before it. A point of material takes one step
from a reversal to the next, so that a cycle costs two or three steps. Time is linear in the points
and in the cycles that are left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from .._option_names import called, command_of
from ..curves.inputs import Array
from ..curves.turns import last_cycle, turning_points
from ..materials.readings import strain_and_stress, thinned, thinned_cycle

__all__ = [
    "DrivenTest",
    "Numbers",
    "checked_numbers",
    "driven_test",
    "said_of_cycles",
    "whole_record",
]

Numbers: TypeAlias = "npt.NDArray[np.int64]"

_MOST = 100_000  # cycles that are run through
_HARDLY = 1e-6  # tolerance of a counter below a whole number
_FEWEST = 40  # points of a part of a record


class DrivenTest(NamedTuple):
    """A test as it drives a material.

    Attributes
    ----------
    path : ndarray, shape (n, 2)
        Strain and stress, with those of cycles that are left out.
    compared : slice or ndarray of int
        Which points were recorded and are compared.
    """

    path: Array
    compared: slice | Numbers


def checked_numbers(numbers: Any, count: int) -> Numbers | None:
    """Return the number of the cycle of each point, or raise ValueError.

    Parameters
    ----------
    numbers : array_like, shape (count,), or None
        A counter may rise within a cycle: 3.25 belongs to cycle 3.
    count : int
        Number of points.
    """
    if numbers is None:
        return None
    given = np.asarray(numbers, dtype=np.float64)
    if given.shape != (count,):
        raise ValueError(f"{_named()} has shape {given.shape}; the test has {count} points")
    if not np.isfinite(given).all() or given[0] < 0.0 or abs(given).max() > 2.0**53:
        raise ValueError(f"{_named()} has a number that is negative or not finite")
    whole: Numbers = np.floor(given + _HARDLY).astype(np.int64)
    falls = np.flatnonzero(np.diff(whole) < 0)
    if falls.size:
        i = int(falls[0])
        raise ValueError(
            f"{_named()} falls from {whole[i]} to {whole[i + 1]} at point {i + 1}; give the "
            "column that counts cycles from the first to the last"
        )
    if (missing := int(_left_out(whole).sum())) > _MOST:
        raise ValueError(
            f"the record leaves out {missing:,} cycles, and at most {_MOST:,} are run through; "
            f"leave out the last recorded cycles ({called('until')})"
        )
    return whole


def _named() -> str:
    return command_of("cycle_column") or "cycle_numbers"


def said_of_cycles(numbers: Numbers) -> str:
    """Return which cycles a record has, in words."""
    found = np.unique(numbers)
    shown = ", ".join(map(str, found[:8])) + (", …" if len(found) > 8 else "")
    missing = int(_left_out(numbers).sum())
    if not missing:
        return f"cycles: the record has all {len(found)} from {found[0]} to {found[-1]}"
    return (
        f"cycles: the record has {len(found)} ({shown}); the {missing} that it leaves out are run "
        "through with the reversals of the cycle before"
    )


def whole_record(test: Any) -> Any:
    """Return a test, with strain and stress of omitted cycles."""
    numbers = getattr(test, "cycle_numbers", None)
    if numbers is None or not _left_out(numbers).any():
        return test
    points = strain_and_stress(test, "test")
    return np.concatenate([rows for rows, _ in _parts(points, numbers)])


def driven_test(test: Any, name: str, cycles: str, points: int) -> DrivenTest:
    """Return a test for driving a material, thinned to about `points` points.

    Parameters
    ----------
    test : array_like, shape (n, 2)
        Strain and stress; a `PreparedTest` may have cycle numbers.
    name : str
        The name of the test in messages.
    cycles : {"all", "last"}
        As for `fit_material`.
    points : int
        Approximate number of compared points.
    """
    whole = whole_record(test)
    if cycles == "last":
        path, compared = thinned_cycle(whole, name, points)
        if whole is not test:
            compared = slice(compared.start + _unrecorded(test, whole, name), compared.stop)
        return DrivenTest(path, compared)
    if whole is test:
        return DrivenTest(thinned(test, name, points), slice(None))
    rows, kept, count = [], [], 0
    measured = strain_and_stress(test, name)
    for part, is_recorded in _parts(measured, test.cycle_numbers):
        if is_recorded:
            share = max(_FEWEST, round(points * len(part) / len(measured)))
            part = thinned(part, name, share)
            kept.append(np.arange(count, count + len(part)))
        rows.append(part)
        count += len(part)
    return DrivenTest(np.concatenate(rows), np.concatenate(kept))


def _unrecorded(test: Any, whole: Array, name: str) -> int:
    """Return 1 if the last complete cycle begins with a reversal that was not recorded, else 0."""
    measured = strain_and_stress(test, name)
    parts = [np.full(len(rows), known) for rows, known in _parts(measured, test.cycle_numbers)]
    recorded = np.concatenate(parts)[last_cycle(whole)]
    if not recorded[1:].all():
        raise ValueError(
            f"{name}: its last complete cycle was not recorded; record a complete cycle at the "
            "end, or compare all cycles"
        )
    return int(not recorded[0])


def _left_out(numbers: Numbers) -> Numbers:
    """Return how many cycles are left out before each point."""
    before = np.concatenate(([min(int(numbers[0]), 1)], numbers[:-1] + 1))
    found: Numbers = np.maximum(numbers - before, 0)
    return found


def _parts(points: Array, numbers: Numbers) -> Iterator[tuple[Array, bool]]:
    """Yield the parts of a record and the cycles between them, and whether they are recorded."""
    left_out = _left_out(numbers)
    begins = [0, *(i for i in np.flatnonzero(left_out).tolist() if i), len(points)]
    for begin, end in pairwise(begins):
        if missing := int(left_out[begin]):
            repeated = numbers[max(begin - 1, 0)]
            yield np.tile(_reversals(points[numbers == repeated]), (missing, 1)), False
        yield points[begin:end], True


def _reversals(cycle: Array) -> Array:
    """Return the first point and the reversals of a cycle."""
    found: Array = cycle[[0, *turning_points(cycle)]]
    return found
