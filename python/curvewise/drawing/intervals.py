"""Figures of the uncertainty: intervals, correlations, weak directions."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ..curves.inputs import Array
from .figures import label_axes, new_figure, xy_labels, xy_of
from .palette import (
    ACCENT_COLOUR,
    CORRELATION_MAP,
    FILL_COLOUR,
    GROUND_COLOUR,
    P_COLOUR,
    Q_COLOUR,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .picture import Picture

__all__ = ["Intervals", "intervals_and_moves"]


class Intervals(NamedTuple):
    """The intervals of parameters.

    Attributes
    ----------
    names : sequence of str
        The parameters.
    places : sequence of (from, to, value)
        The ends of the interval and the value, relative to the bounds: 0 to 1.
    texts : sequence of str
        The text next to each interval.
    determined : sequence of bool
        Whether each is determined; the others are drawn in another colour.
    level : float
        The probability.
    """

    names: Sequence[str]
    places: Sequence[Sequence[float]]
    texts: Sequence[str]
    determined: Sequence[bool]
    level: float


def intervals_and_moves(
    intervals: Intervals,
    correlations: Array,
    loops: Iterable[Sequence[Array]],
    names: Sequence[Sequence[str]],
    title: str,
) -> Picture:
    """Draw a row of two panels, intervals and correlations, and below it the loops, moved.

    Parameters
    ----------
    intervals : Intervals
    correlations : ndarray, shape (k, k)
        The correlations of the errors.
    loops : iterable of four ndarrays
        Test, optimum, and the optimum moved along the weakest direction and the other way.
    names : sequence of sequence of str
        For each loop what its coordinates are called.
    title : str
        The title of the lower row.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot.

    Raises
    ------
    ImportError
        If matplotlib is missing.
    """
    figure = new_figure(figsize=(11, 7.4), layout="constrained")
    upper, lower = figure.subfigures(2, 1, squeeze=False)[:, 0]
    left, right = upper.subplots(1, 2, width_ratios=(1.5, 1))
    _draw_intervals(intervals, left)
    _draw_correlations(intervals.names, correlations, right, figure)
    panels = lower.subplots(1, len(names), squeeze=False)[0]
    for ax, loop, columns in zip(panels, loops, names, strict=True):
        _draw_moves(ax, loop, columns)
    lines, labels = panels[0].get_legend_handles_labels()
    lower.suptitle(textwrap.fill(title, 110), fontsize=10)
    lower.legend(lines, labels, loc="outside lower center", ncols=4, frameon=False)
    return figure


def _draw_intervals(intervals: Intervals, ax: Axes) -> None:
    rows = range(len(intervals.names))
    ax.hlines(rows, 0.0, 1.0, color=GROUND_COLOUR, linewidth=5, zorder=0)
    for row, (low, high, value) in enumerate(intervals.places):
        colour = P_COLOUR if intervals.determined[row] else Q_COLOUR
        ax.hlines(row, max(low, -0.05), min(high, 1.05), color=colour, linewidth=2.5)
        ax.plot(value, row, "o", color=colour, markersize=5)
        ax.text(1.07, row, intervals.texts[row], va="center", fontsize=8)
    ax.set_yticks(rows, intervals.names)
    ax.invert_yaxis()
    percent = f"{100 * intervals.level:g} %"
    ax.set(xlim=(-0.05, 2.5), xlabel="place between the bounds", title=f"{percent} intervals")
    ax.set_xticks([0.0, 0.5, 1.0])


def _draw_correlations(names: Sequence[str], correlations: Array, ax: Axes, figure: Any) -> None:
    image = ax.imshow(correlations, cmap=CORRELATION_MAP, vmin=-1.0, vmax=1.0)
    ax.set_xticks(range(len(names)), names, rotation=45, ha="right")
    ax.set_yticks(range(len(names)), names)
    ax.set_title("Correlations of the errors")
    figure.colorbar(image, ax=ax, shrink=0.85)


def _draw_moves(ax: Axes, loop: Sequence[Array], names: Sequence[str]) -> None:
    """Draw a test, the optimum, and the same moved both ways along the weakest direction."""
    test, optimum, forth, back = map(xy_of, loop)
    ax.plot(*test, ".", color=FILL_COLOUR, markersize=3, label="test")
    ax.plot(*optimum, color=ACCENT_COLOUR, linewidth=1.2, label="optimum")
    ax.plot(*forth, "--", color=P_COLOUR, linewidth=1.0, label="weakest direction")
    ax.plot(*back, "--", color=Q_COLOUR, linewidth=1.0, label="and back")
    label_axes(ax, *xy_labels(names))
