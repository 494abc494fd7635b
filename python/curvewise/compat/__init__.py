"""The names, arguments and numbers of similaritymeasures 1.5.0.

A program written for that package runs with one changed line::

    import curvewise.compat as similaritymeasures

The DTW table and the discrete Fréchet distance come from the compiled library; area, partial
curve mapping and curve length are numpy code that repeats that package's arithmetic, so that the
numbers agree to 1e-12 relative, also where its choices are not those of the paper. New programs
want :mod:`curvewise` itself: its area needs no re-measuring of lengths, its partial curve mapping
is the paper's, its paths do not depend on how a tie is stored.

The same as there: arrays keep their dtype, so that integer curves are refined by truncated
midpoints and integer differences wrap; a direction without extent, a curve without length and a
mean of zero give nan or inf, not an error. Different:

- lists, tuples and DataFrames work everywhere, and nan or inf comes without a warning;
- ``dtw`` and ``frechet_dist`` of curves with nan are nan (there, some skip what is nan);
- distances whose squares or powers leave the range of a double are right (there, 0 or inf);
- no argument is changed (there, ``makeQuad`` reorders the lists it is given);
- masked entries, complex numbers, objects, curves without points or coordinates and, in ``mae``
  and ``mse``, pandas objects with different labels are refused with an error that says so.

scipy is needed only for metrics the compiled library does not have, and for nan or inf in ``dtw``
and ``frechet_dist``: ``pip install 'curvewise[compat]'``.
"""

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

__version__ = "1.5.0"  # of the package whose names and numbers these are; programs print it
