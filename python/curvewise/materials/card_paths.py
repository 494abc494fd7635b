"""Paths of strain that a card of CalculiX follows."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..curves.inputs import Array, as_curve

__all__ = ["CYCLES", "paths_of"]

# Default cycles of a card of CalculiX: they grow to 3 %.
CYCLES = (np.array([0.005, -0.005, 0.01, -0.01, 0.02, -0.02, 0.03, -0.03]),)


def paths_of(along: Any) -> tuple[Array, ...]:
    """Return the paths of strain in `along`, one or several."""
    one = np.ndim(along[0]) == 0 if len(along) else True
    paths = tuple(as_curve(path, "along") for path in ([along] if one else along))
    for path in paths:
        if path.ndim != 1 or np.ptp(path) == 0.0:
            raise ValueError(
                f"along has a path of shape {path.shape}; give strains that change, shape (n,), or "
                "several such"
            )
    return paths
