"""Measured and simulated loops, with the convergence or the parameters."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..curves.inputs import Array
from ..curves.named_curve import Labels
from .figures import draw_curves, label_axes, legend_above, log_ticks, new_figure, xy_labels, xy_of
from .palette import (
    ACCENT_COLOUR,
    BETWEEN_COLOUR,
    FILL_COLOUR,
    GROUND_COLOUR,
    Q_COLOUR,
    series_colours,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .picture import Picture

__all__ = ["loops_and_convergence", "loops_and_places"]


def loops_and_convergence(
    experiments: Sequence[Array],
    simulations: Sequence[Array],
    history: np.recarray[Any, Any],
    objective: str,
    names: Sequence[Sequence[str]],
    titles: Sequence[str],
) -> Picture:
    """Draw simulations and experiments, a panel per loop, and the convergence.

    Parameters
    ----------
    experiments, simulations : sequence of ndarray, shape (n, d)
        The measured curves, and the simulated curve of each at the optimum.
    history : numpy.recarray
        Every evaluation, with its number, its value and whether it failed.
    objective : str
        The label of the value's axis.
    names : sequence of sequence of str
        For each loop the names of its coordinates.
    titles : sequence of str
        The names of the loops.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot: ``figure.savefig("identification.png")``.
        Notebooks show it.

    Raises
    ------
    ImportError
        If matplotlib is missing.

    Notes
    -----
    For curves with more coordinates, the first two are drawn.
    """
    figure, panels, last = _panels(titles, (4.2, 3.4))
    for ax, P, Q, axes in zip(panels, experiments, simulations, names, strict=True):
        measured, simulated = draw_curves(ax, P, Q, Labels(tuple(axes)))
        measured.set(label="experiment", marker=".", markersize=3, linewidth=0.6)
        simulated.set_label("simulation")
    legend_above(figure, panels[0])
    _draw_convergence(history, objective, last)
    return figure


def loops_and_places(
    experiments: Sequence[Array],
    simulations: Mapping[str, Sequence[Array]],
    places: Mapping[str, Mapping[str, float]],
    names: Sequence[Sequence[str]],
    titles: Sequence[str],
) -> Picture:
    """Draw several simulations of every experiment, and where their parameters are.

    Parameters
    ----------
    experiments, names, titles
        As for `loops_and_convergence`.
    simulations : mapping of str to sequence of ndarray
        The simulations by name, a curve for every experiment.
    places : mapping of str to mapping of str to float
        By the same names, the place of each parameter between its bounds, 0 to 1.
    """
    figure, panels, last = _panels(titles, (4.6, 3.6))
    colours = dict(zip(simulations, series_colours(len(simulations)), strict=True))
    for i, (ax, experiment) in enumerate(zip(panels, experiments, strict=True)):
        ax.plot(*xy_of(experiment), ".", color=FILL_COLOUR, markersize=3, label="experiment")
        for name, curves in simulations.items():
            ax.plot(*xy_of(curves[i]), color=colours[name], linewidth=1.1, label=name)
        label_axes(ax, *xy_labels(names[i]))
    legend_above(figure, panels[0])
    parameters = list(next(iter(places.values())))
    rows = range(len(parameters))
    last.hlines(rows, 0.0, 1.0, color=GROUND_COLOUR, linewidth=4, zorder=0)
    for name, of_parameters in places.items():
        found = list(of_parameters.values())
        last.plot(found, rows, "o", color=colours[name], markersize=5, markerfacecolor="none")
    last.set_yticks(rows, parameters)
    last.invert_yaxis()
    last.set(xlim=(-0.03, 1.03), xlabel="place between the bounds", title="Parameters")
    return figure


def _panels(titles: Sequence[str], size: tuple[float, float]) -> tuple[Picture, list[Axes], Axes]:
    """Return a figure, a panel for every loop, with its title if there are several, and one more.

    `size` is that of a panel in inches.
    """
    count = len(titles) + 1
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    figure = new_figure(figsize=(size[0] * columns, size[1] * rows), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
    for ax in panels[count:]:
        ax.remove()
    # A single loop without a user-defined name needs no title.
    if count > 2 or not titles[0].startswith("Loop "):
        for ax, title in zip(panels, titles, strict=False):
            ax.set_title(title)
    return figure, panels[: count - 1], panels[count - 1]


def _draw_convergence(history: np.recarray[Any, Any], objective: str, ax: Axes) -> None:
    number, value, good = history.evaluation, history.value, ~history.failed
    best = np.minimum.accumulate(value)
    ax.plot(number[good], value[good], ".", markersize=2, color=BETWEEN_COLOUR, label="evaluation")
    ax.plot(number, best, color=ACCENT_COLOUR, linewidth=1.3, label="best so far")
    if not good.all():
        # At the top of the axes, not at their value: penalties would flatten everything else.
        failed, top = number[~good], ax.get_xaxis_transform()
        ax.plot(failed, [0.98] * len(failed), "|", transform=top, color=Q_COLOUR, label="failed")
    positive = value[good & (value > 0)]
    if positive.size and (ticks := log_ticks(positive.min(), positive.max())):
        ax.set_yscale("log")
        ax.set_ylim(top=2.0 * positive.max())
        ax.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
        ax.minorticks_off()
    elif positive.size:
        ax.set_ylim(top=1.05 * positive.max())
    ax.set(xlabel="evaluation", ylabel=objective)
    ax.legend(loc="best" if len(history) < 1000 else "upper right", frameon=False)
