"""The global stage of a search: where a surrogate is lowest beyond the region of trust.

A local search ends in the next local minimum, and measures of curves have many beside each other:
sums of distances where noisy curves cross elsewhere, largest distances where other points decide. A
surrogate knows them before the model is run. CMA-ES (`surfaces.evolution`) looks for the lowest
place on it: near the best run on the surface through the runs around it, over all the bounds on the
surface through the best hundred. The inner search of the measure polishes what it finds.

Near the best run it moves along the principal axes of the curves' sensitivity, in each as far as
the curves move alike: parameters that hardly move the curves go far, the others little.

Cost: some 400 evaluations of the measure on predicted curves, and no run.

N. Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772; D. J. Wales, J. P. K. Doye,
"Global optimization by basin-hopping", J. Phys. Chem. A 101 (1997) 5111-5116.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...curves.inputs import Array
from ..surfaces.evolution import evolved
from ..surfaces.surfaces import Surface
from .runs import Runs

__all__ = ["NEAR", "GlobalStage"]

NEAR = 0.1  # how far from the best run the first hop goes, as a fraction of the bounds' range
_MEMBERS, _GENERATIONS = 12, 30
_SETTLED = 5e-3  # what follows is polished by the inner search
_WIDTH = 0.3  # the first standard deviation, in reaches
_LEAST = 0.03  # of the reach: the shortest principal axis
_BEST, _GOOD = 100, 10  # runs in the wide surface, and those from one of which CMA-ES begins
_SAME = 1e-4  # places that are nearer to each other, along each axis, are the same
_POLISHED = 0.05  # how far the inner search may move what CMA-ES finds


class GlobalStage:
    """Finds places that a surrogate promises.

    Parameters
    ----------
    runs : Runs
        Of the search.
    random : numpy.random.Generator
    """

    def __init__(self, runs: Runs, random: np.random.Generator) -> None:
        self._runs, self._random = runs, random

    def lowest(self, number: int, reach: Array) -> tuple[Array, float] | None:
        """Return the lowest place within reaches of a run, and the gain that it promises.

        None where a run is there already.
        """
        longest = float(reach.max())
        surface = self._runs.surrogate(number, 2.0 * longest)
        centre = self._runs.points[number]
        axes = self._principal_axes(surface, centre, longest)
        low, high = np.clip(centre - reach, 0.0, 1.0), np.clip(centre + reach, 0.0, 1.0)

        def function(moves: Array) -> Array:
            points = np.clip(centre + (moves - 0.5) @ axes.T, low, high)
            return self._runs.inner.estimates(surface, points)

        moves = self._evolved(function, np.full(centre.size, 0.5))
        found = np.clip(centre + axes @ (moves - 0.5), low, high)
        return self._promised(surface, number, found)

    def wide(self) -> tuple[Array, float] | None:
        """Return the lowest place of all, and the gain that it promises; None as for `near`."""
        surface = self._runs.surface_through_best(_BEST)
        good = np.argsort(self._runs.values, kind="stable")[:_GOOD]
        start = self._runs.points[int(self._random.choice(good))]
        found = self._evolved(lambda points: self._runs.inner.estimates(surface, points), start)
        return self._promised(surface, self._runs.best, found)

    def _evolved(self, function: Callable[[Array], Array], start: Array) -> Array:
        return evolved(
            function,
            start,
            _WIDTH,
            self._random,
            members=_MEMBERS,
            generations=_GENERATIONS,
            settled=_SETTLED,
        )

    def _promised(self, surface: Surface, number: int, found: Array) -> tuple[Array, float] | None:
        inner = self._runs.inner
        low, high = np.clip(found - _POLISHED, 0.0, 1.0), np.clip(found + _POLISHED, 0.0, 1.0)
        place = inner.lowest(surface, found, low, high)
        if np.abs(self._runs.points - place).max(axis=1).min() <= _SAME:
            return None
        before, after = inner.values(surface, np.array((self._runs.points[number], place)))
        return place, float(before - after)

    def _principal_axes(self, surface: Surface, centre: Array, reach: float) -> Array:
        """Return the axes along which curves move alike, shape (k, k), the longest of a reach."""
        _, slopes = surface.with_slopes(centre)
        sides = self._runs.inner.sides
        scaled = slopes if sides is None else slopes / sides[:, np.newaxis]
        squares, axes = np.linalg.eigh(scaled.T @ scaled)
        lengths = np.sqrt(max(squares[0], 1e-20) / np.maximum(squares, 1e-20))
        scaled_axes: Array = axes * (2.0 * reach * np.maximum(lengths, _LEAST))
        return scaled_axes
