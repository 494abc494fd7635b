"""The curve-length measure, and the residuals that it is the norm of.

OF2 of Andrade-Campos, de-Carvalho & Valente (2012); section 2.5 of the paper. Time O(n + m).
"""

from __future__ import annotations

from .._core import curve_length as compiled_curve_length
from .._core import curve_length_residuals as compiled_curve_length_residuals
from .._options import LengthScale
from ..curves.inputs import Array, CurveLike, as_curves

__all__ = ["curve_length", "curve_length_residuals"]


def curve_length(P: CurveLike, Q: CurveLike, *, scale: LengthScale = "mean") -> float:
    """Compute the curve-length measure between two curves.

    It is the norm of log-relative differences at equal fractions of arc length.

    Every point of P is compared with the point of Q at the same fraction of its curve's length.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves, each of at least 2 different points.
    scale : {"mean", "mean_abs", "range"}
        The divisor of differences in x and in y: the mean of P's x ("mean", the paper's), the mean
        of abs(x), or the range. Loops centred on zero need one of the last two: if the means are
        0.1 % of the ranges, 1 % error in y gives 22.5 with "mean" and 0.17 with "mean_abs".

    Returns
    -------
    float
        Dimensionless. Not symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite, has fewer than 2 points, other than 2 coordinates or length 0. If
        the scale is 0 (for "mean", to rounding). If an option is unknown.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    OF2 of Andrade-Campos, de-Carvalho & Valente (2012); section 2.5 of the paper. Arc lengths
    are taken after dividing by each curve's own max abs(x) and max abs(y). The value is the
    Euclidean norm of :func:`curve_length_residuals`. Time and memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> P = [(0, 0), (1, 1), (2, 2)]
    >>> round(curvewise.curve_length(P, [(0, 1), (1, 2), (2, 3)]), 6)  # sqrt(3) ln 2
    1.200566
    """
    return compiled_curve_length(P, Q, (scale,))


def curve_length_residuals(P: CurveLike, Q: CurveLike, *, scale: LengthScale = "mean") -> Array:
    """Return the terms of :func:`curve_length`, for a least-squares solver.

    Parameters
    ----------
    P, Q, scale
        As for :func:`curve_length`.

    Returns
    -------
    ndarray, shape (n, 2)
        ln(1 + abs(dx / x̄)) and ln(1 + abs(dy / ȳ)) for every point of P.

    Raises
    ------
    ValueError, TypeError
        As for :func:`curve_length`.

    Notes
    -----
    As for :func:`curve_length`.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.curve_length_residuals([(0, 0), (2, 2)], [(0, 0), (2, 2)]).tolist()
    [[0.0, 0.0], [0.0, 0.0]]
    """
    P, Q = as_curves(P, Q)
    return compiled_curve_length_residuals(P, Q, {"scale": scale})
