"""The reversals and cycles of a curve, found in one pass.

The pass keeps the extreme since the last reversal. A reversal is accepted when the curve has come
back from that extreme by more than the smallest reversal that counts. Rainflow counting finds
reversals above a hysteresis gate by the same rule (ASTM E1049). Time and memory are O(n).
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from .._options import real_number
from .checks import check_column, checked_curve
from .inputs import CurveLike

__all__ = ["last_cycle", "turning_points"]

_REVERSALS = "it must be between 0 and 1"


def turning_points(
    curve: CurveLike, *, column: int = 0, reversal: float = 0.1
) -> npt.NDArray[np.int64]:
    """Find the points at which a curve reverses, as a loop does between branches.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve.
    column : int, default 0
        The coordinate that reverses, from 0: usually the strain.
    reversal : float, default 0.1
        The smallest reversal that counts, as a fraction of the coordinate's range; between 0 and 1.
        Choose a value above the noise and below the smallest branch.

    Returns
    -------
    ndarray of int64, shape (k,)
        Indices of the turning points, ascending, without the first and the last point. If the
        coordinate is constant at a reversal, the first of these points.

    Raises
    ------
    TypeError, ValueError
        If `curve` does not hold finite numbers, the column does not exist, or `reversal` is out of
        range.

    Notes
    -----
    O(n) time and memory: about 0.2 s for 10^6 points.

    Examples
    --------
    >>> import curvewise
    >>> from curvewise.curves import turning_points
    >>> test, simulation = curvewise.datasets.hysteresis_pair()
    >>> turning_points(simulation)  # strain 0, +2 %, -2 %, +2 %
    array([30, 90])
    """
    values = checked_curve(curve, 1)
    if not 0.0 < real_number("reversal", reversal, -math.inf, _REVERSALS) < 1.0:
        raise ValueError(f"reversal is {reversal}; {_REVERSALS}")
    x = values[:, check_column(values, column)]
    # Halves cannot overflow.
    least = reversal * (0.5 * float(x.max()) - 0.5 * float(x.min()))
    turns: list[int] = []
    low = high = 0  # indices of the extremes since the last turn
    rises: bool | None = None  # not known before the first reversal
    halves = (0.5 * x).tolist()
    for i, value in enumerate(halves):
        if value < halves[low]:
            low = i
        if value > halves[high]:
            high = i
        fell, rose = halves[high] - value > least, value - halves[low] > least
        if rises is not False and fell:
            if rises:
                turns.append(high)
            low, rises = i, False
        elif rises is not True and rose:
            if rises is False:
                turns.append(low)
            high, rises = i, True
    return np.array(turns, dtype=np.int64)


def last_cycle(curve: CurveLike, *, column: int = 0, reversal: float = 0.1) -> slice:
    """Find the last complete cycle of a curve.

    It is the stabilised cycle of many tests. A cycle is two branches. It extends from a turning
    point to the next but one. The second branch returns to the beginning of the first, or passes
    it; it may miss less than the smallest reversal that counts. The last point of the curve counts
    as a turning point. A test that stops at the end of a branch therefore has its last cycle, and
    one that is cut short has the cycle before. The section before the first turning point does not
    belong to a cycle.

    Parameters
    ----------
    curve, column, reversal
        As for :func:`turning_points`.

    Returns
    -------
    slice
        The points of the cycle, including the turning point at each end.

    Raises
    ------
    ValueError
        If the curve does not have a complete cycle; or as for :func:`turning_points`, with
        TypeError.

    Notes
    -----
    O(n) time and memory.

    Examples
    --------
    >>> import curvewise
    >>> from curvewise.curves import last_cycle
    >>> test, simulation = curvewise.datasets.hysteresis_pair()
    >>> last_cycle(simulation)  # strain +2 %, -2 %, +2 %
    slice(30, 151, None)
    """
    values = checked_curve(curve, 1)
    turns = turning_points(values, column=column, reversal=reversal).tolist()
    x = 0.5 * values[:, check_column(values, column)]
    missing = reversal * float(x.max() - x.min())
    ends = [*turns, len(x) - 1]
    for begin, middle, end in reversed(list(zip(ends, ends[1:], ends[2:], strict=False))):
        way = 1.0 if x[end] > x[middle] else -1.0
        if way * (x[end] - x[begin]) >= -missing:
            return slice(begin, end + 1)
    raise ValueError(
        f"the curve lacks a complete cycle: it reverses {len(turns)} time"
        f"{'' if len(turns) == 1 else 's'}, and after two reversals it never returns to the first; "
        "compare all of it"
    )
