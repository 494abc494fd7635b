"""How far a simulation is from its test, all in all and branch by branch.

A residual is the measured y minus the simulated y at the place that a warping path gives, as for
the noise of an uncertainty (fitted_points.py). Branches end where the test turns back by more than
a tenth of its range. Cost: a warping path.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ...curves import turning_points
from ...curves.inputs import Array
from ..records.search_record import SearchRecord
from ..uncertainty.fitted_points import fitted_points

__all__ = ["Branch", "Loop", "branches_of", "loops_of"]


@dataclass(frozen=True)
class Loop:
    """A test with its simulation.

    Attributes
    ----------
    title : str
        What the test is called.
    axes : sequence of str
        What its columns are called; `is_named` says whether anybody has named them.
    test : ndarray, shape (n, d)
        Of a number (1, 1).
    simulation : ndarray, or None where it is not known
        At the optimum.
    y : int
        The column whose differences are residuals.
    """

    title: str
    axes: Sequence[str]
    is_named: bool
    test: Array = field(repr=False)
    simulation: Any = field(repr=False)
    y: int

    @property
    def has_number(self) -> bool:
        """Whether it is a number with its simulated value, and no curve."""
        return self.test.size == 1 and self.simulation is not None

    @property
    def y_name(self) -> str:
        """What y is called."""
        return self.axes[self.y]

    @cached_property
    def branches(self) -> list[Branch]:
        """The branches with their residuals; none without a simulated curve."""
        if self.simulation is None or len(self.test) < 2:
            return []
        return branches_of(self.test, self.simulation, self.y)

    @property
    def residual(self) -> Array:
        """The residual of every point of the test."""
        # Branches share the points at which the test turns.
        return np.concatenate([one.residual[i > 0 :] for i, one in enumerate(self.branches)])


def loops_of(record: SearchRecord) -> list[Loop]:
    """Return the tests of a search with their simulations at the optimum."""
    details, tests = record.details, record.experiments
    simulated = [*record.curves, *[None] * (len(tests) - len(record.curves))]
    # What a file without a header has, "column 2", is no name.
    named = [
        any(not re.fullmatch(r"column \d+", name) for name in names) for names in details["named"]
    ]
    columns = (details["titles"], details["axes"], named, tests, simulated, details["y"])
    return [Loop(*one) for one in zip(*columns, strict=True)]


class Branch(NamedTuple):
    """A branch of a test: where it is, and the residuals there.

    Attributes
    ----------
    name : str
        "branch 1" and so on.
    x, residual : ndarray
        Of every measured point, in the units of the test.
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
