"""Dynamic time warping: the cheapest monotone matching of all points of two curves.

The table c[i, j] holds the cost of the cheapest warping path from (0, 0) to (i, j):

    c[0, 0] = d(P[0], Q[0]),
    c[i, j] = min(min(c[i-1, j], c[i, j-1]) + d, c[i-1, j-1] + w d),    d = d(P[i], Q[j]),

with w = 1 for the step pattern "symmetric1" and w = 2 for "symmetric2" (Sakoe & Chiba, 1978). It
is filled along anti-diagonals i + j = s, whose cells depend on earlier ones only. Time and memory
O(n m).
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, SupportsFloat, SupportsIndex, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from .._curves import Array, CurveLike, as_curves
from ..results import Alignment
from .checks import check_choice, check_pair, whole_number
from .ground_distance import Metric, check_metric, degree, ground_distances
from .scaling import range_exponent, times_power_of_two

__all__ = ["dtw", "dtw_path", "dtw_table"]

StepPattern: TypeAlias = Literal["symmetric1", "symmetric2"]


def dtw(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: SupportsFloat | None = None,
    step_pattern: StepPattern = "symmetric1",
    window: SupportsIndex | None = None,
    open_begin: bool = False,
    open_end: bool = False,
) -> float:
    """Dynamic time warping distance: the smallest sum of ground distances over warping paths.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d), or (n,) and (m,)
        The curves, of any d.
    metric : {"euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski"}
        The ground distance between points.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    step_pattern : {"symmetric1", "symmetric2"}
        Whether a diagonal step counts its distance once, or twice (R's default, with which the
        paper's tables were made).
    window : int >= 0, optional
        Radius r of the Sakoe–Chiba band abs(i (m-1) - j (n-1)) <= r (max(n, m) - 1), which is
        abs(i - j) <= r where n = m; no limit where n = 1 or m = 1.
    open_begin, open_end : bool
        Match P to a part of Q only, which may begin, or end, anywhere (subsequence DTW). With
        "symmetric1" and without a window only.

    Returns
    -------
    float
        In units of the ground distance; not divided by the length of the path. Symmetric, but
        for open ends.

    Raises
    ------
    ValueError
        A curve is not finite or empty; the curves differ in d; an option is unknown or out of
        range; no path fits into the window.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Time and memory O(n m). Step patterns: Sakoe & Chiba (1978); open ends: Müller, "Information
    Retrieval for Music and Motion" (2007), chapter 4.

    Examples
    --------
    >>> from curvewise import reference
    >>> reference.dtw([0, 1, 2, 3], [0, 2, 3])
    1.0
    >>> reference.dtw([1, 2], [9, 1, 2, 9], open_begin=True, open_end=True)
    0.0
    """
    table = _accumulate(P, Q, metric, p, step_pattern, window, open_begin, open_end)
    return float(table.restored(table.costs[-1, table.end]))


def dtw_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: SupportsFloat | None = None,
    step_pattern: StepPattern = "symmetric1",
    window: SupportsIndex | None = None,
    open_begin: bool = False,
    open_end: bool = False,
) -> Alignment:
    """Dynamic time warping distance with a warping path that attains it.

    Parameters
    ----------
    P, Q, metric, p, step_pattern, window, open_begin, open_end
        As for :func:`dtw`.

    Returns
    -------
    Alignment
        ``distance`` and ``path``, shape (k, 2). Among equal predecessors the diagonal is taken,
        then (i-1, j), then (i, j-1); with an open end, the first best j. The sum of step weight
        times ground distance, in path order, equals the distance to the bit.

    Raises
    ------
    ValueError, TypeError
        As for :func:`dtw`.

    Notes
    -----
    As for :func:`dtw`.

    Examples
    --------
    >>> from curvewise import reference
    >>> reference.dtw_path([0, 1, 2, 3], [0, 2, 3]).path.tolist()
    [[0, 0], [1, 0], [2, 1], [3, 2]]
    """
    table = _accumulate(P, Q, metric, p, step_pattern, window, open_begin, open_end)
    distance = float(table.restored(table.costs[-1, table.end]))
    return Alignment(distance, _warping_path(table))


def dtw_table(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: SupportsFloat | None = None,
    step_pattern: StepPattern = "symmetric1",
    window: SupportsIndex | None = None,
    open_begin: bool = False,
    open_end: bool = False,
) -> Array:
    """Return the cumulative table of dynamic time warping.

    Parameters
    ----------
    P, Q, metric, p, step_pattern, window, open_begin, open_end
        As for :func:`dtw`; `open_end` does not change the table.

    Returns
    -------
    ndarray, shape (n, m)
        c[i, j], the cost of the cheapest path to (i, j); inf outside the window.

    Raises
    ------
    ValueError, TypeError
        As for :func:`dtw`.

    Notes
    -----
    As for :func:`dtw`.

    Examples
    --------
    >>> from curvewise import reference
    >>> reference.dtw_table([0, 1, 2], [0, 2]).tolist()
    [[0.0, 2.0], [1.0, 1.0], [3.0, 1.0]]
    """
    table = _accumulate(P, Q, metric, p, step_pattern, window, open_begin, open_end)
    return np.array(table.restored(table.costs))


class _Table(NamedTuple):
    """A filled table, with what is needed to read a distance or a path off it."""

    costs: Array  # c[i, j], in units of 2**exponent
    ground: Array  # d(P[i], Q[j]), in the same units; inf outside the window
    weight: float  # of a diagonal step
    end: int  # the column in which the path ends
    open_begin: bool
    exponent: int

    def restored(self, values: Any) -> Array:
        """Return values of the table in units of the curves."""
        return times_power_of_two(values, self.exponent)


def _accumulate(
    P: CurveLike,
    Q: CurveLike,
    metric: Metric,
    p: SupportsFloat | None,
    step_pattern: StepPattern,
    window: SupportsIndex | None,
    open_begin: bool,
    open_end: bool,
) -> _Table:
    """Check everything and fill the table."""
    P, Q = as_curves(P, Q)
    metric, order = check_metric(metric, p)
    radius = _check_steps(step_pattern, window, open_begin, open_end)
    P, Q = check_pair(P, Q, "dtw")
    if radius == 0 and len(P) != len(Q) and min(len(P), len(Q)) > 1:
        raise ValueError(
            f"window=0 admits no path between {len(P)} and {len(Q)} points; use at least 1"
        )
    exponent = range_exponent(P, Q)
    P, Q = times_power_of_two(P, -exponent), times_power_of_two(Q, -exponent)
    ground = ground_distances(P, Q, metric, order)
    if radius is not None:
        ground[~_sakoe_chiba_band(len(P), len(Q), radius)] = np.inf
    weight = 1.0 if step_pattern == "symmetric1" else 2.0
    costs = _cumulative_costs(ground, weight, open_begin)
    end = int(np.argmin(costs[-1])) if open_end else len(Q) - 1
    return _Table(costs, ground, weight, end, open_begin, exponent * degree(metric))


def _check_steps(step_pattern: StepPattern, window: Any, open_begin: bool, open_end: bool) -> Any:
    """Check the options that shape the path, and return the radius of the window, or None."""
    check_choice("step_pattern", step_pattern, get_args(StepPattern))
    radius = None
    if window is not None:
        radius = whole_number("window", window, 0, "give a whole number >= 0, or None")
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


def _cumulative_costs(ground: Array, weight: float, open_begin: bool) -> Array:
    n, m = ground.shape
    # costs[i + 1, j + 1] is c[i, j]: behind a border of inf the first row and column need no case
    # of their own. Above an open first row the border is 0: a path may begin in each of its cells.
    costs = np.full((n + 1, m + 1), np.inf)
    if open_begin:
        costs[0, :] = 0.0
    costs[1, 1] = ground[0, 0]
    with np.errstate(over="ignore"):
        for s in range(1, n + m - 1):
            i = np.arange(max(0, s - m + 1), min(s, n - 1) + 1)
            j = s - i
            up, left, diagonal = costs[i, j + 1], costs[i + 1, j], costs[i, j]
            d = ground[i, j]
            costs[i + 1, j + 1] = np.minimum(np.minimum(up, left) + d, diagonal + weight * d)
    return costs[1:, 1:]


def _warping_path(table: _Table) -> npt.NDArray[np.int64]:
    """Trace the path back from its end."""
    costs, ground = table.costs, table.ground
    i, j = len(costs) - 1, table.end
    path = [(i, j)]
    while i > 0 or (j > 0 and not table.open_begin):
        if i == 0:
            j -= 1
        elif j == 0:
            i -= 1
        else:
            up, left, diagonal = costs[i - 1, j], costs[i, j - 1], costs[i - 1, j - 1]
            d = ground[i, j]
            if diagonal + table.weight * d <= min(up, left) + d:
                i, j = i - 1, j - 1
            elif up <= left:
                i -= 1
            else:
                j -= 1
        path.append((i, j))
    return np.array(path[::-1], dtype=np.int64)
