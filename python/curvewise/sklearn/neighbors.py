"""A classifier of scikit-learn for curves: the nearest known ones vote.

The neighbours are found by :class:`curvewise.Index`, exactly, without the table of all distances.
"""

from __future__ import annotations

from typing import Any, Literal, SupportsIndex, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from .._docstrings import filled
from .._options import Default, check_choice
from ..curves.inputs import Array
from ..curves.layouts import Layout
from ..many.nearest import Index, Places
from ..measures.registry import MeasureName
from .inputs import (
    BaseEstimator,
    ClassifierMixin,
    ManyCurves,
    Options,
    check_classification_targets,
    column_or_1d,
    curves_to_fit,
    fitted_curves,
)

__all__ = ["CurveKNeighborsClassifier"]

Weights: TypeAlias = Literal["uniform", "distance"]


@filled()
class CurveKNeighborsClassifier(ClassifierMixin, BaseEstimator):  # type: ignore[misc]  # untyped
    """Classify a curve as the nearest of known curves are.

    As ``sklearn.neighbors.KNeighborsClassifier``, for curves of different lengths.

    Parameters
    ----------
    n_neighbors : int
        Number of neighbours that vote.
    measure : str
        A measure by its name, see :func:`curvewise.available_measures`.
    options : dict, optional
        Options of the measure's own function, e.g. ``{"window": 10}``.
    weights : {"uniform", "distance"}
        Whether every neighbour has one vote, or one over its distance; neighbours at distance 0
        then vote alone.
    workers : int
        Number of threads for a call: at least 1, or -1 for one per core. Does not change a result.
    {layout}

    Attributes
    ----------
    classes_ : ndarray
        The classes, in ascending order.
    index_ : Index
        The known curves.

    Notes
    -----
    Curves are an array of shape (k, n, d), or a sequence of curves of different lengths. As
    elsewhere in scikit-learn, they may also be an array of shape (k, n) whose rows are curves with
    d = 1. Such rows must have the same number of points as those of the fit. Of classes with equal
    votes the first wins.

    Examples
    --------
    >>> from curvewise.sklearn import CurveKNeighborsClassifier
    >>> known = [[0, 1, 2, 3], [0, 2, 3], [3, 2, 1, 0], [3, 1, 0]]
    >>> classifier = CurveKNeighborsClassifier(n_neighbors=1)
    >>> _ = classifier.fit(known, ["up", "up", "down", "down"])
    >>> classifier.predict([[0, 0, 3], [3, 3, 0]]).tolist()
    ['up', 'down']
    """

    def __init__(
        self,
        n_neighbors: SupportsIndex = 5,
        *,
        measure: MeasureName = "dtw",
        options: Options = None,
        weights: Weights = "uniform",
        workers: SupportsIndex = Default.workers,
        layout: Layout | None = None,
    ) -> None:
        self.n_neighbors = n_neighbors
        self.measure = measure
        self.options = options
        self.weights = weights
        self.workers = workers
        self.layout = layout

    def fit(self, X: ManyCurves, y: npt.ArrayLike) -> CurveKNeighborsClassifier:
        """Keep curves X of classes y.

        Parameters
        ----------
        X : array_like, shape (k, n, d) or (k, n), or a sequence of curves
            The known curves.
        y : array_like, shape (k,)
            Their classes. A Series with the labels of X may have them in any order.

        Returns
        -------
        CurveKNeighborsClassifier
            This one.

        Raises
        ------
        ValueError, TypeError
            As for :class:`curvewise.Index`; a `y` that does not fit, has other labels than X, or
            holds no classes.
        """
        check_choice("weights", self.weights, get_args(Weights))
        if y is None:
            raise ValueError(
                "fit requires y to be passed, but the target y is None: give the classes"
            )
        curves, y = curves_to_fit(self, X, y)
        labels = column_or_1d(y, warn=True)
        check_classification_targets(labels)
        if len(labels) != len(curves):
            raise ValueError(f"y has {len(labels)} classes for the {len(curves)} curves of X")
        self.classes_, self._codes = np.unique(labels, return_inverse=True)
        self.index_ = Index(curves, self.measure, layout="channels_last", **(self.options or {}))
        return self

    def kneighbors(
        self, X: ManyCurves | None = None, n_neighbors: SupportsIndex | None = None
    ) -> tuple[Array, Places]:
        """Find the nearest known curves.

        Parameters
        ----------
        X : array_like, shape (q, n, d) or (q, n), or a sequence of curves, optional
            As for :meth:`curvewise.Index.kneighbors`.
        n_neighbors : int, optional
            Number of neighbours; by default that of the classifier.

        Returns
        -------
        distances : ndarray, shape (q, n_neighbors)
        indices : ndarray of int64, shape (q, n_neighbors)

        Raises
        ------
        ValueError, TypeError
            As for :meth:`curvewise.Index.kneighbors`.
        """
        curves = None if X is None else fitted_curves(self, X)
        count = self.n_neighbors if n_neighbors is None else n_neighbors
        distances, indices = self.index_.kneighbors(curves, count, workers=self.workers)
        return distances, indices

    def predict_proba(self, X: ManyCurves) -> Array:
        """Return the share of each class in the votes.

        Parameters
        ----------
        X : array_like, shape (q, n, d) or (q, n), or a sequence of curves
            The query curves.

        Returns
        -------
        ndarray, shape (q, number of classes)
            Rows that add up to 1, in the order of ``classes_``.

        Raises
        ------
        ValueError, TypeError
            As for :meth:`curvewise.Index.kneighbors`.
        """
        distances, indices = self.kneighbors(X)
        votes = np.ones_like(distances)
        if self.weights == "distance":
            with np.errstate(divide="ignore"):
                votes = 1.0 / distances
            at_zero = np.isinf(votes)
            votes = np.where(at_zero.any(axis=1, keepdims=True), at_zero, votes)
        shares = np.zeros((len(indices), len(self.classes_)))
        rows = np.arange(len(indices))
        for column, voters in zip(votes.T, self._codes[indices].T, strict=True):
            shares[rows, voters] += column
        return np.asarray(shares / shares.sum(axis=1, keepdims=True))

    def predict(self, X: ManyCurves) -> npt.NDArray[Any]:
        """Return the class with most votes.

        Parameters
        ----------
        X : array_like, shape (q, n, d) or (q, n), or a sequence of curves
            The query curves.

        Returns
        -------
        ndarray, shape (q,)
            Their classes.

        Raises
        ------
        ValueError, TypeError
            As for :meth:`curvewise.Index.kneighbors`.
        """
        shares = self.predict_proba(X)
        return np.asarray(self.classes_[np.argmax(shares, axis=1)])

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.three_d_array = True
        return tags
