"""The area that one of two closed curves encloses and the other does not."""

from __future__ import annotations

from .._core import symmetric_difference as compiled_symmetric_difference
from ..curves.inputs import CurveLike

__all__ = ["symmetric_difference"]


def symmetric_difference(P: CurveLike, Q: CurveLike) -> float:
    """Compute the area that exactly one of two closed curves encloses.

    A point is inside a curve that winds around it an odd number of times (the even-odd rule), so
    curves may cross themselves and each other. The value does not depend on the first point of a
    curve, its direction, or its sampling.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves. An edge leads from the last point to the first one; a last point that equals the
        first one only closes a curve.

    Returns
    -------
    float
        The area, in units of x times units of y. Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite, is empty or has other than 2 coordinates.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Between neighbouring x of points and of crossings, the edges of both curves have a fixed order.
    Every second gap between them is counted (the slabs of Shamos & Hoey, 1976). Exact up to
    rounding. Time O((n + m + k) a log a), where a edges lie above each other and k pairs of them
    cross; memory O(n + m + a²).

    Examples
    --------
    >>> import curvewise
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> moved = [(3, 3), (1, 3), (1, 1), (3, 1), (3, 3)]
    >>> curvewise.symmetric_difference(square, moved)
    6.0
    """
    return compiled_symmetric_difference(P, Q)
