"""The distances of aeon in its layouts, with Fréchet and Hausdorff.

A series of aeon has shape (n_channels, n_timepoints) or (n_timepoints,). A collection has shape
(n_cases, n_channels, n_timepoints) or (n_cases, n_timepoints), or is a list of series of different
lengths. A curve is the transpose of a series. Names, order and defaults of the arguments are those
of aeon 1.6; values agree to 1e-12. A collection is compared in one compiled call; the functions
import numpy alone. Features of aeon that are missing here raise an error: Itakura's parallelogram,
windows for series of different lengths (aeon uses another band there), `g_arr` of erp,
`independent=False` of msm. If several paths are cheapest, another one may be returned. Time O(n m)
for each pair.

For each name there are ``dtw_distance``, ``dtw_pairwise_distance`` and, except for lcss, msm,
frechet, frechet_continuous and hausdorff, ``dtw_cost_matrix`` and ``dtw_alignment_path``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, SupportsFloat, SupportsIndex, TypeAlias

import numpy as np

from ._extras import extra
from ._names import did_you_mean, names_alone
from .curves.inputs import Array
from .curves.layouts import with_known_layout
from .many.pairwise import cdist
from .measures.registry import MEASURES, WARPINGS, MeasureName

__all__ = [
    "adtw_alignment_path",
    "adtw_cost_matrix",
    "adtw_distance",
    "adtw_pairwise_distance",
    "dtw_alignment_path",
    "dtw_cost_matrix",
    "dtw_distance",
    "dtw_pairwise_distance",
    "edr_alignment_path",
    "edr_cost_matrix",
    "edr_distance",
    "edr_pairwise_distance",
    "entries",
    "erp_alignment_path",
    "erp_cost_matrix",
    "erp_distance",
    "erp_pairwise_distance",
    "frechet_continuous_distance",
    "frechet_continuous_pairwise_distance",
    "frechet_distance",
    "frechet_pairwise_distance",
    "hausdorff_distance",
    "hausdorff_pairwise_distance",
    "lcss_distance",
    "lcss_pairwise_distance",
    "msm_distance",
    "msm_pairwise_distance",
    "twe_alignment_path",
    "twe_cost_matrix",
    "twe_distance",
    "twe_pairwise_distance",
    "wdtw_alignment_path",
    "wdtw_cost_matrix",
    "wdtw_distance",
    "wdtw_pairwise_distance",
]
__dir__ = names_alone(__all__)

Series: TypeAlias = Any
"""An array of shape (n_channels, n_timepoints) or (n_timepoints,)."""
Collection: TypeAlias = Any
"""Series, in an array of two or three dimensions or in a list."""


class _Distance(NamedTuple):
    """One of aeon's distances.

    Attributes
    ----------
    measure : str
        The measure that it is.
    defaults : mapping
        The options of the measure that are others there.
    names : mapping
        The names of its options in aeon, and here.
    has_window : bool
        Whether it takes a window.
    has_path : bool
        Whether it has a table, with the values of aeon's, and a path.
    """

    measure: MeasureName
    defaults: Mapping[str, Any] = {}
    names: Mapping[str, str] = {}
    has_window: bool = True
    has_path: bool = True


_SQUARED = {"metric": "sqeuclidean"}
_DISTANCES = {
    "dtw": _Distance("dtw", _SQUARED),
    "adtw": _Distance("dtw", {**_SQUARED, "penalty": 1.0}, {"warp_penalty": "penalty"}),
    "wdtw": _Distance("wdtw", names={"g": "steepness"}),
    "lcss": _Distance("lcss", names={"epsilon": "epsilon"}, has_path=False),
    "erp": _Distance("erp", names={"g": "gap"}),
    "edr": _Distance("edr", names={"epsilon": "epsilon"}),
    "twe": _Distance("twe", names={"nu": "stiffness", "lmbda": "penalty"}),
    "msm": _Distance("msm", names={"c": "cost"}, has_path=False),
    "frechet": _Distance("frechet", has_path=False),
    "frechet_continuous": _Distance("frechet_continuous", has_window=False, has_path=False),
    "hausdorff": _Distance("hausdorff", has_window=False, has_path=False),
}


def entries() -> list[dict[str, Any]]:
    """Return the distances as the entries of aeon's own table of them.

    Returns
    -------
    list of dict
        Each with the keys of an entry of ``aeon.distances._distance.DISTANCES``: name, distance,
        pairwise_distance, type, symmetric, unequal_support and, where there is one, cost_matrix and
        alignment_path.

    Raises
    ------
    ImportError
        If aeon is missing: ``pip install "curvewise[aeon]"``.

    Examples
    --------
    >>> import curvewise.aeon
    >>> [entry["name"] for entry in curvewise.aeon.entries()][:3]  # doctest: +SKIP
    ['dtw', 'adtw', 'wdtw']
    """
    with extra("aeon", "the entries of aeon's table need aeon"):
        from aeon.distances._distance import DistanceType
    return [
        {
            "name": name,
            **functions,
            "type": DistanceType.ELASTIC,
            "symmetric": True,
            "unequal_support": True,
        }
        for name, functions in _FUNCTIONS.items()
    ]


def _curve(series: Series, name: str) -> Array:
    """Return a series as a curve, which has its points as rows."""
    array = np.asarray(series)
    if array.ndim not in (1, 2):
        raise ValueError(
            f"{name} has {array.ndim} dimensions; a series has shape (n_channels, n_timepoints) or "
            "(n_timepoints,)"
        )
    curve = array.T
    in_doubt = curve.ndim == 2 and curve.shape[1] > len(curve) and curve.dtype.kind in "fiub"
    return with_known_layout(curve) if in_doubt else curve


def _curves(collection: Collection, name: str, is_one: bool = False) -> list[Array]:
    """Return a collection as a list of curves; a single series, too, as a list of one."""
    array = collection if isinstance(collection, np.ndarray) else None
    if array is not None and (array.ndim == 1 or (array.ndim == 2 and is_one)):
        return [_curve(array, name)]
    return [_curve(series, f"{name}[{place}]") for place, series in enumerate(collection)]


def _is_multivariate(collection: Collection) -> bool:
    """Return whether a collection has several channels."""
    if isinstance(collection, np.ndarray):
        return collection.ndim == 3 and collection.shape[1] > 1
    return bool(np.ndim(collection[0]) == 2 and len(collection[0]) > 1)


def _translated(
    name: str, options: Mapping[str, Any], window: SupportsFloat | None, lengths: Sequence[int]
) -> dict[str, Any]:
    """Return curvewise's options for aeon's."""
    measure, defaults, names, has_window, _ = _DISTANCES[name]
    known = ["window"] * has_window + list(names)
    for given in options:
        if given not in names:
            raise TypeError(
                f"{name} of curvewise.aeon has no option {given!r}; it has "
                f"{', '.join(known) or 'none'}{did_you_mean([given], known)}"
            )
    found = {**defaults, **{names[given]: value for given, value in options.items()}}
    if window is None or float(window) == 1.0:
        return found
    if not has_window:
        raise TypeError(f"{name} has no window")
    if not 0.0 <= float(window) <= 1.0:
        raise ValueError(f"window = {window}: give the share of the series' length, from 0 to 1")
    if len(set(lengths)) > 1:
        raise ValueError(
            f"window with series of {min(lengths)} to {max(lengths)} timepoints: aeon's band is "
            f"another there; curvewise.{measure} has a window for them, in timepoints"
        )
    band = int(float(window) * lengths[0])
    if name == "lcss" and band == 0:
        raise ValueError(
            f"window = {window} leaves the diagonal alone, on which aeon's lcss forgets its "
            "matches; curvewise.lcss(x.T, y.T, window=0) counts them all"
        )
    return {**found, "window": band}


def _of_pair(
    name: str, x: Series, y: Series, window: SupportsFloat | None, options: Mapping[str, Any]
) -> tuple[Array, Array, dict[str, Any]]:
    """Return two series as curves, and the measure's options."""
    P, Q = _curve(x, "x"), _curve(y, "y")
    return P, Q, _translated(name, options, window, (len(P), len(Q)))


def _distance_of(name: str) -> Callable[..., Any]:
    measure = MEASURES[_DISTANCES[name].measure].function

    def distance(
        x: Series, y: Series, window: SupportsFloat | None = None, **options: Any
    ) -> float:
        P, Q, translated = _of_pair(name, x, y, window, options)
        return measure(P, Q, **translated)

    return _documented(distance, name, "distance", "float")


def _pairwise_distance_of(name: str) -> Callable[..., Any]:
    def pairwise_distance(
        X: Collection,
        y: Collection | None = None,
        window: SupportsFloat | None = None,
        *,
        n_jobs: SupportsIndex = 1,
        **options: Any,
    ) -> Array:
        first = _curves(X, "X", y is not None and _is_multivariate(y))
        second = None if y is None else _curves(y, "y", _is_multivariate(X))
        lengths = [len(curve) for curve in first + (second or [])]
        translated = _translated(name, options, window, lengths)
        matrix = cdist(first, second, _DISTANCES[name].measure, workers=n_jobs, **translated)
        return np.asarray(matrix)

    result = "ndarray, shape (n_cases, n_cases) or (n_cases, m_cases)"
    return _documented(pairwise_distance, name, "pairwise_distance", result)


def _cost_matrix_of(name: str) -> Callable[..., Any]:
    table = WARPINGS[_DISTANCES[name].measure].table

    def cost_matrix(
        x: Series, y: Series, window: SupportsFloat | None = None, **options: Any
    ) -> Array:
        P, Q, translated = _of_pair(name, x, y, window, options)
        return table(P, Q, **translated)

    return _documented(cost_matrix, name, "cost_matrix", "ndarray, shape (n, m)")


def _alignment_path_of(name: str) -> Callable[..., Any]:
    path = WARPINGS[_DISTANCES[name].measure].path

    def alignment_path(
        x: Series, y: Series, window: SupportsFloat | None = None, **options: Any
    ) -> tuple[list[tuple[int, int]], float]:
        P, Q, translated = _of_pair(name, x, y, window, options)
        found = path(P, Q, **translated)
        return [(int(i), int(j)) for i, j in found.path], found.distance

    result = "list of tuples (i, j), and the distance"
    return _documented(alignment_path, name, "alignment_path", result)


def _documented(
    function: Callable[..., Any], name: str, kind: str, result: str
) -> Callable[..., Any]:
    """Return a function with the name that it has in aeon, and its docstring."""
    measure, defaults, names, has_window, _ = _DISTANCES[name]
    fixed = "".join(f", {option}={value!r}" for option, value in defaults.items())
    renamed = [f"`{there}` is its `{here}`" for there, here in names.items()]
    if has_window:
        renamed.insert(0, "`window` is a share of the length, for series of one length")
    options = "; ".join(renamed) or "it has no options"
    function.__name__ = function.__qualname__ = f"{name}_{kind}"
    function.__doc__ = f"""Compute the {kind.replace("_", " ")} that aeon calls ``{name}``.

    It is that of ``curvewise.{measure}(x.T, y.T{fixed})``, whose docstring has errors, cost and
    source: {options}.

    Returns
    -------
    {result}
    """
    return function


def _functions_of(name: str) -> dict[str, Callable[..., Any]]:
    """Return the functions of one distance by the keys that they have in aeon's table."""
    functions = {"distance": _distance_of(name), "pairwise_distance": _pairwise_distance_of(name)}
    if _DISTANCES[name].has_path:
        functions["cost_matrix"] = _cost_matrix_of(name)
        functions["alignment_path"] = _alignment_path_of(name)
    return functions


_FUNCTIONS = {name: _functions_of(name) for name in _DISTANCES}

# Named one by one, for pickle, for editors and for type checkers.
dtw_distance, dtw_pairwise_distance, *_rest = _FUNCTIONS["dtw"].values()
dtw_cost_matrix, dtw_alignment_path = _rest
adtw_distance, adtw_pairwise_distance, *_rest = _FUNCTIONS["adtw"].values()
adtw_cost_matrix, adtw_alignment_path = _rest
wdtw_distance, wdtw_pairwise_distance, *_rest = _FUNCTIONS["wdtw"].values()
wdtw_cost_matrix, wdtw_alignment_path = _rest
erp_distance, erp_pairwise_distance, *_rest = _FUNCTIONS["erp"].values()
erp_cost_matrix, erp_alignment_path = _rest
edr_distance, edr_pairwise_distance, *_rest = _FUNCTIONS["edr"].values()
edr_cost_matrix, edr_alignment_path = _rest
twe_distance, twe_pairwise_distance, *_rest = _FUNCTIONS["twe"].values()
twe_cost_matrix, twe_alignment_path = _rest
lcss_distance, lcss_pairwise_distance = _FUNCTIONS["lcss"].values()
msm_distance, msm_pairwise_distance = _FUNCTIONS["msm"].values()
frechet_distance, frechet_pairwise_distance = _FUNCTIONS["frechet"].values()
(
    frechet_continuous_distance,
    frechet_continuous_pairwise_distance,
) = _FUNCTIONS["frechet_continuous"].values()
hausdorff_distance, hausdorff_pairwise_distance = _FUNCTIONS["hausdorff"].values()
