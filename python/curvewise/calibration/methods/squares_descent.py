"""One search for the smallest sum of squares, from one start: `least_squares` says how it goes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish, Ledger
from ..records.evaluation import Evaluation
from ..surfaces.bounded_squares import ResidualsAndSlopes, squares_minimum
from .descent import FAR, Descent, Rules
from .robust_losses import Bend
from .shared_runs import SharedRuns

__all__ = ["SquaresDescent", "SquaresRules", "SquaresRuns"]

# Of what is negligible elsewhere: near a perfect fit squares are smaller than distances.
_OF_SQUARES = 1e-3
# Planes of exact slopes lead right into the corners of the bounds, and a search that comes to one
# too early does not leave it where the model changes abruptly there. No step goes further than
# this part of the way to a bound, as in interior methods; three are as good as at it.
_OF_WAY = 0.9
# An end where steps gain nothing of what is promised is none if that is more than this fraction.
_PROMISING = 0.01


@dataclass(frozen=True, kw_only=True)
class SquaresRules(Rules):
    """How a search for squares goes on.

    Attributes
    ----------
    bend : callable, optional
        Of a robust sum.
    """

    bend: Bend | None


class SquaresRuns(SharedRuns):
    """Runs with their residuals, which are squared and added up."""

    def __init__(self, ledger: Ledger, rules: SquaresRules) -> None:
        self._bend = rules.bend
        self._simulations: list[tuple[Array, ...]] = []
        super().__init__(ledger)

    @property
    def negligible(self) -> float:
        """Differences of the sum below this do not count; curve_length is the root of one."""
        objective = self._ledger.objective
        if not objective.is_least_squares:
            return objective.negligible**2
        return _OF_SQUARES * objective.negligible

    def _taken(self, run: Evaluation) -> tuple[Array, float]:
        self._simulations.append(run.simulations or ())
        residuals = self._ledger.objective.residuals(run.simulations)
        return residuals, self.value(residuals)

    def value(self, residuals: Array) -> float:
        """Return what is minimised."""
        if self._bend is not None:
            residuals, _ = self._bend(residuals)
        return float(residuals @ residuals)

    def _known_slopes(self, number: int, by_curve: list[Array]) -> Array:
        """Residuals are differentiated along the slopes of the curves, which takes no runs."""
        return self._ledger.objective.residual_slopes(self._simulations[number], by_curve)

    def surface(self, number: int, within: float) -> ResidualsAndSlopes:
        """Return the surface through the runs nearest to one, or the plane of its slopes."""
        centre, slopes = self.points[number], self.slopes(number)
        if slopes is None:
            reduced = self._bend is None
            return self._bent(self.through_nearest(centre, within, reduced=reduced).with_slopes)
        base = self._vectors[number]
        return self._bent(lambda point: (base + slopes @ (point - centre), slopes))

    def _bent(self, surface: ResidualsAndSlopes) -> ResidualsAndSlopes:
        """Return a surface of what is squared and added up."""
        bend = self._bend
        if bend is None:
            return surface

        def bent_surface(point: Array) -> tuple[Array, Array]:
            plain, slopes = surface(point)
            bent, derivatives = bend(plain)
            return bent, derivatives[:, np.newaxis] * slopes

        return bent_surface


class SquaresDescent(Descent):
    """A search whose inner work is a bounded sum of squares."""

    looks_at_once = False
    _runs: SquaresRuns

    def _lowest(self, radius: float) -> tuple[Array, float]:
        assert self._best is not None
        centre = self.centre
        surface = self._runs.surface(self._best, FAR * radius)
        low, high = np.clip(centre - radius, 0.0, 1.0), np.clip(centre + radius, 0.0, 1.0)
        if self._runs.has_slopes:
            low = np.maximum(low, (1.0 - _OF_WAY) * centre)
            high = np.minimum(high, centre + _OF_WAY * (1.0 - centre))
        point, sum_of_squares = squares_minimum(surface, centre, low, high)
        return point, self.value - sum_of_squares

    def _end(self, radius: float, promised: float, least: float) -> Finish:
        if promised <= least:
            return Finish(True, f"the surface promises to gain less than {least:.2g}")
        region = f"the region is below {self._rules.tol:g} of the bounds' range"
        if promised <= _PROMISING * self.value:
            return Finish(True, region)
        return Finish(False, f"{region}, and steps do not gain what the surface promises")
