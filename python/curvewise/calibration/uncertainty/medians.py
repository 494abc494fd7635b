"""Effect of white noise on an estimate that is a median: by the area, or by dtw of pairs.

The area with `spacing="matched"` cuts the curves into sections of a tenth of the bounding box and
adds up the absolute areas. Noise of the points changes the area of a section by a sum along it,
which is normally distributed. The estimate is a median of these sums, in the direction of every
parameter. Each sum counts by its own deviation. Two sums with the correlation rho, such as
neighbours that share a point, have signs with the correlation (2 / pi) arcsin(rho). The effective
number of observations is therefore the number of sections, mostly 50 of a loop: noise is averaged
only within a section. For sections of one point each, the variance is a median's pi / 2.

If steps along the curves are longer than the noise, `dtw` adds up the distances of fixed pairs. The
estimate is then a spatial median: the score of a pair is the unit vector of its deviation, and its
expected derivative is that of the distance. Both follow from the deviations in the coordinates.
Cost: O(n k^2) for n points and k parameters, or O(n k) and a decomposition of (sections, k).

P. J. Huber, "The behavior of maximum likelihood estimates under nonstandard conditions", Proc. 5th
Berkeley Symp. Math. Stat. Prob. 1 (1967) 221-233.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from ..._extras import required
from ...curves.arc_length import box_scaled_arc_lengths
from ...curves.inputs import Array
from ...curves.travel import travel
from .sensitivity import moves_of

__all__ = ["NoisyCurve", "area_scatter", "paired_scatter", "sums_of_pieces"]

_PIECES_PER_SIDE = 10  # of the box that a curve travels, as `area` has them
_LEAST = 1e-9  # of the largest deviation of a piece: one that is less encloses nothing
_ANGLES = 400  # of a mean over all directions of a deviation


class NoisyCurve(NamedTuple):
    """One test, and the fitted curve that belongs to it.

    Attributes
    ----------
    test : ndarray, shape (m, 2)
    fitted : ndarray, shape (n, 2)
        The points of the fitted curve; each has independent noise.
    moves : ndarray, shape (n, 2)
        The move of each point for one deviation of its noise.
    slopes : ndarray, shape (n, k)
        The derivatives of the points, in deviations of their noise, by the place in the unit cube.
    cost : float
        The change of the objective if all points move by one deviation.
    """

    test: Array
    fitted: Array
    moves: Array
    slopes: Array
    cost: float


def area_scatter(curves: Iterable[NoisyCurve]) -> Array | None:
    """Return the covariance of an estimate by the area, of white noise of one deviation.

    Returns
    -------
    ndarray, shape (k, k), or None
        Return None if there are fewer sections than parameters: a median is useless then.
    """
    deviations, slopes, angles = zip(*map(_signs, curves), strict=True)
    by_place = np.concatenate(slopes)
    if len(by_place) < by_place.shape[1]:
        return None
    moves, _ = moves_of(np.sqrt(np.concatenate(deviations)), by_place)
    parts = np.split(moves, np.cumsum([len(part) for part in deviations])[:-1])
    total: Array = sum(part.T @ (angle @ part) for part, angle in zip(parts, angles, strict=True))
    return total


def _signs(curve: NoisyCurve) -> tuple[Array, Array, Any]:
    """Return what the pieces deviate by, their slopes in deviations, and arcsines as a matrix."""
    sums = sums_of_pieces(curve.test, curve.fitted, curve.moves)
    ones = np.ones(len(curve.fitted))
    together = float(np.abs(sums @ ones).sum())
    sums = sums * (curve.cost / together if together > 0.0 else 0.0)
    deviations = np.sqrt(sums.multiply(sums) @ ones)
    encloses = deviations > _LEAST * deviations.max()
    deviations = deviations[encloses]
    unit = sums[encloses].multiply(1.0 / deviations[:, np.newaxis]).tocsr()
    angles = (unit @ unit.T).tocsr()
    angles.data = np.arcsin(np.clip(angles.data, -1.0, 1.0))
    return deviations, unit @ curve.slopes, angles


def sums_of_pieces(test: Array, fitted: Array, moves: Array) -> Any:
    """Return the change of each section's area as each point moves.

    Returns
    -------
    scipy.sparse.csr_array, shape (pieces, n)
    """
    sides = sum(travel(column) / (float(np.ptp(column)) or 1.0) for column in test.T)
    pieces = max(1, math.ceil(_PIECES_PER_SIDE * sides))
    lengths = box_scaled_arc_lengths(fitted, test)
    at = lengths / (lengths[-1] or 1.0) * pieces
    # Between two of these a piece and a segment go on together.
    cuts = np.unique(np.concatenate([at, np.arange(at[-1])]))
    middle = (cuts[:-1] + cuts[1:]) / 2.0
    segment = np.searchsorted(at, middle, side="right") - 1
    begin, end = ((p - at[segment]) / np.diff(at)[segment] for p in (cuts[:-1], cuts[1:]))
    points = np.concatenate([segment, segment + 1])
    of_end = (end**2 - begin**2) / 2.0
    shares = np.concatenate([end - begin - of_end, of_end])
    normals = np.column_stack((-np.diff(fitted[:, 1]), np.diff(fitted[:, 0])))[np.tile(segment, 2)]
    entries = shares * (normals * moves[points]).sum(axis=1)
    places = np.tile(middle.astype(np.intp), 2), points
    return required("scipy.sparse").csr_array((entries, places), shape=(pieces, len(fitted)))


def paired_scatter(tests: Iterable[tuple[Array, Array, float]]) -> Array:
    """Return the covariance of an estimate.

    Parameters
    ----------
    tests : iterable of (ndarray, ndarray, float)
        For each test the derivatives of its points, shape (n, 2, k), the deviations of the noise in
        both coordinates, and the factor of its distances in the objective.
    """
    rows, weights, variances = [], [], []
    for slopes, deviations, factor in tests:
        bends = factor * _bends(deviations)
        scores = factor**2 * deviations / deviations.sum()
        rows.append(slopes.reshape(-1, slopes.shape[2]))
        weights.append(np.tile(np.sqrt(bends), len(slopes)))
        variances.append(np.tile(scores / bends**2, len(slopes)))
    moves, _ = moves_of(np.concatenate(weights), np.concatenate(rows))
    covariance: Array = (moves.T * np.concatenate(variances)) @ moves
    return covariance


def _bends(deviations: Array) -> Array:
    """Return the expected second derivatives of the length of normal deviations."""
    angles = (np.arange(_ANGLES) + 0.5) * (2.0 * math.pi / _ANGLES)
    squares = np.column_stack((np.cos(angles), np.sin(angles))) ** 2
    density = np.sqrt(0.5 * math.pi / (squares @ deviations**-2.0)) / np.prod(deviations)
    bends: Array = (density[:, np.newaxis] * squares[:, ::-1]).mean(axis=0)
    return bends
