"""Pictures of an identification: the loops at the optimum, and how the search got there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..plotting import drawing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .identification import Identification

__all__ = ["plot_identification"]


def plot_identification(identification: Identification) -> Figure:
    """Draw simulations beside experiments, a panel for every loop, and the convergence.

    Parameters
    ----------
    identification : Identification
        What `identify` returned.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot: ``figure.savefig("identification.png")``.

    Raises
    ------
    ImportError
        Without matplotlib.

    Notes
    -----
    Of curves in more than two dimensions the first two coordinates are drawn.
    """
    with drawing.matplotlib_required():
        from matplotlib.figure import Figure
    count = len(identification.experiments) + 1
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    figure = Figure(figsize=(4.2 * columns, 3.4 * rows), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
    for ax in panels[count:]:
        ax.remove()
    pairs = zip(identification.experiments, identification.simulations, strict=True)
    for i, (experiment, simulation) in enumerate(pairs):
        measured, simulated = drawing.draw_curves(panels[i], experiment[:, :2], simulation[:, :2])
        measured.set(label="experiment", marker=".", markersize=3, linewidth=0.6)
        simulated.set_label("simulation")
        if count > 2:
            panels[i].set_title(f"Loop {i}")
    # Outside, since a loop leaves no room within.
    figure.legend(handles=[measured, simulated], loc="outside upper left", ncols=2, frameon=False)
    _draw_convergence(identification, panels[count - 1])
    return figure


def _draw_convergence(identification: Identification, ax: Axes) -> None:
    history = identification.history
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
        # In axes coordinates: their penalties would flatten everything else.
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
    ax.set(xlabel="evaluation", ylabel=f"{identification.measure} ({identification.preset})")
    ax.legend(loc="best" if len(history) < 1000 else "upper right", frameon=False)
