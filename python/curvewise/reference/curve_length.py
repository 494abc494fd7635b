"""The curve-length measure: log-relative differences at equal fractions of arc length.

OF2 of Andrade-Campos, de-Carvalho & Valente, "Novel criteria for determination of material model
parameters", Int. J. Mechanical Sciences (2012); section 2.5 of the paper. Time O(n log m).
"""

from __future__ import annotations

import math
from typing import get_args

import numpy as np
import numpy.typing as npt

from .._options import LengthScale, check_choice
from ..curves.arc_length import corresponding_positions, interpolate
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.scaling import range_exponent, times_power_of_two
from .checks import check_length, check_pair

__all__ = ["curve_length", "curve_length_residuals"]


def curve_length(P: CurveLike, Q: CurveLike, *, scale: LengthScale = "mean") -> float:
    """Take the Euclidean norm of :func:`curve_length_residuals`, where the cost is."""
    residuals = curve_length_residuals(P, Q, scale=scale)
    with np.errstate(under="ignore"):
        return float(np.sqrt(np.sum(residuals * residuals)))


def curve_length_residuals(P: CurveLike, Q: CurveLike, *, scale: LengthScale = "mean") -> Array:
    """Time O(n log m), memory O(n + m).

    Point i of P, at arc length s of total L_P, is compared with the point of Q at s L_Q / L_P.
    The lengths of each curve are those after its x and y have been divided by its own max abs(x)
    and max abs(y).
    """
    P, Q = as_curves(P, Q)
    check_choice("scale", scale, get_args(LengthScale))
    P, Q = check_pair(P, Q, "curve_length", least_points=2, planar=True)
    check_length(P, "P", "curve_length")
    check_length(Q, "Q", "curve_length")
    position = corresponding_positions(P, Q)
    return np.column_stack([_residuals(P[:, c], Q[:, c], position, "xy"[c], scale) for c in (0, 1)])


def _residuals(
    p: Array,
    q: Array,
    position: tuple[npt.NDArray[np.intp], Array],
    name: str,
    scale: LengthScale,
) -> Array:
    """Return ln(1 + abs(Δ / scale)) in one coordinate."""
    if range_exponent(p, q) != 0:
        # A quotient is dimensionless: p is scaled close to 1, and nothing must be scaled back.
        exponent = math.frexp(np.abs(p).max())[1]
        p, q = times_power_of_two(p, -exponent), times_power_of_two(q, -exponent)
    divisor = _coordinate_scale(p, name, scale)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        relative = np.abs((interpolate(q, *position) - p) / divisor)
    return np.log1p(np.where(np.isfinite(relative), relative, np.inf))


def _coordinate_scale(x: Array, name: str, scale: LengthScale) -> float:
    """Return what differences in one coordinate of P are divided by."""
    largest = float(np.abs(x).max())
    if scale == "mean":
        mean = float(x.mean())
        if abs(mean) <= len(x) * 2.0**-52 * largest:
            raise ValueError(
                f"the mean of P's {name} is 0 to rounding; use scale='mean_abs' or scale='range'"
            )
        return mean
    if largest == 0:
        raise ValueError(
            f"P's {name} is 0 throughout, which leaves nothing to divide by; "
            f"add the same constant to {name} of both curves and use scale='mean_abs'"
        )
    if scale == "mean_abs":
        return float(np.abs(x).mean())
    extent = float(x.max() - x.min())
    if extent == 0:
        raise ValueError(f"the range of P's {name} is 0; use scale='mean' or scale='mean_abs'")
    return extent
