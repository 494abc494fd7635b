"""Edit distances, and weighted dynamic time warping, by the table of reference/recurrence.py.

Each distance defines its steps: a match or change, the removal of a point of P, and of one of Q, in
this order. It also defines the border before the first row and column, and the divisor of the last
cell. Its function fills the table; callers use its value, edit_path and edit_table the rest. Time
and memory O(n m).
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, Literal, NamedTuple, ParamSpec, SupportsFloat, TypeAlias

import numpy as np
import numpy.typing as npt

from .._options import Metric, Order, Radius, Window, real_number, window_radius
from ..curves.ground_distance import check_metric, degree, ground_distances, in_range
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import times_power_of_two
from ..measures.results import Alignment
from .checks import check_pair
from .dtw import sakoe_chiba_band
from .recurrence import CellCost, Recurrence, Step, filled, found_path

__all__ = ["edit_path", "edit_table", "edr", "erp", "lcss", "msm", "twe", "wdtw"]

EditDistance: TypeAlias = Literal["erp", "edr", "lcss", "msm", "twe", "wdtw"]
_Options = ParamSpec("_Options")


class _Found(NamedTuple):
    """A filled table, with its value and the path to its last cell."""

    table: Array
    value: float
    path: npt.NDArray[np.int64] | None


def _value(fill: Callable[_Options, _Found]) -> Callable[_Options, float]:
    """Make of a function that fills a table one that returns its value, and says so."""

    @functools.wraps(fill)
    def value(*curves: _Options.args, **options: _Options.kwargs) -> float:
        return fill(*curves, **options).value

    value.__annotations__["return"] = "float"  # those of `fill`, too, which its signature shows
    return value


def _found(P: CurveLike, Q: CurveLike, measure: str, options: dict[str, Any]) -> _Found:
    found: _Found = globals()[measure].__wrapped__(P, Q, **options)
    return found


def edit_path(P: CurveLike, Q: CurveLike, measure: EditDistance, **options: Any) -> Alignment:
    """Time and memory O(n m)."""
    found = _found(P, Q, measure, options)
    if found.path is None:
        raise ValueError(
            f"{measure} has no path for curves of several coordinates, of which each has its own; "
            "take them one by one"
        )
    return Alignment(found.value, found.path)


def edit_table(P: CurveLike, Q: CurveLike, measure: EditDistance, **options: Any) -> Array:
    """Time and memory O(n m)."""
    return _found(P, Q, measure, options).table


class _Pair(NamedTuple):
    """Two curves that have been checked, and what all edit distances ask of them."""

    P: Array
    Q: Array
    metric: Metric
    order: float
    inside: npt.NDArray[np.bool_]
    exponent: int  # P and Q are in the range of squares, and distances in units of 2**exponent

    @classmethod
    def checked(
        cls,
        P: CurveLike,
        Q: CurveLike,
        metric: Metric,
        p: Order,
        radius: Radius,
        window: Any,
        measure: str,
        *,
        constant: float = 0.0,
        coordinate: float = 0.0,
    ) -> _Pair:
        """Check everything; for the last two see :func:`in_range`."""
        P, Q = as_curves(P, Q)
        metric, order = check_metric(metric, p, radius)
        P, Q = check_pair(P, Q, measure, on_sphere=metric == "haversine")
        reach = window_radius(window, len(P), len(Q))
        P, Q, exponent = in_range(P, Q, metric, constant, coordinate)
        return cls(P, Q, metric, order, sakoe_chiba_band(len(P), len(Q), reach), exponent)

    def ground(self) -> Array:
        """Return d(P[i], Q[j])."""
        return self.between(self.P[:, np.newaxis], self.Q)

    def between(self, A: Array, B: Array) -> Array:
        """Return the distances of points that are broadcast."""
        return ground_distances(A, B, self.metric, self.order)

    def in_units(self, distance: float) -> float:
        """Return a distance in the units of the table's distances."""
        return float(times_power_of_two(np.array(distance), -self.exponent))

    def limit(self, epsilon: float) -> float:
        """Return the same of a limit: one that is not 0 stays so, since equal points are below."""
        return max(self.in_units(epsilon), math.ulp(0.0)) if epsilon > 0 else epsilon

    @property
    def coordinate_exponent(self) -> int:
        """P and Q are in units of 2**coordinate_exponent."""
        return self.exponent // max(degree(self.metric), 1)

    def coordinate(self, x: float) -> float:
        """Return a coordinate in the units of P and Q."""
        return float(times_power_of_two(np.array(x), -self.coordinate_exponent))

    def deviation(self, curve: Array) -> float:
        """Return the standard deviation of all coordinates of P or Q, as they were given."""
        return float(times_power_of_two(np.array(np.std(curve)), self.coordinate_exponent))

    def counted(self, recurrence: Recurrence, divisor: float = 1.0) -> _Found:
        """Fill a table of numbers that have no unit."""
        table, taken = filled(recurrence, self.inside)
        path = found_path(recurrence, self.inside, table, taken)
        return _Found(table, float(table[-1, -1]) / divisor, path)

    def found(self, recurrence: Recurrence) -> _Found:
        """Fill a table of distances."""
        table, _, path = self.counted(recurrence)
        table = times_power_of_two(table, self.exponent)
        return _Found(table, float(table[-1, -1]), path)


def _steps(match: CellCost, constant: float, *gaps: CellCost) -> list[Step]:
    """Return the three steps: what a match costs, and what leaving out costs, and its gap."""
    row, column = ([(1.0, gap)] for gap in gaps) if gaps else ([], [])
    return [
        Step(1, 1, 0.0, [(1.0, match)]),
        Step(1, 0, constant, row),
        Step(0, 1, constant, column),
    ]


def _cell(table: Array) -> CellCost:
    return lambda i, j: float(table[i, j])


# Signature: erp without cutoff, missing
@_value
def erp(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    gap: SupportsFloat = 0.0,
    window: Window = None,
) -> _Found:
    """Time and memory O(n m)."""
    number = real_number("gap", gap, -math.inf, "give a number")
    pair = _Pair.checked(P, Q, metric, p, radius, window, "erp", coordinate=number)
    if pair.metric == "haversine" and abs(number) > 90:
        raise ValueError(
            f"gap is {number:.10g}; metric='haversine' takes it for a longitude and a latitude: "
            "give a number from -90 to 90"
        )
    point = np.full((1, pair.P.shape[1]), pair.coordinate(number))
    rows, columns = pair.between(pair.P, point), pair.between(pair.Q, point)
    steps = _steps(
        _cell(pair.ground()), 0.0, lambda i, j: float(rows[i]), lambda i, j: float(columns[j])
    )
    return pair.found(Recurrence(steps, None, sum(columns.tolist()), sum(rows.tolist())))


# Signature: edr without cutoff, missing
@_value
def edr(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    epsilon: SupportsFloat | None = None,
    window: Window = None,
) -> _Found:
    """Time and memory O(n m)."""
    pair = _Pair.checked(P, Q, metric, p, radius, window, "edr")
    if epsilon is None and pair.metric == "haversine":
        raise ValueError(
            "edr with metric='haversine' needs epsilon: degrees have no deviation in metres"
        )
    quarter = max(pair.deviation(curve) for curve in (pair.P, pair.Q)) / 4
    least = quarter if epsilon is None else epsilon
    least = real_number("epsilon", least, 0.0, "give a number >= 0, or None")
    apart = _cell(np.where(pair.ground() < pair.limit(least), 0.0, 1.0))
    return pair.counted(Recurrence(_steps(apart, 1.0), None, 0.0, 0.0), max(pair.inside.shape))


# Signature: lcss without cutoff, missing
@_value
def lcss(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    epsilon: SupportsFloat = 1.0,
    window: Window = None,
) -> _Found:
    """Time and memory O(n m)."""
    pair = _Pair.checked(P, Q, metric, p, radius, window, "lcss")
    most = real_number("epsilon", epsilon, 0.0, "give a number >= 0")
    together = _cell(np.where(pair.ground() <= pair.limit(most), -1.0, 0.0))
    found = pair.counted(Recurrence(_steps(together, 0.0), None, 0.0, 0.0))
    return found._replace(value=max(0.0, 1.0 + found.value / min(pair.inside.shape)))


# Signature: msm without cutoff, missing
@_value
def msm(
    P: CurveLike,
    Q: CurveLike,
    *,
    cost: SupportsFloat = 1.0,
    window: Window = None,
) -> _Found:
    """Time and memory O(n m)."""
    constant = real_number("cost", cost, 0.0, "give a number >= 0")
    pair = _Pair.checked(P, Q, "cityblock", None, None, window, "msm", constant=constant)
    found = [_msm_of_one(pair, c, constant) for c in range(pair.P.shape[1])]
    table = sum((one.table for one in found[1:]), found[0].table)
    return _Found(table, float(table[-1, -1]), found[0].path if len(found) == 1 else None)


def _msm_of_one(pair: _Pair, coordinate: int, cost: float) -> _Found:
    x, y = pair.P[:, coordinate], pair.Q[:, coordinate]

    def outside(new: float, old: float, other: float) -> float:
        if old <= new <= other or old >= new >= other:
            return 0.0
        return min(abs(new - old), abs(new - other))

    steps = _steps(
        lambda i, j: abs(x[i] - y[j]),
        pair.in_units(cost),
        lambda i, j: outside(x[i], x[i - 1], y[j]),
        lambda i, j: outside(y[j], y[j - 1], x[i]),
    )
    return pair.found(Recurrence(steps, starts={(0, 0): abs(float(x[0] - y[0]))}))


# Signature: twe without cutoff, missing
@_value
def twe(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    stiffness: SupportsFloat = 0.001,
    penalty: SupportsFloat = 1.0,
    window: Window = None,
) -> _Found:
    """Time and memory O(n m)."""
    stiff = real_number("stiffness", stiffness, 0.0, "give a number >= 0")
    deletion = stiff + real_number("penalty", penalty, 0.0, "give a number >= 0")
    constant = max(deletion, 2.0 * stiff)
    pair = _Pair.checked(P, Q, metric, p, radius, window, "twe", constant=constant)
    led_P, led_Q = (
        np.concatenate([np.zeros((1, curve.shape[1])), curve]) for curve in (pair.P, pair.Q)
    )
    ground = pair.between(led_P[:, np.newaxis], led_Q)  # one row and one column more
    rows, columns = pair.between(led_P[1:], led_P[:-1]), pair.between(led_Q[1:], led_Q[:-1])
    match, above, left = _steps(
        lambda i, j: float(ground[i + 1, j + 1]),
        pair.in_units(deletion),
        lambda i, j: float(rows[i]),
        lambda i, j: float(columns[j]),
    )
    more: list[tuple[float, CellCost]] = [
        (1.0, lambda i, j: float(ground[i, j])),
        (pair.in_units(2.0 * stiff), lambda i, j: abs(i - j)),
    ]
    match = match._replace(costs=[*match.costs, *more])
    return pair.found(Recurrence([match, above, left]))


# Signature: wdtw without cutoff, missing
@_value
def wdtw(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "sqeuclidean",
    p: Order = None,
    radius: Radius = None,
    steepness: SupportsFloat = 0.05,
    window: Window = None,
) -> _Found:
    """Time and memory O(n m)."""
    pair = _Pair.checked(P, Q, metric, p, radius, window, "wdtw")
    steep = real_number("steepness", steepness, 0.0, "give a number >= 0")
    n, m = pair.inside.shape
    apart = np.abs(np.arange(n)[:, np.newaxis] - np.arange(m))
    ground = pair.ground() * (1.0 / (1.0 + np.exp(-steep * (apart - max(n, m) / 2.0))))
    cost = _cell(ground)
    steps = [Step(i, j, 0.0, [(1.0, cost)]) for i, j in ((1, 1), (1, 0), (0, 1))]
    return pair.found(Recurrence(steps, starts={(0, 0): float(ground[0, 0])}))
