"""Where values alone are lowest in a box: a surrogate of the value, where that of curves misleads.

Curves whose phase turns with the parameters have no surrogate by point number: half a period off is
as far as it goes. The value itself bends less. A kriged surface goes through the values of the
nearest runs, and a quasi-Newton method finds its minimum, from the best run and from random places.
Cost: some 100 evaluations of the surface.
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
    """Return where a surface through values is lowest in a box, and by how much below the centre.

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
