"""All measures in plain numpy, written to be read: the oracle for the compiled library.

Same names, arguments (except ``workers``), defaults, results and errors as :mod:`curvewise`, one
module for each measure, and nothing compiled except numpy. Docstrings are those of
``curvewise.measures``, for which alone that module is imported; those in the source here become
the Notes. For every metric except minkowski (with p other than 1, 2 and inf) the
values, tables and paths of dtw and frechet equal those of the compiled library bit for bit: every
sum is written out in its order, and nothing is left to a library that may reorder it. The other
measures agree to 1e-12 relative, where no decision (longest segment, simple or complex
quadrilateral, shorter curve) hangs on rounding.

:mod:`curvewise.reference.nearest` has what is made of many distances: nearest neighbours, the runs
of a long curve, and the mean.

Tables are stored whole, so memory is O(n m) where the compiled library needs O(n + m).

"The paper" is Jekel, Venter, Venter, Stander & Haftka, "Similarity measures for identifying
material parameters from hysteresis loops using inverse analysis", Int. J. Material Forming
(2018).
"""

from __future__ import annotations

from .. import measures as _measures
from .._docstrings import inherit
from . import nearest as nearest
from .area import area, area_quads
from .curve_length import curve_length, curve_length_residuals
from .dtw import dtw, dtw_path, dtw_table
from .frechet import frechet, frechet_path, frechet_table
from .frechet_continuous import frechet_continuous, frechet_continuous_path, frechet_within
from .gradient import value_and_gradient
from .normalize import normalize
from .pcm import pcm, pcm_match
from .pointwise import mae, mse, sum_of_squares

__all__ = [
    "area",
    "area_quads",
    "curve_length",
    "curve_length_residuals",
    "dtw",
    "dtw_path",
    "dtw_table",
    "frechet",
    "frechet_continuous",
    "frechet_continuous_path",
    "frechet_path",
    "frechet_table",
    "frechet_within",
    "mae",
    "mse",
    "normalize",
    "pcm",
    "pcm_match",
    "sum_of_squares",
    "value_and_gradient",
]

for _name in __all__:
    inherit(globals()[_name], getattr(_measures, _name))
