"""The exact continuous Fréchet distance, its matching, and its decisions.

The free-space diagram of Alt & Godau (1995), searched with the filters and boxes of Bringmann,
Künnemann & Nusser (2019). Near-linear time for similar curves, memory O(n + m).
"""

from __future__ import annotations

import math
from typing import Literal, SupportsFloat, SupportsIndex, overload

from .._core import (
    closed_frechet_continuous,
    closed_frechet_continuous_bounds,
    closed_frechet_continuous_path,
)
from .._core import frechet_continuous as compiled_frechet_continuous
from .._core import frechet_continuous_bounds as compiled_frechet_continuous_bounds
from .._core import frechet_continuous_part as compiled_frechet_continuous_part
from .._core import frechet_continuous_path as compiled_frechet_continuous_path
from .._core import frechet_within as compiled_frechet_within
from .._options import real_number
from ..curves.inputs import CurveLike, as_curves
from ..curves.named_curve import copied, renamed
from .closed import around
from .results import Matching

__all__ = [
    "frechet_continuous",
    "frechet_continuous_part",
    "frechet_continuous_path",
    "frechet_within",
]


@overload
def frechet_continuous(
    P: CurveLike,
    Q: CurveLike,
    *,
    bounds: Literal[False] = False,
    workers: SupportsIndex = 1,
    closed: bool = False,
) -> float: ...


@overload
def frechet_continuous(
    P: CurveLike,
    Q: CurveLike,
    *,
    bounds: Literal[True],
    workers: SupportsIndex = 1,
    closed: bool = False,
) -> tuple[float, float]: ...


# Shared text: workers, closed
def frechet_continuous(
    P: CurveLike,
    Q: CurveLike,
    *,
    bounds: bool = False,
    workers: SupportsIndex = 1,
    closed: bool = False,
) -> float | tuple[float, float]:
    """Compute the continuous Fréchet distance between two curves.

    The curves are polygonal: the points and the straight edges between them. Unlike
    :func:`frechet`, which pairs points, it does not depend on the sampling of a curve: a straight
    line with two points and the same line with 200 have distance 0.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    bounds : bool, default False
        Whether to return both ends of the interval that contains the distance.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.
    closed : bool, default False
        Whether both curves are closed, so that their first points do not matter. See Notes.

    Returns
    -------
    float, or tuple of two floats
        The distance in units of the coordinates, rounded up to the next double. With `bounds`, the
        distance rounded down, and the distance rounded up: they are equal or neighbours. Symmetric.
        Not above :func:`frechet` before that is rounded, and below it by at most the longest edge
        of either curve. inf if it is beyond the range of a double.

    Raises
    ------
    ValueError
        If a curve is not finite or empty, the curves differ in d, or an option is out of range.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Exact, rounded up to the next double: decisions that rounded arithmetic cannot make use
    integers. This holds for curves of any length and any distance from the origin. Alt & Godau
    (1995), with the filters and boxes of Bringmann, Künnemann & Nusser (2019). Time about O((n + m)
    log(n + m)) for similar curves, about 60 n m steps at worst; memory O(n + m). One thread
    searches one pair, whatever `workers` is; :func:`cdist` and :func:`pdist` share pairs.

    ``closed=True``: the last point of each curve is joined to its first one, unless they are equal.
    Walks go once around both curves, and return to the points at which they began. The value is the
    smallest over all beginnings, which may lie on edges. It is exact and symmetric too. A decision
    is a walk from a free point of the first row to the point one turn behind it, in the diagram of
    P and twice Q. Time about three times that of the open distance for similar curves, and 10 to 60
    times if large parts of the diagram are free; memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_continuous([(0, 0), (10, 0)], [(0, 0), (7, 0), (3, 0), (10, 0)])
    2.0
    >>> square, other = [(0, 0), (2, 0), (2, 2), (0, 2)], [(1, 0), (2, 0), (2, 2), (0, 2), (0, 0)]
    >>> curvewise.frechet_continuous(square, other, closed=True)
    0.0
    """
    if not (bounds or closed):
        return compiled_frechet_continuous(P, Q, (workers,))
    P, Q = as_curves(P, Q)
    options = {"workers": workers}
    if bounds:
        both = closed_frechet_continuous_bounds if closed else compiled_frechet_continuous_bounds
        return both(P, Q, options)
    return closed_frechet_continuous(P, Q, options)


# Signature: frechet_continuous without bounds
def frechet_continuous_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    workers: SupportsIndex = 1,
    closed: bool = False,
) -> Matching:
    """Compute the continuous Fréchet distance with two walks that attain it.

    Parameters
    ----------
    P, Q, workers, closed
        As for :func:`frechet_continuous`.

    Returns
    -------
    Matching
        ``distance`` and ``parameters``, shape (k, 2): vertex index plus fraction on P and on Q,
        from (0, 0) to (n - 1, m - 1), neither ever decreasing. The pair distance never exceeds
        ``distance``. ``distance`` is :func:`frechet_continuous`, or above it by the few units in
        the last place that the rounding of the parameters requires.

        For closed curves of n and m points, without a last one that equals the first, ``curves``
        are P once around and Q twice. The parameters lead from (0, t) to (n, t + m). t is the point
        of Q nearest to P[0] if that attains the distance.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet_continuous`.

    Notes
    -----
    Of all such walks, one on which the curves stay close. It is traced backwards from the end, by
    the nearest point of the sides through which each cell can be entered. About twice the time of
    the distance; memory O(n + m) for the walks, and sqrt(n) times the separate parts of a row of
    the free-space diagram.

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
    if closed:
        found = closed_frechet_continuous_path(p, q, {"workers": workers})
        return Matching(*found, (renamed(P, around(p, 1)), renamed(Q, around(q, 2))))
    found = compiled_frechet_continuous_path(p, q, {"workers": workers})
    return Matching(*found, (copied(P, p), copied(Q, q)))


def frechet_continuous_part(P: CurveLike, Q: CurveLike, *, workers: SupportsIndex = 1) -> Matching:
    """Find the section of Q nearest to P by the continuous Fréchet distance.

    The section begins and ends at any points of Q, also between vertices. For sections from vertex
    to vertex by the discrete distance, see :func:`subsequence`.

    Parameters
    ----------
    P, Q, workers
        As for :func:`frechet_continuous`.

    Returns
    -------
    Matching
        ``distance`` and ``parameters`` as those of :func:`frechet_continuous_path`, except that the
        parameters on Q begin and end with the section: ``parameters[0, 1]`` and
        ``parameters[-1, 1]``. ``distance`` is the least of all sections, or above it by the few
        units in the last place that the rounding of the parameters requires.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet_continuous`.

    Notes
    -----
    Paths through the free-space diagram begin anywhere in its first row, and end anywhere in its
    last one (Alt & Godau, 1995). Exact: decisions that rounded arithmetic cannot make use integers.
    Of several sections, one whose end is nearest to the end of P. Not symmetric. Time a few walks
    through the diagram, at worst about 60, O(n m) each; memory O(n + m) for the walks, and sqrt(n)
    times the separate parts of a row of the diagram.

    Examples
    --------
    >>> import curvewise
    >>> road = [(0, 0), (10, 0), (10, 10)]
    >>> found = curvewise.frechet_continuous_part([(2.5, 0), (10, 0), (10, 5)], road)
    >>> found.distance, found.parameters[[0, -1], 1].tolist()
    (0.0, [0.25, 1.5])
    """
    p, q = as_curves(P, Q)
    found = compiled_frechet_continuous_part(p, q, {"workers": workers})
    return Matching(*found, (copied(P, p), copied(Q, q)))


def frechet_within(
    P: CurveLike, Q: CurveLike, distance: SupportsFloat, *, continuous: bool = True
) -> bool:
    """Return whether the Fréchet distance is at most a given number.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    distance : float
        The number, at least 0.
    continuous : bool, default True
        Whether to use the continuous distance, or the discrete one, Euclidean.

    Returns
    -------
    bool
        The exact decision for the real number. (:func:`frechet` is rounded, and may lie below the
        real number; :func:`frechet_continuous` never does.)

    Raises
    ------
    ValueError
        If `distance` is below 0 or nan, a curve is not finite or empty, or the curves differ in d.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Faster than the distance: one walk through the free-space diagram, and even less if ends or
    bounding boxes of the curves are too far apart. Time about O((n + m) log(n + m)) for similar
    curves, O(n m) at worst; memory O(n + m).

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
