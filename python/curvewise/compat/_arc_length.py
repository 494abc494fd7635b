"""Partial curve mapping and the curve length measure in similaritymeasures' arithmetic.

Both measures compare points of equal arc length along two curves: partial curve mapping at many
offsets between curves of different length, curve length at equal relative length. That package's
partial curve mapping differs from that of the paper (:func:`curvewise.pcm`) in two respects. The
vertices of the longer curve are mapped to the shorter one, at offsets in units of relative length;
past its end its last point is used. Distances are weighted with the arc length from the start of
the curve instead of the segment's. O(n) time for the curve length measure, 200 searches of O(n log
m) for partial curve mapping.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..curves.inputs import Array, CurveLike
from ._arrays import RealArray, plane_curve, vector

__all__ = ["curve_length_measure", "get_length", "normalizeTwoCurves", "pcm"]

_OFFSETS = 200
_CHUNK = 1 << 15
"""Entries in one temporary array of `pcm`: 256 KiB, so that a few of them stay in cache."""


def pcm(
    exp_data: CurveLike, num_data: CurveLike, norm_seg_length: bool = False
) -> np.floating[Any]:
    """Compute the partial curve mapping measure of similaritymeasures.

    Parameters
    ----------
    exp_data, num_data : array_like, shapes (n, 2) and (m, 2)
        The curves. Both are scaled by the bounding box of `exp_data`.
    norm_seg_length : bool
        Measure lengths with each scaled curve divided by its own largest abs(x) and abs(y), as
        that package did before its version 0.6.0.

    Returns
    -------
    p : numpy floating
        The smallest of 200 weighted sums of distances (dimensionless); nan if `exp_data` is flat in
        x or y.

    Raises
    ------
    ValueError
        If an array is not (n, 2), or a curve is empty.
    TypeError
        If input is complex, text, objects or masked.

    See Also
    --------
    curvewise.pcm : partial curve mapping as the paper describes it; other numbers.

    Notes
    -----
    After Witowski & Stander (2012); this module's first paragraph says where it departs. O(n log m)
    time for each of 200 offsets, O(n + m) memory.

    Examples
    --------
    >>> from curvewise.compat import pcm
    >>> round(float(pcm([[0, 0], [1, 1], [2, 0]], [[0, 0], [1, 2], [2, 0]])), 6)
    0.75
    """
    experiment, simulation = plane_curve(exp_data, "exp_data"), plane_curve(num_data, "num_data")
    with np.errstate(all="ignore"):
        xi, eta, xi_prime, eta_prime = normalizeTwoCurves(
            experiment[:, 0], experiment[:, 1], simulation[:, 0], simulation[:, 1]
        )
        longer, shorter = (xi, eta), (xi_prime, eta_prime)
        _, length, s = get_length(*longer, norm_seg_length)
        _, short_length, short_s = get_length(*shorter, norm_seg_length)
        if short_length > length:
            longer, shorter = shorter, longer
            length, short_length, s, short_s = short_length, length, short_s, s
        count = 1 if length == short_length else _OFFSETS
        offsets = np.linspace(0.0, length - short_length, count)
        chunks = np.array_split(offsets, min(count, 1 + count * len(s) // _CHUNK))
        sums = [
            _weighted_sums(o, longer, s / length, shorter, short_s / short_length) for o in chunks
        ]
        return np.min(np.concatenate(sums))


def _weighted_sums(
    offsets: Array,
    longer: tuple[RealArray, RealArray],
    s: Array,
    shorter: tuple[RealArray, RealArray],
    short_s: Array,
) -> Array:
    """Return for each offset the distances between the longer curve and its image, weighted."""
    positions = s + offsets[:, np.newaxis]
    dx, dy = (
        vertices - np.interp(positions, short_s, coordinate)
        for vertices, coordinate in zip(longer, shorter, strict=True)
    )
    distances = np.sqrt(dy**2 + dx**2)
    sums: Array = np.sum(0.5 * (distances[:, :-1] + distances[:, 1:]) * s[1:], axis=1)
    return sums


def curve_length_measure(exp_data: CurveLike, num_data: CurveLike) -> np.floating[Any]:
    """Compute the curve length measure, normalised by the experiment's mean.

    Parameters
    ----------
    exp_data, num_data : array_like, shapes (n, 2) and (m, 2)
        The curves. Each point of `exp_data` is compared with the point of `num_data` at the same
        relative arc length.

    Returns
    -------
    r : numpy floating
        The square root of the sum of squared ln(1 + abs(Δx) / mean(x)) and the same in y
        (dimensionless). It is inf if a mean is zero. It is nan if a negative mean makes the
        logarithm undefined, or the length of `exp_data` is 0.

    Raises
    ------
    ValueError
        If an array is not (n, 2), or a curve is empty.
    TypeError
        If input is complex, text, objects or masked.

    See Also
    --------
    curvewise.curve_length : with an absolute value that lets means be negative, and other scales.

    Notes
    -----
    OF2 of Andrade-Campos, de-Carvalho & Valente (2012). O(n log m) time, O(n + m) memory.

    Examples
    --------
    >>> from curvewise.compat import curve_length_measure
    >>> line = [[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]
    >>> round(float(curve_length_measure(line, [[1.0, 1.0], [3.0, 5.0]])), 6)
    0.803029
    """
    experiment, simulation = plane_curve(exp_data, "exp_data"), plane_curve(num_data, "num_data")
    with np.errstate(all="ignore"):
        _, length, s = get_length(experiment[:, 0], experiment[:, 1])
        _, other_length, other_s = get_length(simulation[:, 0], simulation[:, 1])
        positions = s * (other_length / length)
        squares = np.zeros(len(s))
        for axis in (0, 1):
            values = experiment[:, axis]
            deviation = np.abs(np.interp(positions, other_s, simulation[:, axis]) - values)
            squares += np.log(1.0 + deviation / np.mean(values)) ** 2
        r: np.floating[Any] = np.sqrt(np.sum(squares))
    return r


def get_length(
    x: CurveLike, y: CurveLike, norm_seg_length: bool = True
) -> tuple[Array, np.floating[Any], Array]:
    """Compute arc lengths of a curve: of its segments, in total, from its start.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        The points.
    norm_seg_length : bool
        Divide x by its largest absolute value, and y by its own, before measuring; by 1e-15 where
        that is 0.

    Returns
    -------
    le : ndarray, shape (n,)
        Length of the segment that ends at each point; 0 for the first.
    le_total : numpy floating
        Their sum.
    le_cum : ndarray, shape (n,)
        Length from the first point to each point.

    Raises
    ------
    ValueError
        If x and y have different lengths, or are empty.
    TypeError
        If input is complex, text, objects or masked.

    Notes
    -----
    O(n) time and memory.

    Examples
    --------
    >>> from curvewise.compat import get_length
    >>> le, total, le_cum = get_length([0, 3, 3], [0, 4, 5], norm_seg_length=False)
    >>> le.tolist(), float(total), le_cum.tolist()
    ([0.0, 5.0, 1.0], 6.0, [0.0, 5.0, 6.0])
    """
    x, y = vector(x, "x"), vector(y, "y")
    if len(x) != len(y):
        raise ValueError(f"x has {len(x)} entries and y has {len(y)}; give one of each per point")
    with np.errstate(all="ignore"):
        x_scale, y_scale = (_largest(x), _largest(y)) if norm_seg_length else (1.0, 1.0)
        le = np.zeros(len(x))
        le[1:] = np.sqrt(_squares(np.diff(x) / x_scale) + _squares(np.diff(y) / y_scale))
        return le, np.sum(le), np.cumsum(le)


def _squares(values: RealArray) -> RealArray:
    # One by one, as there: the power of a numpy scalar is C's pow, which differs from the product
    # in the last bit of one value in a thousand. Between curves of equal length that bit decides
    # which of them `pcm` maps to the other.
    return np.array([value**2 for value in values], dtype=values.dtype)


def _largest(values: RealArray) -> Any:
    largest = np.max(np.abs(values))
    return 1e-15 if largest == 0 else largest


def normalizeTwoCurves(
    x: CurveLike, y: CurveLike, w: CurveLike, z: CurveLike
) -> tuple[RealArray, RealArray, RealArray, RealArray]:
    """Scale two curves by the bounding box of the first.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        The first curve.
    w, z : array_like, shape (m,)
        The second.

    Returns
    -------
    xi, eta : ndarray, shape (n,)
        The first curve within [0, 1]; nan in a direction in which it is flat.
    xiP, etaP : ndarray, shape (m,)
        The second curve with the same scale; nan or inf in such a direction.

    Raises
    ------
    ValueError
        If arrays are not (n,), or are empty.
    TypeError
        If input is complex, text, objects or masked.

    See Also
    --------
    curvewise.normalize : for whole curves, any number of them; does not divide by no extent.

    Notes
    -----
    Witowski & Stander (2012). O(n + m) time and memory.

    Examples
    --------
    >>> from curvewise.compat import normalizeTwoCurves
    >>> xi, eta, xiP, etaP = normalizeTwoCurves([1, 3], [0, 4], [2, 5], [1, 1])
    >>> xi.tolist(), eta.tolist(), xiP.tolist(), etaP.tolist()
    ([0.0, 1.0], [0.0, 1.0], [0.5, 2.0], [0.25, 0.25])
    """
    x, y, w, z = vector(x, "x"), vector(y, "y"), vector(w, "w"), vector(z, "z")
    with np.errstate(all="ignore"):
        x_low, y_low = np.min(x), np.min(y)
        width, height = np.max(x) - x_low, np.max(y) - y_low
        return (x - x_low) / width, (y - y_low) / height, (w - x_low) / width, (z - y_low) / height
