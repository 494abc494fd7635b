"""The inner search of a surrogate search: the measure of predicted curves, and its minimum.

The search itself does not depend on the measure: measures differ here alone. Sums of distances are
smooth almost everywhere; a quasi-Newton method for functions with kinks follows their gradient, and
a simplex replaces it for measures without a gradient. A largest distance is a minimax problem
(`largest_distances`). Sums of squares use residuals as vectors (`sums_of_squares`).

Curves of thousands of points are thinned to some hundreds for the inner search, and all points
decide at its end. Cost: 20 to 80 evaluations of the measure with its gradient, 20 k without one.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import ClassVar, Protocol

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ...curves.scaling import box
from ..objective.objective import Objective
from ..records.evaluation import Evaluation
from . import largest_distances
from .quasi_newton import nonsmooth_descent
from .steps import SMALL
from .surfaces import PredictedCurves, Responses, Surface

__all__ = ["CurveSearch", "InnerSearch"]

# Number of points of a thinned curve; curves of up to 1.5 times as many are not thinned. The
# minimum of thinned curves agrees with that of all points to about 1e-3 of the value. If less is to
# be gained, they keep more points.
_MOST_POINTS, _MORE_POINTS, _LESS = 400, 1600, 1e-3
_EVALUATIONS, _POLISHING = 60, 8  # and those after thinned curves
_EDGE = 0.1  # of the simplex, in sides of the box


class InnerSearch(Protocol):
    """The function to minimise, for runs and for predictions of a surrogate."""

    # Whether it is a smooth function of a vector, without kinks and the local minima near them.
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

    def lowest(self, surface: Surface, start: Array, low: Array, high: Array) -> Array:
        """Return a local minimum in a box, from a start in it, never above the start."""


class CurveSearch:
    """Measures of curves; gains below the fraction `gain` of the value do not count."""

    is_smooth: ClassVar[bool] = False

    def __init__(
        self, objective: Objective, gain: float, show_activity: Callable[[], None]
    ) -> None:
        self._objective, self._gain, self._show_activity = objective, gain, show_activity
        self._responses: Responses | None = None
        is_largest = objective.is_largest_distance
        self._minimised = largest_distances.minimised if is_largest else _minimised

    @property
    def negligible(self) -> float:
        """Differences of the measure below this do not count."""
        return self._objective.negligible

    @cached_property
    def sides(self) -> Array:
        """The sides of the tests' boxes, for every coordinate of a vector."""
        assert self._responses is not None
        pairs = zip(self._objective.experiments, self._responses.shapes, strict=True)
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

    def lowest(self, surface: Surface, start: Array, low: Array, high: Array) -> Array:
        """Return a local minimum, on thinned curves first where there are any."""
        most = _EVALUATIONS
        if self._thinned is not None:
            found = self._minimised(self._thinned, surface, start, low, high, most)
            before, after = self._exact.values(surface, np.array((start, found)))
            if after < before:
                start, most = found, _POLISHING
        return self._minimised(self._exact, surface, start, low, high, most)

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
        objective = thinned or self._objective
        return PredictedCurves(objective, self._responses, rows, self._show_activity)


def _minimised(
    predicted: PredictedCurves, surface: Surface, start: Array, low: Array, high: Array, most: int
) -> Array:
    """Return a local minimum of a sum of distances, within so many evaluations with a gradient."""
    seen = predicted.seen(surface)
    width = np.where(high > low, high - low, 1.0)
    place = (start - low) / width
    negligible = SMALL * predicted.objective.negligible
    if predicted.objective.has_gradient:

        def function(place: Array) -> tuple[float, Array]:
            value, gradient = predicted.value_and_gradient(seen, low + place * width)
            return value, gradient * width

        found = nonsmooth_descent(function, place, negligible=negligible, most=most)
    else:
        edges = np.diag(np.where(place > 0.5, -_EDGE, _EDGE))
        options = {
            "initial_simplex": np.vstack((place, place + edges)),
            "maxfev": most * place.size // 2,
            "xatol": _LESS,
            "fatol": negligible,
        }
        found = (
            required("scipy.optimize")
            .minimize(
                lambda place: predicted.value(seen.at(low + place * width)),
                place,
                method="Nelder-Mead",
                bounds=[(0.0, 1.0)] * place.size,
                options=options,
            )
            .x
        )
    point: Array = np.clip(low + found * width, low, high)
    return point
