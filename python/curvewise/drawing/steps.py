"""The figure of a step pattern: the cells of each step, and their weights.

As R's dtw draws it: the cell that is reached is at the top right, and each step leads there from
the cell where it begins. Cost: a few artists for each step.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .figures import new_figure
from .palette import P_COLOUR, Q_COLOUR

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["steps_figure"]


def steps_figure(steps: Sequence[Sequence[tuple[int, int, float]]]) -> Picture:
    """Draw steps, each a list of (rows behind, columns behind, weight) from its begin on."""
    figure = new_figure(figsize=(4.4, 4.4), layout="constrained")
    ax = figure.subplots()
    for step in steps:
        rows, columns = [-cell[0] for cell in step], [-cell[1] for cell in step]
        ax.plot(rows, columns, "-o", color=Q_COLOUR, markerfacecolor="white")
        cells = list(zip(rows, columns, strict=True))
        for place, (_, _, weight) in enumerate(step[1:], 1):
            (i, j), (before_i, before_j) = cells[place], cells[place - 1]
            middle = ((i + before_i) / 2, (j + before_j) / 2)
            ax.annotate(f"{weight:.3g}", middle, color=P_COLOUR, backgroundcolor="white")
    deepest = max(max(cell[:2]) for step in steps for cell in step)
    ticks = range(-deepest, 1)
    ax.set_xticks(ticks)
    ax.set_yticks(ticks)
    ax.set_aspect("equal")
    ax.grid(alpha=0.3)
    ax.set_xlabel("point of P, from i")
    ax.set_ylabel("point of Q, from j")
    return figure
