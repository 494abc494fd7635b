"""The backbone curve of a cyclic test, through the tips of its loops. O(n log n) time."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Literal, get_args

import numpy as np

from .._options import check_choice, real_number
from .checks import check_column, checked_curve
from .inputs import Array, CurveLike
from .reversals import last_extreme, record_and_turns

__all__ = ["BackboneCycle", "backbone"]

BackboneCycle = Literal["first", "last"]
_INCREMENT = "give a fraction, at least 0"


def backbone(
    curve: CurveLike,
    *,
    cycle: BackboneCycle = "first",
    increment: float = 0.1,
    column: int = 0,
    reversal: float = 0.1,
) -> Array:
    """Compute the backbone (skeleton, envelope) curve of a cyclic test.

    Parameters
    ----------
    curve : array_like, shape (n, d)
        The record, from the unloaded state: displacement and force, or strain and stress.
    cycle : {"first", "last"}, default "first"
        Which cycle of each amplitude gives a point. "first": the backbone curve of ASCE/SEI 41 and
        FEMA 461, through the points of peak displacement in the first cycle of each increment.
        "last": through the tips of the last cycle of each increment, the cyclic stress-strain
        curve of ASTM E606 if these cycles are stabilised.
    increment : float, default 0.1
        An amplitude that is larger than all before by more than this fraction begins a new
        increment. Cycles that are smaller by more than this fraction give no point.
    column, reversal
        As for :func:`loops`.

    Returns
    -------
    ndarray, shape (k, d)
        The points by the driving column, ascending: valleys, the first point of the record, and
        peaks.

    Raises
    ------
    TypeError
        If `curve` does not hold real numbers.
    ValueError
        If a number is not finite, `cycle` is unknown, `increment` is negative, `column` does not
        exist, or `reversal` is out of range.

    Notes
    -----
    Amplitudes count from the first point of the record. The end of the last branch is a point of
    the curve if it begins a new increment, as a final pull to failure does. O(n log n) time, O(n)
    memory.

    References
    ----------
    ASCE/SEI 41, section 7.6 (component tests); FEMA 461; ASTM E606/E606M, cyclic stress-strain
    curve; ASTM E2126, envelope curve.

    Examples
    --------
    Two cycles at an amplitude of 1 and two at 2; the force falls in the second cycles:

    >>> from curvewise.curves import backbone
    >>> smaller = [[0, 0], [1, 10], [-1, -10], [1, 9], [-1, -9]]
    >>> larger = [[2, 15], [-2, -15], [2, 13], [-2, -13], [0, 0]]
    >>> backbone(smaller + larger)
    array([[ -2., -15.],
           [ -1., -10.],
           [  0.,   0.],
           [  1.,  10.],
           [  2.,  15.]])
    >>> backbone(smaller + larger, cycle="last")[:, 1]
    array([-13.,  -9.,   0.,   9.,  13.])
    """
    check_choice("cycle", cycle, get_args(BackboneCycle))
    if not 0.0 <= real_number("increment", increment, -math.inf, _INCREMENT) < math.inf:
        raise ValueError(f"increment is {increment}; {_INCREMENT}")
    record, turns = record_and_turns(checked_curve(curve, 1), column, reversal)
    x = record[:, check_column(record, column)]
    least = 0.5 * reversal * float(np.ptp(x))  # as symmetric cycles have that just count
    rows = [0, *(int(turn) for turn in turns), last_extreme(x, turns)]
    valleys, peaks = (
        _tips(way * (x - x[0]), rows, least, increment, cycle == "last") for way in (-1.0, 1.0)
    )
    chosen: Array = record[[*reversed(valleys), 0, *peaks]]
    return chosen


def _tips(
    amplitude: Array, rows: list[int], least: float, increment: float, last: bool
) -> list[int]:
    """Return the rows of the first or last peak of each increment."""
    found: list[int] = []
    largest = 0.0  # amplitude of the first peak of the increment
    for before, row in pairwise(rows):
        reached = float(amplitude[row])
        if reached <= max(least, float(amplitude[before])):
            continue
        if reached > (1.0 + increment) * largest:
            found.append(row)
            largest = reached
        elif last and row != rows[-1] and reached >= (1.0 - increment) * largest:
            found[-1] = row
    return found
