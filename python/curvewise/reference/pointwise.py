"""Sums over the differences of two curves of equal shape, entry by entry: time O(n d)."""

from __future__ import annotations

import numpy as np

from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import range_exponent, times_power_of_two
from .checks import check_pair, check_same_shape

__all__ = ["mae", "mse", "sum_of_squares"]


def sum_of_squares(P: CurveLike, Q: CurveLike) -> float:
    """Eq. 1 of the paper. Time and memory O(n d)."""
    delta, exponent = _differences(P, Q, "sum_of_squares")
    return _restored(np.sum(_squared(delta)), 2 * exponent)


def mse(P: CurveLike, Q: CurveLike) -> float:
    """:func:`sum_of_squares` over n d. Time and memory O(n d)."""
    delta, exponent = _differences(P, Q, "mse")
    return _restored(np.mean(_squared(delta)), 2 * exponent)


def mae(P: CurveLike, Q: CurveLike) -> float:
    """Time and memory O(n d)."""
    delta, exponent = _differences(P, Q, "mae")
    return _restored(np.mean(np.abs(delta)), exponent)


def _differences(P: CurveLike, Q: CurveLike, measure: str) -> tuple[Array, int]:
    """Return P - Q in units of 2**exponent, and the exponent."""
    P, Q = as_curves(P, Q)
    check_same_shape(P, Q, measure)
    P, Q = check_pair(P, Q, measure)
    exponent = range_exponent(P, Q)
    return times_power_of_two(P, -exponent) - times_power_of_two(Q, -exponent), exponent


def _squared(delta: Array) -> Array:
    with np.errstate(under="ignore"):
        return delta * delta


def _restored(value: np.floating, exponent: int) -> float:
    return float(times_power_of_two(np.asarray(value), exponent))
