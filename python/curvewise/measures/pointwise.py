"""Measures of curves of equal shape, and normalisation. Time O(n d)."""

from __future__ import annotations

from .._core import mae as compiled_mae
from .._core import mse as compiled_mse
from .._core import normalize as compiled_normalize
from .._core import sum_of_squares as compiled_sum_of_squares
from .._options import Missing
from ..curves.inputs import Array, CurveLike, as_curve, check_column_names, column_names
from ..curves.layouts import ask_about_curves
from ..curves.missing import skip_in_both

__all__ = ["mae", "mse", "normalize", "sum_of_squares"]


# Shared text: missing
def sum_of_squares(P: CurveLike, Q: CurveLike, *, missing: Missing = "refuse") -> float:
    """Compute the sum of squared differences of two curves of equal shape.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        In squared units of the curves. Symmetric.

    Raises
    ------
    ValueError
        If the shapes differ, or a curve is empty or not finite.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Eq. 1 of the paper. Time O(n d). With ``missing="skip"`` a point
    that one curve lacks is left out of both.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.sum_of_squares([1, 2, 3], [1, 3, 5])
    5.0
    """
    if missing != "refuse":
        P, Q = skip_in_both(P, Q, missing)
    return compiled_sum_of_squares(P, Q)


# Shared text: missing
def mse(P: CurveLike, Q: CurveLike, *, missing: Missing = "refuse") -> float:
    """Compute the mean squared difference of two curves of equal shape.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        In squared units of the curves. Symmetric.

    Raises
    ------
    ValueError, TypeError
        As for :func:`sum_of_squares`.

    Notes
    -----
    :func:`sum_of_squares` over n d. Time O(n d). With ``missing="skip"`` a point
    that one curve lacks is left out of both.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.mse([1, 2, 3, 4], [1, 3, 5, 4])
    1.25
    """
    if missing != "refuse":
        P, Q = skip_in_both(P, Q, missing)
    return compiled_mse(P, Q)


# Shared text: missing
def mae(P: CurveLike, Q: CurveLike, *, missing: Missing = "refuse") -> float:
    """Compute the mean absolute difference of two curves of equal shape.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    float
        In units of the curves. Symmetric.

    Raises
    ------
    ValueError, TypeError
        As for :func:`sum_of_squares`.

    Notes
    -----
    Time O(n d). With ``missing="skip"`` a point
    that one curve lacks is left out of both.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.mae([1, 2, 3, 4], [1, 3, 5, 4])
    0.75
    """
    if missing != "refuse":
        P, Q = skip_in_both(P, Q, missing)
    return compiled_mae(P, Q)


def normalize(P: CurveLike, *others: CurveLike) -> list[Array]:
    """Scale curves by P's bounding box, so that P lies in [0, 1].

    Parameters
    ----------
    P : array_like, shape (n, d) or (n,)
        The curve that defines the scale: its minimum is subtracted and its range divides (except
        for a coordinate in which it is constant).
    *others : array_like, shape (m, d) or (m,)
        Curves to scale in the same way.

    Returns
    -------
    list of ndarray
        P and the others, scaled, each in its original shape.

    Raises
    ------
    ValueError
        If a curve is empty, not finite, or differs from P in d or in the names of its columns.
    TypeError
        If a curve does not hold real numbers.

    Notes
    -----
    Section 2.1 of the paper. Time and memory O(n d) a curve.

    Examples
    --------
    >>> import curvewise
    >>> P, Q = curvewise.normalize([(0, 10), (2, 30)], [(1, 40)])
    >>> P.tolist(), Q.tolist()
    ([[0.0, 0.0], [1.0, 1.0]], [[0.5, 1.5]])
    """
    box = as_curve(P, "P")
    names = ["P", "Q"] if len(others) == 1 else ["P", *(f"others[{i}]" for i in range(len(others)))]
    for curve, name in zip(others, names[1:], strict=True):
        check_column_names(column_names(P), "P", column_names(curve), name)
    curves = [box, *(as_curve(curve, name) for curve, name in zip(others, names[1:], strict=True))]
    ask_about_curves(*curves)
    return [compiled_normalize(box, curve, name) for curve, name in zip(curves, names, strict=True)]
