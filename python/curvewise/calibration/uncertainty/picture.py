"""The picture of an uncertainty: intervals, correlations, and what the loops do not notice."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...drawing import figures as drawing
from ...drawing.loops import drawn, labels
from ...drawing.palette import CORRELATION_MAP, GROUND_COLOUR

if TYPE_CHECKING:
    from ...drawing.picture import Picture

__all__ = ["intervals_correlations_direction"]


def intervals_correlations_direction(
    uncertainty: Any, names: Sequence[str] | None = None
) -> Picture:
    """Draw an `Uncertainty`: a row of two panels, and below it the loops.

    Parameters
    ----------
    uncertainty : Uncertainty
    names : sequence of str, optional
        What the loops' coordinates are called, where that is not known from their columns.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot.

    Raises
    ------
    ImportError
        Without matplotlib.
    """
    experiments = uncertainty.optimum.problem.objective.experiments
    figure = drawing.new_figure(figsize=(11, 7.4), layout="constrained")
    parts = figure.subfigures(2, 1, squeeze=False)
    upper, lower = parts[0, 0], parts[1, 0]
    left, right = upper.subplots(1, 2, width_ratios=(1.5, 1))
    _draw_intervals(uncertainty, left)
    _draw_correlations(uncertainty, right, figure)
    panels = lower.subplots(1, len(experiments), squeeze=False)[0]
    _draw_direction(uncertainty, panels, uncertainty.optimum.problem.objective.axes(names))
    lines, labels = panels[0].get_legend_handles_labels()
    lower.suptitle(textwrap.fill(uncertainty.in_words, 110), fontsize=10)
    lower.legend(lines, labels, loc="outside lower center", ncols=4, frameon=False)
    return figure


def _draw_intervals(uncertainty: Any, ax: Any) -> None:
    space = uncertainty.optimum.problem.space
    for row, name in enumerate(space.names):
        low, high = space.bounds[name]
        ends = np.array([low, high, *uncertainty.intervals[name], uncertainty.parameters[name]])
        if space.is_log[row]:
            ends = np.log(np.maximum(ends, np.finfo(float).tiny))
        first, last, value = (ends[2:] - ends[0]) / (ends[1] - ends[0])
        good = uncertainty.determined[name]
        colour = drawing.P_COLOUR if good else drawing.Q_COLOUR
        ax.hlines(row, 0.0, 1.0, color=GROUND_COLOUR, linewidth=5, zorder=0)
        ax.hlines(row, max(first, -0.05), min(last, 1.05), color=colour, linewidth=2.5)
        ax.plot(value, row, "o", color=colour, markersize=5)
        text = f"{uncertainty.parameters[name]:.4g} ± {uncertainty.standard_errors[name]:.2g}"
        ax.text(1.07, row, text if good else f"{text}, not determined", va="center", fontsize=8)
    ax.set_yticks(range(len(space.names)), space.names)
    ax.invert_yaxis()
    percent = f"{100 * uncertainty.level:g} %"
    ax.set(xlim=(-0.05, 2.1), xlabel="place between the bounds", title=f"{percent} intervals")
    ax.set_xticks([0.0, 0.5, 1.0])


def _draw_correlations(uncertainty: Any, ax: Any, figure: Any) -> None:
    names = uncertainty.optimum.problem.space.names
    image = ax.imshow(uncertainty.correlations, cmap=CORRELATION_MAP, vmin=-1.0, vmax=1.0)
    ax.set_xticks(range(len(names)), names, rotation=45, ha="right")
    ax.set_yticks(range(len(names)), names)
    ax.set_title("Correlations of the errors")
    figure.colorbar(image, ax=ax, shrink=0.85)


def _draw_direction(uncertainty: Any, panels: Any, axes: Sequence[Sequence[str]]) -> None:
    """Draw the loops, and the same moved both ways along the weakest direction."""
    optimum = uncertainty.optimum
    differential = optimum.problem.space.differential(optimum.unit)
    step = np.linalg.solve(differential, np.array(list(uncertainty.weakest_direction.values())))
    moved = [(sign, optimum.curves(optimum.unit + sign * step)) for sign in (1.0, -1.0)]
    for i, ax in enumerate(panels):
        experiment = optimum.problem.objective.experiments[i]
        ax.plot(*drawn(experiment), ".", color=drawing.FILL_COLOUR, markersize=3, label="test")
        best = optimum.curves(optimum.unit)[i]
        ax.plot(*drawn(best), color=drawing.ACCENT_COLOUR, linewidth=1.2, label="optimum")
        for (sign, curves), colour in zip(moved, (drawing.P_COLOUR, drawing.Q_COLOUR), strict=True):
            label = "weakest direction" if sign > 0 else "and back"
            ax.plot(*drawn(curves[i]), "--", color=colour, linewidth=1.0, label=label)
        drawing.label_axes(ax, *labels(axes[i]))
