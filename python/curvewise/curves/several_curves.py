"""One curve or several: what experiments are given as, and what a model returns."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import Any

import numpy as np

from .foreign_curves import is_curve_of_another_package
from .inputs import Array, as_curve, in_columns

__all__ = ["as_points", "curve_list", "digest", "points_of"]


def as_points(curve: Any, name: str) -> Array:
    """Return a curve as a float64 array of shape (n, d): (n, 1) for a series."""
    return in_columns(as_curve(curve, name))


def curve_list(curves: Any) -> list[Any]:
    """Return a list of curves for one curve or several.

    Anything with an array's `ndim` (DataFrames too) is one curve, or several if that is 3. Of a
    list, the first item that is there decides: a point or number, and the list is one curve.
    """
    ndim = getattr(curves, "ndim", None)
    if ndim is not None:
        return list(curves) if ndim == 3 else [curves]
    if not isinstance(curves, (list, tuple)):
        return [curves]
    for item in curves:
        if item is None or isinstance(item, BaseException):
            continue
        ndim = getattr(item, "ndim", None)
        if is_curve_of_another_package(item):
            is_curve = True
        elif ndim is None:
            is_curve = isinstance(item, (list, tuple)) and any(
                isinstance(point, (list, tuple, np.ndarray)) for point in item
            )
        else:
            is_curve = ndim == 2
        return list(curves) if is_curve else [curves]
    return list(curves) if curves else [curves]


def points_of(simulations: Any) -> tuple[Array, ...]:
    """Return copies of the curves that are there, each of shape (n, d)."""
    curves = curve_list(simulations)
    return tuple(as_points(curve, "Q").copy() for curve in curves if curve is not None)


def digest(curves: Iterable[Array]) -> str:
    """Return what tells these curves, by their shapes and their bits in float64, from any others.

    SHA-256.
    """
    found = hashlib.sha256()
    for curve in curves:
        found.update(repr(curve.shape).encode() + curve.astype(np.float64, copy=False).tobytes())
    return found.hexdigest()
