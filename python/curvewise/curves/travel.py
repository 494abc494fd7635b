"""Distance that a coordinate travels: divides areas, and defines sections.

Coordinates are rounded to 30 bits first, so that no rounding error decides what a reversal is.
Time O(n).
"""

from __future__ import annotations

import numpy as np

from .inputs import Array

__all__ = ["GRID", "on_grid", "travel", "travel_on_grid"]

# 30 bits hold more than any measurement does, and leave room for sums of a million distances
# without rounding.
GRID = 2.0**30
# A reversal below this part of the box is noise, or an outlier, and no travel.
_LEAST_REVERSAL = 1 / 3


def on_grid(points: Array) -> Array:
    """Return coordinates in units of the grid, rounded to it."""
    return np.rint(points * GRID)


def travel(coordinate: Array) -> float:
    """Return how far a coordinate travels, to and fro, without reversals below a third of it."""
    low, extent = float(coordinate.min()), float(np.ptp(coordinate))
    return travel_on_grid((coordinate - low) / extent) / GRID * extent if extent > 0 else 0.0


def travel_on_grid(coordinate: Array) -> float:
    """Return how far a coordinate travels whose extent is `GRID`, in the same units."""
    x: list[float] = on_grid(coordinate).tolist()
    least = _LEAST_REVERSAL * GRID
    total = 0.0
    low = high = turn = x[0]
    rises: bool | None = None  # not known until it has travelled far enough
    for value in x:
        low, high = min(low, value), max(high, value)
        if rises is not False and value <= high - least:
            total += high - turn
            turn, low, rises = high, value, False
        elif rises is not True and value >= low + least:
            total += turn - low
            turn, high, rises = low, value, True
    if rises is None:
        return abs(x[-1] - turn)
    last = high if rises else low
    return total + abs(last - turn) + abs(x[-1] - last)
