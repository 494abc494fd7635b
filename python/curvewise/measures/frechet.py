"""The discrete Fréchet distance, a coupling that attains it, and its table.

Eiter & Mannila (1994). Time O(n m), memory O(n + m) except for the table.
"""

from __future__ import annotations

from typing import SupportsIndex

from .. import _core
from .._curves import Array, CurveLike, as_curves
from .._docstrings import filled
from .._options import Default, Metric, Order
from ..results import Alignment

__all__ = ["frechet", "frechet_path", "frechet_table"]


@filled()
def frechet(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = Default.metric,
    p: Order = Default.p,
    workers: SupportsIndex = Default.workers,
) -> float:
    """Discrete Fréchet distance: the shortest leash for two walks along the points.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    {metric}
    {p}
    {workers}

    Returns
    -------
    float
        In units of the ground distance. Symmetric. Not below the continuous Fréchet distance
        (except for "sqeuclidean"), and above it by at most the longest edge of either curve.

    Raises
    ------
    ValueError
        A curve is not finite or empty; the curves differ in d; an option is unknown or out of
        range.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Eiter & Mannila (1994): c[i, j] = max(d(P[i], Q[j]), min(c[i-1, j], c[i, j-1],
    c[i-1, j-1])). Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 3)])
    3.0
    """
    P, Q = as_curves(P, Q)
    return _core.frechet(P, Q, {"metric": metric, "p": p, "workers": workers})


def frechet_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = Default.metric,
    p: Order = Default.p,
    workers: SupportsIndex = Default.workers,
) -> Alignment:
    """Discrete Fréchet distance with a coupling that attains it.

    Parameters
    ----------
    P, Q, metric, p, workers
        As for :func:`frechet`.

    Returns
    -------
    Alignment
        ``distance`` and ``path``, shape (k, 2). Among equal predecessors the diagonal is taken,
        then (i-1, j), then (i, j-1). The largest ground distance along the path equals the
        distance to the bit.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet`.

    Notes
    -----
    As for :func:`frechet`, by divide and conquer over rows: up to three times the time of the
    distance, memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_path([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 3)]).path.tolist()
    [[0, 0], [1, 0], [2, 1]]
    """
    P, Q = as_curves(P, Q)
    return Alignment(*_core.frechet_path(P, Q, {"metric": metric, "p": p, "workers": workers}))


def frechet_table(
    P: CurveLike, Q: CurveLike, *, metric: Metric = Default.metric, p: Order = Default.p
) -> Array:
    """Return the cumulative table of the discrete Fréchet distance.

    Parameters
    ----------
    P, Q, metric, p
        As for :func:`frechet`.

    Returns
    -------
    ndarray, shape (n, m)
        c[i, j]: the distance between the first i + 1 points of P and the first j + 1 of Q.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet`.
    MemoryError
        The table does not fit.

    Notes
    -----
    As for :func:`frechet`. Time O(n m), memory 8 n m bytes.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_table([0, 1, 2], [0, 2]).tolist()
    [[0.0, 2.0], [1.0, 1.0], [2.0, 1.0]]
    """
    P, Q = as_curves(P, Q)
    return _core.frechet_table(P, Q, {"metric": metric, "p": p})
