"""Measures with derivatives, for gradient-based optimisers.

The path, the matching or the cuts of the value are fixed, and the remaining expression is
differentiated: O(n + m) beyond the value.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, SupportsIndex, get_args

import numpy as np
import numpy.typing as npt

from .._core import value_and_gradient as compiled_value_and_gradient
from .._core import values_and_gradients as compiled_values_and_gradients
from .._options import Differentiable, check_choice
from ..curves.inputs import Array, CurveLike, as_curves
from ..curves.layouts import ask_about_curves

__all__ = ["BY_BOTH_CURVES", "value_and_gradient", "values_and_gradients"]

# All that have derivatives except the plain sum, which numpy has by itself.
BY_BOTH_CURVES = tuple(name for name in get_args(Differentiable) if name != "sum_of_squares")

# The messages of the modules for other packages' arrays about missing derivatives.
NO_DERIVATIVE_OF_PCM = (
    "pcm has no derivative: which curve is mapped, and where, is the best of a row of offsets, and "
    "it jumps where another is; take area(spacing='matched') or curve_length"
)
NO_SECOND_DERIVATIVE = (
    "curvewise's measures have first derivatives only; leave out create_graph=True, or use a "
    "method without second derivatives"
)


# Shared text: measure(differentiable)
def value_and_gradient(
    P: CurveLike, Q: CurveLike, measure: Differentiable = "dtw", **options: Any
) -> tuple[float, Array]:
    """Return a measure and its derivative by every coordinate of Q.

    By the chain rule, a model's Jacobian turns this into the measure's derivative by the
    parameters: ``numpy.einsum("jc,jck->k", gradient, dQ)`` for dQ of shape (m, d, k).

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d), or (n,) and (m,)
        The curves, as the measure takes them.
    measure : str
        The name of the measure: "area", "curve_length", "dtw", "frechet", "frechet_continuous",
        "soft_dtw", "sum_of_squares".
    **options
        Options of the measure; for area not ``spacing="arc_length"`` and "function", nor
        ``closed=True``.

    Returns
    -------
    value : float
        The measure, equal to its function's value up to rounding.
    gradient : ndarray, in Q's shape
        The derivative of the value by every coordinate of Q.

    Raises
    ------
    ValueError, TypeError
        As for the measure; if the measure's gradient is not available, or an option of
        sum_of_squares is given.

    Notes
    -----
    O(n + m) time and memory beyond the value; beyond the path for dtw, frechet and
    frechet_continuous, and twice the path at ties of the last two. The measure `soft_dtw` takes up
    to three times the time of its value, and O(n sqrt(m)) memory. It has a derivative everywhere.
    The derivatives of the others are exact if the path, the cuts of the refinement and the order of
    corners do not change at once. Both `dtw` and `frechet` are optima over paths, whose derivative
    is that for a fixed path (the envelope theorem). The derivative of frechet and of
    frechet_continuous is that of the pair of points, or the critical event, that decides the value.
    Derivatives do not exist

    - at a tie of dtw: two paths of equal cost;
    - at a tie of frechet or frechet_continuous: two pairs of points, or two critical events, that
      could each decide;
    - at a tie of area: two longest segments; with ``spacing="matched"`` two paths, or equal points
      of Q;
    - at a tie of curve_length: two points of Q with the largest abs(x) or abs(y), a place on a
      vertex of Q, or equal neighbours;
    - where matched points coincide or a difference is 0, except for squares: a kink, as of abs(x).

    At such places the result is the derivative to one side, or 0 for a term that vanishes. At a tie
    of frechet or frechet_continuous it is the derivative of nearby curves, whose points are moved
    by at most 2^-30 of the value. It is an element of Clarke's generalised gradient. The gradient
    of frechet is 0 except at one point of Q, and jumps when another pair decides. The area with
    ``crossing="rearrange"`` jumps when quadrilaterals become complex; "split" does not. The option
    `cutoff` is ignored.

    Examples
    --------
    >>> import curvewise
    >>> value, gradient = curvewise.value_and_gradient([0.0, 1.0, 2.0], [0.5, 1.25, 4.0])
    >>> value, gradient.round(6).tolist()
    (2.75, [1.0, 1.0, 1.0])
    """
    P, Q = as_curves(P, Q)
    check_choice("measure", measure, get_args(Differentiable))
    if measure == "sum_of_squares" and options:
        raise TypeError(f"sum_of_squares has no options, but {', '.join(options)} given")
    return compiled_value_and_gradient(measure, P, Q, options)


# Shared text: measure(by_both_curves), workers
def values_and_gradients(
    P: npt.ArrayLike,
    Q: npt.ArrayLike,
    measure: Differentiable = "dtw",
    *,
    workers: SupportsIndex = 1,
    **options: Any,
) -> tuple[Array, Array, Array]:
    """Return a measure of many pairs, and its derivatives by both curves.

    Parameters
    ----------
    P, Q : array_like, shapes (b, n, d) and (b, m, d)
        The curves, pair by pair.
    measure : str
        The name of the measure: "area", "curve_length", "dtw", "frechet", "frechet_continuous",
        "soft_dtw".
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.
    **options
        As for :func:`value_and_gradient`.

    Returns
    -------
    values : ndarray, shape (b,)
        The measure of every pair.
    by_P, by_Q : ndarray, shapes (b, n, d) and (b, m, d)
        The derivatives of ``values[k]`` by the coordinates of ``P[k]`` and of ``Q[k]``.

    Raises
    ------
    ValueError, TypeError
        As for the measure, naming the pair. If shapes do not make pairs, or the measure's gradient
        is not available.

    Notes
    -----
    Derivatives, and the places where they do not exist, are those of :func:`value_and_gradient`. At
    ties, the derivatives by P and by Q belong to the same path, or to the same pair of points. Time
    as for that function for each pair, of one thread per pair; memory O(b (n + m) d), plus that of
    the pairs of all threads. Arrays of float64 in C order are not copied.

    Examples
    --------
    >>> import numpy as np
    >>> import curvewise
    >>> P, Q = np.array([[[0.0], [1.0], [2.0]]]), np.array([[[0.5], [1.25], [4.0]]])
    >>> values, by_P, by_Q = curvewise.values_and_gradients(P, Q)
    >>> values.tolist(), by_P.ravel().round(6).tolist(), by_Q.ravel().round(6).tolist()
    ([2.75], [-1.0, -1.0, -1.0], [1.0, 1.0, 1.0])
    """
    check_choice("measure", measure, BY_BOTH_CURVES)
    first, second = np.asarray(P), np.asarray(Q)
    if first.ndim != 3 or second.ndim != 3:
        raise ValueError(
            f"P has shape {first.shape} and Q has shape {second.shape}; give arrays of shapes "
            "(b, n, d) and (b, m, d)"
        )
    ask_about_curves(first, second)
    values, by_P, by_Q = of_arrays(first, second, measure, options, workers=workers)
    return values, by_P, by_Q


def check_pairs(P: tuple[int, ...], Q: tuple[int, ...]) -> None:
    """Refuse shapes that are not (..., n, d) and (..., m, d)."""
    shapes = f"P has shape {P} and Q has shape {Q}"
    if len(P) < 2 or len(P) != len(Q) or P[:-2] != Q[:-2]:
        raise ValueError(
            f"{shapes}; give as many curves of each, of shapes (n, d) and (m, d), or (b, n, d) and "
            "(b, m, d)"
        )
    if P[-1] != Q[-1]:
        raise ValueError(f"{shapes}; both need the same number of coordinates")


def of_arrays(
    P: npt.NDArray[Any],
    Q: npt.NDArray[Any],
    measure: str,
    options: Mapping[str, Any],
    *,
    by: tuple[bool, bool] = (True, True),
    workers: SupportsIndex = -1,
) -> tuple[Array, Array, Array]:
    """Return the same of arrays of shapes (..., n, d) and (..., m, d), for other packages' arrays.

    A derivative that is not requested is an array without entries.
    """
    check_pairs(P.shape, Q.shape)
    pairs = P.shape[:-2]
    count = math.prod(pairs)  # reshape(-1) does not know it of curves without points
    first, second = (C.reshape(count, *C.shape[-2:]) for C in (P, Q))
    for k in range(min(1, len(first))):  # all pairs have the shapes of the first
        as_curves(first[k], second[k])
    values, *found = compiled_values_and_gradients(
        measure, first, second, dict(options), *by, workers
    )
    by_P, by_Q = (
        np.empty((*pairs, 0, 0)) if gradient is None else gradient.reshape(curves.shape)
        for gradient, curves in zip(found, (P, Q), strict=True)
    )
    return values.reshape(pairs), by_P, by_Q
