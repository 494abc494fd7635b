"""Shape-based distance: what correlation leaves where one curve is shifted along the other.

Paparrizos & Gravano, "k-Shape: Efficient and Accurate Clustering of Time Series", SIGMOD 2015. The
correlations of all shifts are computed together by the fast Fourier transform.
"""

from __future__ import annotations

import numpy as np

from ..curves.inputs import Array, CurveLike
from ..curves.pairs import checked_pair

__all__ = ["sbd"]


def sbd(P: CurveLike, Q: CurveLike) -> float:
    """Compute the shape-based distance: 1 minus the largest correlation over all shifts.

    Normalise curves first (``z_normalized``) if their level and scale do not count. For batches
    pass the function to ``cdist`` or to an estimator as its measure.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d, whose points are evenly spaced in time. A shift moves all coordinates
        together.

    Returns
    -------
    float
        From 0, for curves that are equal but for a shift and a positive factor, to 2. It is 1 if
        all points of one curve are 0, and 0 if all points of both are. Symmetric.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, or the curves differ in d.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    1 - max over s of (sum over i of P[i + s] · Q[i]) / (‖P‖ ‖Q‖), with points outside the curves
    counted as 0. For d = 1 and z-normalised curves this is aeon's ``sbd_distance``. Rounding is
    about 1e-15. Time O(d k log k) with k = n + m; memory O(d k).

    Examples
    --------
    >>> import curvewise
    >>> pulse, later = [0, 1, 2, 1, 0, 0, 0], [0, 0, 0, 0, 2, 4, 2]
    >>> abs(round(curvewise.sbd(pulse, later), 12))
    0.0
    >>> round(curvewise.sbd(pulse, [1, -1, 1, -1]), 3)
    0.796
    """
    first, second = checked_pair(P, Q, "sbd")
    n, m = len(first), len(second)
    ours, theirs = _unit(first), _unit(second)
    if not ours.any() or not theirs.any():
        return float(ours.any() or theirs.any())
    size = 1 << (n + m - 2).bit_length()
    spectra = np.fft.rfft(ours, size, axis=0) * np.fft.rfft(theirs, size, axis=0).conj()
    correlations = np.fft.irfft(spectra.sum(axis=1), size)
    shifts = np.concatenate([correlations[:n], correlations[size - m + 1 :]])
    return float(np.clip(1.0 - shifts.max(), 0.0, 2.0))


def _unit(curve: Array) -> Array:
    """Return a curve whose squares add up to 1; one of zeros as it is."""
    curve = np.ascontiguousarray(curve)  # whose squares are added in one order
    largest = np.abs(curve).max()
    if largest == 0.0:
        return curve
    scaled = np.ldexp(curve, -np.frexp(largest)[1])  # squares stay within the range of a double
    return np.asarray(scaled / np.linalg.norm(scaled))
