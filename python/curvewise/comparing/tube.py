"""A tube about a curve, with a tolerance in x and another in y.

The tube is what a rectangle covers whose centre moves along the curve (csv-compare's tube, for any
curve in the plane). A point is in it if its Chebyshev distance to the curve is at most 1, with x
and y in units of their tolerances. Distances to segments are exact; blocks of segments that cannot
be nearest are left out by their bounding boxes. Time O(n) for similar curves, at most O(n m).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from .._options import real_number
from ..curves.checks import check_finite
from ..curves.inputs import Array, CurveLike, as_curves

__all__ = ["Tube", "tube"]

_BLOCK = 64  # points, and segments, that share a bounding box
_FARTHEST = 2.0**45  # tolerances from the origin, beyond which rounding errors would decide
_ABOVE_0 = "a tolerance must be above 0"


@dataclass(frozen=True)
class Tube:
    """Result of `tube`; true if both curves stay within the tolerances.

    Attributes
    ----------
    dx, dy : float
        The tolerances.
    outside : ndarray of int64, shape (k,)
        Rows of Q outside the tube about P.
    missed : ndarray of int64, shape (l,)
        Rows of P outside the tube about Q: parts of P that Q does not follow.
    largest : float
        The largest distance in units of the tolerances; at most 1 if the curves are within.
    place : tuple of float
        The point of Q, or of P, with the largest distance.
    first : tuple of float
        The first point of Q, else of P, outside; () if the curves are within.
    """

    dx: float
    dy: float
    outside: npt.NDArray[np.int64] = field(repr=False)
    missed: npt.NDArray[np.int64] = field(repr=False)
    largest: float
    place: tuple[float, ...]
    first: tuple[float, ...]

    def __bool__(self) -> bool:
        return not len(self.outside) and not len(self.missed)

    def __str__(self) -> str:
        size = f"the tube of ±{self.dx:g}, ±{self.dy:g}"
        if self:
            return f"within {size}; largest deviation {self.largest:.3g} of the tolerance"
        return (
            f"points outside {size}: {len(self.outside)} of Q, {len(self.missed)} of P; first at "
            f"{at(self.first)}, largest deviation {self.largest:.3g} of the tolerance at "
            f"{at(self.place)}"
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the attributes as JSON has them, with `within` as a bool."""
        return {
            "within": bool(self),
            "dx": self.dx,
            "dy": self.dy,
            "outside": self.outside.tolist(),
            "missed": self.missed.tolist(),
            "largest": self.largest,
            "place": list(self.place),
            "first": list(self.first),
        }


def at(point: tuple[float, ...]) -> str:
    """Return a point as text."""
    return f"({', '.join(f'{value:.6g}' for value in point)})"


def tube(P: CurveLike, Q: CurveLike, dx: float, dy: float) -> Tube:
    """Check whether two curves stay within a tolerance in x and another in y.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves; P is the reference.
    dx, dy : float
        The tolerances in x and in y, in the units of the curves; above 0.

    Returns
    -------
    Tube
        True if every point of Q is in the tube about P, and every point of P in the tube about Q.
        It states where a curve leaves the tube.

    Raises
    ------
    TypeError
        If a curve does not hold real numbers.
    ValueError
        If a curve is empty, not finite or does not have two columns; if a tolerance is not above 0,
        or smaller than the rounding of the coordinates.

    See Also
    --------
    curvewise.curves.common_span : Cut the curve that runs longer.

    Notes
    -----
    The tube about a curve is the union of rectangles, 2 dx wide and 2 dy high, about all points of
    its segments. The program csv-compare uses the same definition for functions of time. The order
    of the points does not count: compare loops by `frechet` in addition. Rounding errors of the
    coordinates do not decide. Time O(n + m) for similar curves, at most O(n m).

    Examples
    --------
    >>> import curvewise
    >>> P, Q = [(0, 0), (1, 1), (2, 0)], [(0, 0), (1.1, 1), (2, 0.3)]
    >>> bool(curvewise.tube(P, Q, 0.2, 0.3))
    True
    >>> curvewise.tube(P, Q, 0.05, 0.05).first  # the point of Q that is outside
    (2.0, 0.3)
    """
    reference, other = as_curves(P, Q)
    if reference.ndim != 2 or reference.shape[1] != 2:
        raise ValueError(f"P has shape {reference.shape}; a tube needs x and y, shape (n, 2)")
    for curve, name in ((reference, "P"), (other, "Q")):
        if not len(curve):
            raise ValueError(f"{name} has shape {curve.shape}; at least 1 point is needed")
        check_finite(curve, name)
    size = []
    for name, given in (("dx", dx), ("dy", dy)):
        tolerance = real_number(name, given, -math.inf, _ABOVE_0)
        if not 0.0 < tolerance < math.inf:
            raise ValueError(f"{name} is {given!r}; {_ABOVE_0}")
        size.append(tolerance)
    # As subtractions of coordinates round.
    with np.errstate(over="ignore"):
        farthest = max(float((np.abs(curve) / size).max()) for curve in (reference, other))
    if farthest > _FARTHEST:
        raise ValueError(f"a coordinate is {farthest:g} tolerances; pass larger dx and dy")
    rounding = 4.0 * 2.0**-52 * farthest
    p, q = ((curve - reference[0]) / size for curve in (reference, other))
    of_q, of_p = _distances(q, p), _distances(p, q)
    outside, missed = (np.flatnonzero(found > 1.0 + rounding) for found in (of_q, of_p))
    worst = other[of_q.argmax()] if of_q.max() >= of_p.max() else reference[of_p.argmax()]
    left = [*other[outside[:1]], *reference[missed[:1]]]
    return Tube(
        size[0],
        size[1],
        outside,
        missed,
        float(max(of_q.max(), of_p.max())),
        tuple(worst.tolist()),
        tuple(left[0].tolist()) if left else (),
    )


def _distances(points: Array, curve: Array) -> Array:
    """Return the Chebyshev distance of each point to a polyline."""
    begins, ends = (curve[:-1], curve[1:]) if len(curve) > 1 else (curve, curve)
    starts = np.arange(0, len(begins), _BLOCK)
    low = np.minimum.reduceat(np.minimum(begins, ends), starts)
    high = np.maximum.reduceat(np.maximum(begins, ends), starts)
    found = np.empty(len(points))
    for first in range(0, len(points), _BLOCK):
        block = points[first : first + _BLOCK]
        apart = np.maximum(low - block.max(axis=0), block.min(axis=0) - high).max(axis=1)
        nearest = np.full(len(block), np.inf)
        for k in np.argsort(apart, kind="stable"):
            if apart[k] >= nearest.max():
                break
            part = slice(starts[k], starts[k] + _BLOCK)
            nearest = np.minimum(nearest, _to_segments(block, begins[part], ends[part]))
        found[first : first + _BLOCK] = nearest
    return found


def _to_segments(points: Array, begins: Array, ends: Array) -> Array:
    """Return the least Chebyshev distance of each point to some segments.

    Along a segment the distance is convex and piecewise linear: it is least at an end, where one
    coordinate meets the point's, or where both are equally far.
    """
    x, y = np.moveaxis(begins - points[:, np.newaxis], -1, 0)
    u, v = (ends - begins).T
    least = np.minimum(np.maximum(abs(x), abs(y)), np.maximum(abs(x + u), abs(y + v)))
    for over, under in ((x, u), (y, v), (x - y, u - v), (x + y, u + v)):
        place = np.divide(-over, under, out=np.zeros_like(x), where=under != 0.0).clip(0.0, 1.0)
        np.minimum(least, np.maximum(abs(x + place * u), abs(y + place * v)), out=least)
    nearest: Array = least.min(axis=1)
    return nearest
