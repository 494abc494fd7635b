"""Elementary effects of parameters: their means, and how they differ from place to place."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..curves.inputs import Array
from .figures import new_figure
from .palette import ACCENT_COLOUR, Q_COLOUR

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["elementary_effects"]


def elementary_effects(
    names: Sequence[str], titles: Sequence[str], means: Array, deviations: Array
) -> Picture:
    """Draw mean and deviation of the effects as bars, a panel for every loop.

    Parameters
    ----------
    names, titles : sequence of str
        The parameters and the loops.
    means, deviations : ndarray, shape (loops, k)
        In units of each loop's box.
    """
    size = (4.2 * len(titles), 1.2 + 0.32 * len(names))
    figure = new_figure(figsize=size, layout="constrained")
    panels = figure.subplots(1, len(titles), squeeze=False, sharey=True)[0]
    rows = range(len(names))
    for ax, title, mean, deviation in zip(panels, titles, means, deviations, strict=True):
        ax.barh(rows, 100.0 * mean, height=0.6, color=ACCENT_COLOUR, alpha=0.6)
        ends = (100.0 * (mean - deviation).clip(0.0), 100.0 * (mean + deviation))
        ax.hlines(rows, *ends, color=Q_COLOUR, linewidth=1.5)
        ax.set(xlabel="move of the loop, % of its box", title=title)
    panels[0].set_yticks(rows, names)
    panels[0].invert_yaxis()
    return figure
