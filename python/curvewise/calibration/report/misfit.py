"""How far a fitted model is from a test, in units of y: the one definition for all texts.

By "sum_of_squares" the deviation of a measured point is its y minus that of the simulation at the
same x, on the branch that a warping path of the scaled curves assigns to the point
(`branches`). Other measures do not compare at the same x, where a steep branch
turns the least noise in x into a large difference in y. By these the deviation is the distance to
the nearest point of the simulation around the assigned one, x scaled by the ratio of the test's
extents in y and x. The root mean square over the test's points is the distance of model and test.
Deviations in y that differ at random from point to point are scatter of the test; those that
continue along it are systematic: model error, or what thinning has cut off. The scatter is read off
the median difference of neighbours, which a sharp corner that the model rounds does not move. Of a
curve of more than 2,000 points every k-th takes part. Cost: a warping path of at most 2,000 points.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from ...measures import normalize
from ..uncertainty.directions import at_places, feet_of, matched_places
from .shown_search import Loop

__all__ = ["SCATTERED", "SYSTEMATIC", "Misfit", "misfit_of", "scatter_share"]

# Shares of scatter in the mean square. White noise has 0.9, and 0.3 to 0.9 after thinning; measured
# loops that a model does not follow have 0 to 0.06.
SCATTERED, SYSTEMATIC = 0.25, 0.1
_MOST = 2000  # points of a curve
_FEWEST = 20  # points that tell scatter from model error
_OF_NORMAL = 0.6745 * math.sqrt(2.0)  # median difference of two of a normal distribution
_PERFECT = 1e-6  # of the height: a smaller deviation is of neither kind


class Misfit(NamedTuple):
    """How far a simulation is from its test.

    Attributes
    ----------
    rms, largest : float
        Root mean square and largest deviation, in units of y.
    height : float
        The extent of the test in y.
    scatter : float or None
        The share of scatter in the mean square, at most 1; None where there are too few points, or
        next to no deviation.
    """

    rms: float
    largest: float
    height: float
    scatter: float | None


def misfit_of(loop: Loop) -> Misfit:
    """Return how far the simulation of a curve is from its test.

    Parameters
    ----------
    loop : Loop
        With a simulated curve.
    """
    thinned = replace(loop, test=_thinned(loop.test), simulation=_thinned(loop.simulation))
    residual = thinned.residual
    height = float(np.ptp(loop.test[:, loop.y]))
    sizes = np.abs(residual) if loop.at_same_x else _distances(thinned)
    rms, scatter = math.sqrt(float(np.mean(sizes**2))), None
    if len(residual) >= _FEWEST and rms > _PERFECT * height:
        scatter = scatter_share(residual)
    return Misfit(rms, float(sizes.max()), height, scatter)


def _distances(loop: Loop) -> Array:
    """Return how far each point of a test is from the simulation, in units of y."""
    columns = [0, loop.y]
    if loop.test.shape[1] == 1 or not np.ptp(loop.test[:, columns], axis=0).all():
        return np.abs(loop.residual)
    P, Q = normalize(loop.test[:, columns], loop.simulation[:, columns])
    feet = at_places(Q, feet_of(P, Q, matched_places(P, Q)))
    distances: Array = float(np.ptp(loop.test[:, loop.y])) * np.hypot(*(P - feet).T)
    return distances


def scatter_share(residual: Array) -> float:
    """Return which share of the mean square is scatter from point to point.

    Parameters
    ----------
    residual : ndarray, shape (n,)
        All 0 counts as scatter.
    """
    squares = float(np.mean(residual**2))
    scatter = float(np.median(np.abs(np.diff(residual)))) / _OF_NORMAL
    return min(1.0, scatter**2 / squares) if squares else 1.0


def _thinned(curve: Array) -> Array:
    return curve[:: math.ceil(len(curve) / _MOST)]
