"""dtw of independent coordinates: what ``dependent=False`` computes."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from .._options import check_independent, real_number
from ..curves.inputs import as_curves
from .step_pattern import may_be_negative

__all__ = ["sum_over_coordinates"]


def sum_over_coordinates(measure: Callable[..., float], given: Mapping[str, Any]) -> float:
    """Return the sum of a measure over the coordinates, in their order.

    Parameters
    ----------
    measure : callable
        The function of the measure.
    given : mapping of str to object
        All its arguments by name.
    """
    others = {"P", "Q", "cutoff", "missing", "dependent"}
    options = {name: value for name, value in given.items() if name not in others}
    cutoff = given["cutoff"]
    check_independent(given["metric"])
    P, Q = (np.reshape(curve, (len(curve), -1)) for curve in as_curves(given["P"], given["Q"]))
    d = P.shape[1]
    if d < 2 or d != Q.shape[1]:  # with one path, or refused
        return measure(P, Q, **options, cutoff=cutoff)
    # A coordinate may be above the cutoff, and the sum below it, if others are negative.
    most = None if may_be_negative(options["step_pattern"]) else cutoff
    total = sum(measure(P[:, [c]], Q[:, [c]], **options, cutoff=most) for c in range(d))
    if cutoff is None:
        return total
    return math.inf if total > real_number("cutoff", cutoff, -math.inf, "give a number") else total
