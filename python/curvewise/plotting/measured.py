"""Preparation of a measure's plot: the curves to measure, and those to draw."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.named_curve import Labels, labels_of
from ..measures import normalize
from ..measures.registry import WARPINGS, Warping

__all__ = ["Pair", "measured_and_drawn", "warping_of"]

Pair: TypeAlias = tuple[Array, Array]


def measured_and_drawn(
    P: CurveLike,
    Q: CurveLike,
    normalized: bool,
    names: Sequence[str] | None = None,
    of_more_than_two: str = "",
) -> tuple[Pair, Pair, Labels]:
    """Return the curves to measure and to draw, and their labels.

    Parameters
    ----------
    P, Q
        As given.
    normalized : bool
        Whether the curves are measured scaled by P's box.
    names : sequence of str, optional
        The labels of the axes.
    of_more_than_two : str
        The error for curves of more than two coordinates; if empty they are drawn.

    Returns
    -------
    measured, drawn : two ndarrays each
        The curves to measure, and those to draw: (n, d) and in original units.
    labels : Labels
        The names of coordinates and curves.
    """
    curves = as_curves(P, Q)
    first, second = normalize(*curves) if normalized else curves
    drawn = tuple(curve.reshape(len(curve), -1) for curve in curves)
    dim = drawn[0].shape[1]
    if of_more_than_two and dim > 2:
        raise ValueError(f"P has shape {drawn[0].shape}; {of_more_than_two}")
    return (first, second), (drawn[0], drawn[1]), labels_of(dim, names, P, Q)


def warping_of(measure: str) -> Warping:
    """Return the path and table functions of a measure; raise if missing."""
    if not isinstance(measure, str) or measure not in WARPINGS:
        raise ValueError(f"unknown measure {measure!r}; choose from {', '.join(sorted(WARPINGS))}")
    return WARPINGS[measure]
