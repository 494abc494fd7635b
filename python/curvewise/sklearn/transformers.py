"""Transformers of scikit-learn that prepare curves, each by a function of the package.

They return what they are given: a table of rows as a table, an array of curves of one length as an
array, and else a list. Curves may differ in their number of points.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, SupportsIndex, TypeAlias, get_args

import numpy as np

from .._options import check_choice
from ..curves.derivative import derivative
from ..curves.inputs import Array, in_columns
from ..curves.layouts import Layout, settled_layout
from ..curves.resampling import resample
from ..curves.z_normalization import z_normalized
from ..measures.pointwise import normalize
from .inputs import (
    CurveEstimator,
    ManyCurves,
    TransformerMixin,
    as_listed,
    curves_to_fit,
    fitted_curves,
    is_list_of_curves,
)

__all__ = ["CurveBoxScaler", "CurveDerivative", "CurveResampler", "CurveZNormalizer"]

Places: TypeAlias = Literal["index", "arc_length"]


class _CurveTransformer(TransformerMixin, CurveEstimator):  # type: ignore[misc]  # untyped
    """One function of each curve."""

    def __init__(self, *, layout: Layout | None = None) -> None:
        self.layout = layout

    def fit(self, X: ManyCurves, y: Any = None) -> Any:
        """Check the curves, and learn from them what the transformation needs.

        Parameters
        ----------
        X : array_like, shape (k, n, d) or (k, n), or a sequence of curves
            The curves.
        y : None
            Not used.

        Returns
        -------
        estimator
            This one.

        Raises
        ------
        ValueError, TypeError
            As for :func:`curvewise.cdist`.
        """
        self._learn(curves_to_fit(self, X)[0])
        return self

    def transform(self, X: ManyCurves) -> Any:
        """Return the curves, transformed.

        Parameters
        ----------
        X : array_like, shape (k, n, d) or (k, n), or a sequence of curves
            The curves.

        Returns
        -------
        ndarray or list of ndarray
            A table for a table, an array for an array of curves, else a list.

        Raises
        ------
        ValueError, TypeError
            As for the function that transforms a curve, with the place of the curve.
        """
        X = as_listed(X)
        curves = fitted_curves(self, X)
        function = self._function()
        found = []
        with settled_layout():
            for k, curve in enumerate(curves):
                try:
                    result = function(curve)
                except ValueError as error:
                    detail = f" (n_features={len(curve)})" if curve.ndim == 1 else ""
                    raise ValueError(f"X[{k}]: {error}{detail}") from error
                found.append(result[:, 0] if curve.ndim == 1 and result.ndim == 2 else result)
        alone = isinstance(X, np.ndarray) and X.dtype != object
        return np.stack(found) if alone or not is_list_of_curves(X) else found

    def _learn(self, curves: list[Array]) -> None:
        """Learn nothing."""
        self.is_fitted_ = True

    def _function(self) -> Callable[[Array], Array]:
        raise NotImplementedError


# Shared text: layout
class CurveZNormalizer(_CurveTransformer):
    """Shift and scale each coordinate of every curve to mean 0 and deviation 1.

    The function is :func:`curvewise.curves.z_normalized`.

    Parameters
    ----------
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Examples
    --------
    >>> from curvewise.sklearn import CurveZNormalizer
    >>> [curve.tolist() for curve in CurveZNormalizer().fit_transform([[1, 3], [5, 9, 5, 9]])]
    [[-1.0, 1.0], [-1.0, 1.0, -1.0, 1.0]]
    """

    def _function(self) -> Callable[[Array], Array]:
        return z_normalized


# Shared text: layout
class CurveDerivative(_CurveTransformer):
    """Replace every curve by its slopes, for derivative dynamic time warping.

    The function is :func:`curvewise.curves.derivative`. A curve loses its first and last point.

    Parameters
    ----------
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Examples
    --------
    >>> from curvewise.sklearn import CurveDerivative, CurveKNeighborsClassifier
    >>> from sklearn.pipeline import make_pipeline
    >>> ddtw = make_pipeline(CurveDerivative(), CurveKNeighborsClassifier(1))
    >>> _ = ddtw.fit([[0, 1, 2, 3], [3, 2, 1, 0]], ["up", "down"])
    >>> ddtw.predict([[90, 91, 93], [93, 92, 90, 89]]).tolist()
    ['up', 'down']
    """

    def _function(self) -> Callable[[Array], Array]:
        return derivative


# Shared text: layout
class CurveResampler(_CurveTransformer):
    """Put the same number of evenly spaced points on every curve.

    The function is :func:`curvewise.curves.resample`.

    Parameters
    ----------
    count : int
        The number of points, both ends included; at least 2.
    by : {"index", "arc_length"} or int
        The quantity along which points are evenly spaced: the place in the list of points, which
        suits time series; the arc length; or a column.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Examples
    --------
    >>> from curvewise.sklearn import CurveResampler
    >>> CurveResampler(3).fit_transform([[0, 4], [0, 1, 2, 3, 8]])[1].tolist()
    [0.0, 2.0, 8.0]
    """

    def __init__(
        self,
        count: SupportsIndex = 100,
        *,
        by: Places | int = "index",
        layout: Layout | None = None,
    ) -> None:
        super().__init__(layout=layout)
        self.count = count
        self.by = by

    def _function(self) -> Callable[[Array], Array]:
        count: Any = self.count
        by: Any = self.by
        if isinstance(by, str):
            check_choice("by", by, get_args(Places))

        def resampled(curve: Array) -> Array:
            along = np.arange(len(curve), dtype=float) if by == "index" else by
            return resample(curve, count, by=along)

        return resampled


# Shared text: layout
class CurveBoxScaler(_CurveTransformer):
    """Scale curves by the bounding box of those that were fitted.

    The function is :func:`curvewise.normalize`. The fitted curves then lie between 0 and 1.

    Parameters
    ----------
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Attributes
    ----------
    box_ : ndarray, shape (2, d)
        The smallest and the largest value of each coordinate.

    Examples
    --------
    >>> from curvewise.sklearn import CurveBoxScaler
    >>> scaler = CurveBoxScaler().fit([[(0, 10), (2, 30)], [(1, 20), (2, 50), (1, 30)]])
    >>> scaler.transform([[(1, 50), (3, 10)]])[0].tolist()
    [[0.5, 1.0], [1.5, 0.0]]
    """

    def _learn(self, curves: list[Array]) -> None:
        columns = [in_columns(curve) for curve in curves]
        self.box_ = np.array(
            [
                np.min([curve.min(axis=0) for curve in columns], axis=0),
                np.max([curve.max(axis=0) for curve in columns], axis=0),
            ]
        )

    def _function(self) -> Callable[[Array], Array]:
        return lambda curve: normalize(self.box_, in_columns(curve))[1]
