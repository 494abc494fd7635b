"""Similarity of two curves: area, partial curve mapping, Fréchet, DTW and curve length.

>>> import curvewise
>>> experiment, simulation = curvewise.datasets.hysteresis_pair()
>>> print(curvewise.compare(experiment, simulation))  # doctest: +SKIP
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from . import _environment as _environment  # looks before the compiled module is loaded

# isort: split
from . import curves, datasets, measures
from ._core import build_info as _build_info
from .comparing.comparison import Comparison, compare
from .comparing.tube import tube
from .curves.layouts import LayoutWarning
from .files.curve_files import read_curve
from .many.averages import dtw_mean, medoid, soft_dtw_mean
from .many.matrix_profile import matrix_profile
from .many.nearest import Index
from .many.pairwise import available_measures, cdist, pdist
from .many.prepared import Prepared
from .many.subsequences import subsequence
from .measures import *  # noqa: F403  # the names that measures/__init__ lists
from .measures.edit_distances import *  # noqa: F403  # which type checkers do not see in that list
from .measures.results import *  # noqa: F403  # likewise

if TYPE_CHECKING:
    from . import aeon as aeon
    from . import calibration as calibration
    from . import compat as compat
    from . import dask as dask
    from . import geopandas as geopandas
    from . import installation as installation
    from . import jax as jax
    from . import plotting as plotting
    from . import reference as reference
    from . import sklearn as sklearn
    from . import sktime as sktime
    from . import solvers as solvers
    from . import studies as studies
    from . import torch as torch

__all__ = [
    *measures.__all__,
    *measures.results.__all__,
    "Comparison",
    "Index",
    "LayoutWarning",
    "Prepared",
    "__version__",
    "available_measures",
    "cdist",
    "compare",
    "curves",
    "datasets",
    "dtw_mean",
    "matrix_profile",
    "medoid",
    "pdist",
    "read_curve",
    "reference",
    "soft_dtw_mean",
    "subsequence",
    "tube",
]

_LAZY = (
    "aeon",
    "calibration",
    "compat",
    "dask",
    "fitting",
    "geopandas",
    "installation",
    "jax",
    "materials",
    "plotting",
    "reference",
    "sklearn",
    "sktime",
    "solvers",
    "studies",
    "torch",
)

# Hidden from type checkers, which would otherwise accept every misspelt attribute.
if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """Import a submodule that ``import curvewise`` leaves out to be fast."""
        if name in _LAZY:
            return import_module(f"{__name__}.{name}")
        message = f"module {__name__!r} has no attribute {name!r}"
        if measure := {"ddtw": "dtw", "wddtw": "wdtw"}.get(name):
            message += f"; write {measure}(derivative(P), derivative(Q)), with "
            message += "curvewise.curves.derivative"
        raise AttributeError(message)


def __dir__() -> list[str]:
    # help() imports all of these, and the import of some fails where their packages are missing.
    return sorted({*__all__, *_LAZY} - {"dask", "geopandas", "jax", "sklearn", "sktime", "torch"})


__version__: str = _build_info()["version"]
