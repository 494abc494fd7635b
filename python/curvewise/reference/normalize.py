"""Curves scaled by the bounding box of the first. Time and memory O(n d) a curve."""

from __future__ import annotations

from ..curves.inputs import Array, CurveLike, as_curve, check_column_names, column_names
from ..curves.scaling import box_scaled
from .checks import check_pair

__all__ = ["normalize"]


def normalize(P: CurveLike, *others: CurveLike) -> list[Array]:
    """Section 2.1 of the paper. Time and memory O(n d) a curve."""
    names = ["P", "Q"] if len(others) == 1 else ["P", *(f"others[{i}]" for i in range(len(others)))]
    for curve, name in zip(others, names[1:], strict=True):
        check_column_names(column_names(P), "P", column_names(curve), name)
    given = [as_curve(curve, name) for curve, name in zip((P, *others), names, strict=True)]
    scaled = []
    for curve, name in zip(given, names, strict=True):
        P, points = check_pair(given[0], curve, "normalize", name=name)
        scaled.append(box_scaled(points, P).reshape(curve.shape))
    return scaled
