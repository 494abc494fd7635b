"""A classifier and a regressor of scikit-learn for curves: the nearest known ones decide.

:class:`curvewise.Index` finds the neighbours, exactly, without the table of all distances. Under a
callable measure, which has no bounds, all distances are computed.
"""

from __future__ import annotations

from typing import Any, Literal, SupportsIndex, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from .._options import Default, check_choice
from ..curves.inputs import Array
from ..curves.layouts import Layout
from ..many.nearest import Index, Places, checked_count
from ..many.pairwise import Measure, cdist
from .inputs import (
    ClassifierMixin,
    CurveEstimator,
    ManyCurves,
    Options,
    RegressorMixin,
    check_classification_targets,
    column_or_1d,
    curves_to_fit,
    fitted_curves,
)

__all__ = ["CurveKNeighborsClassifier", "CurveKNeighborsRegressor"]

Weights: TypeAlias = Literal["uniform", "distance"]


class _AllDistances:
    """The nearest of curves under a callable measure."""

    def __init__(self, curves: list[Array], measure: Any, options: dict[str, Any]) -> None:
        self._curves, self._measure, self._options = curves, measure, options

    def kneighbors(
        self, curves: list[Array] | None, n_neighbors: SupportsIndex, *, workers: SupportsIndex
    ) -> tuple[Array, Places]:
        """Return distances and places, as :meth:`curvewise.Index.kneighbors`."""
        told = {"workers": workers, "layout": "channels_last", **self._options}
        given = self._curves if curves is None else curves
        distances = np.asarray(cdist(given, self._curves, self._measure, **told))
        if curves is None:
            np.fill_diagonal(distances, np.inf)
        which = "the other curves" if curves is None else "the curves"
        count = checked_count(n_neighbors, len(self._curves) - (curves is None), which)
        indices = np.argsort(distances, axis=1, kind="stable")[:, :count]
        return np.take_along_axis(distances, indices, axis=1), indices


class _CurveNeighbors(CurveEstimator):
    """Curves that are known, and the nearest of them."""

    def __init__(
        self,
        n_neighbors: SupportsIndex = 5,
        *,
        measure: Measure = "dtw",
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

    def _keep(self, X: Any, y: Any, what: str) -> npt.NDArray[Any]:
        """Keep the curves; return what belongs to each, in their order."""
        check_choice("weights", self.weights, get_args(Weights))
        if y is None:
            raise ValueError(
                f"fit requires y to be passed, but the target y is None: give the {what}"
            )
        curves, y = curves_to_fit(self, X, y)
        y = column_or_1d(y, warn=True)
        if len(y) != len(curves):
            raise ValueError(f"y has {len(y)} {what} for the {len(curves)} curves of X")
        options, measure = dict(self.options or {}), self.measure
        self.index_ = (
            _AllDistances(curves, measure, options)
            if callable(measure)
            else Index(curves, measure, layout="channels_last", **options)
        )
        return np.asarray(y)

    def kneighbors(
        self, X: ManyCurves | None = None, n_neighbors: SupportsIndex | None = None
    ) -> tuple[Array, Places]:
        """Find the nearest known curves.

        Parameters
        ----------
        X : array_like, shape (q, n, d) or (q, n), or a sequence of curves, optional
            As for :meth:`curvewise.Index.kneighbors`.
        n_neighbors : int, optional
            The parameter of the estimator if not given.

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

    def _votes(self, X: Any) -> tuple[Array, Places]:
        """Return the weight of each neighbour, and the neighbours."""
        distances, indices = self.kneighbors(X)
        votes = np.ones_like(distances)
        if self.weights == "distance":
            with np.errstate(divide="ignore"):
                votes = 1.0 / distances
            at_zero = np.isinf(votes)
            votes = np.where(at_zero.any(axis=1, keepdims=True), at_zero, votes)
        return votes, indices


# Shared text: layout
class CurveKNeighborsClassifier(ClassifierMixin, _CurveNeighbors):  # type: ignore[misc]  # untyped
    """Classify a curve as the nearest of known curves are.

    As ``sklearn.neighbors.KNeighborsClassifier``, for curves of different lengths.

    Parameters
    ----------
    n_neighbors : int
        Number of neighbours that vote.
    measure : str or callable
        A measure by its name, see :func:`curvewise.available_measures`, or a function of two curves
        that returns a float. All distances are then computed, pair by pair, in this thread.
    options : dict, optional
        Options of the measure's own function, e.g. ``{"window": 10}``. Each is a parameter too:
        ``options__window`` in a grid search.
    weights : {"uniform", "distance"}
        Whether every neighbour has one vote, or one over its distance; neighbours at distance 0
        then vote alone.
    workers : int
        Number of threads for a call: at least 1, or -1 for one per core. Does not change a result.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

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
        labels = self._keep(X, y, "classes")
        check_classification_targets(labels)
        self.classes_, self._codes = np.unique(labels, return_inverse=True)
        return self

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
        votes, indices = self._votes(X)
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


# Shared text: layout
class CurveKNeighborsRegressor(RegressorMixin, _CurveNeighbors):  # type: ignore[misc]  # untyped
    """Predict a number for a curve: the mean of the nearest known curves' numbers.

    As ``sklearn.neighbors.KNeighborsRegressor``, for curves of different lengths.

    Parameters
    ----------
    n_neighbors : int
        The number of neighbours whose mean is taken.
    measure, options, workers
        As for :class:`CurveKNeighborsClassifier`.
    weights : {"uniform", "distance"}
        Whether every neighbour counts alike, or by one over its distance. Neighbours at distance 0
        then count alone.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Attributes
    ----------
    index_ : Index
        The known curves.

    Notes
    -----
    Curves as for :class:`CurveKNeighborsClassifier`.

    Examples
    --------
    >>> from curvewise.sklearn import CurveKNeighborsRegressor
    >>> known, heights = [[0, 1, 0], [0, 3, 3, 0], [0, 5, 0]], [1.0, 3.0, 5.0]
    >>> CurveKNeighborsRegressor(n_neighbors=2).fit(known, heights).predict([[0, 4, 4, 0]]).tolist()
    [4.0]
    """

    def fit(self, X: ManyCurves, y: npt.ArrayLike) -> CurveKNeighborsRegressor:
        """Keep curves X with numbers y.

        Parameters
        ----------
        X : array_like, shape (k, n, d) or (k, n), or a sequence of curves
            The known curves.
        y : array_like, shape (k,)
            Their numbers. A Series with the labels of X may have them in any order.

        Returns
        -------
        CurveKNeighborsRegressor
            This one.

        Raises
        ------
        ValueError, TypeError
            As for :class:`curvewise.Index`. If `y` does not fit, has other labels than X, or holds
            no finite numbers.
        """
        numbers = self._keep(X, y, "numbers").astype(np.float64)
        if not np.isfinite(numbers).all():
            place = int(np.argmin(np.isfinite(numbers)))
            raise ValueError(f"y[{place}] is {numbers[place]} (NaN or infinity); give finite y")
        self._numbers = numbers
        return self

    def predict(self, X: ManyCurves) -> Array:
        """Return the mean of the neighbours' numbers.

        Parameters
        ----------
        X : array_like, shape (q, n, d) or (q, n), or a sequence of curves
            The curves to predict for.

        Returns
        -------
        ndarray, shape (q,)
            A number for each.

        Raises
        ------
        ValueError, TypeError
            As for :meth:`curvewise.Index.kneighbors`.
        """
        votes, indices = self._votes(X)
        return np.asarray((votes * self._numbers[indices]).sum(axis=1) / votes.sum(axis=1))

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.regressor_tags.poor_score = True  # of rows that are no series
        return tags
