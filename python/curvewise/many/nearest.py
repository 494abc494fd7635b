"""Nearest neighbours among many curves, with an index.

An :class:`Index` finds which of its curves are nearest to others, exactly. Its names, shapes and
conventions are those of ``sklearn.neighbors.NearestNeighbors``. The compiled library computes the
answers.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from itertools import pairwise
from threading import RLock, get_ident
from typing import Any, Literal, SupportsFloat, SupportsIndex, get_args

import numpy as np
import numpy.typing as npt

from .._core import Index as CompiledIndex
from .._core import IndexFile
from .._extras import extra
from .._options import Default, check_choice, whole_number
from .._progress import Report, reporting
from ..curves.inputs import Array, as_curve_list
from ..curves.labels import (
    Labels,
    labelled_column,
    labelled_matrix,
    unlabelled,
)
from ..curves.layouts import Layout
from ..curves.reference_systems import check_reference_systems
from ..measures.registry import MeasureName
from .index_file import read_note, write_note
from .index_labels import IndexLabels, with_gaps
from .pairwise import Curves, LabelledCurves, _check_names, checked_limit, of_compiled

__all__ = ["Index", "checked_count"]

Places = npt.NDArray[np.int64]
GraphMode = Literal["connectivity", "distance"]


# Shared text: measure(all), layout
class Index:
    """Index of many curves for exact nearest-neighbour queries.

    The answers are bitwise identical to :func:`curvewise.cdist` and a stable sort, for any number
    of threads: of equal distances the curve with the smaller index comes first. Methods have the
    names, shapes and conventions of ``sklearn.neighbors.NearestNeighbors``. Later curves have the
    layout of the first ones.

    Parameters
    ----------
    curves : array_like, shape (k, n, d), or a sequence of curves
        The curves of a sequence may differ in length, not in d. They are copied. They may have
        labels, as for :func:`curvewise.cdist`.
    measure : str
        The name of a measure: "area", "pcm", "frechet", "dtw", "curve_length",
        "frechet_continuous", "hausdorff", "hausdorff_continuous", "erp", "edr", "lcss", "msm",
        "twe", "wdtw". A query curve is P, a curve of the index is Q.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.
    **options
        Options of the measure's own function, except ``workers`` and ``cutoff``.

    Raises
    ------
    ValueError
        If the measure refuses a curve, with the curve's place (``curves[3]``). If curves differ in
        d, two curves have the same label, or a measure or option value is unknown. If tracks are in
        degrees without ``metric="haversine"``.
    TypeError
        If a curve does not hold real numbers, or the measure does not have an option.

    See Also
    --------
    cdist : All distances.
    subsequence : The best parts of a long record.

    Notes
    -----
    Curves are processed in the order of lower bounds of their distances. Only those whose bound is
    at most the k-th best distance so far are computed, up to that cutoff. From 256 curves on, trees
    over the first bounds skip most curves that are far. See Seidl & Kriegel,
    "Optimal multi-step k-nearest neighbor search", 1998, and Keogh & Ratanamahatana (2005). The
    index computes few distances if the curves form groups, and all if they are equally distant.
    Lower bounds exist for dtw, frechet and frechet_continuous. The other measures, and dtw and
    frechet with "minkowski", compute every pair. Memory: at most 1.6 times that of the points in
    float64 for curves of at least 32 numbers, and 1.3 times for at least 128. It is about twice for
    frechet_continuous, and three times for "haversine".

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
    >>> index = curvewise.Index({"ramp": ramp, "step": step, "peak": peak})
    >>> index.kneighbors([[0, 2, 3]], n_neighbors=2, return_distance=False).loc[0].tolist()
    ['ramp', 'step']
    """

    def __init__(
        self,
        curves: Curves | LabelledCurves,
        measure: MeasureName = "dtw",
        *,
        layout: Layout | None = None,
        **options: Any,
    ) -> None:
        if callable(measure) or callable(options.get("metric")):
            raise ValueError(
                "an index needs the lower bounds of a named measure and metric, and a function has "
                "none; sort all distances, np.argsort(curvewise.cdist(queries, curves, ...), "
                "axis=1, kind='stable')[:, :k], or give an estimator of curvewise.sklearn a "
                "function of two curves as its measure"
            )
        self._measure = _check_names(measure, options)
        self._options = of_compiled(self._measure, options)
        self._crs = check_reference_systems(options, curves=curves)
        curves, labels = unlabelled(curves, "curves")
        self._labels = IndexLabels(labels)
        given = as_curve_list(curves, "curves", keep_float32=True, layout=layout)
        # Later curves have the same number of coordinates, which settles their layout.
        self._layout: Layout | None = "channels_last" if given and layout is None else layout
        self._hold(CompiledIndex(given, self._measure, self._options))

    def _hold(self, compiled: CompiledIndex) -> None:
        self._index = compiled
        self._changing = RLock()  # has who adds or removes curves
        self._searching: list[int] = []  # threads; a thread appears once for each of its searches

    def __len__(self) -> int:
        return self._index.size()

    def __repr__(self) -> str:
        options = "".join(f", {name}={value!r}" for name, value in self._options.items())
        return f"Index(<{len(self)} curves>, {self._measure!r}{options})"

    def __reduce__(self) -> tuple[Any, ...]:
        with self._changing:
            contents = self._index.curves(), self._index.indices(), self._index.next_index()
            return _restored, (self._described(), *contents)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the index to a file, which :meth:`open` reads.

        Parameters
        ----------
        path : path-like
            The file. It replaces another file of this name at the end, also the file that this
            index was opened from. If saving fails or is interrupted, the other file stays as it is.

        Raises
        ------
        OSError
            If the file cannot be written.
        TypeError
            If a label or an option is not text, a number, a tuple of these, or a `StepPattern`.

        Notes
        -----
        The file has the points in float64, and the labels, indices, measure and options of the
        index. It does not have removed curves. Searches in other threads go on, while :meth:`add`
        and :meth:`remove` wait.

        Examples
        --------
        >>> import curvewise, os, tempfile
        >>> path = os.path.join(tempfile.mkdtemp(), "index")
        >>> curvewise.Index({"ramp": [0, 1, 2, 3], "peak": [0, 3, 0]}, "dtw").save(path)
        >>> index = curvewise.Index.open(path)
        >>> index
        Index(<2 curves>, 'dtw')
        >>> index.kneighbors([[0, 2, 0]], n_neighbors=1)[1].loc[0].tolist()
        ['peak']
        """
        with self._changing:  # so that labels and curves agree
            labels = self._labels.of_rows(self._index.indices())
            note = write_note(self._described(), None if labels is None else list(labels))
            self._index.save(os.fsencode(path), note)

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Index:
        """Return the index of a file that :meth:`save` has written.

        Parameters
        ----------
        path : path-like
            The file.

        Returns
        -------
        Index
            An index with bitwise identical answers. The file is mapped into memory: processes that
            open the same file share the memory of its points. Curves that are added, and curves
            that are removed, do not change the file.

        Raises
        ------
        OSError
            If the file cannot be opened.
        ValueError
            If the file is not an index, is damaged, or has another format or byte order.

        Notes
        -----
        All points are read once, to compare their checksum. For dtw and frechet, and the edit
        distances, opening is several times faster than building the index. "frechet_continuous",
        "curve_length" and "haversine" compute what they need besides the points, in memory of their
        own. Each process also takes about 200 bytes for each curve. Do not write to the file while
        an index is open; :meth:`save` replaces it.
        """
        file = IndexFile(os.fsencode(path))
        described, labels = read_note(file.note(), os.fspath(path))
        index = cls.__new__(cls)
        vars(index).update(described)
        index._hold(CompiledIndex(file, index._measure, index._options))
        remaining = index._index.indices()
        index._labels = IndexLabels(
            with_gaps(labels, remaining, index._index.next_index()), remaining
        )
        return index

    def _described(self) -> dict[str, Any]:
        """Return all attributes but the curves, for a copy."""
        return {
            "_measure": self._measure,
            "_options": self._options,
            "_crs": self._crs,
            "_labels": self._labels.all,
            "_layout": self._layout,
        }

    @property
    def indices(self) -> Places:
        """Indices of the curves, ascending: 0, 1, ..., without those of removed curves."""
        return self._index.indices()

    def add(self, curves: Curves | LabelledCurves) -> None:
        """Add curves behind the existing ones.

        Parameters
        ----------
        curves : array_like, shape (k, n, d), or a sequence of curves
            All curves are added, or, if one is refused, no curve. The curves must have labels if
            the existing ones have labels, and otherwise not.

        Raises
        ------
        ValueError, TypeError
            As for :class:`Index`. ValueError also if only some curves would have labels, or a label
            exists already.
        RuntimeError
            If the progress function of a search in this index calls this method.

        Notes
        -----
        O(n) time for each curve. Searches that run in other threads go on. They see the curves that
        were in the index when they began.
        """
        self._refuse_reports("add", "does not see the curves; add")
        with self._changing:
            crs = check_reference_systems(self._options, known=self._crs, curves=curves)
            curves, labels = unlabelled(curves, "curves")
            with self._labels.added(labels):
                added = as_curve_list(curves, "curves", keep_float32=True, layout=self._layout)
                self._index.add(added)
            self._crs = crs
            if added:
                self._layout = self._layout or "channels_last"

    def remove(self, indices: Iterable[Any]) -> None:
        """Remove curves; the indices of the other curves stay.

        Parameters
        ----------
        indices : sequence
            The labels of the curves, if the curves of the index have labels, and otherwise their
            indices. All of the curves are removed, or, if one is refused, no curve.

        Raises
        ------
        ValueError
            If a curve is not in the index, was removed before, or is given twice.
        TypeError
            If `indices` is not a sequence.
        RuntimeError
            If the progress function of a search in this index calls this method.

        Notes
        -----
        O(1) time for each curve, and a copy of one bit for each curve of the index. Searches that
        run in other threads still see the curves. Their memory is not freed until the index is
        saved and opened, or pickled. An index is not used again, but a label may be.

        Examples
        --------
        >>> import curvewise
        >>> index = curvewise.Index([[0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]])
        >>> index.remove([1])
        >>> index.indices.tolist()
        [0, 2]
        >>> index.kneighbors([[0, 0, 3, 3]], n_neighbors=2)[1].tolist()
        [[0, 2]]
        """
        self._refuse_reports("remove", "still sees the curves; remove")
        if isinstance(indices, str | bytes) or not hasattr(indices, "__iter__"):
            raise TypeError(f"indices is {indices!r}; give a list, such as [{indices!r}]")
        given = list(indices)
        with self._changing:
            if self._labels.all is None:
                self._index.remove(self._checked_indices(given))
                return
            self._index.remove(self._labels.indices_of(given))
            self._labels.remove(given)

    # Shared text: workers
    def kneighbors(
        self,
        X: Curves | LabelledCurves | None = None,
        n_neighbors: SupportsIndex = 5,
        *,
        return_distance: bool = True,
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> Any:
        """Find the nearest curves of the index for each query curve.

        Parameters
        ----------
        X : array_like, shape (q, n, d), or a sequence of curves, optional
            The query curves. By default the curves of the index, in the order of :attr:`indices`;
            a curve does not count as its own neighbour then.
        n_neighbors : int
            Number of neighbours of each query, from 1 to the number of curves.
        return_distance : bool
            Whether to return the distances in addition to the indices.
        workers : int, default 1
            Number of threads: at least 1, or -1 for one per core. The result does not change.
        progress : bool or callable
            True shows a bar (tqdm). A callable is called in this thread with (done, total), as
            :func:`curvewise.cdist` calls it: every pair counts, computed or not.

        Returns
        -------
        distances : ndarray, shape (q, n_neighbors)
            The distances in ascending order; only if requested.
        indices : ndarray of int64, shape (q, n_neighbors)
            The indices of the neighbours; of equal distances the smaller index comes first. If the
            curves of the index have labels, these replace the indices. If the curves of the index
            or of X have labels, both results are DataFrames with the labels of X as their index.

        Raises
        ------
        ValueError
            If the measure refuses a curve, with the curve's place (``X[3]``), or `n_neighbors` is
            too small or too large.
        TypeError
            If a curve does not hold real numbers.
        ImportError
            If ``progress=True`` and tqdm is missing: ``pip install "curvewise[progress]"``.

        Notes
        -----
        Time: for each query a cheap bound of every curve that the trees do not skip, and O(n m) for
        each remaining pair.
        Threads share the queries: a single query is not divided. Ctrl-C as for
        :func:`curvewise.cdist`.
        """
        distances, indices, rows, names = self._nearest(X, n_neighbors, workers, progress)
        if rows is not None:
            names = self._labels.of_rows(rows)
        found = labelled_matrix(self._labels.at(indices), names, None)
        return (labelled_matrix(distances, names, None), found) if return_distance else found

    def radius_neighbors(
        self,
        X: Curves | LabelledCurves | None = None,
        radius: SupportsFloat = 1.0,
        *,
        return_distance: bool = True,
        sort_results: bool = True,
        workers: SupportsIndex = Default.workers,
        progress: bool | Report = False,
    ) -> Any:
        """Find all curves of the index within a radius of each of some others.

        Parameters
        ----------
        X : array_like, shape (q, n, d), or a sequence of curves, optional
            As for :meth:`kneighbors`.
        radius : float >= 0
            The largest distance of a neighbour. It may be negative for a step pattern that has a
            negative weight.
        return_distance : bool
            Whether to return the distances in addition to the indices.
        sort_results : bool
            Whether the neighbours come in ascending order of their distances, those of equal
            distance by index, or all by index.
        workers, progress
            As for :meth:`kneighbors`.

        Returns
        -------
        distances : ndarray of objects, shape (q,)
            For each curve of X an array of distances; only if requested.
        indices : ndarray of objects, shape (q,)
            For each curve of X an array of int64. Labels as for :meth:`kneighbors`, in Series.

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
        distances, indices, begins, rows, names = self._within(
            X, radius, sort_results, return_distance, workers, progress
        )
        if rows is not None:
            names = self._labels.of_rows(rows)
        found = labelled_column(_divided(self._labels.at(indices), begins), names)
        if not return_distance:
            return found
        return labelled_column(_divided(distances, begins), names), found

    def kneighbors_graph(
        self,
        X: Curves | LabelledCurves | None = None,
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
            The entry of a neighbour: 1, or its distance, which may be 0.

        Returns
        -------
        scipy.sparse.csr_matrix, shape (q, k)
            Row i has the neighbours of X[i], without labels. Column j has the curve of index j: it
            is empty if the curve was removed, and without X its row, too. With "distance",
            estimators of scikit-learn with ``metric="precomputed"`` accept it, if they need no more
            neighbours.

        Raises
        ------
        ValueError, TypeError, ImportError
            As for :meth:`kneighbors`; ValueError if the mode is unknown; ImportError if scipy is
            missing.

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
        distances, indices, rows, _ = self._nearest(X, n_neighbors, workers, progress)
        begins = np.arange(len(indices) + 1) * indices.shape[1]
        return self._graph(mode, distances.ravel(), indices.ravel(), begins, rows)

    def radius_neighbors_graph(
        self,
        X: Curves | LabelledCurves | None = None,
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
            Row i has the neighbours of X[i], in ascending order. Removed curves as for
            :meth:`kneighbors_graph`.

        Raises
        ------
        ValueError, TypeError, ImportError
            As for :meth:`kneighbors_graph`, and for :meth:`radius_neighbors`.

        Notes
        -----
        As for :meth:`kneighbors`.
        """
        check_choice("mode", mode, get_args(GraphMode))
        return self._graph(mode, *self._within(X, radius, True, True, workers, progress)[:4])

    def _refuse_reports(self, call: str, why: str) -> None:
        if get_ident() in self._searching:
            raise RuntimeError(
                f"{call} was called by the progress function of a search in the same index, which "
                f"{why} them after the search"
            )

    def _checked_indices(self, indices: list[Any]) -> list[int]:
        most = self._index.next_index() - 1
        advice = f"give indices of curves of the index, from 0 to {most}"
        if most < 0:
            advice = "the index has no curves"
        return [
            whole_number(f"indices[{k}]", index, 0, advice, most) for k, index in enumerate(indices)
        ]

    @contextmanager
    def _reporting(self, progress: bool | Report) -> Iterator[Report | None]:
        """Yield the function for the reports of a search, which this thread must not add to."""
        self._searching.append(get_ident())
        try:
            with reporting(progress) as report:
                yield report
        finally:
            self._searching.remove(get_ident())

    def _nearest(
        self,
        X: Curves | LabelledCurves | None,
        n_neighbors: SupportsIndex,
        workers: SupportsIndex,
        progress: bool | Report,
    ) -> tuple[Array, Places, Places | None, Labels]:
        """Return distances and indices of neighbours, indices of own queries, labels of others."""
        queries, names = self._queries(X)
        which = "the other curves of the index" if X is None else "the curves of the index"
        count = checked_count(n_neighbors, len(self) - (X is None), which)
        with self._reporting(progress) as report:
            distances, indices, _, rows = self._index.kneighbors(queries, count, workers, report, 0)
        return distances, indices, rows, names

    def _queries(self, X: Curves | LabelledCurves | None) -> tuple[list[Array] | None, Labels]:
        """Return the queries and, for an answer with labels, the labels of its rows."""
        if X is None:
            return None, None
        check_reference_systems(self._options, known=self._crs, X=X)
        X, names = unlabelled(X, "X")
        queries = as_curve_list(X, "X", keep_float32=True, layout=self._layout)
        counted = names is None and self._labels.all is not None
        return queries, range(len(queries)) if counted else names

    def _within(
        self,
        X: Curves | LabelledCurves | None,
        radius: SupportsFloat,
        sort_results: bool,
        with_distances: bool,
        workers: SupportsIndex,
        progress: bool | Report,
    ) -> tuple[Array, Places, Places, Places | None, Labels]:
        queries, names = self._queries(X)
        limit = checked_limit("radius", radius, self._measure, self._options)
        with self._reporting(progress) as report:
            distances, indices, begins, _, rows = self._index.radius_neighbors(
                queries, limit, bool(sort_results), bool(with_distances), workers, report
            )
        return distances, indices, begins, rows, names

    def _graph(
        self,
        mode: GraphMode,
        distances: Array,
        indices: Places,
        begins: Places,
        rows: Places | None,
    ) -> Any:
        with extra("compat", "a graph of neighbours needs scipy"):
            csr_matrix = import_module("scipy.sparse").csr_matrix
        columns = self._index.next_index()
        if rows is not None:
            counts = np.zeros(columns + 1, dtype=np.int64)
            counts[rows + 1] = np.diff(begins)
            begins = np.cumsum(counts)
        values = distances if mode == "distance" else np.ones(len(indices))
        return csr_matrix((values, indices, begins), shape=(len(begins) - 1, columns))


def _restored(
    described: dict[str, Any], curves: list[Array], indices: Places, next_index: int
) -> Index:
    """Return a copy of an index with the curves that remain."""
    index = Index.__new__(Index)
    vars(index).update(described)
    index._labels = IndexLabels(described["_labels"], indices)
    given = as_curve_list(curves, "curves", layout="channels_last")  # joblib maps arrays
    index._hold(CompiledIndex(given, indices, next_index, index._measure, index._options))
    return index


def checked_count(n_neighbors: SupportsIndex, most: int, which: str) -> int:
    """Return the requested number of neighbours; raise if it exceeds the curves."""
    advice = f"give a whole number from 1 to {most}, {which}"
    return whole_number("n_neighbors", n_neighbors, 1, advice, most)


def _divided(values: npt.NDArray[Any], begins: Places) -> npt.NDArray[np.object_]:
    parts = np.empty(len(begins) - 1, dtype=object)
    for i, (begin, end) in enumerate(pairwise(begins)):
        parts[i] = values[begin:end]
    return parts
