"""Pictures of two curves with what a measure sees between them; public in `curvewise.plotting`.

Quadrilaterals, couplings and matches come from the function that gives the number, so time and
memory are that function's; drawing adds O(n + m). The one construction repeated here is the
compared points of the curve-length measure, as in figure 6 of Jekel, Venter, Venter, Stander,
Haftka, "Similarity measures for identifying material parameters from hysteresis loops using
inverse analysis", Int. J. Material Forming (2018).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, SupportsFloat

import numpy as np
import numpy.typing as npt

from . import _drawing as drawing
from ._curves import Array, CurveLike, as_curves
from .measures import (
    Crossing,
    LengthScale,
    Spacing,
    area_quads,
    curve_length,
    dtw_path,
    frechet_path,
    normalize,
    pcm_match,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import Collection
    from matplotlib.lines import Line2D

__all__ = ["CurveArtists", "plot_alignment", "plot_area", "plot_curve_length", "plot_pcm"]


class CurveArtists(NamedTuple):
    """The artists of a picture of two curves.

    Attributes
    ----------
    P, Q : matplotlib.lines.Line2D
        The curves.
    between : matplotlib.collections.Collection
        A PolyCollection of quadrilaterals or a LineCollection of lines between points.
    accent : matplotlib.lines.Line2D or None
        Fréchet: the pair whose distance is the value. PCM: the stretch of the longer curve on
        which the shorter one sits. Otherwise None.
    """

    P: Line2D
    Q: Line2D
    between: Collection
    accent: Line2D | None = None


def plot_area(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    spacing: Spacing = "distance",
    crossing: Crossing = "rearrange",
    normalized: bool = False,
) -> CurveArtists:
    """Draw the quadrilaterals whose areas `area` adds up.

    Parameters
    ----------
    P, Q : array_like, shape (n, 2) and (m, 2)
        The curves.
    ax : matplotlib.axes.Axes
        Where to draw.
    spacing, crossing : str
        As in `area`.
    normalized : bool
        Whether to measure ``normalize(P, Q)``, the curves scaled by P's box. They are drawn in
        original units either way.

    Returns
    -------
    CurveArtists
        `between` is a PolyCollection with one polygon for each quadrilateral.

    Raises
    ------
    ValueError, TypeError
        Where `area` does, before anything is drawn.

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
    measured, drawn = drawing.measured_and_drawn(P, Q, normalized)
    quads = area_quads(*measured, spacing=spacing, crossing=crossing).quads
    if normalized:
        low, extent = drawing.box(drawn[0])
        quads = low + extent * quads
    with drawing.matplotlib_required():
        from matplotlib.collections import PolyCollection
    lines = drawing.draw_curves(ax, *drawn)
    between = PolyCollection(
        list(quads),
        facecolors=drawing.FILL_COLOUR,
        edgecolors="white",
        # Edges show how the area is cut where quadrilaterals are few, and hide it where many.
        linewidths=0.6 if len(quads) <= drawing.MAX_LINKS else 0.0,
        alpha=0.5,  # what counts more than once is darker
        zorder=1,
        label="area",
    )
    ax.add_collection(between, autolim=False)
    return CurveArtists(*lines, between)


def plot_alignment(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    measure: Literal["dtw", "frechet"] = "dtw",
    every: int | None = None,
    normalized: bool = False,
    **options: Any,
) -> CurveArtists:
    """Draw which points a DTW or Fréchet coupling matches.

    Curves in the plane are drawn as they are. Series (d = 1) are drawn against the index, with Q
    moved away from P by the amount that its label gives.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    ax : matplotlib.axes.Axes
        Where to draw.
    measure : {"dtw", "frechet"}
        Whose path to draw.
    every : int, optional
        Draw each `every`-th pair of the path. By default at most 80 pairs, evenly spread over
        the path, its ends among them.
    normalized : bool
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
        Where `dtw_path` or `frechet_path` does, for d > 2, and for `every` < 1; before anything
        is drawn.

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
    drawing.check_measure(measure)
    if every is not None and (every < 1 or every % 1):
        raise ValueError(f"every is {every}; give a whole number >= 1, or None")
    measured, drawn = drawing.measured_and_drawn(P, Q, normalized)
    if drawn[0].shape[1] > 2:
        raise ValueError(
            f"P has shape {drawn[0].shape}; plot_alignment draws 1 or 2 coordinates, "
            "plot_table any number"
        )
    path = (dtw_path if measure == "dtw" else frechet_path)(*measured, **options).path
    lines = drawing.draw_curves(ax, *drawn, apart=True)
    points = [np.asarray(line.get_xydata()) for line in lines]
    links = np.stack([points[k][path[:, k]] for k in (0, 1)], axis=1)
    shown = links[:: int(every)] if every else drawing.evenly(links)
    between = drawing.draw_links(ax, shown, "matched points")
    if measure == "dtw":
        return CurveArtists(*lines, between)
    farthest = _farthest_pair(*measured, path, **options)
    (accent,) = ax.plot(
        *links[farthest].T,
        color=drawing.ACCENT_COLOUR,
        linewidth=2,
        marker="o",  # a pair at distance 0 has no length to be seen
        markersize=4,
        zorder=3,
        label="Fréchet distance",
    )
    return CurveArtists(*lines, between, accent)


def plot_pcm(
    P: CurveLike, Q: CurveLike, ax: Axes, *, offsets: int | Literal["continuous"] = 200
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
    curves = as_curves(P, Q)
    shorter, longer = (0, 1) if match.mapped == "P" else (1, 0)
    lengths = [drawing.arc_length(curve) for curve in normalize(*curves)]
    end = match.offset + lengths[shorter][-1]
    inside = curves[longer][(lengths[longer] > match.offset) & (lengths[longer] < end)]
    stretch = np.concatenate([match.points[:1], inside, match.points[-1:]])
    lines = drawing.draw_curves(ax, *curves)
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


def plot_curve_length(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    scale: LengthScale = "mean",
    normalized: bool = False,
) -> CurveArtists:
    """Draw the points that the curve-length measure compares.

    They are at equal fractions of arc length, each curve divided by its own largest abs(x) and
    abs(y): the paper's Fig. 6.

    Parameters
    ----------
    P, Q : array_like, shape (n, 2) and (m, 2)
        The curves.
    ax : matplotlib.axes.Axes
        Where to draw.
    scale : str
        As in `curve_length`: it weighs the differences and does not move the points, but where
        it is 0 there is no value and no picture.
    normalized : bool
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection from points of P to their counterparts on Q (at most 80,
        evenly chosen).

    Raises
    ------
    ValueError, TypeError
        Where `curve_length` does, before anything is drawn.

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
    measured, drawn = drawing.measured_and_drawn(P, Q, normalized)
    curve_length(*measured, scale=scale)  # for its checks
    along_p, along_q = (drawing.arc_length(curve / _largest(curve)) for curve in measured)
    at = along_p * (along_q[-1] / along_p[-1])
    counterparts = np.stack([np.interp(at, along_q, drawn[1][:, k]) for k in (0, 1)], axis=1)
    links = np.stack([drawn[0], counterparts], axis=1)
    lines = drawing.draw_curves(ax, *drawn)
    between = drawing.draw_links(ax, drawing.evenly(links), "points compared")
    return CurveArtists(*lines, between)


def _largest(curve: Array) -> Array:
    """Return the largest abs(x) and abs(y), as `curve_length` divides by them."""
    size: Array = np.abs(curve).max(axis=0)
    return np.where(size == 0, 1e-15, size)


def _farthest_pair(
    P: Array,
    Q: Array,
    path: npt.NDArray[np.int64],
    metric: str = "euclidean",
    p: SupportsFloat | None = None,
) -> int:
    """Return the first place on the path where the ground distance is largest."""
    difference = (P[path[:, 0]] - Q[path[:, 1]]).reshape(len(path), -1)
    orders = {"cityblock": 1.0, "chebyshev": np.inf, "minkowski": 2.0 if p is None else float(p)}
    distances = np.linalg.norm(difference, ord=orders.get(metric, 2.0), axis=1)
    return int(np.argmax(distances))
