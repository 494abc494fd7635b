"""Values of measures in units of y: distances between the compared points.

A value of 0.072 says little; "29 MPa in the mean, 3 % of the height, 88 MPa at most" says what a
plot shows. Every measure but curve_length compares points of P with points of Q.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from .._options import Crossing
from ..curves.arc_length import points_at
from ..curves.inputs import Array, in_columns
from ..curves.scaling import box
from ..curves.travel import travel
from ..measures import area, area_quads, frechet_continuous_path, normalize, pcm_match
from ..measures.registry import MEASURES, Condition
from ..showing.result import Table, Tabular

__all__ = ["Deviation", "Deviations", "cells", "deviation", "largest_places"]

# Mean and largest distance, and the points of P and Q that are farthest apart, if there are any.
_Distances: TypeAlias = tuple[float, float, tuple[Array, Array] | None]


class Deviation(NamedTuple):
    """Distances between the points that a measure compares, in units of y.

    If the measure is computed on scaled curves, a distance is a fraction of P's bounding box. It is
    converted with the box's range of y.

    Attributes
    ----------
    mean : float
        The mean distance; never above the largest. "area": the area divided by the distance that P
        travels along x, a mean difference in y. If that exceeds the largest, because the curves
        travel elsewhere, it is the mean distance of matched points, weighted by the lengths of both
        curves. "dtw", "frechet": the mean distance along the path. "frechet_continuous": the mean
        pair distance, weighted by the lengths of both curves. "pcm": the area divided by the length
        of the mapped curve.
    largest : float
        The largest distance. "area": of facing vertices. "dtw", "frechet": on the path. For both
        Fréchet distances it is the value. "pcm": of the mapped vertices.
    height : float
        The range of P in y, its last coordinate.
    """

    mean: float
    largest: float
    height: float

    def __str__(self) -> str:
        return f"mean {self.mean_text}, largest {self.largest_text}"

    @property
    def mean_text(self) -> str:
        """The mean as a text, with its part of the height."""
        return self._text(self.mean)

    @property
    def largest_text(self) -> str:
        """The largest as a text, with its part of the height."""
        return self._text(self.largest)

    def _text(self, value: float) -> str:
        if not (0 < self.height < math.inf and value < math.inf):
            return f"{value:.4g}"
        share = 100 * (value / self.height)
        return f"{value:.4g} ({share:.2g} %)" if share < 99.5 else f"{value:.4g} ({share:.0f} %)"


class Deviations(Tabular, dict[str, Deviation]):
    """Deviations by measure; prints as a table."""

    def __str__(self) -> str:
        width = max(map(len, self), default=0)
        return "\n".join(f"{name:<{width}}  {deviation}" for name, deviation in self.items())

    def parts(self) -> Sequence[Table | str]:
        """Return mean and largest deviation by measure."""
        header = ["measure", "mean deviation, in units of y", "largest"]
        return [Table([[name, *cells(deviation)] for name, deviation in self.items()], header)]


def cells(deviation: Deviation | None) -> list[str]:
    """Return mean and largest as the cells of a table; "" without a deviation."""
    return ["", ""] if deviation is None else [deviation.mean_text, deviation.largest_text]


def deviation(
    measure: str, condition: Condition, P: Array, Q: Array, *, part: str = "experiment"
) -> Deviation | None:
    """Return the deviation that belongs to a measure, or None for one that compares no points.

    Parameters
    ----------
    measure : str
        One of the registry.
    condition : Condition
        The conditions of its computation.
    P, Q : ndarray
        The curves, not scaled.
    part : {"experiment", "simulation"}
        "simulation": the path of dtw is that of Q to a part of P, as in an objective.

    Returns
    -------
    Deviation or None

    Raises
    ------
    ValueError
        As for the measure.

    Notes
    -----
    Time and memory of a path for dtw and the Fréchet distances, else of the measure.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.measures.registry import PRESETS
    >>> from curvewise.comparing.deviations import deviation
    >>> P = np.array([(0.0, 0.0), (1.0, 200.0), (2.0, 400.0)])
    >>> print(deviation("area", PRESETS["scaled"]["area"], P, P + (0.0, 20.0)))
    mean 20 (5 %), largest 20 (5 %)
    """
    if (distances := _DISTANCES.get(measure)) is None:
        return None
    is_scaled = _is_scaled(measure, condition)
    compared = normalize(P, Q) if is_scaled else [P, Q]
    if part == "simulation":
        compared.reverse()
    with np.errstate(over="ignore", invalid="ignore"):  # beyond the range of a double: inf
        height = float(np.ptp(P[:, -1] if P.ndim == 2 else P))
        mean, largest, _ = distances(measure, condition.options, *compared)
        unit = height if is_scaled and height > 0 else 1.0
        if not mean <= largest:  # rounded, of equal distances; or lengths beyond a double
            mean = largest
        return Deviation(mean * unit, largest * unit, height)


def largest_places(
    measure: str, condition: Condition, P: Array, Q: Array
) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
    """Return the points of P and of Q with the largest deviation.

    Return None if a measure does not pair points.

    Parameters
    ----------
    measure, condition, P, Q
        As for :func:`deviation`. Cost and errors are those of :func:`deviation`.
    """
    if (distances := _DISTANCES.get(measure)) is None:
        return None
    is_scaled = _is_scaled(measure, condition)
    *_, ends = distances(measure, condition.options, *(normalize(P, Q) if is_scaled else (P, Q)))
    if ends is None:
        return None
    low, extent = box(in_columns(P)) if is_scaled else (np.zeros(1), np.ones(1))
    places = (low + np.atleast_1d(end) * extent for end in ends)
    # A coordinate that is a rounding error of the scaling is 0.
    least = 1e-14 * extent if is_scaled else 0.0
    in_p, in_q = (tuple(np.where(abs(one) < least, 0.0, one).tolist()) for one in places)
    return in_p, in_q


def _is_scaled(measure: str, condition: Condition) -> bool:
    return condition.scaled or MEASURES[measure].scales_itself


def _along_path(measure: str, options: Mapping[str, Any], P: Array, Q: Array) -> _Distances:
    warping = MEASURES[measure].warping
    assert warping is not None
    of_path = {key: value for key, value in options.items() if key not in ("normalize", "cutoff")}
    i, j = warping.path(P, Q, **of_path).path.T
    if len(i) == 0:  # the steps admit no path
        return math.inf, math.inf, None
    between = np.abs(P[i] - Q[j]).reshape(len(i), -1)
    distances = np.hypot.reduce(between, axis=1)  # whose squares do not overflow
    worst = int(distances.argmax())
    return float(distances.mean()), float(distances[worst]), (P[i[worst]], Q[j[worst]])


def _along_matching(measure: str, options: Mapping[str, Any], P: Array, Q: Array) -> _Distances:
    match = frechet_continuous_path(P, Q, closed=bool(options.get("closed")))
    assert match.curves is not None  # closed curves are those of the walks around them
    sides = zip(match.curves, match.parameters.T, strict=True)
    ends = [points_at(curve, at) for curve, at in sides]
    leashes = np.hypot.reduce(np.abs(ends[0] - ends[1]), axis=1)
    worst = int(leashes.argmax())
    mean = _mean_leash(leashes, *(np.diff(end, axis=0) for end in ends))
    return mean, match.distance, (ends[0][worst], ends[1][worst])


def _mean_leash(leashes: Array, *edges: Array) -> float:
    """Return the mean of n + 1 distances by how far both ends walk on n edges between them."""
    walked = np.sum([np.hypot.reduce(np.abs(one), axis=1) for one in edges], axis=0)
    if not np.any(walked):
        return float(leashes.max())
    return float(np.average((leashes[:-1] + leashes[1:]) / 2, weights=walked))


def _between_facing(measure: str, options: Mapping[str, Any], P: Array, Q: Array) -> _Distances:
    plain = {key: value for key, value in options.items() if key != "squared"}
    # A quadrilateral that was rearranged has lost the order in which vertices face each other.
    in_order: dict[str, Crossing] = {"crossing": "split"}
    quads, _ = area_quads(P, Q, **{**plain, **in_order})
    A, B = (np.concatenate([quads[:, k], quads[-1:, m]]) for k, m in ((0, 1), (3, 2)))
    leashes = np.hypot(*(A - B).T)
    worst = int(leashes.argmax())
    is_of_x = options.get("spacing") == "function"  # over the x that both curves span
    x = A[:, 0] if is_of_x else np.append(P[:, 0], P[0, 0] if options.get("closed") else [])
    length, largest = travel(x), float(leashes[worst])
    mean = area(P, Q, **plain) / length if length > 0 else math.inf
    if not mean <= largest:
        mean = _mean_leash(leashes, np.diff(A, axis=0), np.diff(B, axis=0))
    return mean, largest, (A[worst], B[worst])


def _of_mapped(measure: str, options: Mapping[str, Any], P: Array, Q: Array) -> _Distances:
    match = pcm_match(P, Q, **options)
    mapped = P if match.mapped == "P" else Q
    length = float(np.hypot(*np.diff(mapped, axis=0).T).sum())
    distances = np.hypot(*(mapped - match.points).T)
    worst = int(distances.argmax())
    ends = mapped[worst], match.points[worst]
    mean = match.value / length if length > 0 else math.inf
    return mean, float(distances[worst]), ends if match.mapped == "P" else ends[::-1]


_DISTANCES: Mapping[str, Callable[..., _Distances]] = {
    "area": _between_facing,
    "pcm": _of_mapped,
    "frechet": _along_path,
    "frechet_continuous": _along_matching,
    "dtw": _along_path,
}
