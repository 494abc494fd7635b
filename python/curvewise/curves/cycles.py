"""The hysteresis loops of a record, with their peaks, valleys and energies.

A cycle has a peak and a valley. Its loop begins and ends at one value of the driving column, so
that the enclosed area is the work dissipated in the cycle. Peak, valley and hysteresis loop are
those of ASTM E1823 and E606.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .checks import check_column, checked_curve
from .inputs import Array, CurveLike
from .reversals import first_extreme, last_extreme, record_and_turns

__all__ = [
    "Cycle",
    "area_of",
    "cycles_of",
    "in_plane",
    "loop_energy",
    "loops",
    "peaks_and_valleys",
    "up_to_level",
]


class Cycle(NamedTuple):
    """A loop with the places of its two reversals, in the order of the record.

    Attributes
    ----------
    points : ndarray, shape (n, d)
        The loop; its first and its last point have one value of the driving column.
    first, second : int
        Rows of `points` at which the reversals are.
    peak_first : bool
        Whether the first reversal is the peak.
    """

    points: Array
    first: int
    second: int
    peak_first: bool

    @property
    def tips(self) -> Array:
        """Peak and valley, shape (2, d)."""
        tips: Array = self.points[[self.first, self.second]]
        return tips if self.peak_first else tips[::-1]

    def branch(self, *, after_peak: bool) -> Array:
        """Return the points from the peak, or from the valley, to the next reversal."""
        if after_peak is self.peak_first:
            return self.points[self.first : self.second + 1]
        return self.points[self.second :]


def loops(curve: CurveLike, *, column: int = 0, reversal: float = 0.1) -> list[Array]:
    """Split a record into the hysteresis loops of its cycles.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The record, in the order of loading: strain and stress, or displacement and force.
    column : int, default 0
        The driving coordinate, from 0. Pass 1 for a test under stress or force control.
    reversal : float, default 0.1
        The smallest reversal that counts, as a fraction of the coordinate's range; between 0 and
        1. Protocols with growing amplitudes (FEMA 461) need about 0.02.

    Returns
    -------
    list of ndarray, shapes (n_k, d)
        One loop a cycle. The first and the last point have the same value of the driving column.
        They may differ by `reversal` of the loop's extent if the record begins or ends there. If
        the record is dense and noisy, the points are averages.

    Raises
    ------
    TypeError
        If `curve` does not hold real numbers.
    ValueError
        If a number is not finite, `column` does not exist, `reversal` is out of range, or no cycle
        is complete.

    See Also
    --------
    last_cycle : The slice of the last complete cycle.

    Notes
    -----
    Peaks and valleys are paired in their order (ASTM E606), the first reversal with the second. A
    loop begins and ends at the outermost value that the branches before and after both reach, on
    the side of its first reversal. If the amplitude grows, the loop ends where the record passes
    that reversal. If the amplitude falls, or the test ends early, the loop begins on the branch
    before; neighbouring loops then share a section. Loops within loops are not separated; rainflow
    counting (ASTM E1049) does that. O(n log n) time, O(n) memory.

    Examples
    --------
    >>> import curvewise
    >>> from curvewise.curves import loops
    >>> test, simulation = curvewise.datasets.hysteresis_pair()
    >>> (loop,) = loops(simulation)  # strain +2 %, -2 %, +2 %
    >>> loop[[0, 60, -1], 0].round(4)
    array([ 0.02, -0.02,  0.02])
    """
    return [cycle.points for cycle in cycles_of(checked_curve(curve, 1), column, reversal)]


def peaks_and_valleys(curve: CurveLike, *, column: int = 0, reversal: float = 0.1) -> Array:
    """Tabulate the peak and the valley of each cycle.

    Parameters
    ----------
    curve, column, reversal
        As for :func:`loops`.

    Returns
    -------
    ndarray, shape (k, 2, d)
        For each cycle the point of its peak and the point of its valley: the largest and the
        smallest value of the driving column (ASTM E1823).

    Raises
    ------
    TypeError, ValueError
        As for :func:`loops`.

    Notes
    -----
    O(n log n) time, O(n) memory.

    Examples
    --------
    >>> from curvewise.curves import peaks_and_valleys
    >>> record = [[0, 0], [1, 10], [-1, -9], [1, 11], [-1, -10], [1, 12]]
    >>> peaks, valleys = peaks_and_valleys(record).swapaxes(0, 1)
    >>> peaks[:, 1], valleys[:, 1]
    (array([10., 11.]), array([ -9., -10.]))
    """
    return np.array([cycle.tips for cycle in cycles_of(checked_curve(curve, 1), column, reversal)])


def loop_energy(curve: CurveLike, *, column: int = 0, reversal: float = 0.1) -> Array:
    r"""Compute the dissipated energy of each cycle, the area of its loop.

    .. math:: E_D = \oint y \, \mathrm{d}x

    Parameters
    ----------
    curve : array_like, shape (n, 2)
        The record: x and y, such as displacement and force.
    column, reversal
        As for :func:`loops`.

    Returns
    -------
    ndarray, shape (k,)
        In units of x times y: J/m³ for strain and stress in Pa, MJ/m³ for MPa. It is negative if
        the loop runs counter-clockwise, which usually means that x and y are swapped.

    Raises
    ------
    TypeError, ValueError
        As for :func:`loops`; if `curve` does not have two columns.

    Notes
    -----
    The area of the polygon, by the trapezoidal rule. O(n log n) time, O(n) memory.

    References
    ----------
    ASTM E606/E606M, hysteresis loop. A. K. Chopra, "Dynamics of Structures", section 3.8.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.curves import loop_energy
    >>> t = np.linspace(0, 4 * np.pi, 2001)
    >>> loop_energy(np.column_stack((np.sin(t), np.sin(t) + 0.2 * np.cos(t)))) / (0.2 * np.pi)
    array([0.99999342, 0.99999342])
    """
    found: Array = np.array(
        [area_of(cycle.points) for cycle in cycles_of(in_plane(curve), column, reversal)]
    )
    return found


def cycles_of(points: Array, column: int, reversal: float) -> list[Cycle]:
    """Return the complete cycles of a record."""
    record, turns = record_and_turns(points, column, reversal)
    x = record[:, check_column(record, column)]
    found = [*_complete(record, x, [int(turn) for turn in turns], reversal)]
    if not found:
        raise ValueError(
            f"the curve lacks a complete cycle: it reverses {len(turns)} time"
            f"{'' if len(turns) == 1 else 's'}; a smaller reversal= counts smaller cycles, and "
            "column= names the coordinate that drives the test"
        )
    return found


def _complete(record: Array, x: Array, turns: list[int], reversal: float) -> Iterator[Cycle]:
    """Yield the cycles of a record whose loops can be closed."""
    # Ends of a record that are too short for a reversal close loops all the same.
    ends = [*turns, last_extreme(x, turns), len(x) - 1]
    start = first_extreme(x, turns)
    if turns and start > 0 and _extent(x, start, ends[0]) >= (1 - reversal) * _extent(x, *ends[:2]):
        turns, ends = [start, *turns], [start, *ends]
    for k in range(0, len(turns), 2):
        begin = ends[k - 1] if k else 0
        first, second, end = ends[k : k + 3]
        way = 1.0 if x[first] > x[second] else -1.0
        level = way * x
        missing = reversal * (level[first] - level[second])
        if k + 1 == len(turns) and level[second] > level[begin] + missing:
            continue  # the last branch is cut short
        closed_at = min(level[first], level[end])
        if level[begin] > closed_at + missing:
            continue  # the record begins too late, and ends too early
        before, after = record[begin : first + 1], record[second : end + 1]
        if closed_at > level[begin]:
            before = up_to_level(before[::-1], level[begin : first + 1][::-1], closed_at)[::-1]
        if level[end] > closed_at:
            after = up_to_level(after, level[second : end + 1], closed_at, rises=True)
        between = record[first + 1 : second]
        points = np.concatenate((before, between, after))
        yield Cycle(points, len(before) - 1, len(before) + len(between), way > 0.0)


def _extent(x: Array, a: int, b: int) -> float:
    return abs(float(x[b] - x[a]))


def up_to_level(points: Array, level: Array, at: float, rises: bool = False) -> Array:
    """Return the points up to where the level first falls (or rises) to a value, interpolated."""
    reached = level >= at if rises else level <= at
    stop = int(np.argmax(reached))
    if stop == 0:
        return points[:1]
    share = (at - level[stop - 1]) / (level[stop] - level[stop - 1])
    last = points[stop - 1] + share * (points[stop] - points[stop - 1])
    return np.concatenate((points[:stop], last[np.newaxis]))


def in_plane(curve: CurveLike) -> Array:
    """Return a checked curve; refuse another number of columns than two."""
    points = checked_curve(curve, 1)
    if points.shape[1] != 2:
        raise ValueError(f"curve has shape {points.shape}; give x and y, shape (n, 2)")
    return points


def area_of(loop: Array) -> float:
    """Return the area of a closed polygon, positive if it runs clockwise."""
    x, y = (loop - loop[0]).T
    return 0.5 * float(y @ np.roll(x, -1) - x @ np.roll(y, -1))
