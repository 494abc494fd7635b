"""A figure of many curves and of their representative curve."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..curves.inputs import Array, in_columns
from ..curves.named_curve import axis_names
from .figures import label_axes, legend_above, new_figure, xy_labels, xy_of
from .palette import BETWEEN_COLOUR, Q_COLOUR

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["bunch_figure"]


def bunch_figure(curves: Sequence[Array], mean: Array, label: str) -> Picture:
    """Draw curves in grey and their mean above them, in the first two coordinates."""
    dim = in_columns(mean).shape[1]
    figure = new_figure(figsize=(9.0, 3.4) if dim == 1 else (6.4, 4.4), layout="constrained")
    ax = figure.subplots()
    for k, curve in enumerate(curves):
        name = None if k else "curves"
        ax.plot(*xy_of(in_columns(curve)), color=BETWEEN_COLOUR, linewidth=0.6, label=name)
    ax.plot(*xy_of(in_columns(mean)), color=Q_COLOUR, linewidth=2.0, label=label)
    label_axes(ax, *xy_labels(axis_names(dim, None, *curves)))
    legend_above(figure, ax)
    return figure
