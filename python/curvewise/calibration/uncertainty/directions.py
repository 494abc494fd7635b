"""The direction in which each measured point deviates from the fitted curve.

A test may have noise in x, in y, or in both, and a model may answer with either. So a deviation is
taken normal to the fitted curve, in coordinates scaled by the test's box; a deviation along the
curve changes no measure to the first order. A curve of other than two coordinates, one without
extent, a single number and a sum of squares have their deviations in the coordinate y. Sizes of
deviations are in units of y. Cost: O(n) a test, and a warping path for the feet.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from ...curves.inputs import Array
from ...measures import dtw_path, normalize
from ..objective.objective import Objective

__all__ = [
    "Directions",
    "at_places",
    "directions_along",
    "directions_of",
    "feet_of",
    "fitted_tests",
    "matched_places",
]

Places: TypeAlias = npt.NDArray[np.intp]

_PAIRED = 0.8  # the least part of the points that a path matches with those of the same number
_REACH = 0.05  # how far from the matched point, as a fraction of the curve's points
_STILL = 1e-9  # of the longest step: a shorter step of a curve does not define a direction


class Directions(NamedTuple):
    """The directions of the deviations of a curve's points.

    Attributes
    ----------
    unit : ndarray, shape (n, d)
        Unit vectors, in the units of `scale`; their y is not negative.
    scale : ndarray, shape (d,)
        The size in each coordinate that counts as much as 1 in y.
    """

    unit: Array
    scale: Array

    def across(self, moves: Array) -> Array:
        """Return how far moves, of shape (n, d), go along the directions."""
        sizes: Array = (moves / self.scale * self.unit).sum(axis=1)
        return sizes


def directions_of(objective: Objective, index: int, curve: Array, places: Array) -> Directions:
    """Return the directions at places along a curve that belongs to a test.

    Parameters
    ----------
    objective : Objective
    index : int
        The number of the test.
    curve : ndarray, shape (m, d)
    places : ndarray, shape (n,)
        In points of the curve, from 0 to m - 1.
    """
    scale = _scale(objective, index, curve)
    if scale is None:
        return _along_y(objective, index, len(places))
    steps = np.diff(curve / scale, axis=0)
    lengths = np.hypot(*steps.T)
    moving = lengths > _STILL * lengths.max()
    # A step without length goes the way of the last one before it, or else of the first.
    last = np.maximum.accumulate(np.where(moving, np.arange(len(steps)), moving.argmax()))
    step = last[np.minimum(places.astype(np.intp), len(steps) - 1)]
    normals = np.column_stack((-steps[step, 1], steps[step, 0])) / lengths[step, np.newaxis]
    normals[normals[:, 1] < 0.0] *= -1.0
    return Directions(normals, scale)


def directions_along(
    objective: Objective, curves: Sequence[Array], counts: Sequence[int]
) -> list[Directions]:
    """Return for each test the directions at evenly spaced places along its curve."""
    return [
        directions_of(objective, i, curve, np.linspace(0.0, len(curve) - 1.0, count))
        for i, (curve, count) in enumerate(zip(curves, counts, strict=True))
    ]


def fitted_tests(
    objective: Objective, curves: Sequence[Array]
) -> Iterator[tuple[Array, Directions, Array, Array | None]]:
    """Yield for each test its fitted points, their directions, the residuals in these, and pairs.

    The residuals are from the points of a curve that are nearest to the measured ones. The fitted
    points are those that a warping path matches with these: they do not scatter along the curve.
    Pairs are the deviations in each coordinate, of shape (n, d), if the path matches points of the
    same number: the steps of the curve are then longer than the noise. Otherwise pairs are None.
    """
    known = objective.fitted(curves)
    for index, (test, curve) in enumerate(zip(objective.experiments, curves, strict=True)):
        scale = _scale(objective, index, curve)
        if scale is None:
            given = known[index]
            points = _fitted_along_y(test, curve) if given is None else given
            directions = _along_y(objective, index, len(test))
            yield points, directions, directions.across(test - points), None
        else:
            places = matched_places(test, curve)
            feet = feet_of(test / scale, curve / scale, places)
            directions = directions_of(objective, index, curve, feet)
            residuals = directions.across(test - at_places(curve, feet))
            yield at_places(curve, places), directions, residuals, _pairs(test, curve, places)


def _fitted_along_y(test: Array, curve: Array) -> Array:
    """Return a test with the last coordinate of the curve where a warping path has its points."""
    if len(test) == 1:
        return curve[:1].copy()
    fitted = test.copy()
    fitted[:, -1] = at_places(curve, matched_places(test, curve))[:, -1]
    return fitted


def _pairs(test: Array, curve: Array, places: Array) -> Array | None:
    same = places == np.arange(len(test))
    if len(test) != len(curve) or same.mean() < _PAIRED:
        return None
    pairs: Array = (test - curve)[same]
    return pairs if pairs.any(axis=0).all() else None  # a model that is driven by the test's x


def at_places(curve: Array, places: Array) -> Array:
    """Return a curve's points at places along it, shape (n, d)."""
    known = np.arange(len(curve))
    return np.column_stack([np.interp(places, known, column) for column in curve.T])


def _scale(objective: Objective, index: int, curve: Array) -> Array | None:
    """Return the scale of a test's normals; None where its deviations are in y."""
    test, extent = objective.experiments[index], objective.extents[index]
    if test.shape[1] != 2 or objective.measures[index] == "sum_of_squares":
        return None
    has_extent = np.ptp(test, axis=0).min() > 0.0 and np.ptp(curve, axis=0).max() > 0.0
    return extent / extent[1] if has_extent else None


def _along_y(objective: Objective, index: int, count: int) -> Directions:
    unit = np.zeros((count, objective.experiments[index].shape[1]))
    unit[:, objective.y_columns[index]] = 1.0
    return Directions(unit, np.ones(unit.shape[1]))


def feet_of(P: Array, Q: Array, places: Array) -> Array:
    """Return the places of the points of Q nearest to those of P, downhill from places along Q."""
    step = np.minimum(places.astype(np.intp), len(Q) - 2)
    squares, fractions = _projected(P, Q, step)
    for _ in range(_reach_of(Q)):
        ahead = np.where(fractions == 1.0, 1, np.where(fractions == 0.0, -1, 0))
        there = np.clip(step + ahead, 0, len(Q) - 2)
        others, at = _projected(P, Q, there)
        nearer = (ahead != 0) & (others < squares)
        if not nearer.any():
            break
        step, squares = np.where(nearer, there, step), np.where(nearer, others, squares)
        fractions = np.where(nearer, at, fractions)
    return step + fractions


def _projected(P: Array, Q: Array, step: Places) -> tuple[Array, Array]:
    """Return the squared distances to steps of Q, and where along these the nearest points are."""
    along, off = Q[step + 1] - Q[step], P - Q[step]
    length = (along**2).sum(axis=1)
    fractions = np.clip((along * off).sum(axis=1) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)
    squares: Array = ((off - fractions[:, np.newaxis] * along) ** 2).sum(axis=1)
    return squares, fractions


def matched_places(P: Array, Q: Array) -> Array:
    """Return where along Q, in its points, a warping path has each point of P."""
    i, j = dtw_path(*normalize(P, Q)).path.T
    places: Array = np.bincount(i, weights=j) / np.bincount(i)
    return places


def _reach_of(Q: Array) -> int:
    """Return how many points of Q from the matched one the fitted one may be."""
    return max(2, round(_REACH * len(Q)))
