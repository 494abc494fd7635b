"""The names, arguments and numbers of similaritymeasures 1.5.0.

A program written for that package runs with one changed line::

    import curvewise.compat as similaritymeasures

The DTW table and the discrete Fréchet distance come from the compiled library. Area, partial curve
mapping and curve length are numpy code that repeats that package's arithmetic: their values are
bitwise identical, even if its choices differ from those of the paper. Use :mod:`curvewise` itself
for new programs. Its area does not measure lengths twice, its partial curve mapping is the paper's,
and its paths do not depend on how a tie is stored.

These oddities are reproduced:

- a vertical segment is not bisected when ``area_between_two_curves`` refines a curve: its first
  point is repeated, as often as points are missing;
- arrays keep their dtype, so that midpoints in integer curves are truncated and differences of
  small integers wrap around;
- a direction without extent, a curve without length and a mean of zero give nan or inf, and no
  error.

These properties differ:

- lists, tuples and DataFrames work everywhere, and nan or inf comes without a warning;
- ``dtw`` and ``frechet_dist`` never skip a distance that is nan (there, some metrics do): curves
  with nan give nan;
- distances whose squares or powers leave the range of a double are right (there, they are 0 or
  inf); "minkowski" agrees to 1e-12 relative, every other metric bit for bit;
- no argument is changed (there, ``makeQuad`` reorders the lists it is given);
- masked entries, complex numbers, objects, curves without points or coordinates and, in ``mae``
  and ``mse``, pandas objects with different labels are refused with an error that says so.

scipy is needed only for metrics that the compiled library does not have, and for nan or inf in
``dtw`` and ``frechet_dist``: ``pip install "curvewise[compat]"``.
"""

from .._names import names_alone
from ._arc_length import curve_length_measure, get_length, normalizeTwoCurves, pcm
from ._area import area_between_two_curves, get_arc_length, is_simple_quad, makeQuad, poly_area
from ._pointwise import mae, mse
from ._warping import dtw, dtw_path, frechet_dist

__all__ = [
    "area_between_two_curves",
    "curve_length_measure",
    "dtw",
    "dtw_path",
    "frechet_dist",
    "get_arc_length",
    "get_length",
    "is_simple_quad",
    "mae",
    "makeQuad",
    "mse",
    "normalizeTwoCurves",
    "pcm",
    "poly_area",
]
__dir__ = names_alone(__all__)

__version__ = "1.5.0"  # of the package whose names and numbers these are; programs print it
