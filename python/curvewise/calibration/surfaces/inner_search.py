"""The interface between a surrogate search and its objective.

The search itself does not depend on the measure. It uses runs as vectors, a surrogate of these
vectors, and an inner search. An inner search defines the vector and the value of a run, the value
of a predicted vector, and its minimum within bounds. Measures of curves differ in the minimum
alone: sums of distances have gradients with kinks (`sums_of_distances`), and a largest distance is
a minimax problem (`largest_distances`). Sums of squares use residuals as vectors
(`sums_of_squares`).

Curves of thousands of points are thinned to some hundreds for the inner search, and all points
decide at its end.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import ClassVar, Protocol

import numpy as np

from ...curves.inputs import Array
from ...curves.scaling import box
from ..objective.objective import Objective
from ..records.evaluation import Evaluation
from . import largest_distances, sums_of_distances
from .predicted_curves import PredictedCurves
from .surfaces import Responses, Surface

__all__ = ["CurveSearch", "InnerSearch"]

# Number of points of a thinned curve; curves of up to 1.5 times as many are not thinned. The
# minimum of thinned curves agrees with that of all points to about 1e-3 of the value. If less is to
# be gained, they keep more points.
_MOST_POINTS, _MORE_POINTS, _LESS = 400, 1600, 1e-3
_EVALUATIONS, _POLISHING = 60, 8  # and those after thinned curves


class InnerSearch(Protocol):
    """The function to minimise, for runs and for predictions of a surrogate.

    Attributes
    ----------
    is_smooth : bool
        Whether it is a smooth function of a vector, without kinks and the local minima near them.
    """

    is_smooth: ClassVar[bool]

    @property
    def negligible(self) -> float:
        """Differences of the value below this do not count."""

    @property
    def sides(self) -> Array | None:
        """The side of the bounding box along each coordinate, shape (m,), or None."""

    def taken(self, run: Evaluation) -> tuple[Array, float]:
        """Return the vector and the value of a run that succeeded."""

    def slopes(self, run: Evaluation, by_curve: list[Array]) -> Array | None:
        """Return the derivatives of a run's vector, shape (m, k), by those of its curves."""

    def values(self, surface: Surface, points: Array) -> Array:
        """Return what a surrogate predicts at points, shape (points,)."""

    def estimates(self, surface: Surface, points: Array) -> Array:
        """Return the same about, for less."""

    def lowest(self, surface: Surface, start: Array, low: Array, high: Array) -> Array:
        """Return a local minimum in a box, from a start in it, never above the start."""


class CurveSearch:
    """Measures of curves.

    Parameters
    ----------
    objective : Objective
        The objective of the tests.
    gain : float
        The smallest gain that counts, as a fraction of the value.
    show_activity : callable
        Called before every evaluation on predicted curves, to show that something moves.
    """

    is_smooth: ClassVar[bool] = False

    def __init__(
        self, objective: Objective, gain: float, show_activity: Callable[[], None]
    ) -> None:
        self._objective, self._gain, self._show_activity = objective, gain, show_activity
        self._responses: Responses | None = None
        self._minimised = (
            largest_distances.minimised
            if objective.is_largest_distance
            else sums_of_distances.minimised
        )

    @property
    def negligible(self) -> float:
        """Differences of the measure below this do not count."""
        return self._objective.negligible

    @cached_property
    def sides(self) -> Array:
        """The sides of the tests' boxes, for every coordinate of a vector."""
        assert self._responses is not None
        shapes = self._responses.shapes
        pairs = zip(self._objective.experiments, shapes, strict=True)
        return np.concatenate([np.tile(box(test)[1], n) for test, (n, _) in pairs])

    def taken(self, run: Evaluation) -> tuple[Array, float]:
        """Return the coordinates of a run's curves as one vector, and its value."""
        assert run.simulations is not None
        if self._responses is None:
            self._responses = Responses(run.simulations)
        return self._responses.vector(run.simulations), run.value

    def slopes(self, run: Evaluation, by_curve: list[Array]) -> Array | None:
        """Return the derivatives of the coordinates."""
        assert self._responses is not None
        return self._responses.slopes(by_curve)

    def values(self, surface: Surface, points: Array) -> Array:
        """Return the measure of predicted curves."""
        return self._exact.values(surface, points)

    def estimates(self, surface: Surface, points: Array) -> Array:
        """Return the measure of some points of predicted curves."""
        predicted = self._thinned or self._exact
        return predicted.values(predicted.seen(surface), points)

    def lowest(self, surface: Surface, start: Array, low: Array, high: Array) -> Array:
        """Return a local minimum, on thinned curves first where there are any."""
        if self._thinned is None:
            return self._minimised(self._exact, surface, start, low, high, _EVALUATIONS)
        found = self._minimised(self._thinned, surface, start, low, high, _EVALUATIONS)
        before, after = self._exact.values(surface, np.array((start, found)))
        begin, most = (found, _POLISHING) if after < before else (start, _EVALUATIONS)
        return self._minimised(self._exact, surface, begin, low, high, most)

    @cached_property
    def _exact(self) -> PredictedCurves:
        assert self._responses is not None
        return PredictedCurves(self._objective, self._responses, None, self._show_activity)

    @cached_property
    def _thinned(self) -> PredictedCurves | None:
        if not self._objective.can_be_thinned:
            return None
        assert self._responses is not None
        most = _MORE_POINTS if self._gain < _LESS else _MOST_POINTS
        rows, thinned = self._responses.thinned_rows(most), self._objective.thinned(most)
        if thinned is None and rows is None:
            return None
        return PredictedCurves(
            thinned or self._objective, self._responses, rows, self._show_activity
        )
