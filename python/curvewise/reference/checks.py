"""Checks of the input: options first, shapes, then numbers.

Every check raises ValueError with one line that states the fault, its place, and the remedy. The
compiled library uses the same messages.
"""

from __future__ import annotations

import numpy as np

from ..curves.checks import check_finite
from ..curves.inputs import Array, in_columns
from ..curves.sphere import check_on_sphere

__all__ = ["check_length", "check_pair", "check_same_shape"]


def check_pair(
    P: Array,
    Q: Array,
    measure: str,
    *,
    least_points: int = 1,
    planar: bool = False,
    on_sphere: bool = False,
    name: str = "Q",
) -> tuple[Array, Array]:
    """Check P and Q, which is called `name`, and return both with shape (n, d)."""
    named = ((P, "P"), (Q, name))
    _check_columns(*named)
    if in_columns(P).shape[1] != in_columns(Q).shape[1]:
        need = "both need the same number of coordinates"
        raise ValueError(f"{_shapes(P, Q, name)}; {need}{_transposed(P, Q)}")
    if (planar or on_sphere) and in_columns(P).shape[1] != 2:
        needed = (
            "needs 2 coordinates, x and y"
            if planar
            else "with metric='haversine' needs 2 coordinates, longitude and latitude"
        )
        need = f"{measure} {needed}"
        raise ValueError(f"{_shapes(P, Q, name)}; {need}{_transposed(P, Q)}")
    for curve, its_name in named:
        if len(curve) < least_points:
            need = f"{measure} needs at least {least_points} point{'s' * (least_points > 1)}"
            raise ValueError(f"{its_name} has shape {curve.shape}; {need}")
    for curve, its_name in named:
        check_finite(curve, its_name)
        if on_sphere:
            check_on_sphere(curve, its_name)
    return in_columns(P), in_columns(Q)


def check_same_shape(P: Array, Q: Array, measure: str) -> None:
    """Refuse curves that cannot be compared entry by entry."""
    _check_columns((P, "P"), (Q, "Q"))
    if in_columns(P).shape != in_columns(Q).shape:
        raise ValueError(f"{_shapes(P, Q)}; {measure} needs equal shapes")


def check_length(curve: Array, name: str, measure: str) -> None:
    """Refuse a curve whose points are all equal."""
    if np.all(curve == curve[0]):
        raise ValueError(
            f"{name} has zero length (all its points are equal); "
            f"{measure} needs two different points"
        )


def _shapes(P: Array, Q: Array, name: str = "Q") -> str:
    return f"P has shape {P.shape} and {name} has shape {Q.shape}"


def _transposed(P: Array, Q: Array) -> str:
    """Return the question that few points of many coordinates raise: x and y in rows."""
    few = any(len(curve) <= 3 < in_columns(curve).shape[1] for curve in (P, Q))
    return " (a row is a point: transpose?)" if few else ""


def _check_columns(*named: tuple[Array, str]) -> None:
    for curve, name in named:
        if in_columns(curve).shape[1] < 1:
            raise ValueError(f"{name} has shape {curve.shape}; a curve needs at least 1 coordinate")
