"""Dynamic time warping: the cheapest monotone matching of all points of two curves.

The table c[i, j] holds the cost of the cheapest warping path from (0, 0) to (i, j):

    c[0, 0] = d(P[0], Q[0]),
    c[i, j] = min(min(c[i-1, j], c[i, j-1]) + d, c[i-1, j-1] + w d),    d = d(P[i], Q[j]),

with w = 1 for the step pattern "symmetric1" and w = 2 for "symmetric2" (Sakoe & Chiba, 1978). It
is filled along anti-diagonals i + j = s, whose cells depend on earlier ones only. Time and memory
O(n m).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple, SupportsFloat

import numpy as np
import numpy.typing as npt

from .._options import (
    GroundDistance,
    Order,
    Radius,
    Relax,
    Window,
    check_closed,
    check_independent,
    check_window,
    real_number,
    whole_number,
    window_radius,
)
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from ..measures.results import Alignment
from ..measures.step_pattern import StepPattern, Steps
from .checks import check_pair
from .closed import closed_dtw
from .ground import Ground
from .recurrence import EndOf, Recurrence, filled, found_path, last_cell, pattern_steps
from .warping_table import filled_table, traced_path

__all__ = ["dtw", "dtw_path", "dtw_table", "sakoe_chiba_band"]


# Signature: dtw without workers, prune, cutoff, missing
def dtw(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    step_pattern: Steps = "symmetric1",
    penalty: SupportsFloat = 0.0,
    window: Window = None,
    open_begin: bool = False,
    open_end: bool = False,
    relax: Relax = None,
    normalize: bool = False,
    closed: bool = False,
    dependent: bool = True,
) -> float:
    """Time and memory O(n m).

    Step patterns: Sakoe & Chiba (1978); open ends: Müller, "Information Retrieval for Music and
    Motion" (2007), chapter 4. Closed curves: a table for each point at which Q may begin, O(n m²).
    """
    if not dependent:
        return _sum_over_coordinates(**locals())
    if closed:
        check_closed(locals())
        return closed_dtw(P, Q, metric, p, radius).distance
    steps, ends = _Steps.checked(locals()), _Ends.checked(locals())
    if normalize and not any(ends.relax):
        steps.check_normalization()
    table = _accumulate(P, Q, metric, p, radius, steps, window, ends)
    distance = float(table.restored(table.costs[table.end]))
    n, m = len(table.costs), table.end[1] + 1
    return distance / {"N": n, "M": m, "N+M": n + m}[steps.per] if normalize else distance


def _sum_over_coordinates(
    P: CurveLike, Q: CurveLike, metric: Any, dependent: bool, **options: Any
) -> float:
    """Return the sum of dtw of each coordinate alone, in their order."""
    check_independent(metric)
    P, Q = check_pair(*as_curves(P, Q), "dtw")
    return sum(
        dtw(P[:, [c]], Q[:, [c]], metric=metric, dependent=not dependent, **options)
        for c in range(P.shape[1])
    )


# Signature: dtw without normalize, workers, prune, cutoff, missing, dependent
def dtw_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    step_pattern: Steps = "symmetric1",
    penalty: SupportsFloat = 0.0,
    window: Window = None,
    open_begin: bool = False,
    open_end: bool = False,
    relax: Relax = None,
    closed: bool = False,
) -> Alignment:
    """As for :func:`dtw`."""
    if closed:
        check_closed(locals())
        return closed_dtw(P, Q, metric, p, radius)
    steps, ends = _Steps.checked(locals()), _Ends.checked(locals())
    table = _accumulate(P, Q, metric, p, radius, steps, window, ends)
    distance = float(table.restored(table.costs[table.end]))
    if table.path is not None:
        return Alignment(distance, table.path())
    c, d, w = table.costs, table.ground, steps.diagonal_weight

    def is_diagonal(i: int, j: int) -> bool:
        return bool(c[i - 1, j - 1] + w * d[i, j] <= min(c[i - 1, j], c[i, j - 1]) + d[i, j])

    return Alignment(distance, traced_path(c, table.end[1], is_diagonal, open_begin=open_begin))


# Signature: dtw without normalize, workers, prune, cutoff, missing, closed, dependent
def dtw_table(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: GroundDistance = "euclidean",
    p: Order = None,
    radius: Radius = None,
    step_pattern: Steps = "symmetric1",
    penalty: SupportsFloat = 0.0,
    window: Window = None,
    open_begin: bool = False,
    open_end: bool = False,
    relax: Relax = None,
) -> Array:
    """As for :func:`dtw`."""
    steps, ends = _Steps.checked(locals()), _Ends.checked(locals())
    table = _accumulate(P, Q, metric, p, radius, steps, window, ends)
    return np.array(table.restored(table.costs))


class _Table(NamedTuple):
    """A filled table, with the data that give a distance or a path."""

    costs: Array  # c[i, j], in units of 2**exponent
    ground: Array  # d(P[i], Q[j]), in the same units; inf outside the window
    end: tuple[int, int]  # the cell in which the path ends
    exponent: int
    # for steps with a separate path function
    path: Callable[[], npt.NDArray[np.int64]] | None = None

    def restored(self, values: Any) -> Array:
        """Return values of the table in units of the curves."""
        return times_power_of_two(values, self.exponent)


def _accumulate(
    P: CurveLike,
    Q: CurveLike,
    metric: GroundDistance,
    p: Order,
    radius: Radius,
    steps: _Steps,
    window: Window,
    ends: _Ends,
) -> _Table:
    """Check everything and fill the table."""
    P, Q = as_curves(P, Q)
    distance = Ground.checked(P, Q, metric, p, radius)
    _check_steps(steps, window, ends)
    P, Q = check_pair(P, Q, "dtw", on_sphere=distance.is_on_sphere)
    reach = window_radius(window, len(P), len(Q))
    ground, exponent = distance.distances(P, Q, steps.penalty)
    inside = sakoe_chiba_band(len(P), len(Q), reach)
    weight = None if any(ends.relax) else steps.diagonal_weight
    if weight is None:
        penalty = float(times_power_of_two(np.array(steps.penalty), -exponent))
        cells = pattern_steps(steps.pattern.steps(), penalty, ground)
        recurrence = Recurrence(cells, ends.starts(ground))
        costs, taken = filled(recurrence, inside)
        end_of = ends.end_of(steps.per)
        path = partial(found_path, recurrence, inside, costs, taken, end_of)
        return _Table(costs, ground, end_of(costs), exponent, path)
    ground[~inside] = np.inf
    costs = filled_table(
        ground,
        lambda d, up, left, diagonal: np.minimum(np.minimum(up, left) + d, diagonal + weight * d),
        open_begin=ends.open_begin,
    )
    end = int(np.argmin(costs[-1])) if ends.open_end else len(Q) - 1
    return _Table(costs, ground, (len(P) - 1, end), exponent)


def _cheapest_end(per: str, table: Array) -> tuple[int, int]:
    """Return the first cell of the last row whose cost over the weight of paths to it is least."""
    n, m = table.shape
    columns = np.arange(1.0, m + 1.0)
    costs = table[-1] / {"N": float(n), "M": columns, "N+M": n + columns}[per]
    end = int(np.argmin(costs))
    return n - 1, end if costs[end] < np.inf else m - 1


def _relaxed_end(relax: Sequence[int], table: Array) -> tuple[int, int]:
    """Return the cheapest end, the first one in the last row, then in the last column."""
    row, column = last_cell(table)
    cells = [(row, j) for j in range(max(0, column - relax[3]), column + 1)]
    cells += [(i, column) for i in range(max(0, row - relax[1]), row)]
    end = min(cells, key=lambda cell: float(table[cell]))
    return end if table[end] < np.inf else (row, column)


class _Ends(NamedTuple):
    """The allowed beginnings and ends of paths."""

    open_begin: bool
    open_end: bool
    relax: tuple[int, ...]
    normalize: bool

    @classmethod
    def checked(cls, given: Mapping[str, Any]) -> _Ends:
        """Check the numbers of points that may be left out; `given` has all arguments by name."""
        ends = given["open_begin"], given["open_end"]
        relax, normalize = given["relax"], given.get("normalize", False)
        if relax is None:
            return cls(*ends, (0, 0, 0, 0), normalize)
        advice = "give four whole numbers >= 0, or None"
        if isinstance(relax, str | bytes) or not hasattr(relax, "__len__") or len(relax) != 4:
            raise ValueError(f"relax is {relax!r}; {advice}")
        numbers = tuple(whole_number("relax", number, 0, advice) for number in relax)
        return cls(*ends, numbers, normalize)

    def starts(self, ground: Array) -> dict[tuple[int, int], float]:
        """Return the cells in which a path may begin, with their costs."""
        n, m = ground.shape
        columns = m if self.open_begin else min(m, self.relax[2] + 1)
        cells = [(0, j) for j in range(columns)]
        cells += [(i, 0) for i in range(1, min(n, self.relax[0] + 1))]
        return {cell: float(ground[cell]) for cell in cells}

    def end_of(self, per: str) -> EndOf:
        """Return what finds the cell in which a path ends."""
        if any(self.relax):
            return partial(_relaxed_end, self.relax)
        return partial(_cheapest_end, per) if self.open_end else last_cell


class _Steps(NamedTuple):
    """A step pattern with its penalty, and whether an end is open."""

    pattern: StepPattern
    name: str
    penalty: float
    is_open: bool

    @classmethod
    def checked(cls, given: Mapping[str, Any]) -> _Steps:
        """Check the pattern and its penalty; `given` has all arguments by name."""
        steps = given["step_pattern"]
        is_own = isinstance(steps, StepPattern)
        return cls(
            pattern=steps if is_own else StepPattern.named(steps),
            name="of one's own" if is_own else steps,
            penalty=real_number("penalty", given["penalty"], 0.0, "give a number >= 0"),
            is_open=given["open_begin"] or given["open_end"],
        )

    @property
    def per(self) -> str:
        """The divisor of normalize."""
        return self.pattern.normalization

    @property
    def diagonal_weight(self) -> float | None:
        """Weight of a diagonal step in the simple tables; None for other tables.

        The simple tables are those of "symmetric1" without a penalty and of "symmetric2" with
        closed ends.
        """
        weights = {"symmetric1": 1.0, "symmetric2": None if self.is_open else 2.0}
        return None if self.penalty else weights.get(self.name)

    def check_normalization(self) -> None:
        """Refuse to normalise where paths differ in their weight."""
        if self.name == "symmetric1" and not self.penalty:
            raise ValueError(
                "normalize needs step_pattern='symmetric2', whose paths all have the weight n + m"
            )
        if self.per == "NA":
            raise ValueError(
                "normalize needs a step pattern whose paths all have one weight, such as "
                f"'symmetric2'; those of {self.name} differ"
            )


def _check_relax(steps: _Steps, window: Any, ends: _Ends) -> None:
    """Refuse options whose paths cannot be compared by their plain sums."""
    if steps.name != "symmetric1":
        raise ValueError("relax needs step_pattern='symmetric1'")
    given = {
        "window": window is not None,
        "open_begin and open_end": steps.is_open,
        "normalize": ends.normalize,
    }
    for option, is_given in given.items():
        if is_given:
            raise ValueError(f"relax cannot be combined with {option}")


def _check_steps(steps: _Steps, window: Any, ends: _Ends) -> None:
    """Check the options that shape the path."""
    check_window(window)
    if any(ends.relax):
        _check_relax(steps, window, ends)
    if not steps.is_open:
        return
    if window is not None:
        raise ValueError("open_begin and open_end cannot be combined with window")
    if steps.diagonal_weight is not None:
        return
    if ends.open_begin and steps.per != "N":
        raise ValueError(
            "open_begin needs step_pattern='symmetric1' without a penalty, or a step pattern "
            f"normalised by N, such as 'asymmetric'; {steps.name} is not"
        )
    if steps.per == "NA":
        raise ValueError(
            "open_end needs step_pattern='symmetric1' without a penalty, or a step pattern whose "
            "paths all have one weight, such as 'symmetric2' or 'asymmetric'; those of "
            f"{steps.name} differ"
        )


def sakoe_chiba_band(n: int, m: int, radius: int | None) -> npt.NDArray[np.bool_]:
    """Return which cells are inside the band, or all."""
    if radius is None or n == 1 or m == 1:
        return np.ones((n, m), dtype=np.bool_)
    i = np.arange(n, dtype=np.int64)[:, np.newaxis]
    j = np.arange(m, dtype=np.int64)
    # A radius of max(n, m) admits every cell, so a larger one need not overflow int64.
    limit = min(radius, max(n, m)) * (max(n, m) - 1)
    return np.asarray(np.abs(i * (m - 1) - j * (n - 1)) <= limit)
