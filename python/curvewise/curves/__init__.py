"""Loops made ready for a comparison: branches, other points, less noise, other units.

Measured curves have points where a logger took them, noise, a start that is not zero, and
engineering values; simulations have none of these. Each function takes a curve of shape (n, d), the
order of the points being the order of loading, and returns a new one. docs/preparing_curves.md
shows them on a test.
"""

from __future__ import annotations

from .resampling import resample, trim
from .smoothing import smooth
from .stress_strain import engineering_to_true, shift_to_origin
from .turns import last_cycle, turning_points
from .z_normalization import z_normalized

__all__ = [
    "engineering_to_true",
    "last_cycle",
    "resample",
    "shift_to_origin",
    "smooth",
    "trim",
    "turning_points",
    "z_normalized",
]
