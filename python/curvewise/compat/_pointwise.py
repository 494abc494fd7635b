"""Mean errors between curves of equal shape, in similaritymeasures' names. O(n·d)."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..curves.inputs import CurveLike
from ._arrays import RealArray, real_array

__all__ = ["mae", "mse"]


def mae(exp_data: CurveLike, num_data: CurveLike) -> np.floating[Any]:
    """Compute the mean absolute error over all coordinates of all points.

    Parameters
    ----------
    exp_data, num_data : array_like, shapes (n, d) and (n, d)
        The curves. Shapes that numpy broadcasts to each other are accepted, as there.

    Returns
    -------
    r : numpy floating
        The mean of abs(exp_data − num_data), in the units of the coordinates; nan without entries.

    Raises
    ------
    ValueError
        If the shapes, or the labels of two pandas objects, differ.
    TypeError
        If input is complex, text, objects or masked.

    Notes
    -----
    O(n·d) time and memory. Integer arrays are subtracted as integers.

    Examples
    --------
    >>> from curvewise.compat import mae
    >>> float(mae([[0.0, 0.0], [1.0, 1.0]], [[0.0, 1.0], [1.0, 3.0]]))
    0.75
    """
    return _mean(np.abs(_differences(exp_data, num_data, "mae")))


def mse(exp_data: CurveLike, num_data: CurveLike) -> np.floating[Any]:
    """Compute the mean squared error over all coordinates of all points.

    Parameters
    ----------
    exp_data, num_data : array_like, shapes (n, d) and (n, d)
        The curves. Shapes that numpy broadcasts to each other are accepted, as there.

    Returns
    -------
    r : numpy floating
        The mean of (exp_data − num_data)², in squared units; nan without entries.

    Raises
    ------
    ValueError
        If the shapes, or the labels of two pandas objects, differ.
    TypeError
        If input is complex, text, objects or masked.

    Notes
    -----
    O(n·d) time and memory. Integer arrays are subtracted and squared as integers.

    Examples
    --------
    >>> from curvewise.compat import mse
    >>> float(mse([[0.0, 0.0], [1.0, 1.0]], [[0.0, 1.0], [1.0, 3.0]]))
    1.25
    """
    with np.errstate(over="ignore"):
        return _mean(np.square(_differences(exp_data, num_data, "mse")))


def _differences(exp_data: Any, num_data: Any, measure: str) -> RealArray:
    if hasattr(exp_data, "iloc") and hasattr(num_data, "iloc"):
        _check_labels(exp_data, num_data)
    experiment, simulation = real_array(exp_data, "exp_data"), real_array(num_data, "num_data")
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            difference: RealArray = experiment - simulation
    except ValueError as error:
        raise ValueError(
            f"exp_data has shape {experiment.shape} and num_data has shape {simulation.shape}; "
            f"{measure} needs equal shapes"
        ) from error
    return difference


def _check_labels(exp_data: Any, num_data: Any) -> None:
    # pandas subtracts label by label, an array row by row: where the two differ, neither is safe.
    labels = [[list(axis) for axis in data.axes] for data in (exp_data, num_data)]
    if labels[0] != labels[1]:
        raise ValueError(
            "exp_data and num_data have different row or column labels; "
            "give exp_data.to_numpy() and num_data.to_numpy() to compare them by position"
        )


def _mean(errors: RealArray) -> np.floating[Any]:
    with np.errstate(over="ignore", invalid="ignore"):
        mean: np.floating[Any] = np.mean(errors) if errors.size else np.float64(np.nan)
    return mean
