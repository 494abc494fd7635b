"""Types of the compiled module; documented in measures.py."""

from typing import Literal, TypedDict

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
    p: float | None,
    step_pattern: str,
    window: int | None,
    open_begin: bool,
    open_end: bool,
    workers: int,
    /,
) -> float: ...
def dtw_path(
    P: _Array,
    Q: _Array,
    metric: str,
    p: float | None,
    step_pattern: str,
    window: int | None,
    open_begin: bool,
    open_end: bool,
    workers: int,
    /,
) -> tuple[float, _Path]: ...
def dtw_table(
    P: _Array,
    Q: _Array,
    metric: str,
    p: float | None,
    step_pattern: str,
    window: int | None,
    open_begin: bool,
    open_end: bool,
    /,
) -> _Array: ...
def frechet(P: _Array, Q: _Array, metric: str, p: float | None, workers: int, /) -> float: ...
def frechet_path(
    P: _Array, Q: _Array, metric: str, p: float | None, workers: int, /
) -> tuple[float, _Path]: ...
def frechet_table(P: _Array, Q: _Array, metric: str, p: float | None, /) -> _Array: ...
def area(P: _Array, Q: _Array, spacing: str, crossing: str, squared: bool, /) -> float: ...
def area_quads(P: _Array, Q: _Array, spacing: str, crossing: str, /) -> tuple[_Array, _Array]: ...
def pcm(P: _Array, Q: _Array, offsets: int | str, /) -> float: ...
def pcm_match(
    P: _Array, Q: _Array, offsets: int | str, /
) -> tuple[float, float, float, Literal["P", "Q"], _Array]: ...
def curve_length(P: _Array, Q: _Array, scale: str, /) -> float: ...
def curve_length_residuals(P: _Array, Q: _Array, scale: str, /) -> _Array: ...
def sum_of_squares(P: _Array, Q: _Array, /) -> float: ...
def mse(P: _Array, Q: _Array, /) -> float: ...
def mae(P: _Array, Q: _Array, /) -> float: ...
def normalize(P: _Array, C: _Array, name: str, /) -> _Array: ...
