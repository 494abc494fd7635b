"""How alike two curves are: area, partial curve mapping, Fréchet, DTW and curve length.

>>> import curvewise
>>> experiment, simulation = curvewise.datasets.hysteresis_pair()
>>> print(curvewise.compare(experiment, simulation))  # doctest: +SKIP
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from . import _environment as _environment  # looks before the compiled module is loaded

# isort: split
from . import _core, curves, datasets
from .averages import dtw_mean, medoid
from .compare import Comparison, compare
from .curve_files import read_curve
from .embedding import get_include
from .measures import (
    area,
    area_quads,
    curve_length,
    curve_length_residuals,
    dtw,
    dtw_info,
    dtw_path,
    dtw_table,
    frechet,
    frechet_continuous,
    frechet_continuous_path,
    frechet_info,
    frechet_path,
    frechet_table,
    frechet_within,
    mae,
    mse,
    normalize,
    pcm,
    pcm_match,
    sum_of_squares,
    value_and_gradient,
)
from .nearest import Index
from .pairwise import Prepared, available_measures, cdist, pdist
from .results import (
    Alignment,
    AreaQuads,
    DtwMean,
    Matching,
    PcmMatch,
    Subsequence,
    WarpingInfo,
)
from .subsequence import subsequence

if TYPE_CHECKING:
    from . import calibration as calibration
    from . import compat as compat
    from . import dask as dask
    from . import plotting as plotting
    from . import reference as reference
    from . import sklearn as sklearn
    from . import solvers as solvers
    from . import studies as studies

__all__ = [
    "Alignment",
    "AreaQuads",
    "Comparison",
    "DtwMean",
    "Index",
    "Matching",
    "PcmMatch",
    "Prepared",
    "Subsequence",
    "WarpingInfo",
    "__version__",
    "area",
    "area_quads",
    "available_measures",
    "build_info",
    "cdist",
    "compare",
    "curve_length",
    "curve_length_residuals",
    "curves",
    "datasets",
    "dtw",
    "dtw_info",
    "dtw_mean",
    "dtw_path",
    "dtw_table",
    "frechet",
    "frechet_continuous",
    "frechet_continuous_path",
    "frechet_info",
    "frechet_path",
    "frechet_table",
    "frechet_within",
    "get_include",
    "mae",
    "medoid",
    "mse",
    "normalize",
    "pcm",
    "pcm_match",
    "pdist",
    "read_curve",
    "reference",
    "subsequence",
    "sum_of_squares",
    "value_and_gradient",
]

_LAZY = (
    "calibration",
    "compat",
    "dask",
    "plotting",
    "reference",
    "sklearn",
    "solvers",
    "studies",
)

# Hidden from type checkers, which would otherwise accept every misspelt attribute.
if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """Import a submodule that ``import curvewise`` leaves out to be fast."""
        if name in _LAZY:
            return import_module(f"{__name__}.{name}")
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    # help() imports all of these, and the import of some fails where their packages are missing.
    return sorted({*globals(), *_LAZY} - {"dask", "sklearn"})


def build_info() -> _core.BuildInfo:
    """Return how the compiled library was built and what it uses on this machine.

    Returns
    -------
    dict
        "version", "compiler", "eigen", "instruction_sets" (those this machine has, the slowest
        first) and "active" (the one in use).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.build_info()["active"] in curvewise.build_info()["instruction_sets"]
    True
    """
    return _core.build_info()


__version__: str = _core.build_info()["version"]
