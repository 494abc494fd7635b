"""The profile of a parameter: the smallest objective against its value."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..curves.inputs import Array
from .figures import new_figure
from .palette import ACCENT_COLOUR, BETWEEN_COLOUR, Q_COLOUR

if TYPE_CHECKING:
    from .picture import Picture

__all__ = ["profile_of_a_parameter"]


def profile_of_a_parameter(
    name: str,
    values: Array,
    objective: Array,
    rise: float,
    interval: tuple[float, float],
    linear: tuple[float, float],
) -> Picture:
    """Draw the objective at several values of a parameter, and two intervals.

    Parameters
    ----------
    name : str
        The name of the parameter.
    values, objective : ndarray, shape (points,)
    rise : float
        The rise of the objective at the ends of the interval.
    interval, linear : (float, float)
        The interval of the profile, and that by sensitivities.
    """
    figure = new_figure(figsize=(5.2, 3.8), layout="constrained")
    ax = figure.subplots()
    lowest, best = float(np.min(objective)), int(np.argmin(objective))
    # Between points the root of the rise is interpolated, as for the interval.
    roots = np.sqrt(objective - lowest) * np.where(np.arange(len(values)) < best, -1.0, 1.0)
    dense = np.linspace(values[0], values[-1], 200)
    ax.plot(dense, lowest + np.interp(dense, values, roots) ** 2, color=ACCENT_COLOUR)
    ax.plot(values, objective, "o", color=ACCENT_COLOUR, markersize=4, label="profile")
    level = lowest + rise
    ax.axhline(level, color=BETWEEN_COLOUR, linewidth=0.8)
    ax.plot(interval, [level] * 2, "|-", color=ACCENT_COLOUR, markersize=12, label="its interval")
    ax.plot(
        linear, [level] * 2, "|", color=Q_COLOUR, markersize=24, zorder=0, label="by sensitivities"
    )
    ax.set(xlabel=name, ylabel="objective")
    ax.legend(frameon=False, loc="upper center")
    return figure
