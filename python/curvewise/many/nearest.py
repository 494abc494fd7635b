"""The nearest of many curves: an index, and what is built on it.

An :class:`Index` answers which of its curves are nearest to others, exactly, with the names, shapes
and conventions of ``sklearn.neighbors.NearestNeighbors``. The work is done by the compiled library.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from itertools import pairwise
from threading import get_ident
from typing import Any, Literal, SupportsFloat, SupportsIndex, get_args, overload

import numpy as np
import numpy.typing as npt

from .._core import Index as CompiledIndex
from .._docstrings import filled
from .._extras import extra
from .._options import Default, check_choice, real_number, whole_number
from .._progress import Report, reporting
from ..curves.inputs import Array, as_curve_list
from ..measures.registry import MeasureName
from .pairwise import Curves, _check_names

__all__ = ["Index", "checked_count"]

Places = npt.NDArray[np.int64]
GraphMode = Literal["connectivity", "distance"]


@filled()
class Index:
    """Many curves, ready to be searched for those that are nearest to others.

    The answers are those of :func:`curvewise.cdist` and a stable sort, bit for bit, for any number
    of threads: of equal distances the curve with the smaller index comes first. Methods have the
    names, shapes and conventions of ``sklearn.neighbors.NearestNeighbors``.

    Parameters
    ----------
    curves : array_like, shape (k, n, d), or a sequence of curves
        The curves of a sequence may differ in length, not in d. They are copied.
    measure : {measures}
        A measure by its name. A curve that is asked for is P, one of the index is Q.
    **options
        Those of the measure's own function, except ``workers`` and ``cutoff``.

    Raises
    ------
    ValueError
        What the measure refuses, with the curve's place (``curves[3]``); curves of different d; an
        unknown measure or option value.
    TypeError
        A curve does not hold real numbers; an option that the measure does not have.

    Notes
    -----
    dtw, frechet and frechet_continuous have lower bounds: the distances of the curves' ends, how
    far their boxes reach beyond each other, and the sum, or the maximum, of the distances of each
    curve's points to boxes around runs of the other. Curves are looked at in the order of their
    bounds, and only those whose bound is not above the k-th best distance so far are computed, as
    far as the cutoff lets them go (Seidl & Kriegel, "Optimal multi-step k-nearest neighbor search",
    1998; with a window the bound is that of Keogh & Ratanamahatana, 2005, with several boxes for
    one). What this saves depends on the curves: nearly everything where they form groups, nothing
    where all are equally far apart. The other measures, and dtw and frechet with "minkowski",
    compute every pair. Memory: some three times that of the points; about once for measures
    without bounds.

    Examples
    --------
    >>> import curvewise
    >>> ramp, step, peak = [0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]
    >>> index = curvewise.Index([ramp, step, peak], "dtw")
    >>> distances, indices = index.kneighbors([[0, 2, 3], [0, 3, 1]], n_neighbors=2)
    >>> indices.tolist()
    [[0, 1], [2, 1]]
    >>> distances.tolist()
    [[1.0, 1.0], [1.0, 2.0]]
    """

    def __init__(self, curves: Curves, measure: MeasureName = "dtw", **options: Any) -> None:
        self._measure = _check_names(measure, options)
        self._options = options
        self._index = CompiledIndex(as_curve_list(curves, "curves"), self._measure, options)
        self._searching: list[int] = []  # threads; one stands as often as it searches

    def __len__(self) -> int:
        return self._index.size()

    def __repr__(self) -> str:
        options = "".join(f", {name}={value!r}" for name, value in self._options.items())
        return f"Index(<{len(self)} curves>, {self._measure!r}{options})"

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(Index, **self._options), (self._index.curves(), self._measure)

    def add(self, curves: Curves) -> None:
        """Add curves behind those there are.

        Parameters
        ----------
        curves : array_like, shape (k, n, d), or a sequence of curves
            All are added, or, where one is refused, none.

        Raises
        ------
        ValueError, TypeError
            As for :class:`Index`.
        RuntimeError
            The progress function of a search in this index calls it.

        Notes
        -----
        O(n) time a curve. Waits for searches that run in other threads.
        """
        if get_ident() in self._searching:
            raise RuntimeError(
                "add was called by the progress function of a search in the same index, for whose "
                "end it would wait; add the curves after the search"
            )
        self._index.add(as_curve_list(curves, "curves"))

    @overload
    def kneighbors(
        self,
        X: Curves | None = None,
        n_neighbors: SupportsIndex = 5,
        *,
        return_distance: Literal[True] = True,
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> tuple[Array, Places]: ...
    @overload
    def kneighbors(
        self,
        X: Curves | None = None,
        n_neighbors: SupportsIndex = 5,
        *,
        return_distance: Literal[False],
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> Places: ...
    @filled()
    def kneighbors(
        self,
        X: Curves | None = None,
        n_neighbors: SupportsIndex = 5,
        *,
        return_distance: bool = True,
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> tuple[Array, Places] | Places:
        """Find the curves of the index that are nearest to each of some others.

        Parameters
        ----------
        X : array_like, shape (q, n, d), or a sequence of curves, optional
            What to look for. If not given, the curves of the index, none of which is then a
            neighbour of itself.
        n_neighbors : int
            How many to find for each, from 1 to the number of curves.
        return_distance : bool
            Whether to return the distances besides the indices.
        {workers}
        progress : bool or callable
            True shows a bar (tqdm). A callable is called in this thread with (done, total), as
            :func:`curvewise.cdist` calls it: every pair counts, computed or not.

        Returns
        -------
        distances : ndarray, shape (q, n_neighbors)
            In ascending order; only where asked for.
        indices : ndarray of int64, shape (q, n_neighbors)
            Those of the neighbours; of equal distances the smaller index comes first.

        Raises
        ------
        ValueError
            What the measure refuses, with the curve's place (``X[3]``); an `n_neighbors` that is
            too small or too large.
        TypeError
            A curve does not hold real numbers.
        ImportError
            ``progress=True`` without tqdm: ``pip install "curvewise[progress]"``.

        Notes
        -----
        Time: for each query a cheap bound of every curve, and the pairs that are left, O(n m)
        each. Threads share the queries: a single one is not divided. Ctrl-C as for
        :func:`curvewise.cdist`.
        """
        queries = None if X is None else as_curve_list(X, "X")
        which = "the other curves of the index" if X is None else "the curves of the index"
        count = checked_count(n_neighbors, len(self) - (X is None), which)
        with self._reporting(progress) as report:
            distances, indices, _ = self._index.kneighbors(queries, count, workers, report)
        return (distances, indices) if return_distance else indices

    @overload
    def radius_neighbors(
        self,
        X: Curves | None = None,
        radius: SupportsFloat = 1.0,
        *,
        return_distance: Literal[True] = True,
        sort_results: bool = True,
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> tuple[npt.NDArray[np.object_], npt.NDArray[np.object_]]: ...
    @overload
    def radius_neighbors(
        self,
        X: Curves | None = None,
        radius: SupportsFloat = 1.0,
        *,
        return_distance: Literal[False],
        sort_results: bool = True,
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> npt.NDArray[np.object_]: ...
    @filled()
    def radius_neighbors(
        self,
        X: Curves | None = None,
        radius: SupportsFloat = 1.0,
        *,
        return_distance: bool = True,
        sort_results: bool = True,
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> tuple[npt.NDArray[np.object_], npt.NDArray[np.object_]] | npt.NDArray[np.object_]:
        """Find all curves of the index within a radius of each of some others.

        Parameters
        ----------
        X : array_like, shape (q, n, d), or a sequence of curves, optional
            As for :meth:`kneighbors`.
        radius : float >= 0
            The largest distance of a neighbour.
        return_distance : bool
            Whether to return the distances besides the indices.
        sort_results : bool
            Whether the neighbours come in ascending order of their distances, those of equal
            distance by index, or all by index.
        workers, progress
            As for :meth:`kneighbors`.

        Returns
        -------
        distances : ndarray of objects, shape (q,)
            Of each curve of X an array of distances; only where asked for.
        indices : ndarray of objects, shape (q,)
            Of each curve of X an array of int64.

        Raises
        ------
        ValueError, TypeError, ImportError
            As for :meth:`kneighbors`; and ValueError for a `radius` that is negative or no number.

        Notes
        -----
        As for :meth:`kneighbors`. Curves are known to be outside by their bounds, or as soon as
        the computation of their distance shows it. Without distances, and without sorting by them,
        frechet_continuous only decides whether a curve is within, which is several times faster.
        """
        distances, indices, begins = self._within(
            X, radius, sort_results, return_distance, workers, progress
        )
        found = _divided(indices, begins)
        return (_divided(distances, begins), found) if return_distance else found

    @filled()
    def kneighbors_graph(
        self,
        X: Curves | None = None,
        n_neighbors: SupportsIndex = 5,
        *,
        mode: GraphMode = "connectivity",
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> Any:
        """Return the neighbours of :meth:`kneighbors` as a sparse matrix.

        Parameters
        ----------
        X, n_neighbors, workers, progress
            As for :meth:`kneighbors`.
        mode : {"connectivity", "distance"}
            What stands for a neighbour: 1, or its distance, which may be 0.

        Returns
        -------
        scipy.sparse.csr_matrix, shape (q, k)
            Row i has the neighbours of X[i]. With "distance", estimators of scikit-learn with
            ``metric="precomputed"`` take it, as long as they ask for no more neighbours.

        Raises
        ------
        ValueError, TypeError, ImportError
            As for :meth:`kneighbors`; ValueError for an unknown mode; ImportError without scipy.

        Notes
        -----
        As for :meth:`kneighbors`.

        Examples
        --------
        >>> import curvewise
        >>> index = curvewise.Index([[0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]])
        >>> index.kneighbors_graph(n_neighbors=1, mode="distance").toarray().tolist()
        [[0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]]
        """
        check_choice("mode", mode, get_args(GraphMode))
        distances, indices = self.kneighbors(X, n_neighbors, workers=workers, progress=progress)
        begins = np.arange(len(indices) + 1) * indices.shape[1]
        return self._graph(mode, distances.ravel(), indices.ravel(), begins)

    @filled()
    def radius_neighbors_graph(
        self,
        X: Curves | None = None,
        radius: SupportsFloat = 1.0,
        *,
        mode: GraphMode = "connectivity",
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> Any:
        """Return the neighbours of :meth:`radius_neighbors` as a sparse matrix.

        Parameters
        ----------
        X, radius, workers, progress
            As for :meth:`radius_neighbors`.
        mode : {"connectivity", "distance"}
            As for :meth:`kneighbors_graph`.

        Returns
        -------
        scipy.sparse.csr_matrix, shape (q, k)
            Row i has the neighbours of X[i], in ascending order.

        Raises
        ------
        ValueError, TypeError, ImportError
            As for :meth:`kneighbors_graph`, and for :meth:`radius_neighbors`.

        Notes
        -----
        As for :meth:`kneighbors`.
        """
        check_choice("mode", mode, get_args(GraphMode))
        return self._graph(mode, *self._within(X, radius, True, True, workers, progress))

    @contextmanager
    def _reporting(self, progress: bool | Report) -> Iterator[Report | None]:
        """Yield the function for the reports of a search, which this thread must not add to."""
        self._searching.append(get_ident())
        try:
            with reporting(progress) as report:
                yield report
        finally:
            self._searching.remove(get_ident())

    def _within(
        self,
        X: Curves | None,
        radius: SupportsFloat,
        sort_results: bool,
        with_distances: bool,
        workers: SupportsIndex,
        progress: bool | Report,
    ) -> tuple[Array, Places, Places]:
        queries = None if X is None else as_curve_list(X, "X")
        limit = real_number("radius", radius, 0.0, "give a number >= 0")
        with self._reporting(progress) as report:
            found = self._index.radius_neighbors(
                queries, limit, bool(sort_results), bool(with_distances), workers, report
            )
        return found[:3]

    def _graph(self, mode: GraphMode, distances: Array, indices: Places, begins: Places) -> Any:
        with extra("compat", "a graph of neighbours needs scipy"):
            csr_matrix = import_module("scipy.sparse").csr_matrix
        values = distances if mode == "distance" else np.ones(len(indices))
        return csr_matrix((values, indices, begins), shape=(len(begins) - 1, len(self)))


def checked_count(n_neighbors: SupportsIndex, most: int, which: str) -> int:
    """Return how many neighbours are asked for; refuse more than there are curves to be one."""
    advice = f"give a whole number from 1 to {most}, {which}"
    return whole_number("n_neighbors", n_neighbors, 1, advice, most)


def _divided(values: npt.NDArray[Any], begins: Places) -> npt.NDArray[np.object_]:
    parts = np.empty(len(begins) - 1, dtype=object)
    for i, (begin, end) in enumerate(pairwise(begins)):
        parts[i] = values[begin:end]
    return parts
