"""Where partial curve mapping places the shorter curve. Time and memory of `pcm_match`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .._curves import Array, CurveLike, as_curves
from .._options import Default, Offsets
from ..measures import normalize, pcm_match
from ..reference.arc_length import arc_lengths
from ..results import PcmMatch
from . import drawing
from .drawing import CurveArtists

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw_match", "plot_pcm"]


def plot_pcm(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    offsets: Offsets = Default.offsets,
    names: Sequence[str] | None = None,
) -> CurveArtists:
    """Draw where partial curve mapping places the shorter curve on the longer one.

    Parameters
    ----------
    P, Q : array_like, shape (n, 2) and (m, 2)
        The curves, drawn in original units; the measure scales them by P's box.
    ax : matplotlib.axes.Axes
        Where to draw.
    offsets : int or "continuous"
        As in `pcm`.
    names
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection from vertices of the shorter curve to their points on the
        longer one (at most 80, evenly chosen); `accent` the stretch of the longer one in use.

    Raises
    ------
    ValueError, TypeError
        Where `pcm` does, before anything is drawn.

    Notes
    -----
    Time and memory of `pcm_match`.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_pcm
    >>> ax = Figure().subplots()
    >>> artists = plot_pcm([[0, 0], [4, 4]], [[1, 1], [3, 3]], ax, offsets="continuous")
    >>> artists.accent.get_xydata().round(9).tolist()
    [[1.0, 1.0], [3.0, 3.0]]
    """
    match = pcm_match(P, Q, offsets=offsets)
    return draw_match(ax, as_curves(P, Q), match, drawing.axis_names(2, names, P, Q))


def draw_match(
    ax: Axes, curves: tuple[Array, Array], match: PcmMatch, axes: Sequence[str]
) -> CurveArtists:
    """Draw curves and where one of them has been placed on the other."""
    shorter, longer = (0, 1) if match.mapped == "P" else (1, 0)
    lengths = [arc_lengths(curve) for curve in normalize(*curves)]
    end = match.offset + lengths[shorter][-1]
    inside = curves[longer][(lengths[longer] > match.offset) & (lengths[longer] < end)]
    stretch = np.concatenate([match.points[:1], inside, match.points[-1:]])
    lines = drawing.draw_curves(ax, *curves, axes)
    links = np.stack([curves[shorter], match.points], axis=1)
    between = drawing.draw_links(ax, drawing.evenly(links), "mapped points")
    (accent,) = ax.plot(
        *stretch.T,
        color=drawing.ACCENT_COLOUR,
        linewidth=5,
        alpha=0.25,
        solid_capstyle="butt",
        zorder=1.5,
        label=f"stretch of {'PQ'[longer]} in use",
    )
    return CurveArtists(*lines, between, accent)
