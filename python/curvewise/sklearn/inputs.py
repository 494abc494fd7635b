"""Input of an estimator: a list of curves, or a table whose rows are curves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np

from .._extras import extra
from ..curves.inputs import as_curve_list
from ..curves.labels import in_order_of, unlabelled
from ..curves.reference_systems import check_reference_systems
from ..many.pairwise import Curves, LabelledCurves

with extra("sklearn", "curvewise.sklearn needs scikit-learn >= 1.6"):
    # Absolute, so these are the packages of that name and not this one.
    from sklearn.base import (
        BaseEstimator,
        ClassifierMixin,
        ClusterMixin,
    )
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.utils import check_random_state
    from sklearn.utils.multiclass import (
        check_classification_targets,
    )
    from sklearn.utils.validation import (
        check_is_fitted,
        column_or_1d,
        validate_data,
    )

__all__ = [
    "BaseEstimator",
    "ClassifierMixin",
    "ClusterMixin",
    "ConvergenceWarning",
    "ManyCurves",
    "Options",
    "check_classification_targets",
    "check_is_fitted",
    "check_random_state",
    "column_or_1d",
    "curves_to_fit",
    "fitted_curves",
    "validate_data",
]

ManyCurves: TypeAlias = Curves | LabelledCurves
Options: TypeAlias = Mapping[str, Any] | None


def curves_to_fit(estimator: Any, X: Any, *y: Any) -> tuple[Any, ...]:
    """Return the curves of X, and y if it is given, checked where X is a table of rows."""
    estimator._crs = _reference_system(estimator, X, None)
    y = tuple(in_order_of(target, X, "y") for target in y)
    X, _ = unlabelled(X, "X")
    if _is_list_of_curves(X):
        estimator.__dict__.pop("n_features_in_", None)  # of rows that were fitted before
        return as_curve_list(X, "X", keep_float32=True, layout=estimator.layout), *y
    checked = validate_data(estimator, X, *y, dtype=np.float64)
    rows, *targets = checked if y else (checked,)
    return list(rows), *targets


def fitted_curves(estimator: Any, X: Any) -> Any:
    """Return curves to be compared with those that were fitted."""
    check_is_fitted(estimator)
    _reference_system(estimator, X, estimator._crs)
    X, _ = unlabelled(X, "X")
    if _is_list_of_curves(X):
        # The curves of the fit have been checked already.
        return as_curve_list(X, "X", keep_float32=True, layout=estimator.layout or "channels_last")
    return list(validate_data(estimator, X, reset=False, dtype=np.float64))


def _reference_system(estimator: Any, X: Any, known: Any) -> Any:
    options = estimator.options or {}
    return check_reference_systems(options, measure=estimator.measure, known=known, X=X)


def _is_list_of_curves(X: Any) -> bool:
    """Return whether X is a list of curves; scikit-learn checks tables."""
    if isinstance(X, np.ndarray):
        return X.ndim == 3 or (X.ndim == 1 and X.dtype == object)
    if not isinstance(X, list | tuple) or len(X) == 0:
        return False
    return np.ndim(X[0]) > 0 or hasattr(X[0], "__geo_interface__")
