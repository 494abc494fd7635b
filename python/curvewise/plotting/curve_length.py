"""The points that the curve-length measure compares. Time and memory O(n + m)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .._options import Default, LengthScale
from ..curves.arc_length import corresponding_positions, interpolate
from ..curves.inputs import CurveLike
from ..drawing.figures import CurveArtists, draw_curves, draw_links, evenly
from ..measures import curve_length
from .measured import measured_and_drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_curve_length"]


def plot_curve_length(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    scale: LengthScale = Default.scale,
    normalized: bool = False,
    names: Sequence[str] | None = None,
) -> CurveArtists:
    """Draw the points that the curve-length measure compares.

    They are at equal fractions of arc length, each curve divided by its own largest abs(x) and
    abs(y): the paper's Fig. 6.

    Parameters
    ----------
    P, Q : array_like, shape (n, 2) and (m, 2)
        The curves.
    ax : matplotlib.axes.Axes
        The axes to draw in.
    scale : str
        As in `curve_length`. It weights the differences and does not move the points. If it is 0,
        the value and the plot are undefined.
    normalized, names
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection from points of P to their counterparts on Q (at most 80,
        evenly chosen).

    Raises
    ------
    ValueError, TypeError
        As for `curve_length`, before anything is drawn.

    Notes
    -----
    O(n + m) time and memory.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_curve_length
    >>> ax = Figure().subplots()
    >>> artists = plot_curve_length([[0, 0], [1, 1], [2, 2]], [[0, 1], [4, 1]], ax)
    >>> artists.between.get_segments()[1].tolist()
    [[1.0, 1.0], [2.0, 1.0]]
    """
    measured, drawn, labels = measured_and_drawn(P, Q, normalized, names)
    curve_length(*measured, scale=scale)  # for its checks
    counterparts = interpolate(drawn[1], *corresponding_positions(*measured))
    links = np.stack([drawn[0], counterparts], axis=1)
    lines = draw_curves(ax, *drawn, labels)
    between = draw_links(ax, links[evenly(len(links))], "points compared")
    return CurveArtists(*lines, between)
