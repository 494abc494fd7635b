"""Points of the sphere in space, from longitude and latitude, and their arcs.

On the sphere of diameter 1 about the origin, the squared distance of two points in space is h, the
square of half the chord of the unit sphere. The arc is 2 asin(sqrt(h)). Sines, cosines and arcsines
are computed by dedicated polynomials, interpolated at Chebyshev nodes with errors below 2e-17. The
order of operations is that of the compiled library, so results are bitwise identical. Time and
memory O(n).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .inputs import Array

__all__ = ["arcs", "check_on_sphere", "in_space"]

_SINE = (
    -8.860961557012979e-07,
    1.3496016231628688e-11,
    -9.788384859392164e-17,
    4.141266948173571e-22,
    -1.1467754740637925e-27,
    2.219718014334642e-33,
)
_COSINE = (
    -0.0001523087098933543,
    3.86632385156299e-09,
    -3.9258319857408015e-14,
    2.1354943029153012e-19,
    -7.227874204324564e-25,
    1.667912805508616e-30,
    -2.766732424324131e-36,
)
# Coefficients of (asin(s) / s - 1) / s**2, by powers of s**2.
_ARCSINE = (
    0.16666666666666669,
    0.07499999999998412,
    0.04464285714665563,
    0.030381944084994415,
    0.0223721770065477,
    0.017352221539201188,
    0.013975730180211136,
    0.01139924601483468,
    0.011310924828955462,
    -0.0032941927380090922,
    0.07377343868679113,
    -0.2809947932275328,
    0.952265420570822,
    -2.3535297860232123,
    4.3847119392409954,
    -5.883233416999023,
    5.436384462318588,
    -3.0948547605199717,
    0.8387674099544927,
)


def check_on_sphere(curve: Array, name: str) -> None:
    """Raise an error for longitudes beyond ±360 and latitudes beyond ±90."""
    limits = (("longitude", 360), ("latitude", 90))
    outside = np.abs(curve) > [limit for _, limit in limits]
    if not outside.any():
        return
    i, c = np.argwhere(outside)[0]
    what, limit = limits[c]
    raise ValueError(
        f"{name}[{i}, {c}] is {curve[i, c]:.10g}; metric='haversine' takes longitude, latitude: "
        f"{what}s are from -{limit} to {limit} degrees"
    )


def in_space(points: Array) -> Array:
    """Return points, shape (..., 2), in space, shape (..., 3): half their unit vectors."""
    sine_along, cosine_along = _sine_and_cosine(points[..., 0])
    sine_up, cosine_up = _sine_and_cosine(points[..., 1])
    half = 0.5 * cosine_up
    return np.stack([half * cosine_along, half * sine_along, 0.5 * sine_up], axis=-1)


def arcs(squares: Array, radius: float) -> Array:
    """Return the arcs of squares of half chords, on a sphere of this radius."""
    h = np.minimum(squares, 1.0)
    s = np.sqrt(np.minimum(h, 1.0 - h))
    z = s * s
    arc = s + s * (z * _by_halves(z))
    angle = np.where(h <= 0.5, arc, 1.5707963267948966 - arc)
    return np.asarray(angle * (radius + radius))


def _by_halves(z: Array) -> Array:
    """Return the polynomial of the arcsine: its even powers, and its odd ones."""
    square = z * z
    return _polynomial(_ARCSINE[::2], square) + z * _polynomial(_ARCSINE[1::2], square)


def _sine_and_cosine(degrees: Array) -> tuple[Array, Array]:
    """Return sine and cosine of an angle; its reduction by 90 degrees is exact."""
    quarters: npt.NDArray[np.int64] = np.rint(degrees / 90.0).astype(np.int64)
    rest = degrees - 90.0 * quarters
    square = rest * rest
    sine = rest * 0.017453292519943295 + rest * (square * _polynomial(_SINE, square))
    cosine = 1.0 + square * _polynomial(_COSINE, square)
    turn = quarters & 3
    return (
        np.choose(turn, [sine, cosine, -sine, -cosine]),
        np.choose(turn, [cosine, -sine, -cosine, sine]),
    )


def _polynomial(coefficients: tuple[float, ...], x: Array) -> Array:
    total = np.full(np.shape(x), coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        total = total * x + coefficient
    return total
