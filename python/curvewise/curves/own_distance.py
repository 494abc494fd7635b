"""A user-defined ground distance: a matrix or a callable.

A callable receives two blocks of points. The compiled code requests the distances of some rows of P
and columns of Q at a time, the reference requests all at once. The user's results are checked here,
for both. Time that of the callable, and O(p q) for a block of p and q points; memory O(p q).
"""

from __future__ import annotations

import numbers
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from .inputs import Array, in_columns

__all__ = ["BlockDistances", "block_distances", "is_own_metric", "refuse_own_metric"]

BlockDistances: TypeAlias = Callable[[int, int, int, int], Array]
"""Of rows first_row, ..., first_row + rows - 1 and columns likewise: shape (rows, columns)."""

# Entries of a matrix per check, so that Ctrl-C works in between, and a copy is small.
_CHECKED_AT_ONCE = 2**20


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
        If `p` or `radius` is given.
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
        If a shape does not fit, or a distance is nan or negative. The returned function raises it,
        too.
    TypeError
        If distances are not real numbers, or are masked.
    """
    if callable(metric):
        return _of_callable(metric, in_columns(P), in_columns(Q))
    return _of_matrix(_real_numbers(metric, "metric"), len(P), len(Q))


def _of_matrix(matrix: npt.NDArray[Any], n: int, m: int) -> BlockDistances:
    if matrix.shape != (n, m):
        raise ValueError(
            f"metric has shape {matrix.shape}; P has {n} points and Q has {m}: give their "
            f"distances, shape {(n, m)}, or a function of two blocks of points"
        )

    def blocks(row: int, rows: int, column: int, columns: int) -> Array:
        return _as_float64(matrix[row : row + rows, column : column + columns])

    rows = max(1, _CHECKED_AT_ONCE // max(1, m))
    for first in range(0, n, rows):
        _check(blocks(first, rows, 0, m), "metric[{}, {}]", first, 0)
    return blocks


def _of_callable(metric: Callable[[Array, Array], Any], P: Array, Q: Array) -> BlockDistances:
    def blocks(row: int, rows: int, column: int, columns: int) -> Array:
        p, q = P[row : row + rows], Q[column : column + columns]
        try:
            answer = metric(p, q)
        except (TypeError, ValueError) as error:
            if not _is_of_two_points(metric, p[0], q[0]):
                raise
            raise ValueError(
                f"metric takes two points, and is called with blocks of them, of shapes {p.shape} "
                f"and {q.shape}; {_instead(rows, columns)}"
            ) from error
        found = _as_float64(_real_numbers(answer, "what metric returns"))
        if found.shape != (rows, columns):
            raise ValueError(
                f"metric returns shape {found.shape} for blocks of points of shapes {p.shape} and "
                f"{q.shape}; {_instead(rows, columns)}"
            )
        _check(found, "metric of P[{}] and Q[{}]", row, column)
        return found

    return blocks


def _is_of_two_points(metric: Callable[[Array, Array], Any], p: Array, q: Array) -> bool:
    """Return whether a function that refuses blocks returns a number for two points."""
    try:
        return isinstance(metric(p, q), numbers.Real)
    except Exception:
        return False


def _instead(rows: int, columns: int) -> str:
    """Return what a callable has to return, and how one of two points does so."""
    return (
        f"return the distance of every pair, shape {(rows, columns)}: of a function f of two "
        "points, metric=lambda p, q: [[f(a, b) for b in q] for a in p] does so, and "
        "numpy.linalg.norm(p[:, None] - q, axis=2) is fast"
    )


def _real_numbers(given: Any, name: str) -> npt.NDArray[Any]:
    """Return an array of them, of any shape."""
    try:
        array = np.asanyarray(given)
    except ValueError as error:
        raise ValueError(f"{name} is ragged; give one row of distances for each point") from error
    if np.ma.is_masked(array):
        raise TypeError(f"{name} has masked entries; fill them first, with inf for no match")
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{name} has dtype {array.dtype}; distances are real numbers")
    return np.asarray(array)


def _as_float64(array: npt.NDArray[Any]) -> Array:
    with np.errstate(over="ignore"):  # a longdouble beyond float64 becomes inf
        array = array.astype(np.float64, copy=False)
    return array if array.flags.aligned else array.copy()


def _check(distances: Array, name: str, row: int, column: int) -> None:
    """Refuse the first wrong one of a block that begins there."""
    wrong = ~(distances >= 0)
    if wrong.any():
        i, j = np.argwhere(wrong)[0]
        raise ValueError(
            f"{name.format(row + i, column + j)} is {distances[i, j]}; distances are at least 0, "
            "or inf where points must not meet"
        )
