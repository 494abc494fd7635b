"""How far an estimate by the area moves with white noise of the points.

Between two points a straight piece of a test is off by what lies between their two errors, and the
area adds up the absolute value of that. So neighbours count together: the area is a median's sum
over all places of the curve, of noise that is interpolated. Of a unit of white noise the slopes of
the area at points 0, 1 and 2 apart have the covariances

    c_k = integral of h_0(s) h_k(t) (2 / pi) arcsin(rho(s, t)) over s and t,

for the hats h_i of interpolation and the correlation rho of interpolated noise, and its mean second
derivatives are, for the variance v of interpolated noise,

    d_k = integral of h_0(s) h_k(s) sqrt(2 / (pi v(s))) over s.

The sandwich of both is the covariance. It is 1.22 times that of least squares where slopes change
slowly along the curve, 1.45 where those of neighbours are unrelated, and 1.58 where they alternate;
a median's, which has no pieces between its points, is pi / 2. Cost: O(n k^2).

P. J. Huber, "The behavior of maximum likelihood estimates under nonstandard conditions", Proc. 5th
Berkeley Symp. Math. Stat. Prob. 1 (1967) 221-233.
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array
from .repeats import Branches

__all__ = ["SECOND_DERIVATIVES", "SLOPE_COVARIANCES", "area_scatter"]

SLOPE_COVARIANCES = (0.6098, 0.2647, 0.0319)
"""Of points 0, 1 and 2 apart: c_k."""
SECOND_DERIVATIVES = (0.6476, 0.1735)
"""By points 0 and 1 apart: d_k."""


def area_scatter(moves: Array, weighted: Array, inverse: Array, branches: Branches) -> Array:
    """Return the covariance of an estimate by the area, of white noise of the variance 1.

    Parameters
    ----------
    moves : ndarray, shape (points, k)
        By how much the estimate of weighted least squares moves with each point.
    weighted : ndarray, shape (points, k)
        Slopes of the curves, times the root of the weight.
    inverse : ndarray, shape (k, k)
        Of the normal matrix of weighted slopes.
    branches : Branches
        Within which points are neighbours.
    """
    own, beside = SECOND_DERIVATIVES
    curved = own * np.eye(len(inverse)) + beside * inverse @ _apart(weighted, 1, branches)
    scatter = SLOPE_COVARIANCES[0] * moves.T @ moves
    for points, covariance in enumerate(SLOPE_COVARIANCES[1:], start=1):
        scatter += covariance * _apart(moves, points, branches)
    half = np.linalg.solve(curved, scatter)
    covariance_of_estimate: Array = np.linalg.solve(curved, half.T)
    return covariance_of_estimate


def _apart(columns: Array, points: int, branches: Branches) -> Array:
    """Return the sum of products of rows that are so many points apart, either way round."""
    products = np.zeros((columns.shape[1], columns.shape[1]))
    for branch in branches.slices:
        part = columns[branch]
        products += part[:-points].T @ part[points:]
    return products + products.T
