"""Pictures of results that know their curves: of an alignment, a matching, a match.

They draw the path or the points that the result has, and compute nothing again. Time and memory
O(n + m).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from .._curves import Array
from ..results import Alignment, Matching, PcmMatch
from . import drawing
from .alignment import draw_path
from .matching import draw_matching
from .pcm import draw_match

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["alignment_figure", "match_figure", "matching_figure"]


def alignment_figure(found: Alignment) -> Picture:
    """Draw an alignment; see :meth:`curvewise.Alignment.plot`."""
    drawn = _drawn(found.curves)
    if drawn is None:
        return _path_alone(found.path, "index in Q", "index in P")
    figure = drawing.new_figure(figsize=_size(drawn), layout="constrained")
    names = drawing.axis_names(drawn[0].shape[1], None, *(found.curves or ()))
    draw_path(figure.subplots(), drawn, found.path, names)
    return _with_legend(figure)


def matching_figure(found: Matching) -> Picture:
    """Draw a matching; see :meth:`curvewise.Matching.plot`."""
    drawn = _drawn(found.curves)
    if drawn is None:
        return _path_alone(found.parameters, "vertex of Q", "vertex of P")
    figure = drawing.new_figure(figsize=_size(drawn), layout="constrained")
    names = drawing.axis_names(drawn[0].shape[1], None, *(found.curves or ()))
    draw_matching(figure.subplots(), drawn, drawn, found, names)
    return _with_legend(figure)


def match_figure(found: PcmMatch) -> Picture:
    """Draw a match; see :meth:`curvewise.PcmMatch.plot`."""
    if found.curves is None:
        raise ValueError("the match does not know its curves; take that of curvewise.pcm_match")
    figure = drawing.new_figure(figsize=(6.4, 4.4), layout="constrained")
    names = drawing.axis_names(2, None, *found.curves)
    draw_match(figure.subplots(), found.curves, found, names)
    return _with_legend(figure)


def _drawn(curves: tuple[Array, Array] | None) -> tuple[Array, Array] | None:
    """Return the curves with shape (n, d) where they are known and d is 1 or 2."""
    if curves is None:
        return None
    P, Q = (curve[:, np.newaxis] if curve.ndim == 1 else curve for curve in curves)
    return (P, Q) if P.shape[1] <= 2 else None


def _size(drawn: tuple[Array, Array]) -> tuple[float, float]:
    return (6.4, 4.4) if drawn[0].shape[1] == 2 else (9.0, 3.4)


def _path_alone(path: npt.NDArray[np.int64] | Array, x: str, y: str) -> Picture:
    figure = drawing.new_figure(figsize=(4.4, 4.4), layout="constrained")
    ax = figure.subplots()
    ax.plot(*path.T[::-1], color=drawing.ACCENT_COLOUR, linewidth=1.3, label="path")
    drawing.label_axes(ax, x, y)
    return _with_legend(figure)


def _with_legend(figure: Picture) -> Picture:
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper left", ncols=len(labels), frameon=False)
    return figure
