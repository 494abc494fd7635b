"""A ground distance of the user's own: a matrix, or a callable of two blocks of points.

The compiled sweep asks for the distances of some rows of P and columns of Q at a time, the
reference for all at once; what a user's object answers is checked here, for both. Time that of the
callable, and O(p q) for a block of p and q points; memory O(p q).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from .inputs import Array, copy_of, in_columns

__all__ = ["BlockDistances", "block_distances", "is_own_metric", "refuse_own_metric"]

BlockDistances: TypeAlias = Callable[[int, int, int, int], Array]
"""Of rows first_row, ..., first_row + rows - 1 and columns likewise: shape (rows, columns)."""


def is_own_metric(metric: object) -> bool:
    """Return whether a metric is not a name, and may be a function or a matrix."""
    if isinstance(metric, str | bytes):
        return False
    if isinstance(metric, list | tuple):
        return len(metric) > 0 and not isinstance(metric[0], str)
    return callable(metric) or hasattr(metric, "__array__")


def refuse_own_metric(p: object, radius: object) -> None:
    """Refuse what applies to a metric by its name.

    Raises
    ------
    ValueError
        `p` or `radius` is given.
    """
    for option, value in (("p", p), ("radius", radius)):
        if value is not None:
            raise ValueError(f"{option} applies to a metric by its name, not to one of one's own")


def block_distances(metric: Any, P: Array, Q: Array) -> BlockDistances:
    """Return the function of a block's first row, rows, first column and columns.

    Parameters
    ----------
    metric : callable or array_like, shape (n, m)
        A function of points of shapes (p, d) and (q, d) that returns their distances, shape (p, q);
        or all of them.
    P, Q : ndarray, shapes (n, d) and (m, d), or (n,) and (m,)
        The curves.

    Raises
    ------
    ValueError
        A shape that does not fit; a distance that is nan or negative. By the function that is
        returned too.
    TypeError
        Distances are not real numbers, or are masked.
    """
    if callable(metric):
        return _of_callable(metric, in_columns(P), in_columns(Q))
    shape = (len(P), len(Q))
    matrix = _as_numbers(metric, "metric")
    if matrix.shape != shape:
        raise ValueError(
            f"metric has shape {matrix.shape}; P has {len(P)} points and Q has {len(Q)}: give "
            f"their distances, shape {shape}, or a function of two blocks of points"
        )
    _check(matrix, lambda i, j: f"metric[{i}, {j}]")

    def blocks(row: int, rows: int, column: int, columns: int) -> Array:
        return matrix[row : row + rows, column : column + columns]

    return blocks


def _of_callable(metric: Callable[[Array, Array], Any], P: Array, Q: Array) -> BlockDistances:
    def blocks(row: int, rows: int, column: int, columns: int) -> Array:
        p, q = P[row : row + rows], Q[column : column + columns]
        found = _as_numbers(metric(p, q), "what metric returns")
        if found.shape != (rows, columns):
            raise ValueError(
                f"metric returns shape {found.shape} for blocks of points of shapes {p.shape} and "
                f"{q.shape}; return the distance of every pair, shape {(rows, columns)}"
            )
        _check(found, lambda i, j: f"metric of P[{row + i}] and Q[{column + j}]")
        return found

    return blocks


def _as_numbers(given: Any, name: str) -> Array:
    """Return an aligned float64 array, of any shape."""
    try:
        array = np.asanyarray(given)
    except ValueError as error:
        raise ValueError(f"{name} is ragged; give one row of distances for each point") from error
    if np.ma.is_masked(array):
        raise TypeError(f"{name} has masked entries; fill them first, with inf for no match")
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{name} has dtype {array.dtype}; distances are real numbers")
    array = np.asarray(array).astype(np.float64, copy=False)
    return array if array.flags.aligned else copy_of(array)


def _check(distances: Array, name: Callable[[int, int], str]) -> None:
    wrong = ~(distances >= 0)
    if wrong.any():
        i, j = np.argwhere(wrong)[0]
        raise ValueError(
            f"{name(i, j)} is {distances[i, j]}; distances are at least 0, or inf where points "
            "must not meet"
        )
