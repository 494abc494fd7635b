"""Measured loops with simulated ones, and how the search for these converged."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..curves.inputs import Array
from . import figures as drawing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .picture import Picture

__all__ = ["drawn", "labels", "loops_and_convergence"]


def loops_and_convergence(
    experiments: Sequence[Array],
    simulations: Sequence[Array],
    history: np.recarray[Any, Any],
    objective: str,
    names: Sequence[Sequence[str]],
    titles: Sequence[str],
) -> Picture:
    """Draw simulations beside experiments, a panel for every loop, and the convergence.

    Parameters
    ----------
    experiments, simulations : sequence of ndarray, shape (n, d)
        The measured curves, and for each of them the simulated one at the optimum.
    history : numpy.recarray
        Every evaluation, with its number, its value and whether it failed.
    objective : str
        What the value is called on its axis.
    names : sequence of sequence of str
        For each loop what its coordinates are called.
    titles : sequence of str
        What the loops are called.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot: ``figure.savefig("identification.png")``.
        Notebooks show it.

    Raises
    ------
    ImportError
        Without matplotlib.

    Notes
    -----
    The first two coordinates are drawn of curves that have more.
    """
    count = len(experiments) + 1
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    figure = drawing.new_figure(figsize=(4.2 * columns, 3.4 * rows), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
    for ax in panels[count:]:
        ax.remove()
    pairs = zip(experiments, simulations, strict=True)
    for i, (experiment, simulation) in enumerate(pairs):
        measured, simulated = drawing.draw_curves(
            panels[i], experiment[:, :2], simulation[:, :2], names[i]
        )
        measured.set(label="experiment", marker=".", markersize=3, linewidth=0.6)
        simulated.set_label("simulation")
        if count > 2:
            panels[i].set_title(titles[i])
    # Outside the panels, since a loop leaves no room within.
    figure.legend(handles=[measured, simulated], loc="outside upper left", ncols=2, frameon=False)
    _draw_convergence(history, objective, panels[count - 1])
    return figure


def _draw_convergence(history: np.recarray[Any, Any], objective: str, ax: Axes) -> None:
    good = ~history.failed
    ax.plot(
        history.evaluation[good],
        history.value[good],
        ".",
        markersize=2,
        color=drawing.BETWEEN_COLOUR,
        label="evaluation",
    )
    ax.plot(
        history.evaluation,
        np.minimum.accumulate(history.value),
        color=drawing.ACCENT_COLOUR,
        linewidth=1.3,
        label="best so far",
    )
    if not good.all():
        # At the top of the axes, not at their value: penalties would flatten everything else.
        ax.plot(
            history.evaluation[~good],
            np.full(int((~good).sum()), 0.98),
            "|",
            transform=ax.get_xaxis_transform(),
            color=drawing.Q_COLOUR,
            label="failed",
        )
    positive = history.value[good & (history.value > 0)]
    if positive.size:
        ax.set_yscale("log")
        ax.set_ylim(top=2.0 * positive.max())
    ax.set(xlabel="evaluation", ylabel=objective)
    ax.legend(loc="best" if len(history) < 1000 else "upper right", frameon=False)


def labels(names: Sequence[str]) -> tuple[str, str]:
    """Return the labels of the axes on which `drawn` is drawn."""
    return ("index", names[0]) if len(names) == 1 else (names[0], names[1])


def drawn(curve: Array) -> tuple[Array, Array]:
    """Return what is drawn of a curve: its first two coordinates, or a series by its index."""
    if curve.shape[1] == 1:
        return np.arange(len(curve), dtype=np.float64), curve[:, 0]
    return curve[:, 0], curve[:, 1]
