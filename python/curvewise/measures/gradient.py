"""A measure with its derivatives by one curve or by both, for optimisers that follow gradients.

The path, the matching or the cuts that the value was found with are held, and what is left is
differentiated: O(n + m) beyond the value.
"""

from __future__ import annotations

from typing import Any, SupportsIndex, get_args

import numpy as np
import numpy.typing as npt

from .._core import value_and_gradient as compiled_value_and_gradient
from .._core import values_and_gradients as compiled_values_and_gradients
from .._options import Default, Differentiable, check_choice
from ..curves.inputs import Array, CurveLike, as_curves

__all__ = ["value_and_gradient", "values_and_gradients"]


def value_and_gradient(
    P: CurveLike, Q: CurveLike, measure: Differentiable = "dtw", **options: Any
) -> tuple[float, Array]:
    """Return a measure and its derivative by every coordinate of Q.

    By the chain rule, the derivatives of a model's curve by its parameters then give those of the
    measure: ``numpy.einsum("jc,jck->k", gradient, dQ)`` for dQ of shape (m, d, k).

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d), or (n,) and (m,)
        The curves, as the measure takes them.
    measure : {"area", "curve_length", "dtw", "frechet", "soft_dtw", "sum_of_squares"}
        The measure.
    **options
        Its options; of area not ``spacing="arc_length"``.

    Returns
    -------
    value : float
        The measure, to rounding what its own function returns.
    gradient : ndarray, in Q's shape
        The derivative of the value by every coordinate of Q.

    Raises
    ------
    ValueError, TypeError
        As for the measure; a measure that has no gradient here; options of sum_of_squares.

    Notes
    -----
    O(n + m) time and memory beyond the value; beyond the path for dtw and frechet; of soft_dtw up
    to three times the time of its value, and O(n sqrt(m)) memory. soft_dtw has a derivative
    everywhere; those of the others are exact where the
    path, the cuts of the refinement and the order of corners do not change at once: dtw and
    frechet are optima over paths, whose derivative is that with the path held (the envelope
    theorem). There is no derivative

    - at ties: two paths that cost the same (dtw), two pairs of points that are furthest apart
      (frechet), two segments that are longest (area), two paths, or equal points of Q (area with
      ``spacing="matched"``), two points of Q with the largest abs(x) or abs(y), or a place that
      lies on a vertex of Q (curve_length);
    - where matched points coincide or a difference is 0, except for squares: a kink, as of abs(x).

    There the result is the derivative to one side, or 0 for a term that vanishes. The gradient of
    frechet is 0 except at one point of Q, and jumps when another pair decides. area jumps with
    ``crossing="rearrange"`` where quadrilaterals turn complex; "split" does not. `cutoff` is not
    looked at.

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


def values_and_gradients(
    P: npt.ArrayLike,
    Q: npt.ArrayLike,
    measure: Differentiable = "dtw",
    *,
    workers: SupportsIndex = Default.workers,
    **options: Any,
) -> tuple[Array, Array, Array]:
    """Return a measure of many pairs, and its derivatives by every coordinate of both curves.

    Parameters
    ----------
    P, Q : array_like, shapes (b, n, d) and (b, m, d)
        The curves, pair by pair.
    measure : {"area", "curve_length", "dtw", "frechet", "soft_dtw"}
        The measure.
    workers : int
        Threads for this call, each with a pair at a time: at least 1, or -1 for one per core. Never
        changes the result.
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
        As for the measure, naming the pair; shapes that do not make pairs; a measure that has no
        gradient here.

    Notes
    -----
    Derivatives are those of :func:`value_and_gradient`, with its notes on where there are none: at
    ties those by P and by Q are of the same path, or of the same pair of points. Time as there for
    each pair; memory O(b (n + m) d) beside what each thread takes for its pair. Arrays of float64
    in C order are not copied.

    Examples
    --------
    >>> import numpy as np
    >>> import curvewise
    >>> P, Q = np.array([[[0.0], [1.0], [2.0]]]), np.array([[[0.5], [1.25], [4.0]]])
    >>> values, by_P, by_Q = curvewise.values_and_gradients(P, Q)
    >>> values.tolist(), by_P.ravel().tolist(), by_Q.ravel().tolist()
    ([2.75], [-1.0, -1.0, -1.0], [1.0, 1.0, 1.0])
    """
    check_choice("measure", measure, BY_BOTH_CURVES)
    first, second = np.asarray(P), np.asarray(Q)
    if first.ndim != 3 or second.ndim != 3 or len(first) != len(second):
        raise ValueError(
            f"P has shape {first.shape} and Q has shape {second.shape}; give as many curves of "
            "each, in arrays of shapes (b, n, d) and (b, m, d)"
        )
    for k in range(min(1, len(first))):  # all pairs have the shapes of the first
        as_curves(first[k], second[k])
    found = compiled_values_and_gradients(measure, first, second, options, True, True, workers)
    return found  # type: ignore[return-value]  # both are asked for


# All that have derivatives except the plain sum, which numpy has by itself.
BY_BOTH_CURVES = tuple(name for name in get_args(Differentiable) if name != "sum_of_squares")
