"""One measure between many curves, on any scheduler of dask: threads, processes, a cluster.

Nearest neighbours are found block by block, in an index of each block of the curves, and merged.

The matrix of :func:`curvewise.cdist` is cut into blocks. A block is one call of curvewise.cdist for
some rows and columns, made wherever dask makes it; without XB, a block of a symmetric measure below
the diagonal is the transpose of the one above. Since a value depends on its two curves alone, the
blocks change no bit, and a block that is lost with its worker is simply computed again. Cost: that
of the local matrix, and about a millisecond a block for dask's scheduler. The curves go into the
graph once, in pieces of a block's rows or columns.
"""

from __future__ import annotations

import itertools
import operator
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, SupportsFloat, SupportsIndex

import numpy as np
import numpy.typing as npt

from .._core import check_batch, is_symmetric
from .._extras import extra
from .._options import whole_number
from ..curves.inputs import Array, as_curve_list, copy_of
from ..many import pairwise
from ..many.nearest import Index, checked_count
from ..many.pairwise import Curves, Measure
from ..measures.registry import MeasureName
from .cancelled import watch

with extra("dask", "curvewise.dask needs dask"):
    # Absolute, so these are the packages of that name and not this module.
    import dask.array as dask_array
    from dask.base import tokenize
    from dask.highlevelgraph import HighLevelGraph

__all__ = ["cdist", "kneighbors"]

# Points of the curves of a block's rows, and of its columns, where the caller does not say: 10^9
# cells of dtw or frechet, about a second, which is long beside what a block costs the scheduler.
_BLOCK_POINTS = 32_000
_LOCAL_ONLY = ("out", "progress", "workers")


def cdist(
    XA: Curves,
    XB: Curves | None = None,
    measure: Measure = "dtw",
    *,
    block: SupportsIndex | None = None,
    cutoff: SupportsFloat | None = None,
    **options: Any,
) -> dask_array.Array:
    """Compute a measure between every curve of one list and every curve of another, with dask.

    Parameters
    ----------
    XA, XB, measure, cutoff, **options
        As for :func:`curvewise.cdist`. A callable must be one that the scheduler's workers can
        unpickle; cloudpickle takes lambdas to them too.
    block : int, optional
        Curves per block, at least 1: a block has this many rows and columns. If not given, as many
        as have some 32,000 points together: about a second of dtw or frechet a block.

    Returns
    -------
    dask.array.Array, shape (k, l)
        Lazy: ``.compute()`` runs it on the scheduler in use. Entry (i, j) has the bits that
        :func:`curvewise.cdist` gives it.

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.cdist`, at once and not when the blocks are computed (except for a
        `window` that admits no path); a `block` below 1; one of `out`, `progress` and `workers`.
    ImportError
        dask is not installed: ``pip install "curvewise[dask]"``.

    Notes
    -----
    Time: that of curvewise.cdist, shared by the scheduler's workers, and some milliseconds a
    block. Each block runs on one thread and releases the interpreter's lock, so that dask's threads
    serve as well as its processes. Memory: the graph holds a copy of the curves; a worker holds
    those of its blocks. A cluster warns of a graph above 10 MB
    (``distributed.admin.large-graph-warning-threshold``); here that is the curves themselves, which
    are sent once. The bar of ``dask.diagnostics.ProgressBar`` or the cluster's dashboard shows the
    progress. Ctrl-C ends the blocks that have begun within 0.2 s, cancelling a task within 1 s.

    Examples
    --------
    >>> import curvewise.dask
    >>> curves = [[0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]]
    >>> lazy = curvewise.dask.cdist(curves, measure="dtw", block=2)
    >>> lazy.chunks
    ((2, 1), (2, 1))
    >>> lazy.compute(scheduler="threads").tolist()
    [[0.0, 2.0, 5.0], [2.0, 0.0, 3.0], [5.0, 3.0, 0.0]]
    """
    rows = as_curve_list(XA, "XA")
    columns = rows if XB is None else as_curve_list(XB, "XB", like=XA)
    limit = pairwise._checked_cutoff(cutoff)
    _refuse_local_only(options)
    mirrored = False
    if not callable(measure):
        name = pairwise._check_names(measure, options)
        mirrored = is_symmetric(name, options) and XB is None  # it checks the options too
        # A block cannot say where in the whole list a curve is.
        check_batch(rows, None if XB is None else columns, name, options)
    size = _block_size(block, rows, columns)
    token = tokenize(rows, columns, measure, limit, options, size, mirrored)
    compute = partial(_block, measure=measure, cutoff=limit, options=options)
    pieces = _pieces(rows, size)
    return _blocks(pieces, None if mirrored else _pieces(columns, size), token, compute)


def kneighbors(
    X: Curves,
    curves: Curves,
    n_neighbors: SupportsIndex = 5,
    measure: MeasureName = "dtw",
    *,
    block: SupportsIndex | None = None,
    **options: Any,
) -> tuple[dask_array.Array, dask_array.Array]:
    """Find the curves that are nearest to each of some others, with dask.

    Parameters
    ----------
    X : array_like, shape (q, n, d), or a sequence of curves
        What to look for.
    curves : array_like, shape (k, n, d), or a sequence of curves
        Where.
    n_neighbors : int
        How many to find for each, from 1 to the number of `curves`.
    measure, **options
        As for :class:`curvewise.Index`.
    block : int, optional
        As for :func:`cdist`: an index holds this many curves.

    Returns
    -------
    distances, indices : dask.array.Array, shape (q, n_neighbors)
        Lazy: ``dask.compute(distances, indices)`` computes both at once. They have the bits that
        :meth:`curvewise.Index.kneighbors` gives them.

    Raises
    ------
    ValueError, TypeError, ImportError
        As for :func:`cdist`; ValueError for an `n_neighbors` that is too small or too large.

    Notes
    -----
    An index of each block of `curves` is asked for the neighbours of each block of X, and the best
    of all blocks are kept. Each block has to find its own nearest, so that more is computed than by
    a single index: blocks should be as large as a worker's memory allows.

    Examples
    --------
    >>> import curvewise.dask, dask
    >>> curves = [[0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]]
    >>> lazy = curvewise.dask.kneighbors([[0, 2, 3]], curves, 2, block=2)
    >>> [part.tolist() for part in dask.compute(*lazy, scheduler="threads")]
    [[[1.0, 1.0]], [[0, 1]]]
    """
    queries = as_curve_list(X, "XA")
    targets = as_curve_list(curves, "XB", like=X)
    _refuse_local_only(options)
    name = pairwise._check_names(measure, options)
    check_batch(queries, targets, name, options)
    count = checked_count(n_neighbors, len(targets), "the curves")
    size = _block_size(block, queries, targets)
    token = tokenize(queries, targets, name, options, size, count)
    build = partial(_index_of, measure=measure, options=options)
    return _neighbor_arrays(_pieces(queries, size), _pieces(targets, size), token, count, build)


def _neighbor_arrays(
    queries: list[_Piece],
    targets: list[_Piece],
    token: str,
    count: int,
    build: Callable[[_Piece], Index],
) -> tuple[dask_array.Array, dask_array.Array]:
    """Return lazy distances and indices: an index for each piece of targets."""
    P, index, found, merged = (f"{part}-{token}" for part in ("kn-P", "kn-index", "kn", "kn-best"))
    graph: dict[Any, Any] = {(P, a): piece for a, piece in enumerate(queries)}
    graph |= {(index, b): (build, piece) for b, piece in enumerate(targets)}
    begins = [0, *itertools.accumulate(map(len, targets))][:-1]
    for a in range(len(queries)):
        for b, begin in enumerate(begins):
            graph[found, a, b] = (partial(_neighbors, count=count, begin=begin), (P, a), (index, b))
        parts = [(found, a, b) for b in range(len(targets))]
        graph[merged, a] = (partial(_best, count=count), parts)
        for which, part in enumerate(("distances", "indices")):
            graph[f"{part}-{token}", a, 0] = (operator.itemgetter(which), (merged, a))
    arrays = []
    array: Callable[..., dask_array.Array] = dask_array.Array
    for part, dtype in (("distances", np.float64), ("indices", np.int64)):
        name = f"{part}-{token}"
        layers = HighLevelGraph.from_collections(name, graph)
        arrays.append(array(layers, name, (tuple(map(len, queries)), (count,)), dtype=dtype))
    return arrays[0], arrays[1]


def _index_of(piece: _Piece, *, measure: MeasureName, options: dict[str, Any]) -> Index:
    return Index(piece.curves, measure, **options)


def _neighbors(
    piece: _Piece, index: Index, *, count: int, begin: int
) -> tuple[Array, npt.NDArray[np.int64]]:
    """Return the nearest of a block, with their places in the whole list."""
    distances, indices = index.kneighbors(piece.curves, min(count, len(index)))
    return distances, indices + begin


def _best(
    parts: list[tuple[Array, npt.NDArray[np.int64]]], *, count: int
) -> tuple[Array, npt.NDArray[np.int64]]:
    """Return the nearest of all blocks, which come in the order of the curves."""
    distances = np.concatenate([part[0] for part in parts], axis=1)
    indices = np.concatenate([part[1] for part in parts], axis=1)
    order = np.argsort(distances, axis=1, kind="stable")[:, :count]
    return np.take_along_axis(distances, order, axis=1), np.take_along_axis(indices, order, axis=1)


class _Piece:
    """Some curves as one object of a graph, in which dask looks for no tasks."""

    __slots__ = ("curves",)

    def __init__(self, curves: list[Array]) -> None:
        self.curves = curves

    def __len__(self) -> int:
        return len(self.curves)

    def __sizeof__(self) -> int:
        return object.__sizeof__(self) + sum(curve.nbytes for curve in self.curves)


def _pieces(curves: list[Array], size: int) -> list[_Piece]:
    """Cut a list into pieces of `size` curves, at least one; copied: who owns them may write."""
    starts = range(0, max(len(curves), 1), size)
    return [_Piece([copy_of(curve) for curve in curves[i : i + size]]) for i in starts]


def _blocks(
    rows: list[_Piece], columns: list[_Piece] | None, token: str, compute: partial[Array]
) -> dask_array.Array:
    """Return the lazy matrix: a task for each piece of curves, and one for each block.

    Without columns it is that of the rows and themselves, of a symmetric measure.

    The graph is written out, since no function of dask.array leaves blocks to their transposes:
    see "Custom graphs" in dask's documentation.
    """
    name, P, Q = (f"{part}-{token}" for part in ("cdist", "cdist-P", "cdist-Q"))
    graph: dict[Any, Any] = {(P, a): piece for a, piece in enumerate(rows)}
    graph |= {(Q, b): piece for b, piece in enumerate(columns or [])}
    chunks = tuple(tuple(map(len, pieces)) for pieces in (rows, columns or rows))
    for a, b in itertools.product(*(range(len(lengths)) for lengths in chunks)):
        if columns:
            graph[name, a, b] = (compute, (P, a), (Q, b))
        elif a == b:
            graph[name, a, b] = (compute, (P, a))
        elif a > b:
            graph[name, a, b] = (np.transpose, (name, b, a))
        else:
            graph[name, a, b] = (compute, (P, a), (P, b))
    layers = HighLevelGraph.from_collections(name, graph)
    # The constructor has no annotations of dask's.
    array: Callable[..., dask_array.Array] = dask_array.Array
    return array(layers, name, chunks, dtype=np.float64)


def _block(
    rows: _Piece,
    columns: _Piece | None = None,
    *,
    measure: Measure,
    cutoff: float,
    options: dict[str, Any],
) -> Array:
    """Compute a block; without columns one of the diagonal, each of its pairs once."""
    others = None if columns is None else columns.curves
    progress = watch() or False
    return pairwise.cdist(rows.curves, others, measure, cutoff=cutoff, progress=progress, **options)


def _block_size(
    block: SupportsIndex | None, rows: Sequence[Array], columns: Sequence[Array]
) -> int:
    if block is None:
        count = len(rows) + len(columns)
        points = sum(map(len, rows)) + sum(map(len, columns))
        return max(1, _BLOCK_POINTS * count // max(points, 1))
    return whole_number("block", block, 1, "give a whole number >= 1, or None")


def _refuse_local_only(options: dict[str, Any]) -> None:
    for name in _LOCAL_ONLY:
        if name in options:
            raise TypeError(
                f"curvewise.dask.cdist has no {name!r}: the scheduler runs the blocks, shows how "
                "far they are and holds the result"
            )
