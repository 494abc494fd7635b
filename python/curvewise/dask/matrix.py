"""The matrix of all distances, or its upper triangle, block by block with dask.

Without XB, a block of a symmetric measure below the diagonal is the transpose of the one above. The
triangle is cut into sections of equal length; each is a few rows of the matrix.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, SupportsFloat, SupportsIndex

import numpy as np
import numpy.typing as npt

from .._core import build_info, check_batch, is_symmetric
from .._options import check_choice
from ..curves.inputs import Array, as_curve_list, as_curve_lists
from ..curves.layouts import Layout
from ..curves.reference_systems import check_reference_systems
from ..many import pairwise
from ..many.pairwise import Curves, Measure
from .cancelled import watch
from .pieces import (
    Piece,
    block_size,
    dask_array,
    lazy_array,
    pieces,
    refuse_local_only,
    tokenize,
)
from .stored_matrix import Contents, Known, begin_store

__all__ = ["cdist", "pdist"]

Store = str | os.PathLike[str]


# Shared text: layout
def cdist(
    XA: Curves,
    XB: Curves | None = None,
    measure: Measure = "dtw",
    *,
    block: SupportsIndex | None = None,
    cutoff: SupportsFloat | None = None,
    store: Store | None = None,
    dtype: npt.DTypeLike = "float64",
    layout: Layout | None = None,
    **options: Any,
) -> dask_array.Array:
    """Compute a measure between all curves of two lists with dask.

    Parameters
    ----------
    XA, XB, measure, cutoff, **options
        As for :func:`curvewise.cdist`. The scheduler's workers must be able to unpickle a callable;
        cloudpickle also transfers lambdas.
    block : int, optional
        Number of curves per block, at least 1: a block has this many rows and columns. By default a
        block's curves have about 32,000 points together, and it has at most 2048 curves: about a
        second of dtw or frechet for each block.
    store : path, optional
        A folder for the matrix. The matrix is then computed at once, on the scheduler in use, and
        written block by block as a zarr array. If a call is interrupted, even by SIGKILL, repeat
        it: it computes only the missing blocks. With new curves behind the stored ones, the matrix
        grows: the call computes only the rows and columns of the new curves. `block` is that of the
        store then. Stored blocks are checked first. A warning names the damaged ones, which are
        computed again. Workers of a cluster must see the same folder.
    dtype : {"float64", "float32"}
        The type of the distances. They are computed in float64; "float32" rounds them, which halves
        the disk and the memory of the result.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Returns
    -------
    dask.array.Array, shape (k, l)
        A lazy array: ``.compute()`` runs it on the scheduler in use; with `store` it reads the
        stored blocks. Entry (i, j) is bitwise identical to that of :func:`curvewise.cdist`, or to
        that in float32.

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.cdist`, raised at once and not when the blocks are computed (except
        for a `window` that does not admit a path). If `block` is below 1, or one of `out`,
        `progress` and `workers` is given. If `store` was begun for other curves or options, or by
        another version of curvewise, or its description is damaged. If `store` is given with a
        callable, which may have changed since. If a stored block is damaged later, ``.compute()``
        raises ValueError.
    ImportError
        If dask is missing: ``pip install "curvewise[dask]"``. If zarr is missing for a store: ``pip
        install "curvewise[zarr]"``.

    Notes
    -----
    Time: that of curvewise.cdist, shared by the scheduler's workers, and some milliseconds a
    block. Each block runs on one thread and releases the interpreter's lock, so that dask's threads
    serve as well as its processes. Memory: the graph holds a copy of the curves; a worker holds
    those of its blocks. A cluster warns of a graph above 10 MB
    (``distributed.admin.large-graph-warning-threshold``); here that is the curves themselves, which
    are sent once. The bar of ``dask.diagnostics.ProgressBar`` or the cluster's dashboard shows the
    progress. Ctrl-C ends the blocks that have begun within 0.2 s, cancelling a task within 1 s.

    A store takes 8 k l bytes of disk, 4 k l in float32, and each thread the memory of up to three
    blocks. One program at a time may fill it. A matrix that grows writes the blocks at its edge
    again; arrays that this function returned before cannot read them then.
    ``zarr.open_array(store)`` reads a store without dask. It notices a block whose content has
    changed, but not blocks that have changed places.

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
    check_reference_systems(options, measure=measure, XA=XA, XB=XB)
    rows, others = as_curve_lists(XA, XB, keep_float32=True, layout=layout)
    columns = rows if others is None else others
    limit = pairwise.checked_limit("cutoff", cutoff, measure, options)
    refuse_local_only(options)
    mirrored = False
    if not callable(measure):
        name = pairwise._check_names(measure, options)
        options = pairwise.of_compiled(name, options)
        mirrored = is_symmetric(name, options) and XB is None  # it checks the options too
        # A block cannot say where in the whole list a curve is.
        check_batch(rows, others, name, options)
    dtype = _checked_dtype(dtype)
    size = block_size(block, rows, columns)
    kept = None
    if store is not None:
        curves = {"XA": rows, "XB": rows if XB is None else columns}
        contents = Contents(_settings(measure, limit, options, dtype), **curves)
        shape = len(rows), len(columns)
        kept = begin_store(store, shape, (size, size), contents, keep_block=block is None)
        size = kept.store.array.chunks[0]
    token = tokenize(rows, columns, measure, limit, options, size, mirrored, dtype)
    compute = partial(_block, measure=measure, cutoff=limit, options=options, dtype=dtype)
    sides = pieces(rows, size), None if mirrored else pieces(columns, size)
    build = partial(_blocks, *sides, token, compute, dtype)
    return kept.filled(build) if kept else build({})


# Shared text: layout
def pdist(
    X: Curves,
    measure: Measure = "dtw",
    *,
    block: SupportsIndex | None = None,
    cutoff: SupportsFloat | None = None,
    store: Store | None = None,
    dtype: npt.DTypeLike = "float64",
    layout: Layout | None = None,
    **options: Any,
) -> dask_array.Array:
    """Compute a symmetric measure between every two curves of a list, with dask.

    Parameters
    ----------
    X, measure, cutoff, **options
        As for :func:`curvewise.pdist`; a callable as for :func:`cdist`.
    block : int, optional
        As for :func:`cdist`: a block has as many distances as one of the matrix.
    store : path, optional
        As for :func:`cdist`; it takes half the disk, and does not grow.
    dtype : {"float64", "float32"}
        As for :func:`cdist`.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Returns
    -------
    dask.array.Array, shape (k (k-1) / 2,)
        Lazy, as that of :func:`cdist`, with the bits of :func:`curvewise.pdist`.

    Raises
    ------
    ValueError, TypeError, ImportError
        As for :func:`cdist`; ValueError if a measure is not symmetric.

    Notes
    -----
    As for :func:`cdist`, except that a block needs all curves behind its first one, and computes up
    to two rows that it has only in part.

    Examples
    --------
    >>> import curvewise.dask
    >>> curves = [[0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]]
    >>> lazy = curvewise.dask.pdist(curves, "dtw", block=1)
    >>> lazy.compute(scheduler="threads").tolist()
    [2.0, 5.0, 3.0]
    """
    check_reference_systems(options, measure=measure, X=X)
    curves = as_curve_list(X, "X", keep_float32=True, layout=layout)
    limit = pairwise.checked_limit("cutoff", cutoff, measure, options)
    refuse_local_only(options)
    if not callable(measure):
        name = pairwise._check_names(measure, options)
        options = pairwise.of_compiled(name, options)
        pairwise._check_symmetric(name, options)
        check_batch(curves, None, name, options)
    dtype = _checked_dtype(dtype)
    size = block_size(block, curves)
    token = tokenize(curves, measure, limit, options, size, dtype)
    compute = partial(_run, measure=measure, cutoff=limit, options=options, dtype=dtype)
    lazy = _runs(pieces(curves, size), size, token, compute, dtype)
    if store is None:
        return lazy
    contents = Contents(_settings(measure, limit, options, dtype), X=curves)
    return begin_store(store, lazy.shape, (size * size,), contents).filled(lambda _: lazy)


def _checked_dtype(dtype: npt.DTypeLike) -> str:
    name = np.dtype(dtype).name
    check_choice("dtype", name, ("float64", "float32"))
    return name


def _settings(
    measure: Measure, limit: float, options: Mapping[str, Any], dtype: str
) -> dict[str, str]:
    """Return what the distances of a store depend on besides the curves."""
    if callable(measure):
        raise ValueError(
            "a store needs a measure by its name: a function may be another one when the store is "
            "begun again"
        )
    return {
        "measure": measure,
        "options": repr(sorted(options.items())),
        "cutoff": repr(limit),
        "dtype": dtype,
        "version of curvewise": build_info()["version"],
    }


def _blocks(
    rows: list[Piece],
    columns: list[Piece] | None,
    token: str,
    compute: partial[Array],
    dtype: str,
    known: Known,
) -> dask_array.Array:
    """Return the lazy matrix: a task for each piece of curves, and one for each block.

    Without columns it is that of the rows and themselves, of a symmetric measure. Blocks in `known`
    are extended.

    The graph is written out, since no function of dask.array leaves blocks to their transposes:
    see "Custom graphs" in dask's documentation.
    """
    name, P, Q = (f"{part}-{token}" for part in ("cdist", "cdist-P", "cdist-Q"))
    graph: dict[Any, Any] = {(P, a): piece for a, piece in enumerate(rows)}
    graph |= {(Q, b): piece for b, piece in enumerate(columns or [])}
    chunks = tuple(tuple(map(len, pieces)) for pieces in (rows, columns or rows))
    for a, b in itertools.product(*(range(len(lengths)) for lengths in chunks)):
        stored = known.get((a, b))
        task = partial(_extended, stored=stored, compute=compute) if stored else compute
        if columns:
            graph[name, a, b] = (task, (P, a), (Q, b))
        elif a == b:
            graph[name, a, b] = (task, (P, a))
        elif a > b:
            graph[name, a, b] = (np.transpose, (name, b, a))
        else:
            graph[name, a, b] = (task, (P, a), (P, b))
    return lazy_array(graph, name, chunks, dtype)


def _extended(
    rows: Piece,
    columns: Piece | None = None,
    *,
    stored: Callable[[], Array],
    compute: partial[Array],
) -> Array:
    """Compute what a block has besides its stored first rows and columns."""
    corner = stored()
    k, m = corner.shape
    old, new = Piece(rows.curves[:k]), Piece(rows.curves[k:])
    if columns is None:
        beside = compute(old, new)
        return np.block([[corner, beside], [beside.T, compute(new)]])
    beside = compute(old, Piece(columns.curves[m:]))
    return np.vstack([np.hstack([corner, beside]), compute(new, columns)])


def _block(
    rows: Piece,
    columns: Piece | None = None,
    *,
    measure: Measure,
    cutoff: float,
    options: dict[str, Any],
    dtype: str,
) -> Array:
    """Compute a block; without columns one of the diagonal, each of its pairs once."""
    others = None if columns is None else columns.curves
    progress = watch() or False
    wanted = {"cutoff": cutoff, "progress": progress, "layout": "channels_last", **options}
    return np.asarray(pairwise.cdist(rows.curves, others, measure, **wanted), dtype)


def _runs(
    parts: list[Piece], size: int, token: str, compute: partial[Array], dtype: str
) -> dask_array.Array:
    """Return the lazy triangle, row by row, in runs of size * size distances."""
    name, P = (f"{part}-{token}" for part in ("pdist", "pdist-P"))
    graph: dict[Any, Any] = {(P, a): piece for a, piece in enumerate(parts)}
    count = sum(map(len, parts))
    begins = [*range(0, max(count * (count - 1) // 2, 1), size * size), count * (count - 1) // 2]
    row_begins = np.cumsum([0, *range(count - 1, 0, -1)])  # where each row of the triangle begins
    for run, (begin, end) in enumerate(itertools.pairwise(begins)):
        first, last = np.searchsorted(row_begins, [begin, end - 1], side="right") - 1
        behind = [(P, a) for a in range(first // size, len(parts))]
        offset = first - first // size * size
        part = partial(
            compute,
            rows=range(offset, offset + last - first + 1),
            within=slice(begin - row_begins[first], end - row_begins[first]),
        )
        graph[name, run] = (part, behind)
    lengths = tuple(end - begin for begin, end in itertools.pairwise(begins))
    return lazy_array(graph, name, (lengths,), dtype)


def _run(
    parts: list[Piece],
    *,
    rows: range,
    within: slice,
    measure: Measure,
    cutoff: float,
    options: dict[str, Any],
    dtype: str,
) -> Array:
    """Compute some rows of the triangle and return the requested part."""
    curves = [curve for piece in parts for curve in piece.curves]
    ours, others = curves[rows.start : rows.stop], curves[rows.stop :]
    wanted = {"measure": measure, "cutoff": cutoff, "progress": watch() or False, **options}
    wanted["layout"] = "channels_last"
    triangle, rectangle = pairwise.pdist(ours, **wanted), pairwise.cdist(ours, others, **wanted)
    begins = np.cumsum([0, *range(len(ours) - 1, -1, -1)])
    pairs = zip(itertools.pairwise(begins), rectangle, strict=True)
    parts_of_rows = (part for (i, j), row in pairs for part in (triangle[i:j], row))
    return np.concatenate([np.empty(0), *parts_of_rows])[within].astype(dtype, copy=False)
