"""Preparation of loops, and their energy, stiffness and damping.

Measured curves have irregularly placed points, noise, an offset, and engineering values;
simulations do not. Each function takes a curve of shape (n, d) with its points in the order of
loading. docs/how_to/prepare_curves.md and docs/how_to/analyse_hysteresis_loops.md show them on
tests.
"""

from __future__ import annotations

from .._names import names_alone
from .backbone import backbone
from .common_span import common_span
from .cycles import loop_energy, loops, peaks_and_valleys
from .derivative import derivative
from .resampling import resample, trim
from .reversals import reversals
from .simplification import simplify
from .smoothing import smooth
from .stiffness import damping, stiffness
from .stress_strain import engineering_to_true, shift_to_origin
from .turns import last_cycle, turning_points
from .z_normalization import z_normalized

__all__ = [
    "backbone",
    "common_span",
    "damping",
    "derivative",
    "engineering_to_true",
    "last_cycle",
    "loop_energy",
    "loops",
    "peaks_and_valleys",
    "resample",
    "reversals",
    "shift_to_origin",
    "simplify",
    "smooth",
    "stiffness",
    "trim",
    "turning_points",
    "z_normalized",
]
__dir__ = names_alone(__all__)
