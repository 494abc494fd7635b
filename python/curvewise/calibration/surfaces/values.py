"""Minimum of a kriging surrogate of the value.

It is used if the surrogate of the curves is misleading. Curves whose phase depends strongly on the
parameters have no useful surrogate by point number: beyond half a period its prediction is wrong.
The value itself varies more smoothly. A kriged surface interpolates the values of the nearest runs.
A quasi-Newton method finds its minimum, starting at the best run and at random places. Cost: about
100 evaluations of the surface.
"""

from __future__ import annotations

import numpy as np

from ...curves.inputs import Array
from .kriged_surface import KrigedSurface
from .nonsmooth_descent import nonsmooth_descent

__all__ = ["lowest_value"]

_PLACES, _MOST = 3, 50  # and the most evaluations from each


def lowest_value(
    points: Array,
    values: Array,
    centre: Array,
    low: Array,
    high: Array,
    random: np.random.Generator,
) -> tuple[Array, float]:
    """Return the minimiser of a surface through values, and its gain.

    Parameters
    ----------
    points : ndarray, shape (n, k)
    values : ndarray, shape (n,)
    centre, low, high : ndarray, shape (k,)
        One of the points, and the box around it.
    random : numpy.random.Generator
    """
    least = np.finfo(float).tiny
    surface = KrigedSurface(points, np.log(np.maximum(values, least))[:, np.newaxis], centre)

    width = np.where(high > low, high - low, 1.0)

    def function(place: Array) -> tuple[float, Array]:
        value, slopes = surface.with_slopes(low + place * width)
        return float(value[0]), slopes[0] * width

    starts = [(centre - low) / width, *random.random((_PLACES, centre.size))]
    found = [nonsmooth_descent(function, start, negligible=0.0, most=_MOST) for start in starts]
    points_found = np.clip(low + np.array(found) * width, low, high)
    predicted = np.exp(surface.at(points_found)[:, 0])
    best = int(np.argmin(predicted))
    return points_found[best], float(np.exp(surface.at(centre)[0]) - predicted[best])
