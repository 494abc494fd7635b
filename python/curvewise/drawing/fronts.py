"""The trade-off between two values of many runs: all of them, and what lies along the front."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..curves.inputs import Array
from .figures import new_figure
from .palette import ACCENT_COLOUR, BETWEEN_COLOUR, Q_COLOUR, series_colours

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["front_and_parameters"]

_VIEW = 4.0  # how far beyond the front runs are shown, in lengths of the front


def front_and_parameters(
    values: Array,
    front: Array,
    compromise: int,
    measures: Sequence[str],
    names: Sequence[str],
    parameters: Array,
) -> Picture:
    """Draw runs by two measures with their front, and the parameters along it.

    Parameters
    ----------
    values, front : ndarray, shape (runs, 2) and (n, 2)
        The values of all runs, and of those on the front, from one end to the other.
    compromise : int
        Which run of the front is marked.
    measures, names : sequence of str
        The names of the values and the parameters.
    parameters : ndarray, shape (n, k)
        The parameters of the runs on the front.
    """
    figure = new_figure(figsize=(9.6, 4.0), layout="constrained")
    left, right = figure.subplots(1, 2)
    left.plot(*values.T, ".", color=BETWEEN_COLOUR, markersize=3, label="run")
    left.plot(*front.T, ".-", color=ACCENT_COLOUR, linewidth=1.0, markersize=5, label="front")
    marked = {"color": Q_COLOUR, "markerfacecolor": "none", "markersize": 10, "linestyle": "none"}
    left.plot(*front[compromise], "o", label="compromise", **marked)
    low = front.min(axis=0)
    size = np.where(np.ptp(front, axis=0) > 0.0, np.ptp(front, axis=0), 0.01 * np.abs(low) + 1e-12)
    limits = np.column_stack((low - 0.15 * size, low + _VIEW * size))
    left.set(xlabel=measures[0], ylabel=measures[1], xlim=limits[0], ylim=limits[1])
    left.locator_params(axis="x", nbins=5)
    left.legend(loc="best", frameon=False)
    along = 100.0 * (front[:, 0] / front[0, 0] - 1.0) if front[0, 0] > 0.0 else front[:, 0]
    reference = np.where(parameters[compromise] != 0.0, np.abs(parameters[compromise]), 1.0)
    shares = 100.0 * (parameters - parameters[compromise]) / reference
    colours = series_colours(len(names))
    for i, (name, share) in enumerate(zip(names, shares.T, strict=True)):
        line = "--" if colours[i] in colours[:i] else "-"  # there are fewer colours than names
        right.plot(along, share, line, color=colours[i], linewidth=1.0, marker=".", label=name)
    right.axvline(along[compromise], color=BETWEEN_COLOUR, linewidth=0.8)
    right.set(
        xlabel=f"{measures[0]}, % above its best" if front[0, 0] > 0.0 else measures[0],
        ylabel="parameter, % from the compromise",
    )
    right.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure
