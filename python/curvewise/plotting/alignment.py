"""Which points a DTW or Fréchet coupling matches. Time and memory of the path."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from .._options import Default, GroundDistance, Metric, Order, Radius, WarpingName
from ..curves.ground_distance import check_metric, ground_distances
from ..curves.inputs import Array, CurveLike
from ..curves.own_distance import block_distances, is_own_metric
from ..drawing.figures import CurveArtists
from ..drawing.links import draw_pair, draw_path
from ..measures.edit_distances import EditDistance
from .measured import measured_and_drawn, warping_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_alignment"]


def plot_alignment(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    measure: WarpingName | EditDistance = "dtw",
    every: int | None = None,
    normalized: bool = False,
    names: Sequence[str] | None = None,
    **options: Any,
) -> CurveArtists:
    """Draw which points a DTW or Fréchet coupling matches.

    Plane curves are drawn unchanged. Series (d = 1) are drawn against the index, with Q shifted
    from P by the amount that its label gives.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    ax : matplotlib.axes.Axes
        The axes to draw in.
    measure : {"dtw", "frechet"} or an edit distance
        Whose path to draw.
    every : int, optional
        Draw each `every`-th pair of the path. By default at most 80 pairs, evenly spread over
        the path, its ends among them.
    normalized, names
        As in `plot_area`.
    **options
        Passed to `dtw_path` or `frechet_path`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection, each line from a point of P to one of Q. `accent` is, for
        Fréchet, the first pair of the path whose distance is the value.

    Raises
    ------
    ValueError, TypeError
        As for `dtw_path` or `frechet_path`; if d > 2, or `every` < 1; before anything is drawn.

    Notes
    -----
    Time and memory of the path.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_alignment
    >>> ax = Figure().subplots()
    >>> artists = plot_alignment([0, 1, 2], [0, 2], ax, measure="frechet")
    >>> len(artists.between.get_segments()), artists.accent.get_label()
    (3, 'Fréchet distance')
    """
    warping = warping_of(measure)
    if every is not None and (every < 1 or every % 1):
        raise ValueError(f"every is {every}; give a whole number >= 1, or None")
    refused = "plot_alignment draws 1 or 2 coordinates, plot_table any number"
    measured, drawn, labels = measured_and_drawn(P, Q, normalized, names, refused)
    path = warping.path(*measured, **options).path
    artists = draw_path(ax, drawn, path, labels, every=every)
    if measure != "frechet":
        return artists
    # The first place on the path where the ground distance is largest.
    farthest = path[np.argmax(_along(path, *measured, **options))]
    ends = [
        np.asarray(line.get_xydata())[i]
        for line, i in zip((artists.P, artists.Q), farthest, strict=True)
    ]
    return artists._replace(accent=draw_pair(ax, ends, "Fréchet distance"))


def _along(
    path: npt.NDArray[np.int64],
    P: Array,
    Q: Array,
    *,
    metric: GroundDistance = Default.metric,
    p: Order = Default.p,
    radius: Radius = Default.radius,
    **_: Any,
) -> Array:
    """Return the ground distances of the pairs of a path."""
    if is_own_metric(metric):
        of_block = block_distances(metric, P, Q)
        return np.array([of_block(i, 1, j, 1)[0, 0] for i, j in path.tolist()])
    points = [curve[path[:, k]].reshape(len(path), -1) for k, curve in enumerate((P, Q))]
    return ground_distances(points[0], points[1], *check_metric(cast(Metric, metric), p, radius))
