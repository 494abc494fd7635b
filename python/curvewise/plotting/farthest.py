"""The pair of points that a Hausdorff distance is the distance of: of vertices, or of lines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .._options import Default, Metric, Order, Radius
from ..curves.arc_length import points_at
from ..curves.ground_distance import check_metric, ground_distances
from ..curves.inputs import CurveLike
from ..drawing.figures import CurveArtists, draw_curves, draw_links
from ..drawing.links import draw_pair, draw_path
from ..measures import hausdorff_continuous_points
from .measured import measured_and_drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_farthest", "plot_farthest_of_lines"]


def plot_farthest(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    metric: Metric = Default.metric,
    p: Order = Default.p,
    radius: Radius = Default.radius,
    normalized: bool = False,
    names: Sequence[str] | None = None,
) -> CurveArtists:
    """Draw each point's nearest on the other curve, and the pair farthest apart.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    ax : matplotlib.axes.Axes
        The axes to draw in.
    metric, p, radius
        As for :func:`curvewise.hausdorff`.
    normalized, names
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection; each line connects a point of P with the nearest point of Q,
        or the reverse. `accent` is the pair whose distance is the value.

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.hausdorff`, and if d > 2; before anything is drawn.

    Notes
    -----
    Time and memory O(n m).

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_farthest
    >>> ax = Figure().subplots()
    >>> plot_farthest([0, 1, 2], [0, 2], ax).accent.get_label()
    'Hausdorff distance'
    """
    metric, order = check_metric(metric, p, radius)
    refused = "plot_farthest draws 1 or 2 coordinates"
    (A, B), drawn, labels = measured_and_drawn(P, Q, normalized, names, refused)
    A, B = A.reshape(len(A), -1), B.reshape(len(B), -1)
    ground = ground_distances(A[:, np.newaxis], B, metric, order)
    rows, columns = np.arange(len(A)), np.arange(len(B))
    pairs = np.vstack(
        [
            np.column_stack([rows, ground.argmin(axis=1)]),
            np.column_stack([ground.argmin(axis=0), columns]),
        ]
    )
    artists = draw_path(ax, drawn, pairs, labels)
    farthest = pairs[np.argmax(ground[pairs[:, 0], pairs[:, 1]])]
    ends = [
        np.asarray(line.get_xydata())[i]
        for line, i in zip((artists.P, artists.Q), farthest, strict=True)
    ]
    return artists._replace(accent=draw_pair(ax, ends, "Hausdorff distance"))


def plot_farthest_of_lines(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    directed: bool = Default.directed,
    normalized: bool = False,
    names: Sequence[str] | None = None,
) -> CurveArtists:
    """Draw the points of polygonal curves that are farthest apart.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    ax : matplotlib.axes.Axes
        Axes to draw into.
    directed
        As for :func:`curvewise.hausdorff_continuous`.
    normalized, names
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection of a line for each directed distance, from the farthest point
        to the nearest point of the other curve. `accent` is the longest of the lines.

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.hausdorff_continuous`, and if d > 2; before anything is drawn.

    Notes
    -----
    Time and memory of :func:`curvewise.hausdorff_continuous`.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_farthest_of_lines
    >>> ax = Figure().subplots()
    >>> artists = plot_farthest_of_lines([(0, 0), (4, 0)], [(0, 0), (0, 3), (4, 3), (4, 0)], ax)
    >>> artists.accent.get_xydata().tolist()
    [[0.0, 0.0], [0.0, 3.0]]
    """
    refused = "plot_farthest_of_lines draws 1 or 2 coordinates"
    measured, drawn, labels = measured_and_drawn(P, Q, normalized, names, refused)
    found = hausdorff_continuous_points(*measured, directed=directed)
    lines = draw_curves(ax, *drawn, labels, apart=True)
    ends = [
        points_at(np.asarray(line.get_xydata()), at)
        for line, at in zip(lines, found.parameters.T, strict=True)
    ]
    links = np.stack(ends, axis=1)
    between = draw_links(ax, links, "farthest points")
    longest = links[np.argmax(found.distances)]
    return CurveArtists(*lines, between, draw_pair(ax, longest, "Hausdorff distance"))
