"""The objective of the curves that a surface predicts, of all their points or of some.

Cost: that of the surface and of the measure.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows
from ..objective.objective import Objective
from .surfaces import Responses, Surface

__all__ = ["PredictedCurves"]


class PredictedCurves:
    """An objective as a function of the curves on a surface.

    Parameters
    ----------
    objective : Objective
        The objective of the tests.
    responses : Responses
        Converts vectors of the surface to curves.
    rows : list of ndarray, optional
        The points of each simulated curve that take part; all by default.
    show_activity : callable
        Called before every evaluation, to display activity.
    """

    def __init__(
        self,
        objective: Objective,
        responses: Responses,
        rows: list[Rows] | None,
        show_activity: Callable[[], None],
    ) -> None:
        self.objective, self._show_activity = objective, show_activity
        self.responses = responses if rows is None else responses.of_rows(rows)
        self._places = None if rows is None else responses.places_of_rows(rows)

    def seen(self, surface: Surface) -> Surface:
        """Return the surface of the points that take part."""
        return surface.of_places(self._places)

    def value(self, vector: Array) -> float:
        """Return the objective of curves as one vector."""
        self._show_activity()
        return self.objective.predicted(self.responses.curves(vector)).value

    def values(self, seen: Surface, points: Array) -> Array:
        """Return the objective at several points, shape (points,), on a surface of `seen`."""
        return np.array([self.value(vector) for vector in seen.at(points)])

    def value_and_gradient(self, seen: Surface, point: Array) -> tuple[float, Array]:
        """Return the objective at a point, and its gradient, on a surface of `seen`."""
        self._show_activity()
        vector, chain_rule = seen.with_chain_rule(point)
        value, gradients = self.objective.value_and_gradient(self.responses.curves(vector))
        return value, chain_rule(np.concatenate([gradient.ravel() for gradient in gradients]))
