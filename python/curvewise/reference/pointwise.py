"""Sums over the differences of two curves of equal shape, entry by entry: time O(n d)."""

from __future__ import annotations

import numpy as np

from .._curves import Array, CurveLike, as_curves
from .checks import check_pair, check_same_shape
from .scaling import range_exponent, times_power_of_two

__all__ = ["mae", "mse", "sum_of_squares"]


def sum_of_squares(P: CurveLike, Q: CurveLike) -> float:
    """Sum of squared differences of two curves of equal shape, entry by entry.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.

    Returns
    -------
    float
        In squared units of the curves. Symmetric.

    Raises
    ------
    ValueError
        The shapes differ; a curve is empty or not finite.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Eq. 1 of the paper. Time and memory O(n d).

    Examples
    --------
    >>> from curvewise import reference
    >>> reference.sum_of_squares([1, 2, 3, 4], [1, 3, 5, 4])
    5.0
    """
    delta, exponent = _differences(P, Q, "sum_of_squares")
    return _restored(np.sum(_squared(delta)), 2 * exponent)


def mse(P: CurveLike, Q: CurveLike) -> float:
    """Mean squared difference over all n d entries of two curves of equal shape.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.

    Returns
    -------
    float
        In squared units of the curves. Symmetric.

    Raises
    ------
    ValueError, TypeError
        As for :func:`sum_of_squares`.

    Notes
    -----
    :func:`sum_of_squares` over n d. Time and memory O(n d).

    Examples
    --------
    >>> from curvewise import reference
    >>> reference.mse([1, 2, 3, 4], [1, 3, 5, 4])
    1.25
    """
    delta, exponent = _differences(P, Q, "mse")
    return _restored(np.mean(_squared(delta)), 2 * exponent)


def mae(P: CurveLike, Q: CurveLike) -> float:
    """Mean absolute difference over all n d entries of two curves of equal shape.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.

    Returns
    -------
    float
        In units of the curves. Symmetric.

    Raises
    ------
    ValueError, TypeError
        As for :func:`sum_of_squares`.

    Notes
    -----
    Time and memory O(n d).

    Examples
    --------
    >>> from curvewise import reference
    >>> reference.mae([1, 2, 3, 4], [1, 3, 5, 4])
    0.75
    """
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
