"""The quadrilaterals between two curves. Time and memory of `area_quads`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .._options import Crossing, Default, Spacing
from ..curves.inputs import CurveLike
from ..curves.scaling import box
from ..drawing.figures import MAX_LINKS, CurveArtists, draw_curves, matplotlib_required
from ..drawing.palette import FILL_COLOUR
from ..measures import area_quads
from .measured import measured_and_drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_area"]


def plot_area(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    spacing: Spacing = Default.spacing,
    crossing: Crossing = Default.crossing,
    closed: bool = False,
    normalized: bool = False,
    names: Sequence[str] | None = None,
) -> CurveArtists:
    """Draw the quadrilaterals whose areas `area` adds up.

    Parameters
    ----------
    P, Q : array_like, shape (n, 2) and (m, 2)
        The curves.
    ax : matplotlib.axes.Axes
        The axes to draw in.
    spacing, crossing : str
        As in `area`.
    closed : bool, default False
        As in `area`.
    normalized : bool
        Whether to measure ``normalize(P, Q)``, the curves scaled by P's box. They are drawn in
        original units either way.
    names : sequence of str, optional
        The labels of the axes; by default the names of the curves' columns (DataFrames,
        `read_curve`), else x and y.

    Returns
    -------
    CurveArtists
        `between` is a PolyCollection with one polygon for each quadrilateral.

    Raises
    ------
    ValueError, TypeError
        As for `area`, before anything is drawn.

    Notes
    -----
    Time and memory of `area_quads`.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_area
    >>> ax = Figure().subplots()
    >>> artists = plot_area([[0, 0], [1, 0], [2, 0]], [[0, 1], [2, 1]], ax)
    >>> len(artists.between.get_paths())
    2
    """
    measured, drawn, labels = measured_and_drawn(P, Q, normalized, names)
    quads = area_quads(*measured, spacing=spacing, crossing=crossing, closed=closed).quads
    if normalized:
        low, extent = box(drawn[0])
        quads = low + extent * quads
    with matplotlib_required():
        from matplotlib.collections import PolyCollection
    lines = draw_curves(ax, *drawn, labels)
    between = PolyCollection(
        list(quads),
        facecolors=FILL_COLOUR,
        edgecolors="white",
        # Edges show how the area is cut where quadrilaterals are few, and hide it where many.
        linewidths=0.6 if len(quads) <= MAX_LINKS else 0.0,
        alpha=0.5,  # what counts more than once is darker
        zorder=1,
        label="area",
    )
    ax.add_collection(between, autolim=False)
    return CurveArtists(*lines, between)
