"""All measures in plain numpy, written to be read: the oracle for the compiled library.

The interface, results and errors are those of :mod:`curvewise`, without ``workers``, and with one
module for each measure. Only numpy is compiled. Docstrings are copied from ``curvewise.measures``,
which is imported only for that purpose; the docstrings in the source here become the Notes. The
values, tables and paths of dtw and frechet are bitwise identical to those of the compiled library.
The only exception is the metric minkowski with p other than 1, 2 and inf. Every sum is therefore
written out in its order, without library functions that may reorder it. The other measures agree to
1e-12 relative, if decisions do not depend on rounding (longest segment, simple or complex
quadrilateral, shorter curve).

:mod:`curvewise.reference.nearest` has the functions of many distances: nearest neighbours,
subsequences of a long curve, and the mean. :mod:`curvewise.reference.materials` has the
material-point models, integrated with many small steps.

Tables are stored whole, so memory is O(n m) where the compiled library needs O(n + m).

"The paper" is Jekel, Venter, Venter, Stander & Haftka, "Similarity measures for identifying
material parameters from hysteresis loops using inverse analysis", Int. J. Material Forming
(2018).
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING

from .. import measures as _measures
from .._docstrings import inherit
from .._names import names_alone
from . import nearest as nearest

if TYPE_CHECKING:  # the same names and signatures; a test compares them one by one
    from ..measures import *  # noqa: F403

__all__: list[str] = []

# Functions of the modules that are also measures.
for _found in iter_modules(globals()["__path__"]):
    _module = import_module(f"{__name__}.{_found.name}")
    for _name in set(_module.__all__) & set(_measures.__all__):
        globals()[_name] = getattr(_module, _name)
        inherit(globals()[_name], getattr(_measures, _name))
        __all__.append(_name)
__all__.sort()
__dir__ = names_alone(__all__)
