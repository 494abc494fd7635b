"""Plot of partial curve mapping. Time and memory of `pcm_match`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .._options import Default, Offsets
from ..curves.inputs import CurveLike, as_curves
from ..curves.named_curve import labels_of
from ..drawing.figures import CurveArtists
from ..drawing.links import draw_placement
from ..measures import pcm_match

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_pcm"]


def plot_pcm(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    offsets: Offsets = Default.offsets,
    names: Sequence[str] | None = None,
) -> CurveArtists:
    """Draw the place of the shorter curve in partial curve mapping.

    Parameters
    ----------
    P, Q : array_like, shape (n, 2) and (m, 2)
        The curves, drawn in original units; the measure scales them by P's box.
    ax : matplotlib.axes.Axes
        The axes to draw in.
    offsets : int or "continuous"
        As in `pcm`.
    names
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection from vertices of the shorter curve to their points on the
        longer one (at most 80, evenly chosen). `accent` is the mapped section of the longer one.

    Raises
    ------
    ValueError, TypeError
        As for `pcm`, before anything is drawn.

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
    labels = labels_of(2, names, P, Q)
    return draw_placement(ax, as_curves(P, Q), match.mapped, match.offset, match.points, labels)
