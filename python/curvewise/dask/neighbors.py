"""The nearest of many curves, in an index of each block of them, with dask."""

from __future__ import annotations

import itertools
import operator
from collections.abc import Callable
from functools import partial
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from .._core import check_batch
from ..curves.inputs import Array, as_curve_lists
from ..curves.layouts import Layout
from ..curves.reference_systems import check_reference_systems
from ..many import pairwise
from ..many.nearest import Index, checked_count
from ..many.pairwise import Curves
from ..measures.registry import MeasureName
from .pieces import Piece, block_size, dask_array, lazy_array, pieces, refuse_local_only, tokenize

__all__ = ["kneighbors"]


# Shared text: layout
def kneighbors(
    X: Curves,
    curves: Curves,
    n_neighbors: SupportsIndex = 5,
    measure: MeasureName = "dtw",
    *,
    block: SupportsIndex | None = None,
    layout: Layout | None = None,
    **options: Any,
) -> tuple[dask_array.Array, dask_array.Array]:
    """Find the curves that are nearest to each of some others, with dask.

    Parameters
    ----------
    X : array_like, shape (q, n, d), or a sequence of curves
        The query curves.
    curves : array_like, shape (k, n, d), or a sequence of curves
        Where.
    n_neighbors : int
        Number of neighbours of each query, from 1 to the number of `curves`.
    measure, **options
        As for :class:`curvewise.Index`.
    block : int, optional
        As for :func:`cdist`: an index holds this many curves.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Returns
    -------
    distances, indices : dask.array.Array, shape (q, n_neighbors)
        Lazy: ``dask.compute(distances, indices)`` computes both at once. They have the bits that
        :meth:`curvewise.Index.kneighbors` gives them.

    Raises
    ------
    ValueError, TypeError, ImportError
        As for :func:`cdist`; ValueError if `n_neighbors` is too small or too large.

    Notes
    -----
    The index of each block of `curves` is queried with each block of X, and the best of all blocks
    are kept. Each block must find its own nearest curves, so more is computed than with a single
    index: blocks should be as large as a worker's memory allows.

    Examples
    --------
    >>> import curvewise.dask, dask
    >>> curves = [[0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]]
    >>> lazy = curvewise.dask.kneighbors([[0, 2, 3]], curves, 2, block=2)
    >>> [part.tolist() for part in dask.compute(*lazy, scheduler="threads")]
    [[[1.0, 1.0]], [[0, 1]]]
    """
    check_reference_systems(options, curves=curves, X=X)
    queries, targets = as_curve_lists(X, curves, keep_float32=True, layout=layout)
    assert targets is not None
    refuse_local_only(options)
    name = pairwise._check_names(measure, options)
    options = pairwise.of_compiled(name, options)
    check_batch(queries, targets, name, options)
    count = checked_count(n_neighbors, len(targets), "the curves")
    size = block_size(block, queries, targets)
    token = tokenize(queries, targets, name, options, size, count)
    build = partial(_index_of, measure=measure, options=options)
    return _neighbor_arrays(pieces(queries, size), pieces(targets, size), token, count, build)


def _neighbor_arrays(
    queries: list[Piece],
    targets: list[Piece],
    token: str,
    count: int,
    build: Callable[[Piece], Index],
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
    chunks = (tuple(map(len, queries)), (count,))
    distances = lazy_array(graph, f"distances-{token}", chunks, np.float64)
    return distances, lazy_array(graph, f"indices-{token}", chunks, np.int64)


def _index_of(piece: Piece, *, measure: MeasureName, options: dict[str, Any]) -> Index:
    return Index(piece.curves, measure, layout="channels_last", **options)


def _neighbors(
    piece: Piece, index: Index, *, count: int, begin: int
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
