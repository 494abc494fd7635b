"""Clusters of curves around means, as an estimator of scikit-learn.

Lloyd's algorithm: every curve goes to the nearest centre, every centre moves to the mean of its
curves, until the sum of distances falls no further. A mean is found from where it was, so that
neither step raises the sum. First centres as greedy k-means++ (Arthur & Vassilvitskii 2007). Cost
of a round: k distances a curve, and those of ten moves of its mean; the distances of all pairs are
never needed, except where the centres are medoids.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, SupportsFloat, SupportsIndex, get_args

import numpy as np
import numpy.typing as npt

from .._options import Default, check_choice, real_number, whole_number
from ..curves.foreign_curves import warn
from ..curves.inputs import Array, as_curve_list, copy_of
from ..curves.layouts import Layout
from .inputs import (
    ClusterMixin,
    ConvergenceWarning,
    CurveEstimator,
    ManyCurves,
    Options,
    check_random_state,
    checked_sample_weight,
    curves_to_fit,
    fitted_curves,
)
from .means import MEANS, MOVES, Curves, Mean, MeanName

__all__ = ["CurveKMeans"]


_STARTS = 10
_FEW_CELLS = 2e9  # of a round, for which all starts are made


# Shared text: layout
class CurveKMeans(ClusterMixin, CurveEstimator):  # type: ignore[misc]  # untyped
    """Divide curves into clusters, each around the mean of its curves.

    Parameters
    ----------
    n_clusters : int
        Number of clusters.
    measure : {"dtw", "soft_dtw", "frechet", "sbd"}
        The kind of mean. "dtw" is that of :func:`curvewise.dtw_mean` (DTW barycentre averaging),
        whose sum is of ``dtw(curve, mean, metric="sqeuclidean")``. "soft_dtw" is that of
        :func:`curvewise.soft_dtw_mean`. "frechet" is the medoid under frechet;
        :class:`CurveKMedoids` finds smaller sums if all distances can be computed. "sbd" is
        k-Shape: curves are z-normalised, and the mean is the shape that correlates most with its
        curves, each shifted to where it fits best; see :func:`curvewise.sbd`.
    options : dict, optional
        Options: for dtw "window", for soft_dtw "gamma" and "window", for frechet those of its
        function, for sbd none.
    init : "k-means++" or callable
        The choice of first centres. "k-means++" draws each with the chance of its distance from
        those before, and keeps the best of ``2 + log(n_clusters)`` draws. A callable is called as
        ``init(X, n_clusters, random_state)`` and returns the centres, a list of curves.
    n_init : int or "auto"
        Number of choices of first centres; the smallest sum counts. "auto" takes 10 if these take
        a few seconds (up to 2e9 cells of dtw tables for each round and start), else 1.
    max_iter : int
        Maximum number of rounds.
    tol : float >= 0
        The iteration ends if a round lowers the sum by no more than this fraction.
    random_state : int, RandomState or None
        Draws the first centres.
    workers : int
        Number of threads for a call: at least 1, or -1 for one per core. Does not change a result.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Attributes
    ----------
    cluster_centers_ : list of ndarray
        The means; each has the number of points of its initial curve.
    labels_ : ndarray of int64, shape (k,)
        The cluster of each curve; of equally near ones the first.
    inertia_ : float
        The sum of the distances from the means.
    n_iter_ : int
        Number of rounds.

    Warns
    -----
    ConvergenceWarning
        If the sum still fell by more than `tol` after `max_iter` rounds.

    Notes
    -----
    k-means++ (Arthur & Vassilvitskii 2007) and Lloyd's algorithm. "sbd" is the algorithm of
    Paparrizos & Gravano, "k-Shape: Efficient and Accurate Clustering of Time Series", SIGMOD 2015,
    with k-means++ instead of random labels. A cluster without curves gets the one that is farthest
    from its centre. Curves as for :class:`CurveKMedoids`. Time: k distances and ten moves of a mean
    for each curve and round, nothing of all pairs; memory that of the curves.

    Examples
    --------
    >>> from curvewise.sklearn import CurveKMeans
    >>> curves = [[0, 1, 2, 3], [0, 1, 3], [0, 2, 2, 3], [9, 8, 7], [9, 9, 7]]
    >>> found = CurveKMeans(2, random_state=0).fit(curves)
    >>> bool(found.labels_[0] == found.labels_[2] != found.labels_[3])
    True
    >>> bool(found.predict([[8, 8]])[0] == found.labels_[4])
    True
    """

    def __init__(
        self,
        n_clusters: SupportsIndex = 8,
        *,
        measure: MeanName = "dtw",
        options: Options = None,
        init: Literal["k-means++"] | Callable[..., Any] = "k-means++",
        n_init: SupportsIndex | Literal["auto"] = "auto",
        max_iter: SupportsIndex = 50,
        tol: SupportsFloat = 1e-6,
        random_state: Any = None,
        workers: SupportsIndex = Default.workers,
        layout: Layout | None = None,
    ) -> None:
        self.n_clusters = n_clusters
        self.measure = measure
        self.options = options
        self.init = init
        self.n_init = n_init
        self.max_iter = max_iter
        self.tol = tol
        self.random_state = random_state
        self.workers = workers
        self.layout = layout

    def fit(
        self, X: ManyCurves, y: None = None, sample_weight: npt.ArrayLike | None = None
    ) -> CurveKMeans:
        """Find the clusters of curves X.

        Parameters
        ----------
        X : array_like, shape (k, n, d) or (k, n), or a sequence of curves
            The curves.
        y : None
            Not used.
        sample_weight : array_like, shape (k,), optional
            How much each curve counts, at least 0; 1 if not given.

        Returns
        -------
        CurveKMeans
            This one.

        Raises
        ------
        ValueError, TypeError
            As for :func:`curvewise.dtw_mean`; more clusters than curves; an option that the mean
            does not have.
        """
        mean, options = self._mean()
        moves = whole_number("max_iter", self.max_iter, 1, "give a whole number >= 1")
        limit = real_number("tol", self.tol, 0.0, "give a number >= 0")
        (given,) = curves_to_fit(self, X)
        curves = as_curve_list(given, "X", layout="channels_last")  # in float64
        curves = [mean.prepared(curve) for curve in curves]
        most = len(curves)
        advice = f"give a whole number from 1 to {most}, the curves (n_samples={most})"
        count = whole_number("n_clusters", self.n_clusters, 1, advice, most)
        weights = checked_sample_weight(sample_weight, curves)
        random = check_random_state(self.random_state)
        begins = [
            self._first_centers(curves, count, weights, mean, options, random)
            for _ in range(self._starts(curves, count))
        ]
        runs = [_lloyd(curves, weights, centers, mean, options, moves, limit) for centers in begins]
        best = min(runs, key=lambda run: run.cost)
        if not best.converged:
            warn(
                ConvergenceWarning(
                    f"the sum still fell by more than tol={limit} after max_iter={moves} moves; "
                    "give more"
                )
            )
        self.cluster_centers_ = best.centers
        self.labels_ = best.labels
        self.inertia_ = best.cost
        self.n_iter_ = best.moves
        return self

    def predict(self, X: ManyCurves) -> npt.NDArray[np.int64]:
        """Return the cluster whose mean is nearest.

        Parameters
        ----------
        X : array_like, shape (q, n, d) or (q, n), or a sequence of curves
            The query curves.

        Returns
        -------
        ndarray of int64, shape (q,)
            Their clusters.

        Raises
        ------
        ValueError, TypeError
            As for :func:`curvewise.cdist`.
        """
        mean, options = self._mean()
        curves = [mean.prepared(curve) for curve in fitted_curves(self, X)]
        return _nearest(curves, self.cluster_centers_, mean, options)[0]

    def _starts(self, curves: Curves, count: int) -> int:
        """Return from how many choices of first centres to begin."""
        if not (isinstance(self.n_init, str) and self.n_init == "auto"):
            return whole_number("n_init", self.n_init, 1, 'give a whole number >= 1, or "auto"')
        points = sum(map(len, curves))
        cells = points * points / len(curves) * (count + MOVES)  # of a round
        return _STARTS if cells <= _FEW_CELLS else 1

    def _first_centers(
        self,
        curves: Curves,
        count: int,
        weights: Array,
        mean: Mean,
        options: dict[str, Any],
        random: Any,
    ) -> Curves:
        """Return the centres of a start: those of k-means++, or of a callable."""
        if not callable(self.init):
            check_choice("init", self.init, ("k-means++",))
            return _first_centers(curves, count, weights, mean, options, random)
        centers = as_curve_list(self.init(curves, count, random), "init", layout="channels_last")
        if len(centers) != count:
            raise ValueError(f"init returns {len(centers)} curves; give {count}, one a cluster")
        return [copy_of(mean.prepared(center)) for center in centers]

    def _mean(self) -> tuple[Mean, dict[str, Any]]:
        """Return the kind of mean, and the arguments of its functions."""
        check_choice("measure", self.measure, get_args(MeanName))
        mean = MEANS[self.measure]
        options = dict(self.options or {})
        for name in options:
            if mean.options is not None and name not in mean.options:
                raise TypeError(
                    f"the mean under {self.measure!r} has no option {name!r}; it has "
                    f"{' and '.join(mean.options) or 'none'}"
                )
        return mean, {"workers": self.workers, **options}


@dataclass(frozen=True)
class _Run:
    """The end of one run of Lloyd's algorithm."""

    centers: Curves
    labels: npt.NDArray[np.int64]
    cost: float
    moves: int
    converged: bool


def _first_centers(
    curves: Curves,
    count: int,
    weights: Array,
    mean: Mean,
    options: dict[str, Any],
    random: Any,
) -> Curves:
    """Return curves, each the best of some that are drawn by their distances from those before.

    The distances are sums of squares under dtw; under frechet they are squared, and those of
    soft_dtw, which may be below 0, are counted from the smallest. Of several draws the one counts
    that leaves the smallest sum.
    """
    chosen: list[int] = []
    nearest = np.full(len(curves), np.inf)
    chances = weights
    for _ in range(count):
        trials = 1 if not chosen else 2 + int(np.log(count))
        drawn = random.choice(len(curves), trials, p=chances / chances.sum())
        latest = mean.distances(curves, [curves[i] for i in drawn], **options)
        if mean is MEANS["frechet"]:
            latest = latest * latest
        left = np.minimum(nearest[:, np.newaxis], latest)
        best = int(np.argmin(weights @ left))
        chosen.append(int(drawn[best]))
        nearest = left[:, best]
        chances = weights * (nearest - min(0.0, float(nearest.min())))
        chances[chosen] = 0.0
        if not chances.any():  # all others are equal to one that was drawn, or do not count
            chances = np.ones(len(curves))
            chances[chosen] = 0.0
    return [copy_of(curves[i]) for i in chosen]


def _lloyd(
    curves: Curves,
    weights: Array,
    centers: Curves,
    mean: Mean,
    options: dict[str, Any],
    most: int,
    limit: float,
) -> _Run:
    """Move centers and labels in turn until the sum falls no further."""
    labels, near = _nearest(curves, centers, mean, options)
    for moves in range(1, most + 1):
        moved = _moved(curves, weights, centers, labels, near, mean, options)
        moved_labels, moved_near = _nearest(curves, moved, mean, options)
        cost = float(weights @ near)
        fell = cost - float(weights @ moved_near)
        if fell > 0.0:
            centers, labels, near = moved, moved_labels, moved_near
        if not fell > limit * abs(cost):
            return _Run(centers, labels, float(weights @ near), moves, True)
    return _Run(centers, labels, float(weights @ near), most, False)


def _moved(
    curves: Curves,
    weights: Array,
    centers: Curves,
    labels: npt.NDArray[np.int64],
    near: Array,
    mean: Mean,
    options: dict[str, Any],
) -> Curves:
    """Return the centers, nearer to their curves; one without any is where a curve is far off."""
    far = weights * near
    moved = []
    for k, center in enumerate(centers):
        members = np.flatnonzero((labels == k) & (weights > 0.0))
        if len(members) > 0:
            own = [curves[i] for i in members]
            moved.append(mean.moved(center, own, weights[members], **options))
        else:
            farthest = int(np.argmax(far))
            far[farthest] = -np.inf
            moved.append(copy_of(curves[farthest]))
    return moved


def _nearest(
    curves: Curves, centers: Curves, mean: Mean, options: dict[str, Any]
) -> tuple[npt.NDArray[np.int64], Array]:
    """Return the nearest center of each curve, and how far that is."""
    distances = mean.distances(curves, centers, **options)
    labels = np.argmin(distances, axis=1)
    return labels, distances[np.arange(len(curves)), labels]
