"""Scaling: by P's bounding box, and by a power of two where squares would overflow or vanish.

Squares of numbers beyond 2**512 overflow and those of numbers below 2**-512 lose bits, although
the distances asked for are representable. Curves whose largest magnitude is beyond 2**±500 are
therefore multiplied by a power of two before the work, which changes no bit of a number that
stays in range, and the result is multiplied back. Time and memory O(n d).
"""

from __future__ import annotations

import math

import numpy as np

from .._curves import Array, CurveLike, as_curve
from .checks import check_pair

__all__ = ["box_scaled", "normalize", "range_exponent", "times_power_of_two"]

_LARGE = 2.0**500
_SMALL = 2.0**-500


def normalize(P: CurveLike, *others: CurveLike) -> list[Array]:
    """Scale curves by P's bounding box: P comes to lie in [0, 1] in every coordinate.

    Parameters
    ----------
    P : array_like, shape (n, d) or (n,)
        The curve whose minimum is subtracted, and by whose extent is divided (not in a
        coordinate in which it has none).
    *others : array_like, shape (m, d) or (m,)
        Curves to scale alike.

    Returns
    -------
    list of ndarray
        P and the others, scaled, each in the shape it came in.

    Raises
    ------
    ValueError
        A curve is empty, not finite, or differs from P in d.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Section 2.1 of the paper. Time and memory O(n d) a curve.

    Examples
    --------
    >>> from curvewise import reference
    >>> P, Q = reference.normalize([(0, 10), (2, 30)], [(1, 40)])
    >>> P.tolist(), Q.tolist()
    ([[0.0, 0.0], [1.0, 1.0]], [[0.5, 1.5]])
    """
    names = ["P", "Q"] if len(others) == 1 else ["P", *(f"others[{i}]" for i in range(len(others)))]
    given = [as_curve(curve, name) for curve, name in zip((P, *others), names, strict=True)]
    scaled = []
    for curve, name in zip(given, names, strict=True):
        box, points = check_pair(given[0], curve, "normalize", name=name)
        scaled.append(box_scaled(points, box).reshape(curve.shape))
    return scaled


def box_scaled(curve: Array, box_of: Array) -> Array:
    """Return `curve` scaled by the bounding box of `box_of`, both of shape (., d).

    Each coordinate has a range of its own, that of the box: x may be as large as y is small.
    """
    scaled = np.empty(curve.shape)
    for c in range(curve.shape[1]):
        x, box = curve[:, c], box_of[:, c]
        extent = 1.0
        if box.max() > box.min():
            exponent = range_exponent(box)
            x, box = times_power_of_two(x, -exponent), times_power_of_two(box, -exponent)
            extent = box.max() - box.min()
        with np.errstate(over="ignore", under="ignore"):
            scaled[:, c] = (x - box.min()) / extent
    return scaled


def range_exponent(*arrays: Array) -> int:
    """Return k such that the arrays times 2**-k are neither too large nor too small to square.

    0, for no change, unless the largest magnitude is above 2**500 or (not 0 and) below 2**-500.
    """
    largest = max(float(np.max(np.abs(array), initial=0.0)) for array in arrays)
    if largest > _LARGE or 0 < largest < _SMALL:
        return math.frexp(largest)[1]
    return 0


def times_power_of_two(array: Array, exponent: int) -> Array:
    """Return array * 2**exponent; beyond the range of a double, inf."""
    if exponent == 0:
        return array
    with np.errstate(over="ignore", under="ignore"):
        return np.asarray(np.ldexp(array, exponent))
