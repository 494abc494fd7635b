"""Where a sum of distances of predicted curves is lowest in a box: along gradients, else a simplex.

Sums of distances are smooth almost everywhere. Their gradient is that of the measure with its path
held, times the slopes of the surrogate; a quasi-Newton method for functions with kinks goes along
it (`nonsmooth_descent`). Measures without a gradient take a simplex. Either may halt at a kink,
beyond which the global stage of a search looks (`methods.global_stage`).

Cost: 20 to 80 evaluations of the measure with its gradient; 20 k without one, for k parameters.
"""

from __future__ import annotations

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from .nonsmooth_descent import nonsmooth_descent
from .predicted_curves import PredictedCurves
from .surfaces import Surface

__all__ = ["minimised"]

_OF_NEGLIGIBLE = 1e-4  # a step on a surrogate costs little
_EDGE, _RESOLUTION = 0.1, 1e-3  # of the simplex, in sides of the box


def minimised(
    predicted: PredictedCurves, surface: Surface, start: Array, low: Array, high: Array, most: int
) -> Array:
    """Return a local minimum in a box, from a start in it.

    Parameters
    ----------
    predicted, surface
        The function to minimise, and the surface of its argument.
    start, low, high : ndarray, shape (k,)
    most : int
        The maximum number of evaluations with a gradient.
    """
    seen = predicted.seen(surface)
    width = np.where(high > low, high - low, 1.0)
    place = (start - low) / width
    negligible = _OF_NEGLIGIBLE * predicted.objective.negligible
    if predicted.objective.has_gradient:

        def function(place: Array) -> tuple[float, Array]:
            value, gradient = predicted.value_and_gradient(seen, low + place * width)
            return value, gradient * width

        found = nonsmooth_descent(function, place, negligible=negligible, most=most)
    else:
        edges = np.where(place > 0.5, -_EDGE, _EDGE)
        found = (
            required("scipy.optimize")
            .minimize(
                lambda place: predicted.value(seen.at(low + place * width)),
                place,
                method="Nelder-Mead",
                bounds=[(0.0, 1.0)] * place.size,
                options={
                    "initial_simplex": np.vstack((place, place + np.diag(edges))),
                    "maxfev": most * place.size // 2,
                    "xatol": _RESOLUTION,
                    "fatol": negligible,
                },
            )
            .x
        )
    point: Array = np.clip(low + found * width, low, high)
    return point
