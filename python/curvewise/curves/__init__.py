"""Loops made ready for a comparison, and what is read from them: energy, stiffness, damping.

Measured curves have points where a logger took them, noise, a start that is not zero, and
engineering values; simulations have none of these. Each function takes a curve of shape (n, d), the
order of the points being the order of loading. docs/preparing_curves.md and
docs/hysteresis_loops.md show them on tests.
"""

from __future__ import annotations

from .backbone import backbone
from .common_span import common_span
from .cycles import loop_energy, loops, peaks_and_valleys
from .resampling import resample, trim
from .reversals import reversals
from .smoothing import smooth
from .stiffness import damping, stiffness
from .stress_strain import engineering_to_true, shift_to_origin
from .turns import last_cycle, turning_points
from .z_normalization import z_normalized

__all__ = [
    "backbone",
    "common_span",
    "damping",
    "engineering_to_true",
    "last_cycle",
    "loop_energy",
    "loops",
    "peaks_and_valleys",
    "resample",
    "reversals",
    "shift_to_origin",
    "smooth",
    "stiffness",
    "trim",
    "turning_points",
    "z_normalized",
]
