"""From what a user passes to the arrays that similaritymeasures would compute with.

Unlike the rest of curvewise, this module keeps the dtype of integer and float32 arrays. In
similaritymeasures, midpoints inserted in an integer curve are truncated and float32 curves are
computed in float32, which determines its numbers. :mod:`curvewise.curves.inputs` decides which
input is accepted.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ..curves.inputs import CurveLike, as_numbers

__all__ = ["RealArray", "plane_curve", "real_array", "vector"]

RealArray: TypeAlias = npt.NDArray[Any]
"""An array of integers or of floats of at most 64 bits."""


def real_array(values: CurveLike, name: str) -> RealArray:
    """Return `values` as an array of one or two dimensions that keeps its dtype.

    Booleans and extended precision become float64.
    """
    converted = as_numbers(values, name)
    array = np.asarray(values)
    return array if array.dtype.kind in "iuf" and array.dtype.itemsize <= 8 else converted


def plane_curve(values: CurveLike, name: str) -> RealArray:
    """Return a curve of shape (n, d) with n >= 1 and x and y in its first two columns."""
    curve = real_array(values, name)
    if curve.ndim != 2 or curve.shape[1] < 2:
        raise ValueError(
            f"{name} has shape {curve.shape}; give shape (n, 2), with x in column 0, y in column 1"
        )
    if len(curve) == 0:
        raise ValueError(f"{name} has shape {curve.shape}; it needs at least 1 point")
    return curve


def vector(values: CurveLike, name: str) -> RealArray:
    """Return one coordinate of all points, shape (n,) with n >= 1."""
    array = real_array(values, name)
    if array.ndim != 1 or len(array) == 0:
        raise ValueError(
            f"{name} has shape {array.shape}; give one coordinate of at least 1 point, shape (n,)"
        )
    return array
