"""The part of two curves over which both are known. O(n) time and memory."""

from __future__ import annotations

import numpy as np

from .checks import check_column, checked_curve
from .inputs import Array, CurveLike
from .resampling import trim

__all__ = ["common_span"]


def common_span(P: CurveLike, Q: CurveLike, *, by: int = 0) -> tuple[Array, Array]:
    """Cut two curves to the span of a column that both cover.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, such as two histories of different length.
    by : int, default 0
        The column, from 0, such as a time. It must not reverse.

    Returns
    -------
    P, Q : ndarray, shapes (k, d) and (l, d)
        The curves between the larger of both first values and the smaller of both last values. The
        ends are interpolated if they lie between points.

    Raises
    ------
    TypeError
        If a curve does not hold real numbers.
    ValueError
        If a curve has fewer than two points, a number is not finite, the column does not exist or
        reverses, or the spans do not overlap.

    Notes
    -----
    O(n + m) time and memory.

    Examples
    --------
    >>> from curvewise.curves import common_span
    >>> P, Q = common_span([[0, 0], [1, 2], [2, 4]], [[0.5, 1], [3, 6]])
    >>> P.tolist(), Q.tolist()
    ([[0.5, 1.0], [1.0, 2.0], [2.0, 4.0]], [[0.5, 1.0], [2.0, 4.0]])
    """
    columns = []
    for name, curve in (("P", P), ("Q", Q)):
        points = checked_curve(curve, 2)
        x = points[:, check_column(points, by)]
        back = np.flatnonzero(np.diff(x) < 0.0)
        if back.size:
            row = int(back[0]) + 1
            raise ValueError(
                f"column {by} of {name} reverses at row {row}, from {x[row - 1]} to {x[row]}; a "
                "common span needs a column that ascends, such as a time"
            )
        columns.append(x)
    start, stop = (float(choose(x[i] for x in columns)) for i, choose in ((0, max), (-1, min)))
    if start >= stop:
        ends = " and ".join(f"{x[0]} to {x[-1]}" for x in columns)
        raise ValueError(f"P and Q have no common span: column {by} is {ends}")
    return trim(P, start, stop, by=by), trim(Q, start, stop, by=by)
