"""Residuals of a simulation, branch by branch.

A residual is the measured y minus the simulated y at the place on a warping path, as for the noise
of an uncertainty (fitted_points.py). Branches end where the test reverses by more than a tenth of
its range. Cost: a warping path.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...curves import turning_points
from ...curves.inputs import Array
from ..uncertainty.fitted_points import fitted_points

__all__ = ["Branch", "branches_of"]


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
    residual = experiment[:, -1] - fitted_points(experiment, simulation)[:, -1]
    if experiment.shape[1] == 1:
        return [Branch("all", np.arange(len(experiment), dtype=np.float64), residual)]
    x = experiment[:, 0]
    turns = turning_points(experiment) if np.ptp(x) > 0 else np.array([], dtype=np.int64)
    ends = [0, *turns.tolist(), len(x) - 1]
    return [
        Branch(f"branch {k + 1}", x[first : end + 1], residual[first : end + 1])
        for k, (first, end) in enumerate(pairwise(ends))
    ]
