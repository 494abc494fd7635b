"""Pieces of a list of curves for the blocks of a matrix, and their sizes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, SupportsIndex

from .._extras import extra
from .._options import whole_number
from ..curves.inputs import Array, copy_of

with extra("dask", "curvewise.dask needs dask"):
    # Absolute, so these are the packages of that name and not this one.
    import dask.array as dask_array
    from dask.base import tokenize
    from dask.delayed import Delayed
    from dask.highlevelgraph import HighLevelGraph

__all__ = [
    "Delayed",
    "HighLevelGraph",
    "Piece",
    "block_size",
    "dask_array",
    "lazy_array",
    "pieces",
    "refuse_local_only",
    "tokenize",
]

# Default number of points of the curves of a block's rows, and of its columns. That is 10^9 cells
# of dtw or frechet, about a second, which is long compared with the scheduler's overhead per block.
_BLOCK_POINTS = 32_000
_BLOCK_CURVES = 2048  # at most, of short curves: 32 MB of distances
_LOCAL_ONLY = ("out", "progress", "workers")


class Piece:
    """Some curves as one object of a graph, in which dask looks for no tasks."""

    __slots__ = ("curves",)

    def __init__(self, curves: list[Array]) -> None:
        self.curves = curves

    def __len__(self) -> int:
        return len(self.curves)

    def __sizeof__(self) -> int:
        return object.__sizeof__(self) + sum(curve.nbytes for curve in self.curves)


def pieces(curves: list[Array], size: int) -> list[Piece]:
    """Cut a list into pieces of `size` curves, at least one; copied: who owns them may write."""
    starts = range(0, max(len(curves), 1), size)
    return [Piece([copy_of(curve) for curve in curves[i : i + size]]) for i in starts]


def lazy_array(
    graph: dict[Any, Any], name: str, chunks: tuple[tuple[int, ...], ...], dtype: Any
) -> dask_array.Array:
    """Return the array whose blocks are the tasks (name, i, …) of a graph."""
    # dask does not annotate the constructor.
    array: Callable[..., dask_array.Array] = dask_array.Array
    return array(HighLevelGraph.from_collections(name, graph), name, chunks, dtype=dtype)


def block_size(block: SupportsIndex | None, *lists: Sequence[Array]) -> int:
    """Return how many curves a block's side has: as given, or some 32,000 points."""
    if block is None:
        count = sum(map(len, lists))
        points = sum(len(curve) for curves in lists for curve in curves)
        return max(1, min(_BLOCK_CURVES, _BLOCK_POINTS * count // max(points, 1)))
    return whole_number("block", block, 1, "give a whole number >= 1, or None")


def refuse_local_only(options: dict[str, Any]) -> None:
    """Raise TypeError for an option that only the functions of this machine have."""
    for name in _LOCAL_ONLY:
        if name in options:
            raise TypeError(
                f"curvewise.dask.cdist has no {name!r}: the scheduler runs the blocks, shows how "
                "far they are and holds the result"
            )
