"""Figures of two curves and what links them, where the curves may be unknown.

They draw the path or the points that they are given, and compute nothing again. Time and memory
O(n + m).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array
from ..curves.named_curve import Labels, labels_of
from .figures import legend_above, new_figure
from .links import draw_matching, draw_path, draw_placement, draw_walk

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["alignment_figure", "matching_figure", "placement_figure"]

Curves: TypeAlias = tuple[Array, Array] | None


def alignment_figure(curves: Curves, path: npt.NDArray[np.int64]) -> Picture:
    """Draw curves and the pairs of a path, or the path alone."""
    return _linked(curves, path, draw_path, "index in")


def matching_figure(curves: Curves, walks: Array) -> Picture:
    """Draw curves and the pairs of two walks along them, or the walks alone."""
    return _linked(curves, walks, draw_matching, "vertex of")


def placement_figure(
    curves: tuple[Array, Array], mapped: str, offset: float, points: Array
) -> Picture:
    """Draw curves and where one of them has been placed on the other."""
    figure = new_figure(figsize=(6.4, 4.4), layout="constrained")
    ax = figure.subplots()
    draw_placement(ax, curves, mapped, offset, points, labels_of(2, None, *curves))
    legend_above(figure, ax)
    return figure


def _linked(
    curves: Curves, links: npt.NDArray[Any], draw: Callable[..., object], place: str
) -> Picture:
    """Draw curves with links between them; alone where the curves are unknown, or d is above 2."""
    columns = [curve.reshape(len(curve), -1) for curve in curves or ()]
    dim = columns[0].shape[1] if columns else 0
    size = {1: (9.0, 3.4), 2: (6.4, 4.4)}.get(dim, (4.4, 4.4))
    figure = new_figure(figsize=size, layout="constrained")
    ax = figure.subplots()
    labels = labels_of(dim, None, *curves) if curves else Labels(())
    if dim in (1, 2):
        draw(ax, columns, links, labels)
    else:
        draw_walk(ax, links, place, labels)
    legend_above(figure, ax)
    return figure
