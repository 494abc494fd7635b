"""A measure with its derivative by Q, for optimisers that follow gradients.

The path, the matching or the cuts that the value was found with are held, and what is left is
differentiated: O(n + m) beyond the value.
"""

from __future__ import annotations

from typing import Any, get_args

from .._core import value_and_gradient as compiled_value_and_gradient
from .._options import Differentiable, check_choice
from ..curves.inputs import Array, CurveLike, as_curves

__all__ = ["value_and_gradient"]


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
    measure : {"area", "curve_length", "dtw", "frechet", "sum_of_squares"}
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
    O(n + m) time and memory beyond the value; beyond the path for dtw and frechet. Exact where the
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
