"""Two curves with what links them: a path, a matching, or the place of one on the other.

Each function draws arrays that have been computed already, into given axes. Time and memory
O(n + m); at most `MAX_LINKS` links are drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..curves.arc_length import arc_lengths, points_at
from ..curves.inputs import Array
from ..curves.named_curve import Labels
from ..curves.scaling import box_scaled
from .figures import MAX_LINKS, CurveArtists, draw_curves, draw_links, evenly, label_axes
from .palette import ACCENT_COLOUR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

__all__ = ["draw_matching", "draw_pair", "draw_path", "draw_placement", "draw_walk", "label_places"]


def draw_path(
    ax: Axes,
    drawn: tuple[Array, Array],
    path: npt.NDArray[np.int64],
    labels: Labels,
    *,
    every: int | None = None,
) -> CurveArtists:
    """Draw curves of shapes (n, d), d = 1 or 2, and lines between the points of a path's pairs."""
    lines = draw_curves(ax, *drawn, labels, apart=True)
    points = [np.asarray(line.get_xydata()) for line in lines]
    links = np.stack([points[k][path[:, k]] for k in (0, 1)], axis=1)
    shown = links[:: int(every)] if every else links[evenly(len(links))]
    return CurveArtists(*lines, draw_links(ax, shown, "matched points"))


def draw_matching(
    ax: Axes,
    drawn: tuple[Array, Array],
    walks: Array,
    labels: Labels,
    measured: tuple[Array, Array] | None = None,
) -> CurveArtists:
    """Draw a matching on curves; that of others, if it was these that were `measured`."""
    columns = [curve.reshape(len(curve), -1) for curve in measured or drawn]
    ends = [points_at(curve, walks[:, k]) for k, curve in enumerate(columns)]
    longest = walks[np.argmax(np.linalg.norm(ends[0] - ends[1], axis=1))]
    lines = draw_curves(ax, *drawn, labels, apart=True)
    points = [np.asarray(line.get_xydata()) for line in lines]
    shown = _evenly(walks)
    links = np.stack([points_at(points[k], shown[:, k]) for k in (0, 1)], axis=1)
    between = draw_links(ax, links, "matched points")
    ends = [points_at(points[k], longest[k : k + 1])[0] for k in (0, 1)]
    return CurveArtists(*lines, between, draw_pair(ax, ends, "continuous Fréchet distance"))


def draw_pair(ax: Axes, ends: Sequence[Array], label: str) -> Line2D:
    """Draw the two points whose distance is the value, and the line between them."""
    (pair,) = ax.plot(
        *np.transpose(ends),
        color=ACCENT_COLOUR,
        linewidth=2,
        marker="o",  # a distance of 0 would otherwise be invisible
        markersize=4,
        zorder=3,
        label=label,
    )
    return pair


def draw_walk(ax: Axes, walk: npt.NDArray[Any], place: str, labels: Labels) -> Line2D:
    """Draw a walk along both curves, of shape (k, 2): the place on Q to the right, on P upwards.

    `place` is what the axes show: "index in", or "vertex of".
    """
    label_places(ax, place, labels)
    (line,) = ax.plot(*walk.T[::-1], color=ACCENT_COLOUR, linewidth=1.3, label="path")
    return line


def label_places(ax: Axes, place: str, labels: Labels) -> None:
    """Label axes; one of them is the place along Q and the other along P."""
    label_axes(ax, *(f"{place} {curve}" for curve in reversed(labels.curves)))


def draw_placement(
    ax: Axes,
    curves: tuple[Array, Array],
    mapped: str,
    offset: float,
    points: Array,
    labels: Labels,
) -> CurveArtists:
    """Draw curves and where one of them has been placed on the other."""
    scaled = [box_scaled(curve, curves[0]) for curve in curves]
    shorter, longer = (0, 1) if mapped == "P" else (1, 0)
    lengths = [arc_lengths(curve) for curve in scaled]
    end = offset + lengths[shorter][-1]
    inside = curves[longer][(lengths[longer] > offset) & (lengths[longer] < end)]
    stretch = np.concatenate([points[:1], inside, points[-1:]])
    lines = draw_curves(ax, *curves, labels)
    links = np.stack([curves[shorter], points], axis=1)
    between = draw_links(ax, links[evenly(len(links))], "mapped points")
    (accent,) = ax.plot(
        *stretch.T,
        color=ACCENT_COLOUR,
        linewidth=5,
        alpha=0.25,
        solid_capstyle="butt",
        zorder=1.5,
        label=f"stretch of {labels.curves[longer]} in use",
    )
    return CurveArtists(*lines, between, accent)


def _evenly(matched: Array) -> Array:
    """Return parameters of a matching that are evenly spread along its path."""
    shares = matched / np.maximum(matched[-1], 1)  # both curves have the same weight
    steps = np.abs(np.diff(shares, axis=0)).sum(axis=1)
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    places = np.linspace(0, walked[-1], MAX_LINKS)
    return np.column_stack([np.interp(places, walked, matched[:, k]) for k in (0, 1)])
