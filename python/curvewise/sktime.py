"""Distances and a classifier of sktime with curvewise behind them.

A panel of sktime, in whatever of its formats, becomes a list of curves: a time point is a point, a
variable a coordinate, and the index does not count. Series may differ in length. A matrix is one
compiled call; the classifier's neighbours are found by :class:`curvewise.Index`, without the table
of all distances. The conventions are those of sktime 1.0 and later
(``pip install "curvewise[sktime]"``), whose ``check_estimator`` both pass.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from ._extras import extra
from ._names import names_alone
from ._options import Default
from .curves.inputs import Array
from .many.pairwise import cdist
from .measures.registry import MEASURES, MeasureName

with extra("sktime", "curvewise.sktime needs sktime"):
    # Absolute, so these are the packages of that name and not this one. They have no types.
    from sktime.classification.base import BaseClassifier
    from sktime.dists_kernels.base import BasePairwiseTransformerPanel

__all__ = ["CurveDistance", "CurveKNeighborsTimeSeriesClassifier"]
__dir__ = names_alone(__all__)

Panel = list[Any]
"""One DataFrame a series, in which sktime hands over every other format."""
_SHARED_TAGS = {
    "authors": "the curvewise developers",
    "maintainers": "the curvewise developers",
    "X_inner_mtype": "df-list",
    "capability:missing_values": False,
    "capability:multivariate": True,
    "capability:unequal_length": True,
}


class CurveDistance(BasePairwiseTransformerPanel):  # type: ignore[misc]  # untyped
    """Every measure of curvewise as a distance between time series.

    Parameters
    ----------
    measure : str
        A measure by its name, see :func:`curvewise.available_measures`.
    options : dict, optional
        Options of the measure's own function, e.g. ``{"window": 10}``.
    workers : int
        Threads for a call: at least 1, or -1 for one per core. Never changes a result.

    Notes
    -----
    For the DTW distance of sktime and aeon, use ``options={"metric": "sqeuclidean"}``. Instances
    can replace any distance in sktime: ``KNeighborsTimeSeriesClassifier(distance=...)``,
    ``TimeSeriesKMedoids(metric=...)``, sums and products of distances. Errors, cost and source are
    those of :func:`curvewise.cdist`.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.sktime import CurveDistance
    >>> panel = np.array([[[0.0, 1, 2, 3]], [[0, 0, 3, 3]]])  # 2 series of 1 variable
    >>> CurveDistance("dtw").transform(panel).tolist()
    [[0.0, 2.0], [2.0, 0.0]]
    """

    _tags = {**_SHARED_TAGS, "symmetric": True, "pwtrafo_type": "distance"}  # noqa: RUF012

    def __init__(
        self,
        measure: MeasureName = "dtw",
        options: Mapping[str, Any] | None = None,
        workers: SupportsIndex = Default.workers,
    ) -> None:
        self.measure = measure
        self.options = options
        self.workers = workers
        super().__init__()
        info = MEASURES.get(measure)
        self.set_tags(symmetric=info is not None and info.symmetric and not options)

    def _transform(self, X: Panel, X2: Panel | None = None) -> Array:
        columns = None if X2 is None or X2 is X else _curves(X2)
        options = {"workers": self.workers, "layout": "channels_last", **(self.options or {})}
        matrix = cdist(_curves(X), columns, self.measure, **options)
        return np.asarray(matrix)

    @classmethod
    def get_test_params(cls, parameter_set: str = "default") -> list[dict[str, Any]]:
        """Return the parameters with which sktime tests the class.

        Parameters
        ----------
        parameter_set : str
            There is one set.

        Returns
        -------
        list of dict
            Arguments of the constructor.
        """
        window = {"metric": "sqeuclidean", "window": 0.5}
        return [{}, {"measure": "frechet"}, {"options": window, "workers": 2}]


class CurveKNeighborsTimeSeriesClassifier(BaseClassifier):  # type: ignore[misc]  # untyped
    """Classify a time series as the nearest of known ones are.

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
        Threads for a call: at least 1, or -1 for one per core. Never changes a result.

    Notes
    -----
    :class:`curvewise.sklearn.CurveKNeighborsClassifier` under sktime's interface, with its errors
    and cost: exact, and mostly without computing all distances.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.sktime import CurveKNeighborsTimeSeriesClassifier
    >>> panel = np.array([[[0.0, 1, 2, 3]], [[3, 2, 1, 0]]])  # 2 series of 1 variable
    >>> classifier = CurveKNeighborsTimeSeriesClassifier().fit(panel, np.array(["up", "down"]))
    >>> classifier.predict(np.array([[[0.0, 0, 3, 3]]])).tolist()
    ['up']
    """

    _tags = {  # noqa: RUF012
        **_SHARED_TAGS,
        "capability:multithreading": True,
        "capability:predict_proba": True,
        "classifier_type": "distance",
        "python_dependencies": "scikit-learn",
    }

    def __init__(
        self,
        n_neighbors: SupportsIndex = 1,
        measure: MeasureName = "dtw",
        options: Mapping[str, Any] | None = None,
        weights: str = "uniform",
        workers: SupportsIndex = Default.workers,
    ) -> None:
        self.n_neighbors = n_neighbors
        self.measure = measure
        self.options = options
        self.weights = weights
        self.workers = workers
        super().__init__()

    def _fit(self, X: Panel, y: npt.NDArray[Any]) -> CurveKNeighborsTimeSeriesClassifier:
        from .sklearn import CurveKNeighborsClassifier

        parameters = {**self.get_params(deep=False), "layout": "channels_last"}
        self.classifier_ = CurveKNeighborsClassifier(**parameters).fit(_curves(X), y)
        return self

    def _predict_proba(self, X: Panel) -> Array:
        return self.classifier_.predict_proba(_curves(X))

    def _predict(self, X: Panel) -> npt.NDArray[Any]:
        return self.classifier_.predict(_curves(X))

    @classmethod
    def get_test_params(cls, parameter_set: str = "default") -> list[dict[str, Any]]:
        """Return the parameters with which sktime tests the class.

        Parameters
        ----------
        parameter_set : str
            There is one set.

        Returns
        -------
        list of dict
            Arguments of the constructor.
        """
        return [{}, {"n_neighbors": 3, "measure": "frechet", "weights": "distance"}]


def _curves(panel: Panel) -> list[Array]:
    """Return the series of a panel as arrays with a row a time point."""
    return [np.asarray(frame.to_numpy(), dtype=np.float64) for frame in panel]
