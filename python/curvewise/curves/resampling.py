"""Other points on the same curve, and a part of it.

Interpolation between the points is linear, or along great circles with ``metric="haversine"``.

Places along a curve are arc lengths, or the values of a column or of a time. O(n + count) time and
memory; numpy alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from .._options import check_choice, real_number
from .arc_length import points_at
from .checks import Turns, branch_slices, check_column, checked_curve
from .great_circles import checked_track, points_on_arcs, warn_of_longitudes
from .ground_distance import check_metric, ground_distances
from .inputs import Array, CurveLike
from .isotonic import ascending
from .named_curve import renamed

__all__ = ["Along", "StepMetric", "resample", "trim"]

# A column that reverses by at most this fraction of its range along a branch is noisy.
# turning_points ignores reversals of this size by default.
_NOISE = 0.1

Along = Literal["arc_length"] | int | npt.NDArray[np.float64] | Sequence[float]
"""What measures places along a curve: "arc_length", a column's index, or n values (a time)."""

StepMetric = Literal["euclidean", "haversine"]
"""How far neighbouring points are from each other, in the plane (or space), or on the sphere."""


def resample(
    curve: CurveLike,
    count: int | Sequence[int] | None = None,
    *,
    spacing: float | None = None,
    by: Along = "arc_length",
    metric: StepMetric | None = None,
    turns: Turns = (),
) -> Array:
    """Resample a curve at evenly spaced points, branch by branch.

    If two curves are resampled with `turns` and the same `count`, their branches have the same
    indices. `sum_of_squares`, `mse`, `mae` and the default of `area` require this.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve.
    count : int or sequence of int, optional
        Number of points in each branch, both of its ends included; at least 2. A sequence has a
        number for every branch. Without `turns` the curve is one branch. Give either `count` or
        `spacing`.
    spacing : float, optional
        The largest step, above 0, in the unit of the quantity `by`. Each branch has equal steps.
        With "arc_length", the unit is that of the coordinates, which must then be the same for all;
        metres with ``metric="haversine"``.
    by : "arc_length", int or array_like of shape (n,), default "arc_length"
        The quantity along which points are evenly spaced. "arc_length": see `metric`. An integer:
        the values of this column, from 0 (negative: from the end). An array: values of the points,
        such as their times. A column or a time must not reverse within a branch.
    metric : {"euclidean", "haversine"}, optional
        The definition of arc length. By default each coordinate is divided by its range, which
        suits curves whose coordinates have different units. "euclidean": the coordinates are
        unchanged; this is also the default with `spacing`. "haversine": the columns are longitude
        and latitude in degrees, and arc lengths are metres on the sphere. Points lie on great
        circles. Longitudes of the result are from -180 to 180.
    turns : sequence of int, optional
        Indices of the turning points, at which branches meet, as `turning_points` returns them.
        Turning points and ends stay bitwise identical; without `turns`, turning points are cut off.

    Returns
    -------
    ndarray, shape (k, d)
        The points, each turning point once: k is the sum of the branches' counts minus the number
        of turns. Shape (k, 1) for a curve of shape (n,).

    Raises
    ------
    TypeError, ValueError
        If `curve` does not have at least two finite points. If `count` is below 2, or not one per
        branch. If `turns` do not ascend. If the column does not exist. If the values of `by`
        reverse by more than a tenth of a branch, or are constant within it. If not exactly one of
        `count` and `spacing` is given. With ``metric="haversine"``: if `by` is a column, its values
        reverse at all, points are not on the sphere, or neighbours are opposite on it.

    Warns
    -----
    UserWarning
        If the coordinates look like longitude and latitude, the longitude jumps by more than 180
        between neighbours, and `metric` is not given.

    Notes
    -----
    O(n + count) time and memory. Noise adds length: smooth a noisy test before resampling by arc
    length. If a column or time is constant for several points, the last of them counts.

    Examples
    --------
    >>> import curvewise
    >>> from curvewise.curves import resample, turning_points
    >>> loops = curvewise.datasets.hysteresis_pair()
    >>> P, Q = (resample(loop, [40, 80, 80], turns=turning_points(loop)) for loop in loops)
    >>> P.shape, Q.shape
    ((198, 2), (198, 2))
    >>> resample([(0, 0), (1000, 0), (1000, 100)], spacing=500)  # metres
    array([[   0.        ,    0.        ],
           [ 366.66666667,    0.        ],
           [ 733.33333333,    0.        ],
           [1000.        ,  100.        ]])
    >>> resample([(179, 0), (-179, 0)], 3, metric="haversine")[1]
    array([180.,   0.])
    """
    points = _checked(curve, by, metric)
    if spacing is not None:
        metric = metric or "euclidean"
    branches = branch_slices(turns, len(points))
    placed = [
        _places(points, by, metric, branch, f"branch {k}") for k, branch in enumerate(branches)
    ]
    counts = _counts(count, spacing, [float(places[-1] - places[0]) for places, _ in placed])
    pieces = []
    for k, (branch, (places, there)) in enumerate(zip(branches, placed, strict=True)):
        at = np.linspace(places[0], places[-1], counts[k])
        piece = _points_at(there, at, places, metric)
        piece[0], piece[-1] = points[branch][[0, -1]]
        pieces.append(piece if k == 0 else piece[1:])
    return renamed(curve, np.concatenate(pieces))


def trim(
    curve: CurveLike,
    start: float | None = None,
    stop: float | None = None,
    *,
    by: int | npt.NDArray[np.float64] | Sequence[float] = 0,
    metric: StepMetric | None = None,
) -> Array:
    """Cut off what comes before and after two values of a column, or of a time.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve.
    start, stop : float, optional
        The result begins where the column first has the value `start`, and ends where from there
        on it first has the value `stop`; `stop` may be below `start`. By default the curve's own
        ends.
    by : int or array_like of shape (n,), default 0
        The column, by its index from 0, or values of the points, such as their times. They may
        reverse: for a loop, ``trim(loop, 0.0, 0.02)`` is the first loading.
    metric : {"euclidean", "haversine"}, optional
        Between which points the two ends are interpolated: on a straight line, the default, or with
        "haversine" on a great circle, of longitudes and latitudes in degrees. `by` is then a value
        for each point, and longitudes of the result are from -180 to 180.

    Returns
    -------
    ndarray, shape (k, d)
        The points between, and the two ends, interpolated where they lie between points. Shape
        (k, 1) for a curve of shape (n,).

    Raises
    ------
    TypeError, ValueError
        If `curve` does not have at least two finite points, the column does not exist, or a value
        is never reached. With ``metric="haversine"`` as for :func:`resample`.

    Warns
    -----
    UserWarning
        As for :func:`resample`.

    Notes
    -----
    O(n) time and memory.

    Examples
    --------
    >>> from curvewise.curves import trim
    >>> trim([[0, 0], [1, 10], [2, 20], [1, 5]], 0.5, 2)
    array([[ 0.5,  5. ],
           [ 1. , 10. ],
           [ 2. , 20. ]])
    """
    points = _checked(curve, by, metric)
    x = _values(points, by)
    first = 0.0 if start is None else _first_place(x, start, 0.0, "start")
    last = len(x) - 1.0 if stop is None else _first_place(x, stop, first, "stop")
    between = np.arange(int(np.floor(first)) + 1, int(np.ceil(last)))
    places = np.concatenate(([first], between, [last])) if last > first else np.array([first])
    return renamed(curve, _points_at(points, places, np.arange(float(len(points))), metric))


def _checked(curve: CurveLike, by: Along, metric: StepMetric | None) -> Array:
    """Return the points of a curve, of a track on the sphere with its longitudes in range."""
    points = checked_curve(curve, 2)
    if metric is None:
        warn_of_longitudes(
            points, "pass metric='haversine' to go round the sphere, or 'euclidean' if it does jump"
        )
        return points
    check_choice("metric", metric, get_args(StepMetric))
    if metric == "euclidean":
        return points
    if isinstance(by, int | np.integer):
        raise ValueError(
            "metric='haversine' interpolates between points on great circles, and not in a column; "
            f"by is {by}: give a value for each point, such as its time"
        )
    return checked_track(points)


def _points_at(points: Array, at: Array, places: Array, metric: StepMetric | None) -> Array:
    """Return the points at places along a curve, by the places of its points."""
    if metric == "haversine":
        return points_on_arcs(points, at, places)
    return points_at(points, at, places)


def _counts(
    count: int | Sequence[int] | None, spacing: float | None, lengths: Sequence[float]
) -> list[int]:
    """Return how many points each branch has, whose lengths are given."""
    if (count is None) == (spacing is None):
        raise ValueError(
            f"count is {count!r}, spacing is {spacing!r}; give either count or spacing"
        )
    if spacing is not None:
        step = real_number("spacing", spacing, math.ulp(0.0), "give a number > 0")
        # A quotient that is whole but for rounding needs no further step.
        return [max(1, math.ceil(length / step * (1 - 1e-12))) + 1 for length in lengths]
    branches = len(lengths)
    counts = np.asarray(count)
    if counts.dtype.kind not in "iu":
        raise TypeError(f"count is {count!r}; give a whole number, or one for every branch")
    if counts.ndim > 0 and counts.shape != (branches,):
        raise ValueError(f"count has shape {counts.shape}; there are {branches} branches")
    if (counts < 2).any():
        raise ValueError(f"count is {count!r}; a branch needs at least 2 points")
    return [int(number) for number in np.broadcast_to(counts, branches)]


def _values(points: Array, by: int | npt.NDArray[np.float64] | Sequence[float]) -> Array:
    """Return the values of a column, or those given for the points."""
    if isinstance(by, int | np.integer):
        return points[:, check_column(points, int(by))]
    values = np.asarray(by, dtype=np.float64)
    if values.shape != (len(points),):
        raise ValueError(
            f"by has shape {values.shape}; give one value for each of the {len(points)} points"
        )
    if not np.isfinite(values).all():
        raise ValueError(f"by[{int(np.argmin(np.isfinite(values)))}] is not finite")
    return values


def _places(
    points: Array, by: Along, metric: StepMetric | None, branch: slice, name: str
) -> tuple[Array, Array]:
    """Return ascending values along a branch, and the points that have them."""
    there = points[branch]
    if isinstance(by, str):
        if by != "arc_length":
            raise ValueError(f"unknown by {by!r}; choose 'arc_length', a column or values")
        places = np.concatenate(([0.0], np.cumsum(_lengths(there, points, metric))))
    else:
        places = _values(points, by)[branch]
        if places[-1] < places[0]:
            places = -places
        back = np.maximum.accumulate(places) - places
        # Points of a noisy reversing column are averaged in coordinates, which is invalid on the
        # sphere.
        allowed = 0.0 if metric == "haversine" else _NOISE
        if back.max() > allowed * (places[-1] - places[0]):
            raise ValueError(
                f"the values of by reverse in {name}, by {back.max():.3g} before point "
                f"{branch.start + int(back.argmax())}; give all turns, or use by='arc_length'"
            )
        if back.any():
            places, there = ascending(places, there)
    if not places[-1] > places[0]:
        raise ValueError(f"what to space by is constant in {name}")
    return places, there


def _lengths(there: Array, points: Array, metric: StepMetric | None) -> Array:
    """Return how far apart neighbours in a branch are."""
    if metric == "haversine":
        return ground_distances(there[:-1], there[1:], *check_metric(metric, None))
    if metric == "euclidean":
        return np.asarray(np.hypot.reduce(np.diff(there, axis=0), axis=1))
    extent = np.ptp(points, axis=0)
    steps = np.diff(there / np.where(extent > 0.0, extent, 1.0), axis=0)
    return np.asarray(np.sqrt((steps**2).sum(axis=1)))


def _first_place(x: Array, value: float, begin: float, name: str) -> float:
    """Return where x first has a value, as an index and a fraction, from `begin` on."""
    real_number(name, value, -np.inf, "give a number")
    k = int(begin)
    tail = x[k:].copy()
    tail[0] += (begin - k) * (x[min(k + 1, len(x) - 1)] - x[k])
    below, above = tail <= value, tail >= value
    hits = np.flatnonzero(below & above)
    crossed = np.flatnonzero((below[:-1] & above[1:]) | (above[:-1] & below[1:]))
    if not hits.size and not crossed.size:
        raise ValueError(
            f"{name} is {value}, which is never reached; from there on the values are "
            f"{tail.min():.6g} to {tail.max():.6g}"
        )
    if hits.size and (not crossed.size or hits[0] <= crossed[0]):
        return max(begin, float(k + hits[0]))
    i = int(crossed[0])
    fraction = (value - tail[i]) / (tail[i + 1] - tail[i])
    left = begin if i == 0 else float(k + i)
    return left + float(fraction) * (k + i + 1 - left)
