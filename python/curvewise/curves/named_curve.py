"""Names of a curve's coordinates, used only for the axes of plots.

A curve that was read from a file, or made by :mod:`curvewise.datasets`, is an array that remembers
the names of its columns; a DataFrame has names anyway. Measures ignore these names, so that two
files with different headers can be compared. The names stay with the array if its columns are
unchanged, that is, if rows are selected (``curve[::10]``) or the array is copied. Every other numpy
operation returns a plain array without names, because a wrong name on an axis is worse than a
missing one.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from .inputs import Array, column_names, copy_of

__all__ = [
    "Labels",
    "NamedCurve",
    "axis_names",
    "copied",
    "known_file",
    "known_names",
    "labels_of",
    "name_of_test",
    "renamed",
]

_LONGEST = 32  # characters of a file's name in a plot


class Labels(NamedTuple):
    """Labels of the axes and curves in a plot.

    Attributes
    ----------
    axes : tuple of str
        The names of the coordinates.
    curves : tuple of str
        The names of the curves.
    """

    axes: tuple[str, ...]
    curves: tuple[str, str] = ("P", "Q")


class NamedCurve(np.ndarray[tuple[int, ...], np.dtype[np.float64]]):
    """An array of shape (n, d) that knows what its d columns are called.

    Parameters
    ----------
    values : ndarray, shape (n, d)
        The curve, which is not copied.
    names : sequence of str
        One for each column.
    file : str, optional
        The name of the file that it was read from.

    Attributes
    ----------
    column_names : tuple of str
        The names; empty where they are not known any more.
    file : str
        As given.

    Raises
    ------
    ValueError
        If the number of names differs from the number of columns.

    Notes
    -----
    It prints, calculates and pickles like a plain array.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.curves.named_curve import NamedCurve
    >>> curve = NamedCurve(np.zeros((3, 2)), ["strain", "stress"])
    >>> curve[1:].column_names
    ('strain', 'stress')
    >>> type(2.0 * curve) is type(curve[:, 1]) is np.ndarray
    True
    """

    column_names: tuple[str, ...]
    file: str

    def __new__(cls, values: Array, names: Sequence[str], file: str = "") -> NamedCurve:
        """Make a view of the values, with names."""
        if values.ndim != 2 or values.shape[1] != len(names):
            raise ValueError(f"there are {len(names)} names for an array of shape {values.shape}")
        named = values.view(cls)
        named.column_names, named.file = tuple(names), file
        return named

    def __array_finalize__(self, made_of: Any) -> None:
        self.column_names, self.file = (), ""

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        if "out" in keywords:
            keywords["out"] = tuple(map(_plain, keywords["out"]))
        return getattr(ufunc, method)(*map(_plain, inputs), **keywords)

    def __getitem__(self, key: Any) -> Any:
        chosen = _plain(self)[key]
        if isinstance(key, tuple) or np.ndim(chosen) != 2 or not self.column_names:
            return chosen
        return NamedCurve(chosen, self.column_names, self.file)

    def __reduce__(self) -> Any:
        plain = _plain(self)
        if not self.column_names:
            return plain.__reduce__()
        return (NamedCurve, (plain, self.column_names, self.file))

    def __repr__(self) -> str:
        return repr(_plain(self))

    def __str__(self) -> str:
        return str(_plain(self))

    def copy(self, order: Any = "C") -> Any:
        """Return a copy, as of any array, with the same names."""
        copied = _plain(self).copy(order)
        return NamedCurve(copied, self.column_names, self.file) if self.column_names else copied


def _plain(value: Any) -> Any:
    return value.view(np.ndarray) if isinstance(value, NamedCurve) else value


def copied(curve: Any, array: Array) -> Array:
    """Return a copy of the array that a curve was given as, with the names that the curve has."""
    return renamed(curve, copy_of(array))


def renamed(curve: Any, array: Array) -> Array:
    """Return an array whose columns are those of a curve, with the names that the curve has."""
    names = () if type(curve) is np.ndarray else known_names(curve)
    fits = array.ndim == 2 and len(names) == array.shape[1]
    return NamedCurve(array, names, known_file(curve)) if fits else array


def known_names(*curves: Any) -> tuple[str, ...]:
    """Return the column names of the first curve that has any, or ()."""
    for curve in curves:
        names = getattr(curve, "column_names", ()) or column_names(curve)
        if names:
            return tuple(map(str, names))
    return ()


def known_file(curve: Any) -> str:
    """Return the name of the file that a curve was read from; empty if that is not known."""
    return curve.file if isinstance(curve, NamedCurve) else ""  # a frame may have such a column


def name_of_test(test: Any, i: int) -> str:
    """Return the file of a test, also of a prepared one, or its place in `tests`, for messages."""
    return known_file(getattr(test, "curve", test)) or f"tests[{i}]"


def labels_of(dim: int, names: Sequence[str] | None, P: Any, Q: Any) -> Labels:
    """Return the labels for a plot of P and Q; see `axis_names`."""
    files = [known_file(curve)[-_LONGEST:] for curve in (P, Q)]
    p, q = (file or letter for file, letter in zip(files, "PQ", strict=True))
    curves = (f"{p} (P)", f"{q} (Q)") if p == q else (p, q)
    return Labels(axis_names(dim, names, P, Q), curves)


def axis_names(
    dim: int, names: Sequence[str] | None, *curves: Any, default: Sequence[str] = ("x", "y")
) -> tuple[str, ...]:
    """Return the labels of the axes of a plot.

    Parameters
    ----------
    dim : int
        Number of coordinates of the curves.
    names : sequence of str, or None
        The names that the user wants.
    *curves : array_like
        Curves whose own names are the second choice: those of the first that has any.
    default : sequence of str
        The names of a plane curve's coordinates if nothing else is known.

    Returns
    -------
    tuple of str, of length dim

    Raises
    ------
    TypeError
        If `names` is a single text.
    ValueError
        If the number of names differs from the number of coordinates.

    Examples
    --------
    >>> from curvewise.curves.named_curve import axis_names
    >>> axis_names(2, None, [(0, 0), (1, 1)]), axis_names(2, ["time", "force"])
    (('x', 'y'), ('time', 'force'))
    """
    if names is not None:
        if isinstance(names, str):
            raise TypeError(f"names is {names!r}; give a list, even for one coordinate")
        if len(names) != dim:
            raise ValueError(
                f"names is {list(names)}; the curves have {dim} coordinates, and each needs one"
            )
        return tuple(map(str, names))
    known = known_names(*curves)
    if len(known) == dim:
        return known
    if dim == 1:
        return ("value",)
    return tuple(default) if dim == 2 else tuple(f"coordinate {i}" for i in range(dim))
