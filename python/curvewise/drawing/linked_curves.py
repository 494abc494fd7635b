"""Figures of two curves and what links them, where the curves may be unknown.

They draw the path or the points that they are given, and compute nothing again. Time and memory
O(n + m).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array
from ..curves.named_curve import axis_names
from .figures import label_axes, new_figure
from .links import draw_matching, draw_path, draw_placement
from .palette import ACCENT_COLOUR

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["alignment_figure", "matching_figure", "placement_figure"]

Curves: TypeAlias = tuple[Array, Array] | None


def alignment_figure(curves: Curves, path: npt.NDArray[np.int64]) -> Picture:
    """Draw curves and the pairs of a path, or the path alone."""
    drawn = _drawn(curves)
    if drawn is None:
        return _path_alone(path, "index in Q", "index in P")
    figure = new_figure(figsize=_size(drawn), layout="constrained")
    names = axis_names(drawn[0].shape[1], None, *(curves or ()))
    draw_path(figure.subplots(), drawn, path, names)
    return _with_legend(figure)


def matching_figure(curves: Curves, walks: Array) -> Picture:
    """Draw curves and the leashes between two walks along them, or the walks alone."""
    drawn = _drawn(curves)
    if drawn is None:
        return _path_alone(walks, "vertex of Q", "vertex of P")
    figure = new_figure(figsize=_size(drawn), layout="constrained")
    names = axis_names(drawn[0].shape[1], None, *(curves or ()))
    draw_matching(figure.subplots(), drawn, drawn, walks, names)
    return _with_legend(figure)


def placement_figure(
    curves: tuple[Array, Array], mapped: str, offset: float, points: Array
) -> Picture:
    """Draw curves and where one of them has been placed on the other."""
    figure = new_figure(figsize=(6.4, 4.4), layout="constrained")
    names = axis_names(2, None, *curves)
    draw_placement(figure.subplots(), curves, mapped, offset, points, names)
    return _with_legend(figure)


def _drawn(curves: Curves) -> tuple[Array, Array] | None:
    """Return the curves with shape (n, d) where they are known and d is 1 or 2."""
    if curves is None:
        return None
    P, Q = (curve[:, np.newaxis] if curve.ndim == 1 else curve for curve in curves)
    return (P, Q) if P.shape[1] <= 2 else None


def _size(drawn: tuple[Array, Array]) -> tuple[float, float]:
    return (6.4, 4.4) if drawn[0].shape[1] == 2 else (9.0, 3.4)


def _path_alone(path: npt.NDArray[np.int64] | Array, x: str, y: str) -> Picture:
    figure = new_figure(figsize=(4.4, 4.4), layout="constrained")
    ax = figure.subplots()
    ax.plot(*path.T[::-1], color=ACCENT_COLOUR, linewidth=1.3, label="path")
    label_axes(ax, x, y)
    return _with_legend(figure)


def _with_legend(figure: Picture) -> Picture:
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper left", ncols=len(labels), frameon=False)
    return figure
