"""The reversals of a record, noisy or not, and the record that its cycles are read from.

If the noise of the driving column exceeds its step from row to row, an extreme is an extreme of the
noise. Reversals are then those of averages (`averaging`), and cycles are read from the averages.
Otherwise they are the extremes of the record (`turns`).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .averaging import averaged, averaged_turns
from .checks import Turns, check_column, checked_curve
from .inputs import Array, CurveLike
from .turns import turning_points

__all__ = ["first_extreme", "last_extreme", "record_and_turns", "reversals"]


def reversals(curve: CurveLike, *, column: int = 0, reversal: float = 0.1) -> npt.NDArray[np.int64]:
    """Find the reversals of a record, also through noise.

    A reversal is a peak or a valley (ASTM E1823). :func:`turning_points` returns the row with the
    extreme value. In a dense, noisy record that row depends on the noise; `reversals` returns the
    row at which averages from both sides meet.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The record, in the order of loading.
    column : int, default 0
        The driving coordinate, from 0: strain or displacement of a test under such control.
    reversal : float, default 0.1
        The smallest reversal that counts, as a fraction of the coordinate's range; between 0 and
        1. Choose a value above the noise and below the smallest branch.

    Returns
    -------
    ndarray of int64, shape (k,)
        Row numbers, ascending, without the first and the last row.

    Raises
    ------
    TypeError
        If `curve` does not hold real numbers.
    ValueError
        If a number is not finite, `column` does not exist, or `reversal` is out of range.

    See Also
    --------
    turning_points : The extremes, whatever the noise.

    Notes
    -----
    O(n log n) time and O(n) memory for a dense, noisy record, else O(n). A record counts as dense
    and noisy if the noise of the driving column exceeds its step from row to row.

    Examples
    --------
    The middle of a triangular wave of 20,000 rows:

    >>> import numpy as np
    >>> from curvewise.curves import reversals, turning_points
    >>> wave = np.interp(np.arange(20001), [0, 10000, 20000], [0.0, 1.0, 0.0])
    >>> noisy = wave + np.random.default_rng(1).normal(0.0, 0.005, wave.size)
    >>> bool(abs(reversals(noisy)[0] - 10000) < 20)
    True
    >>> bool(abs(turning_points(noisy)[0] - 10000) < 20)
    False
    """
    points = checked_curve(curve, 1)
    turns = turning_points(points, column=column, reversal=reversal)
    driven = _driven(points, check_column(points, column))
    rows = averaged_turns(driven, turns, reversal) if len(turns) else None
    return turns if rows is None else np.asarray(rows, dtype=np.int64)


def record_and_turns(points: Array, column: int, reversal: float) -> tuple[Array, Turns]:
    """Return a checked record, averaged if it is dense and noisy, and its reversals."""
    turns = turning_points(points, column=column, reversal=reversal)
    index = check_column(points, column)
    dense = averaged(_driven(points, index), turns, reversal) if len(turns) else None
    if dense is None:
        return points, turns
    means, found = dense
    return np.insert(means[:, 1:], index, means[:, 0], axis=1), found


def first_extreme(x: Array, turns: Turns) -> int:
    """Return the row at which the first branch is farthest from where it ends."""
    end = int(turns[0]) if len(turns) else len(x) - 1
    return int(np.abs(0.5 * x[: end + 1] - 0.5 * x[end]).argmax())


def last_extreme(x: Array, turns: Turns) -> int:
    """Return the row at which the last branch is farthest from where it begins."""
    begin = int(turns[-1]) if len(turns) else 0
    return begin + int(np.abs(0.5 * x[begin:] - 0.5 * x[begin]).argmax())


def _driven(points: Array, column: int) -> Array:
    """Return the points with the driving column first."""
    others = np.delete(points, column, axis=1)
    return np.column_stack((points[:, column], others))
