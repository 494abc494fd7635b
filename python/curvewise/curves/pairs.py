"""Pairs of curves for functions that numpy computes."""

from __future__ import annotations

from .checks import check_finite
from .inputs import Array, CurveLike, as_curves, in_columns
from .layouts import ask_about_curves

__all__ = ["checked_pair"]


def checked_pair(P: CurveLike, Q: CurveLike, measure: str) -> tuple[Array, Array]:
    """Return both curves, finite and with shapes (n, d) and (m, d)."""
    first, second = as_curves(P, Q)
    for curve, name in ((first, "P"), (second, "Q")):
        if curve.size == 0:
            raise ValueError(f"{name} has shape {curve.shape}; {measure} needs at least 1 point")
        check_finite(curve, name)
    ask_about_curves(first, second)
    rows, others = in_columns(first), in_columns(second)
    if rows.shape[1] != others.shape[1]:
        raise ValueError(
            f"P has shape {first.shape} and Q has shape {second.shape}; both need the same number "
            "of coordinates"
        )
    return rows, others
