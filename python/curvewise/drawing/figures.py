"""Building blocks of figures: curves, connecting lines, and panels.

The colours are those of palette.py. The number of artists does not depend on the number of points:
each curve is one line, and all connecting lines are one collection. The module never uses pyplot,
so any backend and any format of matplotlib works. It imports matplotlib when something is drawn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import AbstractContextManager
from importlib import import_module
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .._extras import extra
from ..curves.inputs import Array
from ..curves.named_curve import Labels
from .palette import BETWEEN_COLOUR, P_COLOUR, Q_COLOUR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import Collection, LineCollection
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from .picture import Picture

__all__ = [
    "MAX_LINKS",
    "CurveArtists",
    "draw_curves",
    "draw_links",
    "evenly",
    "label_axes",
    "legend_above",
    "log_ticks",
    "matplotlib_required",
    "new_figure",
    "panels",
    "xy_labels",
    "xy_of",
]

MAX_LINKS = 80  # more lines than this merge into a grey mass
_MOST_TICKS = 6


class CurveArtists(NamedTuple):
    """The artists of a plot of two curves.

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


def matplotlib_required() -> AbstractContextManager[None]:
    """Say how to get matplotlib where an import of it fails."""
    return extra("plot", "pictures need matplotlib, which is not installed")


def new_figure(**options: Any) -> Picture:
    """Return an empty figure that notebooks show; options as of matplotlib's Figure."""
    with matplotlib_required():
        import_module("matplotlib.figure")  # Picture may have been imported when it was there
        from .picture import Picture
    return Picture(**options)


def draw_curves(
    ax: Axes, P: Array, Q: Array, labels: Labels, *, apart: bool = False
) -> tuple[Line2D, Line2D]:
    """Draw curves in the plane, or series (d = 1) against the index: `apart`, with Q below P."""
    p_label, q_label = labels.curves
    x_label, y_label = xy_labels(labels.axes)
    if apart and P.shape[1] == 1:
        Q, q_label = _below(P, Q, q_label)
        y_label = f"{y_label} ({q_label})"
    label_axes(ax, x_label, y_label)
    (p_line,) = ax.plot(*xy_of(P), color=P_COLOUR, linewidth=1.3, label=p_label)
    (q_line,) = ax.plot(*xy_of(Q), color=Q_COLOUR, linewidth=1.3, label=q_label)
    return p_line, q_line


def xy_labels(names: Sequence[str]) -> tuple[str, str]:
    """Return the labels of the axes on which `xy_of` is drawn."""
    return ("index", names[0]) if len(names) == 1 else (names[0], names[1])


def xy_of(curve: Array) -> tuple[Array, Array]:
    """Return x and y to draw of a curve: its first two coordinates, or index and value."""
    if curve.shape[1] == 1:
        return np.arange(len(curve), dtype=np.float64), curve[:, 0]
    return curve[:, 0], curve[:, 1]


def _below(P: Array, Q: Array, label: str) -> tuple[Array, str]:
    """Return series Q moved below series P, with room between, and a label that says so."""
    span = max(float(np.ptp(P)), float(np.ptp(Q))) or 1.0
    digits = 1 - int(np.floor(np.log10(span)))  # a round number reads well
    shift = round(float(P.min() - Q.max()) - 0.3 * span, digits)
    return Q + shift, f"{label} {'+' if shift > 0 else '−'} {abs(shift):.10g}"


def label_axes(ax: Axes, x: str, y: str) -> None:
    """Label the axes that have no label."""
    ax.set_xlabel(ax.get_xlabel() or x)
    ax.set_ylabel(ax.get_ylabel() or y)


def legend_above(figure: Figure, ax: Axes) -> None:
    """Put the legend of a panel above the figure, since a loop leaves no room within."""
    handles, labels = ax.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper left", ncols=len(labels), frameon=False)


def draw_links(ax: Axes, links: Array, label: str) -> LineCollection:
    """Draw the lines `links`, shape (k, 2, 2), under the curves that they connect."""
    with matplotlib_required():
        from matplotlib.collections import LineCollection
    collection = LineCollection(
        list(links), colors=BETWEEN_COLOUR, linewidths=0.7, alpha=0.8, zorder=1, label=label
    )
    ax.add_collection(collection, autolim=False)  # their ends are on the curves
    return collection


def evenly(count: int, most: int = MAX_LINKS) -> npt.NDArray[np.intp]:
    """Return at most `most` of the indices below `count`, including both ends."""
    return np.linspace(0, count - 1, min(count, most)).round().astype(np.intp)


def log_ticks(low: float, high: float) -> list[float]:
    """Return ticks of a logarithmic axis that are far enough apart to be read, at most 6.

    1, 2 and 5 times the powers of ten; over two decades or more the powers, every k-th of them.
    None where the axis covers less than a decade: a linear one is read more easily there.
    """
    if high < 10.0 * low:
        return []
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    if high < 100.0 * low:
        ticks = [digit * 10.0**power for power in powers for digit in (1.0, 2.0, 5.0)]
    else:
        ticks = [10.0**power for power in powers[:: -(-len(powers) // _MOST_TICKS)]]
    return [tick for tick in ticks if low <= tick <= high]


def panels(figure: Figure, dim: int, count: int) -> tuple[Axes, list[Axes]]:
    """Return a panel for the curves, and `count` panels for their measures."""
    if dim == 1:  # wide ones, one above the other
        figure.set_size_inches(9, 2.4 * (1 + count))
        main, *others = figure.subplots(1 + count, 1, sharex=True, squeeze=False)[:, 0]
    elif dim == 2:  # a large one, with small ones to its right and below it
        rows = 2 + math.ceil(max(0, count - 2) / 3)
        figure.set_size_inches(11, 2.9 * rows)
        grid = figure.add_gridspec(rows, 3)
        main = figure.add_subplot(grid[:2, :2])
        cells = [(0, 2), (1, 2), *product(range(2, rows), range(3))]
        others = [figure.add_subplot(grid[cell]) for cell in cells[:count]]
    else:
        figure.set_size_inches(4.2 * (1 + count), 4)
        main, *others = figure.subplots(1, 1 + count, squeeze=False)[0]
    return main, others
