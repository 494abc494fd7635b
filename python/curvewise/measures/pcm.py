"""Partial curve mapping: where the shorter curve fits best on the longer one, and how well.

Witowski & Stander (2012), as section 2.1 of the paper describes it. Time O(n + m) an offset.
"""

from __future__ import annotations

from .._core import pcm as compiled_pcm
from .._core import pcm_match as compiled_pcm_match
from .._options import Offsets
from ..curves.inputs import CurveLike, as_curves
from ..curves.named_curve import copied
from .results import PcmMatch

__all__ = ["pcm", "pcm_match"]


def pcm(P: CurveLike, Q: CurveLike, *, offsets: Offsets = 200) -> float:
    """Compute the partial curve mapping measure between two curves.

    It is the area to the best-matching part of the longer curve. Both curves are scaled by P's
    bounding box. The vertices of the shorter one are mapped to the longer one at equal arc length,
    starting at an offset along it. The value is the smallest area between the two over all offsets.

    A short curve that agrees with a part of the other has a small value by design: a simulation
    that stopped early may have 0. :func:`pcm_match` reports the covered part of the longer curve.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves, each of at least 2 different points.
    offsets : int >= 1, or "continuous"
        The number of evenly spaced offsets (1: only 0), or "continuous". The latter is the minimum
        over all offsets, to 1e-12 of the shorter length or 1e-13 of the value, whichever is more.
        It is never above that of 200 offsets.

    Returns
    -------
    float
        The area, dimensionless. Not symmetric: P's box scales both. inf if a scaled length is
        beyond the range of a double.

    Raises
    ------
    ValueError
        If a curve is not finite, has fewer than 2 points, other than 2 coordinates or length 0. If
        `offsets` is out of range.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Witowski & Stander (2012), as in section 2.1 of the paper. Time O(offsets (n + m)). The option
    "continuous" needs about 10³ evaluations of O(n + m) for curves that bend. It needs more if the
    area has many equal minima: about 20 n for zigzags along one line (4 s for 2201 and 4401
    points). After 2^20 evaluations the tolerance is doubled after every 2^14 more. Curves of up to
    10⁶ boxes in length therefore need at most 2.1 million evaluations. The `tolerance` of
    :func:`pcm_match` is the final one. Memory O(n + m). The error of the grid is at most S (T - S)
    / (2 (offsets - 1)) for lengths S <= T.

    Examples
    --------
    >>> import curvewise
    >>> loop = [(0, 0), (1, 1), (2, 0), (3, 1)]
    >>> round(curvewise.pcm(loop, loop[1:3], offsets="continuous"), 9)
    0.0
    """
    return compiled_pcm(P, Q, (offsets,))


def pcm_match(P: CurveLike, Q: CurveLike, *, offsets: Offsets = 200) -> PcmMatch:
    """Return the partial curve mapping, with the place of the shorter curve.

    Parameters
    ----------
    P, Q, offsets
        As for :func:`pcm`.

    Returns
    -------
    PcmMatch
        ``value``, ``offset``, ``coverage`` (shorter length over longer), ``mapped`` ("P" or "Q",
        the shorter curve), ``points`` (for each of its vertices the point on the other curve,
        unscaled), and ``tolerance``. The last is a bound for the excess of ``value`` over the
        smallest area of all offsets. If a scaled length is beyond the range of a double, ``value``
        and ``tolerance`` are inf, ``offset`` and ``coverage`` are 0 and ``points`` are nan.

    Raises
    ------
    ValueError, TypeError
        As for :func:`pcm`.

    Notes
    -----
    As for :func:`pcm`.

    Examples
    --------
    >>> import curvewise
    >>> match = curvewise.pcm_match([(0, 0), (1, 0), (4, 0)], [(1, 0), (2, 0)])
    >>> match.mapped, match.coverage
    ('Q', 0.25)
    """
    p, q = as_curves(P, Q)
    found = compiled_pcm_match(p, q, {"offsets": offsets})
    return PcmMatch(*found, (copied(P, p), copied(Q, q)))
