"""dtw, soft_dtw and its divergence in the operations of an array package, along anti-diagonals.

For arrays on other devices than the CPU, which stay there. The operations are those that PyTorch
and ``jax.numpy`` both have by one name; the package differentiates them. The cells of an
anti-diagonal, of all pairs of a batch, are computed at once. Cost of b pairs: n + m - 1 steps of a
few operations each; memory O(b n (n + m)), all of the table.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .dtw import dtw_table

__all__ = ["ArrayPackage", "has_diagonals", "values_of_diagonals"]

_FAR = 1e300  # the value of unreachable cells; infinity does not have a derivative


class ArrayPackage(NamedTuple):
    """Operations that PyTorch and JAX name or perform differently.

    Attributes
    ----------
    xp : module
        The functions.
    place : callable
        A function that copies a numpy array to the device.
    scan : callable
        A function of (step, start, xs) that returns the stacked results of all steps, as
        ``jax.lax.scan`` does.
    """

    xp: Any
    place: Callable[[Any], Any]
    scan: Callable[..., Any]


def has_diagonals(measure: str, options: Mapping[str, Any]) -> bool:
    """Return whether the measure with these options can be computed here."""
    if measure in ("soft_dtw", "soft_dtw_divergence"):
        return True
    known = measure == "dtw" and set(options) <= {"metric", "window"}
    return known and options.get("metric", "euclidean") in _GROUND


def values_of_diagonals(
    package: ArrayPackage,
    P: Any,
    Q: Any,
    lengths: tuple[Any, Any],
    measure: str,
    options: Mapping[str, Any],
) -> Any:
    """Return the values, shape (b,), of arrays of float64 of shapes (b, n, d) and (b, m, d).

    Lengths are numpy arrays of shape (b,), or without a window also arrays of the package. Points
    beyond them must be finite.
    """

    def value(first: int, second: int) -> Any:
        curves = ((P, lengths[0]), (Q, lengths[1]))
        return _values(package, *curves[first], *curves[second], measure, options)

    if measure == "soft_dtw_divergence":
        return value(0, 1) - 0.5 * (value(0, 0) + value(1, 1))
    return value(0, 1)


def _values(
    package: ArrayPackage,
    P: Any,
    of_P: Any,
    Q: Any,
    of_Q: Any,
    measure: str,
    options: Mapping[str, Any],
) -> Any:
    xp, place, scan = package
    (count, n, _), m = P.shape, Q.shape[1]
    smoothness = None if measure == "dtw" else float(options.get("gamma", 1.0))
    metric = options.get("metric", "euclidean") if measure == "dtw" else "sqeuclidean"
    ground = _GROUND[metric](xp, P[:, :, None, :] - Q[:, None, :, :])
    rows = np.arange(n)[:, None]
    columns = np.arange(n + m - 1)[None] - rows  # of the anti-diagonals
    inside = ((columns >= 0) & (columns < m))[None]
    columns = columns.clip(0, m - 1)
    if options.get("window") is not None:
        inside = inside & _band(of_P, of_Q, n, m, options["window"])[:, rows, columns]
    costs = ground[:, place(rows), place(columns)]

    def step(carry: tuple[Any, Any], costs_and_inside: tuple[Any, Any]) -> tuple[Any, Any]:
        before, latest = carry
        cost, is_inside = costs_and_inside
        least = _least(xp, smoothness, before[:, :-1], latest[:, :-1], latest[:, 1:])
        cells = xp.where(is_inside, cost + least, border)
        current = xp.hstack((border, cells))  # with a cell before the first
        return (latest, current), current

    border = place(np.full((count, 1), _FAR))
    start = np.full((2, count, n + 1), _FAR)
    start[0, :, 0] = 0.0
    diagonals = (xp.moveaxis(costs, -1, 0), place(np.moveaxis(inside, -1, 0).copy()))
    table = scan(step, (place(start[0]), place(start[1])), diagonals)
    last, first = place(of_P), place(of_Q)
    return table[last + first - 2, place(np.arange(count)), last]


def _least(xp: Any, smoothness: float | None, corner: Any, above: Any, left: Any) -> Any:
    least = xp.minimum(xp.minimum(corner, above), left)
    if smoothness is None:
        return least
    terms = [xp.exp((least - before) / smoothness) for before in (corner, above, left)]
    return least - smoothness * xp.log(terms[0] + terms[1] + terms[2])


def _band(of_P: Any, of_Q: Any, n: int, m: int, window: Any) -> npt.NDArray[np.bool_]:
    """Return the cells within the band, shape (b, n, m), which the compiled table tells."""
    cells = np.zeros((len(of_P), n, m), dtype=bool)
    for k, j in {*zip(of_P.tolist(), of_Q.tolist(), strict=True)}:
        reached = np.isfinite(dtw_table(np.zeros(k), np.zeros(j), window=window))
        cells[(of_P == k) & (of_Q == j), :k, :j] = reached
    return cells


def _euclidean(xp: Any, differences: Any) -> Any:
    squares = (differences * differences).sum(-1)
    is_zero = squares == 0.0
    return xp.where(is_zero, squares, xp.sqrt(xp.where(is_zero, squares + 1.0, squares)))


_GROUND: Mapping[str, Callable[[Any, Any], Any]] = {
    "euclidean": _euclidean,
    "sqeuclidean": lambda _, differences: (differences * differences).sum(-1),
    "cityblock": lambda xp, differences: xp.abs(differences).sum(-1),
}
