"""Types of the compiled module; documented in measures/, pairwise.py and nearest.py.

Options are given by name; those left out have the defaults that ``measures()`` returns.
"""

from collections.abc import Callable
from typing import Any, Literal, SupportsIndex, TypeAlias, TypedDict

import numpy as np
import numpy.typing as npt

_Array: TypeAlias = npt.NDArray[np.float64]
_Path: TypeAlias = npt.NDArray[np.int64]
_Options: TypeAlias = dict[str, Any]
_Report: TypeAlias = Callable[[int, int], object]

class BuildInfo(TypedDict):
    version: str
    compiler: str
    eigen: str
    instruction_sets: list[str]
    active: str

def build_info() -> BuildInfo: ...
def measures() -> dict[str, dict[str, Any]]: ...
def choices() -> dict[str, tuple[str, ...]]: ...
def presets() -> dict[str, dict[str, tuple[bool, dict[str, Any]]]]: ...

# The value of each measure, by its name.
def __getattr__(measure: str, /) -> Callable[[_Array, _Array, _Options], float]: ...
def area_quads(P: _Array, Q: _Array, options: _Options, /) -> tuple[_Array, _Array]: ...
def pcm_match(
    P: _Array, Q: _Array, options: _Options, /
) -> tuple[float, float, float, Literal["P", "Q"], _Array, float]: ...
def frechet_path(P: _Array, Q: _Array, options: _Options, /) -> tuple[float, _Path]: ...
def frechet_table(P: _Array, Q: _Array, options: _Options, /) -> _Array: ...
def frechet_info(
    P: _Array, Q: _Array, options: _Options, /
) -> tuple[float, bool, int, float, tuple[float, float], dict[str, float]]: ...
def dtw_path(P: _Array, Q: _Array, options: _Options, /) -> tuple[float, _Path]: ...
def dtw_table(P: _Array, Q: _Array, options: _Options, /) -> _Array: ...
def dtw_info(
    P: _Array, Q: _Array, options: _Options, /
) -> tuple[float, bool, int, float, tuple[float, float], dict[str, float]]: ...
def curve_length_residuals(P: _Array, Q: _Array, options: _Options, /) -> _Array: ...
def frechet_continuous_bounds(
    P: _Array, Q: _Array, options: _Options, /
) -> tuple[float, float]: ...
def frechet_continuous_path(P: _Array, Q: _Array, options: _Options, /) -> tuple[float, _Array]: ...
def frechet_within(P: _Array, Q: _Array, distance: float, continuous: bool, /) -> bool: ...
def value_and_gradient(
    measure: str, P: _Array, Q: _Array, options: _Options, /
) -> tuple[float, _Array]: ...
def sum_of_squares(P: _Array, Q: _Array, /) -> float: ...
def mse(P: _Array, Q: _Array, /) -> float: ...
def mae(P: _Array, Q: _Array, /) -> float: ...
def normalize(P: _Array, C: _Array, name: str, /) -> _Array: ...
def cdist(
    XA: list[_Array],
    XB: list[_Array] | None,
    measure: str,
    options: _Options,
    out: _Array,
    workers: SupportsIndex,
    cutoff: float,
    progress: _Report | None,
    /,
) -> None: ...
def check_batch(
    XA: list[_Array], XB: list[_Array] | None, measure: str, options: _Options, /
) -> None: ...
def pdist(
    X: list[_Array],
    measure: str,
    options: _Options,
    out: _Array,
    workers: SupportsIndex,
    cutoff: float,
    progress: _Report | None,
    /,
) -> None: ...
def is_symmetric(measure: str, options: _Options, /) -> bool: ...

class Prepared:
    def __init__(self, P: _Array, measure: str, options: _Options, /) -> None: ...
    def value(self, Q: _Array, /) -> float: ...
    def values(self, Qs: list[_Array], workers: SupportsIndex, /) -> _Array: ...

class Index:
    def __init__(self, curves: list[_Array], measure: str, options: _Options, /) -> None: ...
    def add(self, curves: list[_Array], /) -> None: ...
    def size(self) -> int: ...
    def curves(self) -> list[_Array]: ...
    def kneighbors(
        self,
        X: list[_Array] | None,
        n_neighbors: int,
        workers: SupportsIndex,
        progress: _Report | None,
        /,
    ) -> tuple[_Array, _Path, tuple[int, int, int]]: ...
    def radius_neighbors(
        self,
        X: list[_Array] | None,
        radius: float,
        sort_results: bool,
        with_distances: bool,
        workers: SupportsIndex,
        progress: _Report | None,
        /,
    ) -> tuple[_Array, _Path, _Path, tuple[int, int, int]]: ...

def dtw_subsequences(
    P: _Array, Q: _Array, count: int, options: _Options, /
) -> list[tuple[float, int, int]]: ...
def frechet_subsequences(
    P: _Array, Q: _Array, count: int, options: _Options, /
) -> list[tuple[float, int, int]]: ...
def dtw_mean(
    curves: list[_Array],
    weights: list[float],
    initial: _Array,
    window: SupportsIndex | float | None,
    iterations: SupportsIndex,
    tolerance: float,
    workers: SupportsIndex,
    progress: _Report | None,
    /,
) -> tuple[_Array, _Array, bool]: ...
