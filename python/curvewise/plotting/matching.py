"""The continuous Fréchet distance: what it matches, and the free space that the matching is in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .._curves import Array, CurveLike
from ..measures import frechet_continuous_path
from ..results import Matching
from . import drawing
from .drawing import CurveArtists

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D

__all__ = ["draw_matching", "plot_free_space", "plot_matching"]

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

    Curves in the plane are drawn as they are. Series (d = 1) are drawn against the index, with Q
    moved away from P by the amount that its label gives.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    ax : matplotlib.axes.Axes
        Where to draw.
    normalized, names
        As in `plot_area`.

    Returns
    -------
    CurveArtists
        `between` is a LineCollection from points of P to points of Q: at most 80 leashes, evenly
        spread along both curves. `accent` is the longest leash.

    Raises
    ------
    ValueError, TypeError
        Where `frechet_continuous_path` does, and for d > 2; before anything is drawn.

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
    measured, drawn = drawing.measured_and_drawn(P, Q, normalized)
    if drawn[0].shape[1] > 2:
        raise ValueError(
            f"P has shape {drawn[0].shape}; plot_matching draws 1 or 2 coordinates, "
            "plot_free_space any number"
        )
    axes = drawing.axis_names(drawn[0].shape[1], names, P, Q)
    return draw_matching(ax, measured, drawn, frechet_continuous_path(*measured), axes)


def draw_matching(
    ax: Axes,
    measured: tuple[Array, Array],
    drawn: tuple[Array, Array],
    matching: Matching,
    axes: Sequence[str],
) -> CurveArtists:
    """Draw a matching of the curves that were measured on the curves to be drawn."""
    matched = matching.parameters
    lengths = _leashes(*measured, matched)
    lines = drawing.draw_curves(ax, *drawn, axes, apart=True)
    points = [np.asarray(line.get_xydata()) for line in lines]
    shown = _evenly(matched)
    links = np.stack([_points_at(points[k], shown[:, k]) for k in (0, 1)], axis=1)
    between = drawing.draw_links(ax, links, "matched points")
    longest = matched[np.argmax(lengths)]
    ends = [_points_at(points[k], longest[k : k + 1])[0] for k in (0, 1)]
    (accent,) = ax.plot(
        *np.transpose(ends),
        color=drawing.ACCENT_COLOUR,
        linewidth=2,
        marker="o",  # a leash of length 0 is not seen
        markersize=4,
        zorder=3,
        label="continuous Fréchet distance",
    )
    return CurveArtists(*lines, between, accent)


def plot_free_space(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    distance: float | None = None,
    normalized: bool = False,
) -> tuple[AxesImage, Line2D | None]:
    """Draw the free-space diagram of two short curves, and a path through it.

    A point of the diagram is a point of P and one of Q; it is free, and drawn white, where a leash
    of length `distance` reaches from one to the other. A leash is long enough where a path that
    never goes down or back leads through the free space from corner to corner.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,)
        The curves, of any d. Of curves of more than some 100 points cells are too small to see.
    ax : matplotlib.axes.Axes
        Where to draw: the vertices of P upwards, those of Q to the right.
    distance : float, optional
        The length of the leash; the continuous Fréchet distance if not given.
    normalized : bool
        As in `plot_area`.

    Returns
    -------
    image : matplotlib.image.AxesImage
        The free space.
    path : matplotlib.lines.Line2D or None
        The path of `frechet_continuous_path`, where the leash is long enough for it.

    Raises
    ------
    ValueError, TypeError
        Where `frechet_continuous_path` does, before anything is drawn.

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
    with drawing.matplotlib_required():
        from matplotlib.colors import ListedColormap
    (P, Q), _ = drawing.measured_and_drawn(P, Q, normalized)
    points = [curve.reshape(len(curve), -1) for curve in (P, Q)]
    matching = frechet_continuous_path(P, Q)
    leash = matching.distance if distance is None else float(distance)
    n, m = (max(len(curve) - 1, 1) for curve in points)
    sides = [(np.arange(_PIXELS) + 0.5) / _PIXELS * edges for edges in (n, m)]
    p, q = (_points_at(curve, side) for curve, side in zip(points, sides, strict=True))
    square = sum((p[:, np.newaxis, c] - q[:, c]) ** 2 for c in range(p.shape[1]))
    image = ax.imshow(
        square <= leash**2,
        cmap=ListedColormap([drawing.FILL_COLOUR, "#FFFFFF"]),
        vmin=0,
        vmax=1,
        origin="lower",
        aspect="auto",
        interpolation="nearest",
        extent=(0, m, 0, n),
    )
    for draw, edges in ((ax.hlines, n), (ax.vlines, m)):
        if edges <= _LINES:
            across = m if draw == ax.hlines else n
            draw(np.arange(1, edges), 0, across, colors=drawing.BETWEEN_COLOUR, linewidths=0.4)
    path = None
    if leash >= matching.distance:
        (path,) = ax.plot(
            *matching.parameters.T[::-1],
            color=drawing.ACCENT_COLOUR,
            linewidth=1.3,
            label="path",
        )
    drawing.label_axes(ax, "vertex of Q", "vertex of P")
    return image, path


def _points_at(curve: Array, parameters: Array) -> Array:
    """Return the points at parameters of a curve, vertex index plus fraction."""
    first = np.minimum(parameters.astype(np.intp), max(len(curve) - 2, 0))
    t = (parameters - first)[:, np.newaxis]
    following = np.minimum(first + 1, len(curve) - 1)
    points: Array = (1 - t) * curve[first] + t * curve[following]
    return points


def _leashes(P: Array, Q: Array, matched: Array) -> Array:
    """Return the lengths of the leashes of a matching."""
    P, Q = (curve.reshape(len(curve), -1) for curve in (P, Q))
    lengths: Array = np.linalg.norm(
        _points_at(P, matched[:, 0]) - _points_at(Q, matched[:, 1]), axis=1
    )
    return lengths


def _evenly(matched: Array) -> Array:
    """Return parameters of a matching that are evenly spread along its path."""
    shares = matched / np.maximum(matched[-1], 1)  # both curves count alike
    steps = np.abs(np.diff(shares, axis=0)).sum(axis=1)
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    places = np.linspace(0, walked[-1], drawing.MAX_LINKS)
    return np.column_stack([np.interp(places, walked, matched[:, k]) for k in (0, 1)])
