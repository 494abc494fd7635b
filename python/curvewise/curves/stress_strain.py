"""From what a test machine records to true stress and strain from a true zero. O(n)."""

from __future__ import annotations

import numpy as np

from .._options import real_number
from .checks import checked_curve
from .inputs import Array, CurveLike
from .named_curve import renamed

__all__ = ["engineering_to_true", "shift_to_origin"]


def engineering_to_true(curve: CurveLike) -> Array:
    r"""Convert engineering strain and stress to true (logarithmic, Cauchy) ones.

    With constant volume and uniform strain,

    .. math::

        \varepsilon = \ln(1 + e), \qquad \sigma = s (1 + e).

    Parameters
    ----------
    curve : array_like, shape (n, 2)
        Engineering strain e, as a fraction and not in per cent, and engineering stress s.
        Compression is negative.

    Returns
    -------
    ndarray, shape (n, 2)
        True strain, and true stress in the unit of `s`.

    Raises
    ------
    TypeError, ValueError
        If `curve` does not have two finite columns, or a strain is -1 or less.

    Notes
    -----
    O(n) time and memory. It is valid up to the largest force. Beyond it a tension specimen necks,
    and the mean strain is that of neither section (`trim` cuts this part off).

    Examples
    --------
    >>> from curvewise.curves import engineering_to_true
    >>> engineering_to_true([[0.0, 0.0], [0.1, 500.0]]).round(4)
    array([[0.00e+00, 0.00e+00],
           [9.53e-02, 5.50e+02]])
    """
    points = _strain_and_stress(curve)
    low = int(points[:, 0].argmin())
    if points[low, 0] <= -1.0:
        raise ValueError(
            f"curve[{low}, 0] is {points[low, 0]}; an engineering strain is above -1, a fraction"
        )
    strain, stress = points.T
    return np.column_stack((np.log1p(strain), stress * (1.0 + strain)))


def shift_to_origin(
    curve: CurveLike, *, elastic: tuple[float, float] | None = None, cut: bool = False
) -> Array:
    """Shift a curve so that it begins at the origin.

    Parameters
    ----------
    curve : array_like, shape (n, d) or (n,)
        The curve; with `elastic` strain and stress, (n, 2).
    elastic : (low, high), optional
        Two stresses between which the first loading is a straight line. The strain is shifted so
        that this line, fitted by least squares, passes through the origin; the stress is unchanged.
        This removes the toe that slack and settling grips cause (toe compensation of ASTM E111 and
        D638). By default the first point becomes the origin.
    cut : bool, default False
        Whether to cut off the toe: the curve then begins with the first point of the straight line,
        as a material fit requires. Only with `elastic`.

    Returns
    -------
    ndarray, shape (n, d)
        The shifted curve. Shape (n, 1) for a curve of shape (n,).

    Raises
    ------
    TypeError, ValueError
        If `curve` does not hold finite numbers. If `elastic` is not low < high, fewer than three
        points of the first loading lie between the two, or their line does not rise. If `cut` is
        given without `elastic`.

    Notes
    -----
    O(n) time and memory.

    Examples
    --------
    A toe up to 100 MPa, then 200 GPa:

    >>> from curvewise.curves import shift_to_origin
    >>> test = [[0, 0], [0.001, 100], [0.00125, 150], [0.0015, 200], [0.00175, 250]]
    >>> shift_to_origin(test, elastic=(100, 250))[:, 0].round(6)
    array([-0.0005 ,  0.0005 ,  0.00075,  0.001  ,  0.00125])
    >>> shift_to_origin(test, elastic=(100, 250), cut=True)[:, 0].round(6)
    array([0.0005 , 0.00075, 0.001  , 0.00125])
    """
    if elastic is None:
        if cut:
            raise ValueError("cut is True; give the straight part too: elastic=(low, high)")
        points = checked_curve(curve, 1)
        shifted: Array = points - points[0]
        return renamed(curve, shifted)
    points = _strain_and_stress(curve)
    needed = "give two stresses, low < high"
    for limit in elastic:
        real_number("elastic", limit, -np.inf, needed)
    low, high = elastic
    if not low < high:
        raise ValueError(f"elastic is {elastic}; {needed}")
    strain, stress = points.T
    beyond = np.flatnonzero(stress > high)
    first = slice(0, int(beyond[0]) if beyond.size else len(points))
    inside = np.flatnonzero(stress[first] >= low)
    if inside.size < 3:
        raise ValueError(
            f"only {inside.size} points of the first loading have stresses from {low} to {high}; "
            "a line needs three"
        )
    x, y = strain[inside] - strain[inside].mean(), stress[inside] - stress[inside].mean()
    if not x @ y > 0.0:
        raise ValueError(f"stresses from {low} to {high} do not rise with the strain")
    # The line as strain over stress, which is steep: its error is that of the strain.
    zero = strain[inside].mean() - stress[inside].mean() * float(x @ y / (y @ y))
    first_kept = int(inside[0]) if cut else 0
    return renamed(curve, np.column_stack((strain - zero, stress))[first_kept:])


def _strain_and_stress(curve: CurveLike) -> Array:
    points = checked_curve(curve, 1)
    if points.shape[1] != 2:
        raise ValueError(f"curve has shape {points.shape}; give strain and stress, shape (n, 2)")
    return points
