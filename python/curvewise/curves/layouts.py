"""Checks by the shape whether the points of a curve are its rows.

A curve has shape (n, d): a row is a point. Many packages for time series have the channels first.
The same rule holds for arrays of all packages, for all measures and for all sizes:

- A shape with more coordinates than points, d > n, is in doubt. Two points in space and embeddings
  of words have such shapes. The curves are computed unchanged, with a `LayoutWarning`.
- Curves of different n and the same d are not in doubt. With points as columns they would differ in
  their number of coordinates, which no measure accepts.
- Tables whose columns have names, lines of shapely and series of aeon and sktime are not in doubt.

The check looks at one shape, and at further ones only if the first has d > n.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from .foreign_curves import warn

__all__ = [
    "Layout",
    "LayoutWarning",
    "ask_about_curves",
    "ask_about_list",
    "settled_layout",
    "with_known_layout",
]

Array: TypeAlias = npt.NDArray[np.float64]
Shape: TypeAlias = tuple[int, ...]

Layout: TypeAlias = Literal["channels_first", "channels_last"]
"""Whether the points of curves are the columns of their arrays, or the rows."""

_settled: ContextVar[bool] = ContextVar("_settled", default=False)


class LayoutWarning(UserWarning):
    """Curves have more coordinates than points: rows and columns may be swapped.

    Functions of many curves take ``layout="channels_first"`` or ``layout="channels_last"``, which
    answer the question. For a single pair, transpose the curves, or ignore this warning.

    Examples
    --------
    >>> import warnings
    >>> import curvewise
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", curvewise.LayoutWarning)
    ...     curvewise.dtw([[0, 0, 0], [1, 0, 0]], [[0, 0, 1], [1, 0, 1]])  # 2 points in space
    2.0
    """


class _RowsArePoints(np.ndarray[tuple[int, ...], np.dtype[np.float64]]):
    """The base of an array whose layout its source has told."""


def with_known_layout(array: Array) -> Array:
    """Return a copy of an array, shape (n, d), that is not asked about."""
    owner = _RowsArePoints(array.shape)  # numpy forgets a base that has a base itself
    owner[...] = array
    return owner.view(np.ndarray)


@contextmanager
def settled_layout() -> Iterator[None]:
    """Ask nothing within the block: the layout is known, or was asked about."""
    token = _settled.set(True)
    try:
        yield
    finally:
        _settled.reset(token)


def ask_about_list(curves: Sequence[Array], name: str) -> None:
    """Warn if all curves of a call are in doubt, and name the option that answers."""
    if curves and _in_doubt(curves):
        _ask(
            f"{name}[0]",
            curves[0].shape,
            "give layout='channels_first' if its points are its columns, layout='channels_last' if "
            "they are its rows",
        )


def ask_about_curves(*curves: Any, batched: bool = False) -> None:
    """Warn if curves without an option for their layout are in doubt.

    Parameters
    ----------
    *curves : array of any package, shape (n, d) or (..., n, d)
        P and the curve compared with it, or batches of both. The warning suggests what to write.
    batched : bool
        Whether batches are accepted too, so that (n, d) may be meant as n series.
    """
    if not _in_doubt(curves):
        return
    shape = tuple(curves[0].shape)
    *batch, n, d = shape
    series = f"for {n} series of {d} points give P[..., None]; " if batched and not batch else ""
    _ask(
        "P",
        shape,
        f"{series}if its points are columns, transpose: P{'.swapaxes(-1, -2)' if batch else '.T'}; "
        "if they are rows, write warnings.simplefilter('ignore', curvewise.LayoutWarning)",
    )


def _in_doubt(curves: Sequence[Any]) -> bool:
    """Return whether all curves have the same n, and more coordinates than points."""
    first = curves[0].shape[-2:]
    if len(first) < 2 or not first[1] > first[0] > 0 or _settled.get():
        return False
    return all(
        curve.shape[-2:] == first and not isinstance(getattr(curve, "base", None), _RowsArePoints)
        for curve in curves
    )


def _ask(name: str, shape: Shape, ways_out: str) -> None:
    n, d = shape[-2:]
    points = f"as a curve {n} point{'' if n == 1 else 's'} in {d} dimensions"
    warn(LayoutWarning(f"{name} has shape {shape}, {points}; {ways_out}"))
