"""What searches and statistics ask of the loops of an objective, beside their values.

Nothing here runs or compares anything; it is of the experiments and of the weights. Cost: none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ...curves.named_curve import axis_names
from ...curves.several_curves import curve_list

__all__ = ["Loops"]


class Loops:
    """The loops of an objective.

    Attributes
    ----------
    weights : ndarray, shape (loops,)
        The factor of each.
    """

    _loops: Sequence[Any]  # Loop, or what a case has in its place
    weights: Array

    @property
    def names(self) -> list[tuple[str, ...]]:
        """What the columns of every experiment are called; empty where that is not known."""
        return [loop.names for loop in self._loops]

    @property
    def titles(self) -> list[str]:
        """What the loops are called: by their numbers."""
        return [f"Loop {i}" for i in range(len(self._loops))]

    def axes(self, names: Sequence[str] | None = None) -> list[tuple[str, ...]]:
        """Return for each loop what its coordinates are called: as given, or as its columns are."""
        return [_axes(loop.experiment, names, loop.names) for loop in self._loops]

    @property
    def extents(self) -> list[Array]:
        """The extent of every experiment in each coordinate, of a number the number itself."""
        return [loop.extent for loop in self._loops]

    @property
    def y_columns(self) -> list[int]:
        """The column of each experiment that noise is in."""
        return [loop.y for loop in self._loops]

    @property
    def sigmas(self) -> list[float | None]:
        """The noise of each loop, where it is given beforehand."""
        return [None] * len(self._loops)

    @property
    def residual_counts(self) -> list[int]:
        """How many residuals each loop has."""
        return [loop.residual_count for loop in self._loops]

    @property
    def residual_factors(self) -> Array:
        """By what a difference in y is multiplied to be a residual of "sum_of_squares"."""
        heights = np.array([loop.height for loop in self._loops])
        factors: Array = np.sqrt(self.weights) / heights
        return factors

    @property
    def has_gradient(self) -> bool:
        """Whether there is a gradient that is of use to a minimisation."""
        return all(loop.has_gradient for loop in self._loops)

    @property
    def can_be_thinned(self) -> bool:
        """Whether some of the points of tests and simulations will do, for an estimate.

        Not where y is compared at each point of the test, which costs little anyway.
        """
        return all(loop.can_be_thinned for loop in self._loops)

    def _matched(self, simulations: Any) -> list[Any]:
        """Return one simulation for every experiment."""
        count = len(self._loops)
        if simulations is None or isinstance(simulations, BaseException):
            return [simulations] * count
        curves = curve_list(simulations)
        if len(curves) != count:
            raise ValueError(
                f"there are {len(curves)} simulations and {count} experiments; "
                "the model must return a curve for every experiment"
            )
        return curves

    def _located(self, message: str, i: int) -> str:
        return message if len(self._loops) == 1 else f"loop {i}: {message}"


def _axes(experiment: Array, names: Sequence[str] | None, known: Sequence[str]) -> tuple[str, ...]:
    given = names if experiment.size > 1 else None
    if given is None and len(known) == experiment.shape[1]:
        return tuple(known)
    return axis_names(experiment.shape[1], given)
