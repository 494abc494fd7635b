"""What a picture of a measure begins with: the curves to measure, and those to draw."""

from __future__ import annotations

import numpy as np

from ..curves.inputs import Array, CurveLike, as_curves
from ..measures import normalize
from ..measures.registry import WARPINGS, Warping

__all__ = ["measured_and_drawn", "warping_of"]


def measured_and_drawn(
    P: CurveLike, Q: CurveLike, normalized: bool
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Return the curves to measure, and the curves to draw: (n, d) and in original units."""
    P, Q = as_curves(P, Q)
    measured = tuple(normalize(P, Q)) if normalized else (P, Q)
    P, Q = (curve[:, np.newaxis] if curve.ndim == 1 else curve for curve in (P, Q))
    return (measured[0], measured[1]), (P, Q)


def warping_of(measure: str) -> Warping:
    """Return the path and the table of a measure; refuse one that has none."""
    if not isinstance(measure, str) or measure not in WARPINGS:
        raise ValueError(f"unknown measure {measure!r}; choose from {', '.join(sorted(WARPINGS))}")
    return WARPINGS[measure]
