"""The area that one of two closed curves encloses and the other does not."""

from __future__ import annotations

from .._core import symmetric_difference as compiled_symmetric_difference
from ..curves.inputs import CurveLike

__all__ = ["symmetric_difference"]


def symmetric_difference(P: CurveLike, Q: CurveLike) -> float:
    """Area that one of two closed curves encloses and the other does not.

    A point is inside a curve that goes around it an odd number of times (the even-odd rule), so
    that curves may cross themselves and each other. The value depends neither on where a curve
    begins, nor on its direction, nor on its sampling.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves. An edge leads from the last point to the first one; a last point that equals
        the first one only closes a curve.

    Returns
    -------
    float
        In units of x times units of y. Symmetric.

    Raises
    ------
    ValueError
        A curve is not finite, has no point or other than 2 coordinates.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Between neighbouring x of points and of crossings, the edges of both curves have one order, and
    every second gap between them is counted (the slabs of Shamos & Hoey, 1976). Exact but for
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
