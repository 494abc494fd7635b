"""Checks of a curve and of its turning points."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from .inputs import Array, CurveLike, as_numbers, in_columns

__all__ = ["Turns", "branch_slices", "check_column", "check_finite", "checked_curve"]

Turns = Sequence[int] | npt.NDArray[np.int64]
"""Indices of turning points, as `turning_points` returns them."""


def checked_curve(curve: CurveLike, least: int) -> Array:
    """Return a curve as a finite array (n, d) with at least `least` points."""
    array = in_columns(as_numbers(curve, "curve"))  # a column of time is resampled with the rest
    if array.shape[0] < least or array.shape[1] == 0:
        points = "point is" if least == 1 else "points are"
        raise ValueError(f"curve has shape {array.shape}; at least {least} {points} needed")
    check_finite(array, "curve")
    return array


def check_finite(array: Array, name: str, what: str = "curves") -> None:
    """Raise an error if numbers are not finite; `what` names them in the plural."""
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        place = ", ".join(map(str, bad[0]))
        raise ValueError(f"{name}[{place}] is {array[tuple(bad[0])]}; {what} must be finite")


def check_column(curve: Array, column: int) -> int:
    """Return the index of a column from 0; negative ones count from the end, as numpy's do."""
    index, d = operator.index(column), int(curve.shape[1])
    if not -d <= index < d:
        raise ValueError(f"column is {column}; the curve has columns 0 to {d - 1}")
    return index % d


def branch_slices(turns: Turns, n: int) -> list[slice]:
    """Return the branches between turning points; neighbours share the point they meet at."""
    array = np.asarray(turns)
    if array.size == 0:
        return [slice(0, n)]
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise TypeError("turns must be whole numbers, as turning_points(curve) returns them")
    ends = [0, *array.tolist(), n - 1]
    if any(a >= b for a, b in pairwise(ends)):
        raise ValueError(f"turns is {array.tolist()}; they must ascend, from 1 to {n - 2}")
    return [slice(a, b + 1) for a, b in pairwise(ends)]
