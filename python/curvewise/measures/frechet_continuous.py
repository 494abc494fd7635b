"""The continuous Fréchet distance, certified; a matching that attains it; and decisions about it.

The free-space diagram of Alt & Godau (1995), searched by filters and boxes in the way of Bringmann,
Künnemann & Nusser (2019). Near-linear time for curves that are alike, memory O(n + m).
"""

from __future__ import annotations

import math
from typing import Literal, SupportsFloat, SupportsIndex, overload

from .._core import frechet_continuous as compiled_frechet_continuous
from .._core import frechet_continuous_bounds as compiled_frechet_continuous_bounds
from .._core import frechet_continuous_path as compiled_frechet_continuous_path
from .._core import frechet_within as compiled_frechet_within
from .._docstrings import filled
from .._options import Default, real_number
from ..curves.inputs import CurveLike, as_curves
from ..curves.named_curve import copied
from .results import Matching

__all__ = ["frechet_continuous", "frechet_continuous_path", "frechet_within"]


@overload
def frechet_continuous(
    P: CurveLike,
    Q: CurveLike,
    *,
    bounds: Literal[False] = False,
    workers: SupportsIndex = Default.workers,
) -> float: ...


@overload
def frechet_continuous(
    P: CurveLike, Q: CurveLike, *, bounds: Literal[True], workers: SupportsIndex = Default.workers
) -> tuple[float, float]: ...


@filled()
def frechet_continuous(
    P: CurveLike,
    Q: CurveLike,
    *,
    bounds: bool = False,
    workers: SupportsIndex = Default.workers,
) -> float | tuple[float, float]:
    """Continuous Fréchet distance: the shortest leash for two walks along the curves themselves.

    The curves are polygonal: the points and the straight edges between them. Unlike
    :func:`frechet`, which walks from point to point, it does not depend on how a curve was
    sampled: a straight line with two points and the same with 200 have distance 0.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    bounds : bool, default False
        Return both ends of the interval that holds the distance.
    {workers}

    Returns
    -------
    float, or tuple of two floats
        The least double that is not below the distance, in units of the coordinates; with
        `bounds`, the greatest double that is not above it, and that: they are equal or
        neighbours. Symmetric. Not above :func:`frechet` before that is rounded, and below it by
        at most the longest edge of either curve. inf where it is beyond the range of a double.

    Raises
    ------
    ValueError
        A curve is not finite or empty; the curves differ in d; an option is out of range.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Certified: whatever rounded arithmetic cannot decide is decided in whole numbers, so that the
    value is that of the real number however long the curves are and however far from the origin.
    Alt & Godau (1995), with the filters and boxes of Bringmann, Künnemann & Nusser (2019). Time
    about O((n + m) log(n + m)) for curves that are alike, some 60 n m steps at worst; memory
    O(n + m). One pair is searched by one thread, whatever `workers` says; :func:`cdist` and
    :func:`pdist` share pairs.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_continuous([(0, 0), (10, 0)], [(0, 0), (7, 0), (3, 0), (10, 0)])
    2.0
    """
    if not bounds:
        return compiled_frechet_continuous(P, Q, (workers,))
    return compiled_frechet_continuous_bounds(*as_curves(P, Q), {"workers": workers})


def frechet_continuous_path(
    P: CurveLike, Q: CurveLike, *, workers: SupportsIndex = Default.workers
) -> Matching:
    """Continuous Fréchet distance with two walks that attain it.

    Parameters
    ----------
    P, Q, workers
        As for :func:`frechet_continuous`.

    Returns
    -------
    Matching
        ``distance`` and ``parameters``, shape (k, 2): vertex index plus fraction on P and on Q,
        from (0, 0) to (n - 1, m - 1), neither ever decreasing. The leash is nowhere above
        ``distance``, which is :func:`frechet_continuous`, or above it by the few units in the
        last place that the rounding of the parameters takes.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet_continuous`.

    Notes
    -----
    Of all such walks one that keeps to where the curves are close: backwards from the end, the
    nearest point of the sides by which each cell can have been entered. About twice the time of
    the distance; memory O(n + m) for the walks, and sqrt(n) times what a row of the free-space
    diagram holds of separate pieces.

    Examples
    --------
    >>> import curvewise
    >>> found = curvewise.frechet_continuous_path([(0, 0), (2, 0)], [(0, 1), (1, 1), (2, 1)])
    >>> found
    Matching(distance=1.0, parameters=<array of shape (3, 2)>)
    >>> found.parameters.tolist()
    [[0.0, 0.0], [0.5, 1.0], [1.0, 2.0]]
    """
    p, q = as_curves(P, Q)
    found = compiled_frechet_continuous_path(p, q, {"workers": workers})
    return Matching(*found, (copied(P, p), copied(Q, q)))


def frechet_within(
    P: CurveLike, Q: CurveLike, distance: SupportsFloat, *, continuous: bool = True
) -> bool:
    """Whether the Fréchet distance is at most a number.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    distance : float
        The number, at least 0.
    continuous : bool, default True
        Whether the continuous distance is meant, or the discrete one, Euclidean.

    Returns
    -------
    bool
        Certified: it is of the real number. (:func:`frechet` is rounded, and may lie below the
        real number; :func:`frechet_continuous` never does.)

    Raises
    ------
    ValueError
        `distance` is below 0 or nan; a curve is not finite or empty; the curves differ in d.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Faster than the distance: one walk through the free-space diagram, or none where ends or boxes
    of the curves are too far apart. Time about O((n + m) log(n + m)) for curves that are alike,
    O(n m) at worst; memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> P, Q = [(0, 0), (10, 0)], [(0, 0), (7, 0), (3, 0), (10, 0)]
    >>> curvewise.frechet_within(P, Q, 2), curvewise.frechet_within(P, Q, 1.9999)
    (True, False)
    """
    P, Q = as_curves(P, Q)
    radius = real_number("distance", distance, -math.inf, "give a number >= 0")
    return compiled_frechet_within(P, Q, radius, bool(continuous))
