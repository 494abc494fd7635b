"""Types of the compiled module; documented in measures.py."""

from collections.abc import Callable
from typing import Any, Literal, SupportsFloat, SupportsIndex, TypedDict

import numpy as np
import numpy.typing as npt

_Array = npt.NDArray[np.float64]
_Path = npt.NDArray[np.int64]

class BuildInfo(TypedDict):
    version: str
    compiler: str
    eigen: str
    instruction_sets: list[str]
    active: str

def build_info() -> BuildInfo: ...
def dtw(
    P: _Array,
    Q: _Array,
    metric: str,
    p: SupportsFloat | None,
    step_pattern: str,
    window: SupportsIndex | None,
    open_begin: bool,
    open_end: bool,
    workers: SupportsIndex,
    /,
) -> float: ...
def dtw_path(
    P: _Array,
    Q: _Array,
    metric: str,
    p: SupportsFloat | None,
    step_pattern: str,
    window: SupportsIndex | None,
    open_begin: bool,
    open_end: bool,
    workers: SupportsIndex,
    /,
) -> tuple[float, _Path]: ...
def dtw_table(
    P: _Array,
    Q: _Array,
    metric: str,
    p: SupportsFloat | None,
    step_pattern: str,
    window: SupportsIndex | None,
    open_begin: bool,
    open_end: bool,
    /,
) -> _Array: ...
def frechet(
    P: _Array, Q: _Array, metric: str, p: SupportsFloat | None, workers: SupportsIndex, /
) -> float: ...
def frechet_path(
    P: _Array, Q: _Array, metric: str, p: SupportsFloat | None, workers: SupportsIndex, /
) -> tuple[float, _Path]: ...
def frechet_table(P: _Array, Q: _Array, metric: str, p: SupportsFloat | None, /) -> _Array: ...
def area(P: _Array, Q: _Array, spacing: str, crossing: str, squared: bool, /) -> float: ...
def area_quads(P: _Array, Q: _Array, spacing: str, crossing: str, /) -> tuple[_Array, _Array]: ...
def pcm(P: _Array, Q: _Array, offsets: SupportsIndex | str, /) -> float: ...
def pcm_match(
    P: _Array, Q: _Array, offsets: SupportsIndex | str, /
) -> tuple[float, float, float, Literal["P", "Q"], _Array]: ...
def curve_length(P: _Array, Q: _Array, scale: str, /) -> float: ...
def curve_length_residuals(P: _Array, Q: _Array, scale: str, /) -> _Array: ...
def cdist(
    XA: list[_Array],
    XB: list[_Array] | None,
    measure: str,
    options: tuple[Any, ...],
    out: _Array,
    workers: SupportsIndex,
    cutoff: float,
    progress: Callable[[int, int], object] | None,
    /,
) -> None: ...
def pdist(
    X: list[_Array],
    measure: str,
    options: tuple[Any, ...],
    out: _Array,
    workers: SupportsIndex,
    cutoff: float,
    progress: Callable[[int, int], object] | None,
    /,
) -> None: ...
def is_symmetric(measure: str, options: tuple[Any, ...], /) -> bool: ...

class Prepared:
    def __init__(self, P: _Array, measure: str, options: tuple[Any, ...], /) -> None: ...
    def value(self, Q: _Array, /) -> float: ...
    def values(self, Qs: list[_Array], workers: SupportsIndex, /) -> _Array: ...

def sum_of_squares(P: _Array, Q: _Array, /) -> float: ...
def mse(P: _Array, Q: _Array, /) -> float: ...
def mae(P: _Array, Q: _Array, /) -> float: ...
def normalize(P: _Array, C: _Array, name: str, /) -> _Array: ...
