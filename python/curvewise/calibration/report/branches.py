"""Residuals of a simulation, branch by branch.

A dynamic time warping path assigns each measured point to a section of the simulation. A residual
is the measured y minus the simulated y there, at the measured x. If the section does not reach that
x (a simulation that reverses earlier), it is the y of the matched point. Branches end where the
test reverses by more than a tenth of its range. Cost: a warping path, O(n + m) memory.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...curves import turning_points
from ...curves.inputs import Array
from ..uncertainty.directions import matched_places

__all__ = ["Branch", "branches_of"]

_REACH = 0.05  # how far from the matched point, as a fraction of the simulation's points


class Branch(NamedTuple):
    """A branch of a test: where it is, and the residuals there.

    Attributes
    ----------
    name : str
        "branch 1" and so on.
    x, residual : ndarray
        The x and the residual of every measured point, in the units of the test.
    """

    name: str
    x: Array
    residual: Array

    def row(self) -> list[str]:
        """Return its name, from where to where, how many points, and mean, rms and largest."""
        ends = [f"{x:.4g}" for x in self.x[[0, -1]]]
        rms, largest = np.sqrt(np.mean(self.residual**2)), np.abs(self.residual).max()
        spread = [f"{number:.4g}" for number in (self.residual.mean(), rms, largest)]
        return [self.name, *ends, f"{len(self.x)}", *spread]


def branches_of(experiment: Array, simulation: Array, y: int) -> list[Branch]:
    """Return the branches of a test with the residuals of its column `y`."""
    if experiment.shape[1] > 1:  # a third column, such as time, is left out
        experiment, simulation = (curve[:, [0, y]] for curve in (experiment, simulation))
    residual = experiment[:, -1] - _fitted_points(experiment, simulation)[:, -1]
    if experiment.shape[1] == 1:
        return [Branch("all", np.arange(len(experiment), dtype=np.float64), residual)]
    x = experiment[:, 0]
    turns = turning_points(experiment) if np.ptp(x) > 0 else np.array([], dtype=np.int64)
    ends = [0, *turns.tolist(), len(x) - 1]
    return [
        Branch(f"branch {k + 1}", x[first : end + 1], residual[first : end + 1])
        for k, (first, end) in enumerate(pairwise(ends))
    ]


def _fitted_points(P: Array, Q: Array) -> Array:
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
    reach = max(2, round(_REACH * len(Q)))
    for k, (x, place) in enumerate(zip(P[:, 0], places, strict=True)):
        first = max(0, int(place) - reach)
        y = _nearest_crossing(Q[first : int(place) + reach + 2], x, place - first)
        if y is not None:
            fitted[k, 1] = y
    return fitted


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
