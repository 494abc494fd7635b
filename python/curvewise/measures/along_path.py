"""Values along a warping path: one curve on the index of the other, and the average of both.

A path of index pairs (i, j) matches a point j of one curve with one or several points i of the
other curve. The mean or the first of them is the value at j. A step over several points leaves
points between without a partner. Their values are interpolated linearly, as in R's ``dtw::warp``
(Giorgino 2009). The average along the path is that of Gupta et al. (1996).
"""

from __future__ import annotations

from typing import Literal, SupportsFloat, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from .._options import check_choice, real_number
from ..curves.inputs import Array, as_numbers, in_columns

__all__ = ["By", "Onto", "Path", "average_along", "values_onto"]

Path: TypeAlias = npt.NDArray[np.int64]
By: TypeAlias = Literal["mean", "first"]
Onto: TypeAlias = Literal["Q", "P"]


def values_onto(path: Path, values: npt.ArrayLike, by: By, onto: Onto, sizes: list[int]) -> Array:
    """Return the values of one curve at every point of the other.

    Parameters
    ----------
    path : ndarray of int64, shape (k, 2)
        Index pairs.
    values : array_like, shape (n, c) or (n,)
        One row for each point of the curve that is not `onto`.
    by : {"mean", "first"}
        Which of several partners count.
    onto : {"Q", "P"}
        The curve on whose index the values are returned.
    sizes : list of two int
        Numbers of points of P and of Q.

    Returns
    -------
    ndarray, shape (m, c) or (m,)
        NaN before the first matched point and behind the last.

    Raises
    ------
    ValueError, TypeError
        If an option is unknown, the path is empty, or the number of rows differs.
    """
    check_choice("by", by, get_args(By))
    check_choice("onto", onto, get_args(Onto))
    source = 0 if onto == "Q" else 1
    rows = _rows(values, "PQ"[source], path, sizes[source])
    places, first, group = np.unique(path[:, 1 - source], return_index=True, return_inverse=True)
    columns = in_columns(rows)
    if by == "first":
        at_places = columns[path[first, source]]
    else:
        at_places = np.zeros((len(places), columns.shape[1]))
        np.add.at(at_places, group, columns[path[:, source]])
        at_places /= np.bincount(group)[:, np.newaxis]
    filled = np.full((sizes[1 - source], columns.shape[1]), np.nan)
    filled[places] = at_places
    between = np.setdiff1d(np.arange(places[0], places[-1]), places)
    for column, known in zip(filled.T, at_places.T, strict=True):
        column[between] = np.interp(between, places, known)
    return filled[:, 0] if rows.ndim == 1 else filled


def average_along(
    path: Path, P: npt.ArrayLike, Q: npt.ArrayLike, weight: SupportsFloat, sizes: list[int]
) -> Array:
    """Return (1 - weight) P[i] + weight Q[j] for every pair (i, j) of a path.

    Raises
    ------
    ValueError, TypeError
        If the weight is out of range, the path is empty, or rows or columns differ in number.
    """
    advice = "give a number between 0 and 1"
    share = real_number("weight", weight, 0.0, advice)
    if share > 1.0:
        raise ValueError(f"weight is {weight!r}; {advice}")
    rows_of_p, rows_of_q = (
        _rows(values, name, path, size)
        for values, name, size in zip((P, Q), "PQ", sizes, strict=True)
    )
    first, second = in_columns(rows_of_p), in_columns(rows_of_q)
    if first.shape[1] != second.shape[1]:
        raise ValueError(
            f"P has {first.shape[1]} columns and Q has {second.shape[1]}; give the same columns"
        )
    average = (1.0 - share) * first[path[:, 0]] + share * second[path[:, 1]]
    return average[:, 0] if rows_of_p.ndim == rows_of_q.ndim == 1 else average


def _rows(values: npt.ArrayLike, name: str, path: Path, size: int) -> Array:
    """Return values as an array, after checking that a path fits `size` rows."""
    if len(path) == 0:
        raise ValueError("the path is empty: the step pattern admits none between these curves")
    rows = as_numbers(values, name)
    if len(rows) != size:
        raise ValueError(
            f"{name} has {len(rows)} rows, but the path is that of {size} points; "
            "give one row for each point"
        )
    return rows
