"""Dynamic time warping: the cheapest monotone matching of all points of two curves.

The table c[i, j] holds the cost of the cheapest warping path from (0, 0) to (i, j):

    c[0, 0] = d(P[0], Q[0]),
    c[i, j] = min(min(c[i-1, j], c[i, j-1]) + d, c[i-1, j-1] + w d),    d = d(P[i], Q[j]),

with w = 1 for the step pattern "symmetric1" and w = 2 for "symmetric2" (Sakoe & Chiba, 1978). It
is filled along anti-diagonals i + j = s, whose cells depend on earlier ones only. Time and memory
O(n m).
"""

from __future__ import annotations

from typing import Any, NamedTuple, get_args

import numpy as np
import numpy.typing as npt

from .._options import Default, Metric, Order, StepPattern, Window, check_choice, whole_number
from ..curves.ground_distance import check_metric, ground_distances, in_range
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from ..measures.results import Alignment
from .checks import check_pair
from .warping_table import filled_table, traced_path

__all__ = ["dtw", "dtw_path", "dtw_table"]


def dtw(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = Default.metric,
    p: Order = Default.p,
    step_pattern: StepPattern = Default.step_pattern,
    window: Window = Default.window,
    open_begin: bool = Default.open_begin,
    open_end: bool = Default.open_end,
    normalize: bool = Default.normalize,
) -> float:
    """Time and memory O(n m).

    Step patterns: Sakoe & Chiba (1978); open ends: Müller, "Information Retrieval for Music and
    Motion" (2007), chapter 4.
    """
    if normalize and step_pattern == "symmetric1":
        raise ValueError(
            "normalize needs step_pattern='symmetric2', whose paths all have the weight n + m"
        )
    table = _accumulate(P, Q, metric, p, step_pattern, window, open_begin, open_end)
    distance = float(table.restored(table.costs[-1, table.end]))
    return distance / sum(table.costs.shape) if normalize else distance


def dtw_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = Default.metric,
    p: Order = Default.p,
    step_pattern: StepPattern = Default.step_pattern,
    window: Window = Default.window,
    open_begin: bool = Default.open_begin,
    open_end: bool = Default.open_end,
) -> Alignment:
    """As for :func:`dtw`."""
    table = _accumulate(P, Q, metric, p, step_pattern, window, open_begin, open_end)
    distance = float(table.restored(table.costs[-1, table.end]))
    c, d, w = table.costs, table.ground, table.weight

    def is_diagonal(i: int, j: int) -> bool:
        return bool(c[i - 1, j - 1] + w * d[i, j] <= min(c[i - 1, j], c[i, j - 1]) + d[i, j])

    return Alignment(distance, traced_path(c, table.end, is_diagonal, open_begin=open_begin))


def dtw_table(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = Default.metric,
    p: Order = Default.p,
    step_pattern: StepPattern = Default.step_pattern,
    window: Window = Default.window,
    open_begin: bool = Default.open_begin,
    open_end: bool = Default.open_end,
) -> Array:
    """As for :func:`dtw`."""
    table = _accumulate(P, Q, metric, p, step_pattern, window, open_begin, open_end)
    return np.array(table.restored(table.costs))


class _Table(NamedTuple):
    """A filled table, with what is needed to read a distance or a path off it."""

    costs: Array  # c[i, j], in units of 2**exponent
    ground: Array  # d(P[i], Q[j]), in the same units; inf outside the window
    weight: float  # of a diagonal step
    end: int  # the column in which the path ends
    exponent: int

    def restored(self, values: Any) -> Array:
        """Return values of the table in units of the curves."""
        return times_power_of_two(values, self.exponent)


def _accumulate(
    P: CurveLike,
    Q: CurveLike,
    metric: Metric,
    p: Order,
    step_pattern: StepPattern,
    window: Window,
    open_begin: bool,
    open_end: bool,
) -> _Table:
    """Check everything and fill the table."""
    P, Q = as_curves(P, Q)
    metric, order = check_metric(metric, p)
    radius = _check_steps(step_pattern, window, open_begin, open_end)
    P, Q = check_pair(P, Q, "dtw")
    if isinstance(radius, float):
        radius = int(radius * max(len(P), len(Q)))
    if radius == 0 and len(P) != len(Q) and min(len(P), len(Q)) > 1:
        raise ValueError(
            f"window=0 admits no path between {len(P)} and {len(Q)} points; use at least 1"
        )
    P, Q, exponent = in_range(P, Q, metric)
    ground = ground_distances(P[:, np.newaxis], Q, metric, order)
    if radius is not None:
        ground[~_sakoe_chiba_band(len(P), len(Q), radius)] = np.inf
    weight = 1.0 if step_pattern == "symmetric1" else 2.0
    costs = filled_table(
        ground,
        lambda d, up, left, diagonal: np.minimum(np.minimum(up, left) + d, diagonal + weight * d),
        open_begin=open_begin,
    )
    end = int(np.argmin(costs[-1])) if open_end else len(Q) - 1
    return _Table(costs, ground, weight, end, exponent)


def _check_steps(step_pattern: StepPattern, window: Any, open_begin: bool, open_end: bool) -> Any:
    """Check the options that shape the path, and return the radius, or a fraction, or None."""
    check_choice("step_pattern", step_pattern, get_args(StepPattern))
    radius = None
    if window is not None:
        is_fraction = isinstance(window, float) and 0 < window < 1
        advice = "give a whole number >= 0, a fraction between 0 and 1, or None"
        radius = window if is_fraction else whole_number("window", window, 0, advice)
    if open_begin or open_end:
        if step_pattern != "symmetric1":
            raise ValueError("open_begin and open_end need step_pattern='symmetric1'")
        if window is not None:
            raise ValueError("open_begin and open_end cannot be combined with window")
    return radius


def _sakoe_chiba_band(n: int, m: int, radius: int) -> npt.NDArray[np.bool_]:
    """Return which cells are inside the band."""
    if n == 1 or m == 1:
        return np.ones((n, m), dtype=np.bool_)
    i = np.arange(n, dtype=np.int64)[:, np.newaxis]
    j = np.arange(m, dtype=np.int64)
    # A radius of max(n, m) admits every cell, so a larger one need not overflow int64.
    limit = min(radius, max(n, m)) * (max(n, m) - 1)
    return np.asarray(np.abs(i * (m - 1) - j * (n - 1)) <= limit)
