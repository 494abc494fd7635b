"""Input of an estimator: a list of curves, or a table whose rows are curves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, ValuesView
from typing import Any, TypeAlias

import numpy as np

from .._extras import extra
from ..curves.inputs import Array, as_curve_list
from ..curves.labels import in_order_of, unlabelled
from ..curves.reference_systems import check_reference_systems
from ..many.pairwise import Curves, LabelledCurves

with extra("sklearn", "curvewise.sklearn needs scikit-learn >= 1.6"):
    # Absolute, so these are the packages of that name and not this one.
    from sklearn.base import (
        BaseEstimator,
        ClassifierMixin,
        ClusterMixin,
        RegressorMixin,
        TransformerMixin,
    )
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.utils import check_random_state
    from sklearn.utils.multiclass import (
        check_classification_targets,
    )
    from sklearn.utils.validation import (
        _check_sample_weight,
        check_is_fitted,
        column_or_1d,
        validate_data,
    )

__all__ = [
    "BaseEstimator",
    "ClassifierMixin",
    "ClusterMixin",
    "ConvergenceWarning",
    "CurveEstimator",
    "ManyCurves",
    "Options",
    "RegressorMixin",
    "TransformerMixin",
    "as_listed",
    "check_classification_targets",
    "check_is_fitted",
    "check_random_state",
    "checked_sample_weight",
    "column_or_1d",
    "curves_to_fit",
    "fitted_curves",
    "is_list_of_curves",
    "validate_data",
]

ManyCurves: TypeAlias = Curves | LabelledCurves
Options: TypeAlias = Mapping[str, Any] | None

_OPTION = "options__"


class CurveEstimator(BaseEstimator):  # type: ignore[misc]  # untyped
    """An estimator of curves with a measure, whose options are parameters too.

    ``options__window`` is ``options["window"]``, as searches over a grid write it.
    """

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """Return the parameters.

        Parameters
        ----------
        deep : bool
            Whether to return each of the `options` as ``options__...`` too.

        Returns
        -------
        dict
            The values of the parameters by their names.
        """
        params: dict[str, Any] = super().get_params(deep=False)
        options = params.get("options")
        if deep and isinstance(options, Mapping):
            params |= {f"{_OPTION}{name}": value for name, value in options.items()}
        return params

    def set_params(self, **params: Any) -> Any:
        """Set parameters, and with ``options__...`` one of the `options`.

        Parameters
        ----------
        **params
            The values of the parameters by their names.

        Returns
        -------
        estimator
            This one.

        Raises
        ------
        ValueError
            If the estimator does not have a parameter.
        """
        names = [name for name in params if name.startswith(_OPTION)]
        given = {name.removeprefix(_OPTION): params.pop(name) for name in names}
        super().set_params(**params)
        if given:
            self.options: Options = {**(self.options or {}), **given}
        return self

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.three_d_array = True
        return tags


def curves_to_fit(estimator: Any, X: Any, *y: Any) -> tuple[Any, ...]:
    """Return the curves of X, and y if it is given, checked where X is a table of rows."""
    X = _read_once(X)
    if hasattr(estimator, "measure"):
        estimator._crs = _reference_system(estimator, X, None)
    y = tuple(in_order_of(target, X, "y") for target in y)
    X = as_listed(X)
    if is_list_of_curves(X):
        estimator.__dict__.pop("n_features_in_", None)  # of rows that were fitted before
        return as_curve_list(X, "X", keep_float32=True, layout=estimator.layout), *y
    checked = validate_data(estimator, X, *y, dtype=np.float64)
    rows, *targets = checked if y else (checked,)
    return list(rows), *targets


def checked_sample_weight(sample_weight: Any, curves: Any) -> Array:
    """Return how much each curve counts: at least 0, not all 0."""
    weights: Array = _check_sample_weight(
        sample_weight, curves, dtype=np.float64, ensure_non_negative=True
    )
    if not weights.any():
        raise ValueError("sample_weight is 0 for all curves; give one above 0")
    return weights


def fitted_curves(estimator: Any, X: Any) -> Any:
    """Return curves to be compared with those that were fitted."""
    check_is_fitted(estimator)
    X = _read_once(X)
    if hasattr(estimator, "measure"):
        _reference_system(estimator, X, estimator._crs)
    X = as_listed(X)
    if is_list_of_curves(X):
        # The curves of the fit have been checked already.
        return as_curve_list(X, "X", keep_float32=True, layout=estimator.layout or "channels_last")
    return list(validate_data(estimator, X, reset=False, dtype=np.float64))


def as_listed(X: Any) -> Any:
    """Return any collection of curves as a list; tables and arrays stay."""
    curves, _ = unlabelled(_read_once(X), "X")
    return curves


def _read_once(X: Any) -> Any:
    """Return curves of an iterator, which can be read only once, or of a dict's values."""
    return list(X) if isinstance(X, Iterator | ValuesView) else X


def _reference_system(estimator: Any, X: Any, known: Any) -> Any:
    options = estimator.options or {}
    return check_reference_systems(options, measure=estimator.measure, known=known, X=X)


def is_list_of_curves(X: Any) -> bool:
    """Return whether X is a list of curves; scikit-learn checks tables."""
    if isinstance(X, np.ndarray):
        return X.ndim == 3 or (X.ndim == 1 and X.dtype == object)
    if not isinstance(X, list | tuple) or len(X) == 0:
        return False
    return np.ndim(X[0]) > 0 or hasattr(X[0], "__geo_interface__")
