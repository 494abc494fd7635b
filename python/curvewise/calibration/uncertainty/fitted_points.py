"""The simulated point that belongs to each measured one, by y at the measured x.

A dynamic time warping path assigns each measured point to a section of the simulation. There the
simulation is interpolated at the measured x, on the corresponding branch. If the section does not
reach that x (a simulation that reverses earlier), the y of the matched point is used. O(n + m)
memory; the time of a path.
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array
from ...measures import dtw_path, normalize

__all__ = ["fitted_points", "matched_places", "reach_of"]

_REACH = 0.05  # how far from the matched point, as a fraction of the simulation's points


def fitted_points(P: Array, Q: Array) -> Array:
    """Return P with the last coordinate of Q at each of its points.

    Parameters
    ----------
    P, Q : ndarray, shape (n, d) and (m, d)
        The measured and the simulated curve.
    """
    if len(P) == 1:
        return Q[:1].copy()
    places = matched_places(P, Q)
    fitted = P.copy()
    fitted[:, -1] = np.interp(places, np.arange(len(Q)), Q[:, -1])
    if P.shape[1] != 2:
        return fitted
    reach = reach_of(Q)
    for k, (x, place) in enumerate(zip(P[:, 0], places, strict=True)):
        first = max(0, int(place) - reach)
        y = _nearest_crossing(Q[first : int(place) + reach + 2], x, place - first)
        if y is not None:
            fitted[k, 1] = y
    return fitted


def matched_places(P: Array, Q: Array) -> Array:
    """Return where along Q, in its points, a warping path has each point of P."""
    i, j = dtw_path(*normalize(P, Q)).path.T
    places: Array = np.bincount(i, weights=j) / np.bincount(i)
    return places


def reach_of(Q: Array) -> int:
    """Return how many points of Q from the matched one the fitted one may be."""
    return max(2, round(_REACH * len(Q)))


def _nearest_crossing(Q: Array, x: float, place: float) -> float | None:
    """Return y where Q passes x, at the crossing nearest to a place along Q."""
    before, after = Q[:-1, 0] - x, Q[1:, 0] - x
    (crossed,) = np.nonzero((before * after <= 0.0) & (before != after))
    if not crossed.size:
        return None
    fractions = before[crossed] / (before[crossed] - after[crossed])
    nearest = int(np.argmin(np.abs(crossed + fractions - place)))
    k, fraction = crossed[nearest], fractions[nearest]
    return float(Q[k, 1] + fraction * (Q[k + 1, 1] - Q[k, 1]))
