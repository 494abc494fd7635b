"""The measures: definition, options, cost and source of each.

Every function takes two curves, ``P`` (the reference, e.g. the experiment) and ``Q`` (e.g. the
simulation). A curve is anything that ``numpy.asarray`` turns into an array of finite real numbers
of shape (n, d), or (n,) for d = 1. The two may have different n. Inputs are never changed. The
compiled library computes in float64. :mod:`curvewise.reference` has the same functions in plain
numpy, and :mod:`curvewise.measures.registry` has further properties of each measure.

"The paper" is Jekel, Venter, Venter, Stander & Haftka, "Similarity measures for identifying
material parameters from hysteresis loops using inverse analysis", Int. J. Material Forming
(2018).
"""

from __future__ import annotations

from .._names import names_alone
from . import edit_distances
from .area import area, area_quads
from .common_part import common_part
from .curve_length import curve_length, curve_length_residuals
from .dtw import dtw, dtw_info, dtw_path, dtw_table
from .edit_distances import *  # noqa: F403  # the names that it lists
from .frechet import frechet, frechet_info, frechet_path, frechet_table
from .frechet_continuous import (
    frechet_continuous,
    frechet_continuous_part,
    frechet_continuous_path,
    frechet_within,
)
from .gradient import value_and_gradient, values_and_gradients
from .hausdorff import hausdorff
from .hausdorff_continuous import hausdorff_continuous, hausdorff_continuous_points
from .lower_bounds import lb_improved, lb_keogh, lb_kim
from .pcm import pcm, pcm_match
from .pointwise import mae, mse, normalize, sum_of_squares
from .shape import sbd
from .soft_dtw import soft_dtw, soft_dtw_divergence
from .step_pattern import StepPattern

__all__ = [
    *edit_distances.__all__,
    "StepPattern",
    "area",
    "area_quads",
    "common_part",
    "curve_length",
    "curve_length_residuals",
    "dtw",
    "dtw_info",
    "dtw_path",
    "dtw_table",
    "frechet",
    "frechet_continuous",
    "frechet_continuous_part",
    "frechet_continuous_path",
    "frechet_info",
    "frechet_path",
    "frechet_table",
    "frechet_within",
    "hausdorff",
    "hausdorff_continuous",
    "hausdorff_continuous_points",
    "lb_improved",
    "lb_keogh",
    "lb_kim",
    "mae",
    "mse",
    "normalize",
    "pcm",
    "pcm_match",
    "sbd",
    "soft_dtw",
    "soft_dtw_divergence",
    "sum_of_squares",
    "value_and_gradient",
    "values_and_gradients",
]
__dir__ = names_alone(__all__)
