"""Clusters of curves around medoids, for every measure, as an estimator of scikit-learn."""

from __future__ import annotations

from typing import Any, Literal, SupportsIndex

import numpy as np
import numpy.typing as npt

from .._options import Default, whole_number
from ..curves.foreign_curves import warn
from ..curves.inputs import as_curve, copy_of
from ..curves.layouts import Layout
from ..many.k_medoids import k_medoids
from ..many.pairwise import Measure, cdist
from .inputs import (
    ClusterMixin,
    ConvergenceWarning,
    CurveEstimator,
    ManyCurves,
    Options,
    check_is_fitted,
    checked_sample_weight,
    curves_to_fit,
    fitted_curves,
    validate_data,
)

__all__ = ["CurveKMedoids"]


# Shared text: layout
class CurveKMedoids(ClusterMixin, CurveEstimator):  # type: ignore[misc]  # untyped
    """Divide curves into clusters, each around one of them: its medoid.

    The sum of the distances of all curves from their medoids is as small as no exchange of a medoid
    for another curve makes it smaller.

    Parameters
    ----------
    n_clusters : int
        Number of clusters.
    measure : str or callable
        A measure by its name, see :func:`curvewise.available_measures`, or a function of two
        curves. Where it is not symmetric, the medoid is Q. Or "precomputed": X is then the matrix
        of all distances, as :func:`curvewise.cdist` returns it, which serves several numbers of
        clusters.
    options : dict, optional
        Options of the measure's own function, e.g. ``{"window": 10}``.
    max_iter : int
        Maximum number of passes in which each curve is tried as a medoid.
    workers : int
        Threads for a call: at least 1, or -1 for one per core. Never changes a result.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Attributes
    ----------
    medoid_indices_ : ndarray of int64, shape (n_clusters,)
        Which curves are the medoids, in ascending order.
    cluster_centers_ : list of ndarray
        The medoids; not where the distances were given.
    labels_ : ndarray of int64, shape (k,)
        The cluster of each curve; of equally near ones the first.
    inertia_ : float
        The sum of the distances from the medoids.
    n_iter_ : int
        Number of passes.

    Warns
    -----
    ConvergenceWarning
        After `max_iter` rounds an exchange still lowered the sum.

    Notes
    -----
    FasterPAM (Schubert & Rousseeuw 2021), which begins with the medoids of BUILD (Kaufman &
    Rousseeuw 1990): no randomness. Curves as for :class:`CurveKNeighborsClassifier`; a dict, a
    groupby and a table of lines, whose labels are not kept, too. Time: that of all distances, and
    O(k^2) a cluster and round; memory 8 k^2 bytes.

    Examples
    --------
    >>> from curvewise.sklearn import CurveKMedoids
    >>> curves = [[0, 1, 2, 3], [0, 1, 3], [0, 2, 2, 3], [9, 8, 7], [9, 9, 7]]
    >>> found = CurveKMedoids(2, measure="frechet").fit(curves)
    >>> found.labels_.tolist(), found.medoid_indices_.tolist()
    ([0, 0, 0, 1, 1], [0, 3])
    >>> found.predict([[8, 8], [1, 2]]).tolist()
    [1, 0]
    """

    def __init__(
        self,
        n_clusters: SupportsIndex = 8,
        *,
        measure: Measure | Literal["precomputed"] = "dtw",
        options: Options = None,
        max_iter: SupportsIndex = 100,
        workers: SupportsIndex = Default.workers,
        layout: Layout | None = None,
    ) -> None:
        self.n_clusters = n_clusters
        self.measure = measure
        self.options = options
        self.max_iter = max_iter
        self.workers = workers
        self.layout = layout

    def fit(
        self, X: ManyCurves, y: None = None, sample_weight: npt.ArrayLike | None = None
    ) -> CurveKMedoids:
        """Find the clusters of curves X.

        Parameters
        ----------
        X : array_like, shape (k, n, d) or (k, n), or a sequence of curves
            The curves; or the matrix of their distances, shape (k, k).
        y : None
            Not used.
        sample_weight : array_like, shape (k,), optional
            How much the distance of each curve counts, at least 0; 1 if not given.

        Returns
        -------
        CurveKMedoids
            This one.

        Raises
        ------
        ValueError, TypeError
            As for :func:`curvewise.cdist`; more clusters than curves.
        """
        rounds = whole_number("max_iter", self.max_iter, 1, "give a whole number >= 1")
        if self.measure == "precomputed":
            curves = None
            distances = validate_data(self, X, dtype=np.float64)
            if distances.shape[0] != distances.shape[1]:
                raise ValueError(
                    f"X has shape {distances.shape}; the distances of k curves have shape (k, k)"
                )
        else:
            (curves,) = curves_to_fit(self, X)
            distances = self._distances(curves, None)
        most = len(distances)
        advice = f"give a whole number from 1 to {most}, the curves (n_samples={most})"
        count = whole_number("n_clusters", self.n_clusters, 1, advice, most)
        from_medoids = np.ascontiguousarray(distances.T)
        weights = checked_sample_weight(sample_weight, from_medoids)
        found = k_medoids(from_medoids * weights, count, rounds)
        if not found.converged:
            warn(
                ConvergenceWarning(
                    f"an exchange still lowered the sum after max_iter={rounds} rounds; give more"
                )
            )
        self.medoid_indices_ = found.medoids
        # A curve that does not count has a cluster too.
        self.labels_ = np.argmin(from_medoids[found.medoids], axis=0)
        self.inertia_ = found.cost
        self.n_iter_ = found.rounds
        self.__dict__.pop("cluster_centers_", None)
        if curves is not None:
            self.cluster_centers_ = [copy_of(as_curve(curves[i], f"X[{i}]")) for i in found.medoids]
        return self

    def predict(self, X: ManyCurves) -> npt.NDArray[np.int64]:
        """Return the cluster whose medoid is nearest.

        Parameters
        ----------
        X : array_like, shape (q, n, d) or (q, n), or a sequence of curves
            The query curves; or their distances from the curves of the fit, shape (q, k).

        Returns
        -------
        ndarray of int64, shape (q,)
            Their clusters.

        Raises
        ------
        ValueError, TypeError
            As for :func:`curvewise.cdist`.
        """
        check_is_fitted(self)
        if self.measure == "precomputed":
            distances = validate_data(self, X, reset=False, dtype=np.float64)
            distances = distances[:, self.medoid_indices_]
        else:
            distances = self._distances(fitted_curves(self, X), self.cluster_centers_)
        return np.asarray(np.argmin(distances, axis=1))

    def _distances(self, X: Any, medoids: Any) -> Any:
        measure: Any = self.measure
        options = {"workers": self.workers, "layout": "channels_last", **(self.options or {})}
        return cdist(X, medoids, measure, **options)

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.pairwise = self.measure == "precomputed"
        return tags
