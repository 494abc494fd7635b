"""The global stage of a search: minima of a surrogate beyond the trust region.

A local search ends in the nearest local minimum, and measures of curves have many close together. A
surrogate predicts them before the model is run. CMA-ES (`surfaces.evolution`) searches two
surrogates: that of the runs around the best one, along the principal axes of the curves'
sensitivity, and, with clouds of several widths, that of the best runs, whose metric is that
sensitivity. Smooth objectives need neither that metric nor several clouds. The inner search
polishes the result.

Cost: 400 to 900 evaluations of the measure on predicted curves, and no run of the model.

D. J. Wales, J. P. K. Doye, "Global optimization by basin-hopping", J. Phys. Chem. A 101 (1997)
5111-5116.
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from ..surfaces.evolution import evolved
from ..surfaces.steps import FEW, SMALL
from ..surfaces.surfaces import Surface
from .runs import Runs

__all__ = ["GlobalStage"]

_LEAST = 0.03  # of the reach: the shortest principal axis
_POLISHED = 0.05  # how far the inner search may move what CMA-ES finds
_MOST = 100  # best runs in the surface of a smooth objective
# Of clouds: the first begins at a given run, the others at one of the best FEW.
_WIDTHS, _MEMBERS, _SETTLED = (0.05, 0.15, 0.3), 10, 1e-3


class GlobalStage:
    """Finds places that a surrogate through the runs of a search promises."""

    def __init__(self, runs: Runs, random: np.random.Generator) -> None:
        self._runs, self._random = runs, random

    def lowest(
        self, number: int, reach: Array, seen: Rows | None = None
    ) -> tuple[Array, float] | None:
        """Return the lowest place within reaches of a run, and its predicted reduction.

        The surrogate uses the runs `seen`, or all. Return None if a run exists at that place.
        """
        longest = float(reach.max())
        surface = self._runs.surrogate(number, 2.0 * longest, seen)
        centre = self._runs.points[number]
        axes = self._principal_axes(surface, centre, longest)
        low, high = np.clip(centre - reach, 0.0, 1.0), np.clip(centre + reach, 0.0, 1.0)

        def function(moves: Array) -> Array:
            points = np.clip(centre + (moves - 0.5) @ axes.T, low, high)
            return self._runs.inner.values(surface, points, roughly=True)

        moves = evolved(function, np.full(centre.size, 0.5), self._random)
        found = np.clip(centre + axes @ (moves - 0.5), low, high)
        return self._promised(surface, number, found)

    def promising(self) -> tuple[Array, float] | None:
        """Return the lowest place of all and its predicted reduction.

        Return None if a run exists at that place.
        """
        inner, best = self._runs.inner, self._runs.best
        if not inner.is_smooth:
            return self.anywhere(best, None)
        surface = self._runs.surface_through_best(_MOST)
        start = self._runs.points[int(self._random.choice(self._runs.best_of(FEW, None)))]
        found = evolved(
            lambda points: inner.values(surface, points, roughly=True), start, self._random
        )
        return self._promised(surface, best, found)

    def anywhere(self, number: int, seen: Rows | None) -> tuple[Array, float] | None:
        """Return the lowest place of several clouds, and its predicted reduction below a run.

        The surrogate uses the runs `seen`, or all. Return None if a run exists at that place.
        """
        surface = self._runs.surface_by_sensitivity(number, seen)

        def function(points: Array) -> Array:
            return self._runs.inner.values(surface, points, roughly=True)

        others = self._random.choice(self._runs.best_of(FEW, seen), len(_WIDTHS) - 1)
        clouds = [
            evolved(
                function,
                self._runs.points[start],
                self._random,
                width=width,
                members=_MEMBERS,
                settled=_SETTLED,
            )
            for start, width in zip((number, *others), _WIDTHS, strict=True)
        ]
        lowest = int(np.argmin(function(np.array(clouds))))
        return self._promised(surface, number, clouds[lowest])

    def _promised(self, surface: Surface, number: int, found: Array) -> tuple[Array, float] | None:
        inner = self._runs.inner
        low, high = np.clip(found - _POLISHED, 0.0, 1.0), np.clip(found + _POLISHED, 0.0, 1.0)
        place = inner.lowest(surface, found, low, high)
        if np.abs(self._runs.points - place).max(axis=1).min() <= SMALL:
            return None
        before, after = inner.values(surface, np.array((self._runs.points[number], place)))
        return place, float(before - after)

    def _principal_axes(self, surface: Surface, centre: Array, reach: float) -> Array:
        """Return the axes scaled to equal curve movement, shape (k, k), none above `reach`."""
        _, slopes = surface.with_slopes(centre)
        sides = self._runs.inner.sides
        scaled = slopes if sides is None else slopes / sides[:, np.newaxis]
        squares, axes = np.linalg.eigh(scaled.T @ scaled)
        lengths = np.sqrt(max(squares[0], 1e-20) / np.maximum(squares, 1e-20))
        scaled_axes: Array = axes * (2.0 * reach * np.maximum(lengths, _LEAST))
        return scaled_axes
