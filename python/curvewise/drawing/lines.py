"""Several quantities over the same axis, a line each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..curves.inputs import Array
from .figures import new_figure
from .palette import series_colours

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["lines_by_name"]


def lines_by_name(x: Array, lines: Mapping[str, Array], labels: tuple[str, str]) -> Picture:
    """Draw lines of shape (n,) over `x`, with the labels of both axes."""
    figure = new_figure(figsize=(7, 4.2), layout="constrained")
    ax = figure.subplots()
    for (name, y), colour in zip(lines.items(), series_colours(len(lines)), strict=True):
        ax.plot(x, y, color=colour, linewidth=1.2, label=name)
    ax.set(xlabel=labels[0], ylabel=labels[1])
    figure.legend(loc="outside upper center", ncols=len(lines), frameon=False)
    return figure
