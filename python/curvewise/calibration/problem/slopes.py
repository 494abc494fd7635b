"""What a model says of its slopes: the derivatives of its curves by its parameters."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...curves.inputs import Array

__all__ = ["checked_slopes"]


def checked_slopes(found: Any, curves: int, parameters: int) -> list[Array]:
    """Return what ``jacobian`` of a model has returned as one array for every curve.

    Parameters
    ----------
    found : array_like, shape (n, d, p), or sequence of such
    curves, parameters : int
        How many there have to be.

    Raises
    ------
    ValueError
        There are others, or derivatives that are not finite.
    """
    by_curve = [found] if isinstance(found, np.ndarray) else list(found)
    slopes = [np.asarray(one, dtype=np.float64) for one in by_curve]
    shapes = [one.shape for one in slopes]
    if len(slopes) != curves or any(len(s) != 3 or s[2] != parameters for s in shapes):
        raise ValueError(
            f"jacobian of the model returned shapes {shapes}; return an array for each of {curves} "
            f"curves, (points, coordinates, {parameters}): derivatives by the parameters in the "
            "order of the dict that it is called with"
        )
    if not all(np.isfinite(one).all() for one in slopes):
        raise ValueError("jacobian of the model returned derivatives that are not finite")
    return slopes
