"""Nelder-Mead simplex search within bounds, restarted until it gains nothing.

It restarts scipy's simplex. A simplex may collapse at a point that is not a minimum, most often at
the kinks of an objective that sums absolute values or takes a maximum. A new simplex in other
directions lets the search continue. The search is local and suits few parameters: up to 10, better
5.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..._extras import required
from ...curves.inputs import Array

__all__ = ["nelder_mead"]


def nelder_mead(
    function: Callable[[Array], float],
    start: Array,
    box: tuple[Array, Array],
    random: np.random.Generator,
    *,
    negligible: float,
    size: float,
    restarts: int,
    **options: Any,
) -> tuple[Array, bool, str]:
    """Minimise a function; return the minimiser, convergence, and message.

    Parameters
    ----------
    function : callable
        A function of a point, shape (k,).
    start : ndarray
        The starting point.
    box : (low, high)
        The bounds of the search.
    random : numpy.random.Generator
        Draws the directions of the simplices after the first, which has those of the axes.
    negligible : float
        Gains below ten times this do not count.
    size : float
        Length of the edges of a fresh simplex.
    restarts : int
        The most fresh simplices after the first; two in a row that gain nothing end the search.
    **options
        Options of scipy's Nelder-Mead.
    """
    minimize = required("scipy.optimize").minimize
    k = start.size
    low, high = box
    best, value = start, function(start)
    idle = 0
    for restart in range(1 + restarts):
        directions = np.eye(k) if restart == 0 else np.linalg.qr(random.normal(size=(k, k)))[0]
        # Inwards: of the two ends of an edge the one nearer to the middle.
        outwards = directions @ (best - (low + high) / 2) > 0
        directions *= np.where(outwards, -size, size)[:, np.newaxis]
        simplex = np.clip(np.vstack((best, best + directions)), low, high)
        result = minimize(
            function,
            best,
            method="Nelder-Mead",
            bounds=list(zip(low, high, strict=True)),
            options={"adaptive": k > 3, **options, "initial_simplex": simplex},
        )
        gained = value - result.fun
        if gained > 0:
            best, value = result.x, float(result.fun)
        idle = 0 if gained > max(10.0 * negligible, 1e-3 * value) else idle + 1
        if value <= 10.0 * negligible or idle == 2:
            break
    return best, bool(result.success), str(result.message)
