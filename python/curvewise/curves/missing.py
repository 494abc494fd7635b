"""Gaps in curves: points in which a coordinate is nan.

``missing="skip"`` leaves them out, so that they take no part in a measure; a warning says how many.
This is the one place that does it, for single pairs as for lists of curves. Time and memory O(n d).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, get_args

import numpy as np
import numpy.typing as npt

from .._options import Missing, check_choice
from .foreign_curves import warn
from .inputs import Array, as_curve, as_curves, in_columns
from .named_curve import copied

__all__ = ["named_without_gaps", "skip_in_both", "skip_in_each", "skip_in_list", "skip_in_pair"]


def skip_in_pair(P: Any, Q: Any, missing: Missing) -> tuple[Any, Any]:
    """Return P and Q, each without its points that are missing, if they are to be skipped."""
    check_choice("missing", missing, get_args(Missing))
    if missing == "refuse":
        return P, Q
    P, Q = as_curves(P, Q)
    p, q = skip_in_each([P, Q], ["P", "Q"], missing)
    return p, q


def skip_in_both(P: Any, Q: Any, missing: Missing) -> tuple[Any, Any]:
    """Return P and Q without the entries at which either is missing: compared point by point."""
    check_choice("missing", missing, get_args(Missing))
    if missing == "refuse":
        return P, Q
    P, Q = as_curves(P, Q)
    if P.shape != Q.shape:  # which is refused
        return P, Q
    gaps = _gaps(P) | _gaps(Q)
    _say(gaps, "P and Q")
    return (P[~gaps], Q[~gaps]) if gaps.any() else (P, Q)


def skip_in_each(curves: Sequence[Array], names: Sequence[str], missing: Missing) -> list[Array]:
    """Return curves, called `names`, without missing points if these are skipped.

    A curve without gaps is returned unchanged. There is one warning for each curve with gaps.
    """
    check_choice("missing", missing, get_args(Missing))
    if missing == "refuse":
        return list(curves)
    kept = []
    for curve, name in zip(curves, names, strict=True):
        gaps = _gaps(curve)
        _say(gaps, name)
        kept.append(curve[~gaps] if gaps.any() else curve)
    return kept


def skip_in_list(curves: list[Array], name: str, missing: Missing) -> list[Array]:
    """Return the curves of a list, whose messages name them ``XA[3]``, as `skip_in_each` does."""
    if missing == "refuse":  # without a name for each curve
        return curves
    return skip_in_each(curves, [f"{name}[{i}]" for i in range(len(curves))], missing)


def named_without_gaps(curves: list[Any], missing: Missing) -> list[Any]:
    """Return tests unchanged, or without missing points; keep column names."""
    check_choice("missing", missing, get_args(Missing))
    if missing == "refuse":
        return curves
    kept = skip_in_list([as_curve(curve, "test") for curve in curves], "tests", missing)
    return [copied(curve, array) for curve, array in zip(curves, kept, strict=True)]


def _gaps(curve: Array) -> npt.NDArray[np.bool_]:
    return np.asarray(np.isnan(in_columns(curve)).any(axis=1))


def _say(gaps: npt.NDArray[np.bool_], name: str) -> None:
    if gaps.any():
        warn(
            f"{name}: {gaps.sum()} of {len(gaps)} points left out, nan; the first is point "
            f"{gaps.argmax()}"
        )
