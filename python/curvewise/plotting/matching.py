"""The continuous Fréchet distance: its matching, and the free space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..curves.arc_length import points_at
from ..curves.inputs import CurveLike
from ..drawing.figures import CurveArtists, matplotlib_required
from ..drawing.links import draw_matching, draw_walk, label_places
from ..drawing.palette import BETWEEN_COLOUR, FILL_COLOUR
from ..measures import frechet_continuous_path
from .measured import measured_and_drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D

__all__ = ["plot_free_space", "plot_matching"]

_LINES = 60  # of a curve; more vertices than this are not marked in a diagram
_PIXELS = 600  # of a side of the diagram


def plot_matching(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    normalized: bool = False,
    names: Sequence[str] | None = None,
) -> CurveArtists:
    """Draw which points of the curves the continuous Fréchet distance matches.

    Plane curves are drawn unchanged. Series (d = 1) are drawn against the index, with Q shifted
    from P by the amount that its label gives.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    ax : matplotlib.axes.Axes
        The axes to draw in.
    normalized, names
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection from points of P to points of Q: at most 80 pairs, evenly
        spread along both curves. `accent` is the pair with the largest distance.

    Raises
    ------
    ValueError, TypeError
        As for `frechet_continuous_path`, and if d > 2; before anything is drawn.

    Notes
    -----
    Time and memory of `frechet_continuous_path`.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_matching
    >>> ax = Figure().subplots()
    >>> artists = plot_matching([(0, 0), (10, 0)], [(0, 1), (5, 3), (10, 1)], ax)
    >>> artists.accent.get_xydata().tolist()
    [[5.0, 0.0], [5.0, 3.0]]
    """
    refused = "plot_matching draws 1 or 2 coordinates, plot_free_space any number"
    measured, drawn, labels = measured_and_drawn(P, Q, normalized, names, refused)
    walks = frechet_continuous_path(*measured).parameters
    return draw_matching(ax, drawn, walks, labels, measured)


def plot_free_space(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    distance: float | None = None,
    normalized: bool = False,
) -> tuple[AxesImage, Line2D | None]:
    """Draw the free-space diagram of two short curves, and a path through it.

    A point of the diagram is a point of P and one of Q. It is free, and drawn white, if their
    distance is at most `distance`. The Fréchet distance is at most `distance` if a path that never
    goes down or back leads through the free space from corner to corner.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,)
        The curves, of any d. For curves with more than about 100 points, the cells are too small to
        see.
    ax : matplotlib.axes.Axes
        The axes to draw in: the vertices of P upwards, those of Q to the right.
    distance : float, optional
        The largest distance of free pairs; by default the continuous Fréchet distance.
    normalized : bool
        As in `plot_area`.

    Returns
    -------
    image : matplotlib.image.AxesImage
        The free space.
    path : matplotlib.lines.Line2D or None
        The path of `frechet_continuous_path`, if `distance` is large enough for it.

    Raises
    ------
    ValueError, TypeError
        As for `frechet_continuous_path`, before anything is drawn.

    Notes
    -----
    Time and memory of `frechet_continuous_path`, and 360 000 distances. Alt & Godau (1995).

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_free_space
    >>> image, path = plot_free_space([0, 10], [0, 7, 3, 10], Figure().subplots())
    >>> path.get_xydata()[[0, -1]].tolist()
    [[0.0, 0.0], [3.0, 1.0]]
    """
    with matplotlib_required():
        from matplotlib.colors import ListedColormap
    measured, _, labels = measured_and_drawn(P, Q, normalized)
    points = [curve.reshape(len(curve), -1) for curve in measured]
    matching = frechet_continuous_path(*measured)
    leash = matching.distance if distance is None else float(distance)
    n, m = (max(len(curve) - 1, 1) for curve in points)
    sides = [(np.arange(_PIXELS) + 0.5) / _PIXELS * edges for edges in (n, m)]
    p, q = (points_at(curve, side) for curve, side in zip(points, sides, strict=True))
    square = sum((p[:, np.newaxis, c] - q[:, c]) ** 2 for c in range(p.shape[1]))
    image = ax.imshow(
        square <= leash**2,
        cmap=ListedColormap([FILL_COLOUR, "#FFFFFF"]),
        vmin=0,
        vmax=1,
        origin="lower",
        aspect="auto",
        interpolation="nearest",
        extent=(0, m, 0, n),
    )
    for draw, edges, across in ((ax.hlines, n, m), (ax.vlines, m, n)):
        if edges <= _LINES:
            draw(np.arange(1, edges), 0, across, colors=BETWEEN_COLOUR, linewidths=0.4)
    label_places(ax, "vertex of", labels)
    if leash < matching.distance:
        return image, None
    return image, draw_walk(ax, matching.parameters, "vertex of", labels)
