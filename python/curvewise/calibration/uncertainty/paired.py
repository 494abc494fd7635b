"""Effect of white noise on an estimate by dtw, of points that belong together one by one.

If steps along the curves are longer than the noise, `dtw` adds up the distances of fixed pairs. The
estimate is then a spatial median: the score of a pair is the unit vector of its deviation, and its
expected derivative is that of the distance. Both follow from the deviations in the coordinates.
Cost: O(n k^2) for n points and k parameters.

P. J. Huber, "The behavior of maximum likelihood estimates under nonstandard conditions", Proc. 5th
Berkeley Symp. Math. Stat. Prob. 1 (1967) 221-233.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from ...curves.inputs import Array
from .sensitivity import moves_of

__all__ = ["paired_scatter"]

_ANGLES = 400


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
