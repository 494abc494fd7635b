"""Nearest curves, subsequences and means, by their definitions.

The code neither prunes nor estimates. It computes the distances of this package for every pair or
every window, and selects the results from them. Values and indices are bitwise identical to those
of :class:`curvewise.Index`, :func:`curvewise.subsequence`, :func:`curvewise.matrix_profile` and
:func:`curvewise.dtw_mean`, if those of the measure are.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

import numpy as np
import numpy.typing as npt

from .._options import Metric, Order, Radius, WarpingName, Window
from ..curves.ground_distance import Root, before_root, check_metric, ground_distances, in_range
from ..curves.inputs import Array, CurveLike, as_curve
from ..curves.scaling import times_power_of_two
from ..curves.z_normalization import z_normalized
from ..measures.results import DtwMean, MatrixProfile, Subsequence
from .checks import check_pair
from .dtw import dtw, dtw_path

__all__ = ["dtw_mean", "kneighbors", "matrix_profile", "radius_neighbors", "subsequence"]

Curves = Sequence[CurveLike]


def kneighbors(
    curves: Curves,
    X: Curves,
    n_neighbors: int = 5,
    measure: str = "dtw",
    **options: Any,
) -> tuple[Array, npt.NDArray[np.int64]]:
    """Return distances and indices of the nearest of `curves`: a table, and a stable sort."""
    table = _all_distances(X, curves, measure, options)
    order = np.argsort(table, axis=1, kind="stable")[:, :n_neighbors]
    return np.take_along_axis(table, order, axis=1), order


def radius_neighbors(
    curves: Curves, X: Curves, radius: float, measure: str = "dtw", **options: Any
) -> tuple[list[Array], list[npt.NDArray[np.int64]]]:
    """Return distances and indices of curves within a radius, nearest first."""
    distances, indices = [], []
    for row in _all_distances(X, curves, measure, options):
        order = np.argsort(row, kind="stable")
        near = order[row[order] <= radius]
        distances.append(row[near])
        indices.append(near)
    return distances, indices


def subsequence(
    P: CurveLike,
    Q: CurveLike,
    *,
    k: int = 1,
    measure: WarpingName = "dtw",
    metric: Metric = "euclidean",
    p: Order = None,
    radius: Radius = None,
    cutoff: float = np.inf,
) -> list[Subsequence]:
    """Return the best subsequence of Q, then the best of the remaining sections.

    Every section is searched separately, in its own table.
    """
    metric, order = check_metric(metric, p, radius)
    P, Q = as_curve(P, "P"), as_curve(Q, "Q")
    P, Q = check_pair(P, Q, measure, on_sphere=metric == "haversine")
    P, Q, exponent = in_range(P, Q, metric)
    ground, root = ground_distances(P[:, np.newaxis], Q, metric, order), None
    if measure == "frechet":
        ground, root = before_root(P[:, np.newaxis], Q, metric, order)
    pieces = [_best_run(ground, measure, root, 0, ground.shape[1])]
    answers: list[Subsequence] = []
    while pieces and len(answers) < k:
        best = min(pieces, key=lambda piece: (piece[0], piece[2]))
        value, start, stop, begin, end = best
        distance = float(times_power_of_two(np.array(value), exponent))
        if value == np.inf or distance > cutoff:
            break
        answers.append(Subsequence(distance, start, stop))
        pieces.remove(best)
        for left, right in ((begin, start), (stop + 1, end)):
            if right > left:
                pieces.append(_best_run(ground, measure, root, left, right))
    return answers


def matrix_profile(
    record: CurveLike, length: int, *, window: int | None = 0, exclusion: int | None = None
) -> MatrixProfile:
    """Return the nearest of all windows that are not excluded, from a table of all distances."""
    curve = as_curve(record, "record")
    zone = length // 2 if exclusion is None else exclusion
    starts = np.arange(len(curve) - length + 1)
    windows = [z_normalized(curve[i : i + length]) for i in starts]
    sums = np.full((len(starts), len(starts)), np.inf)
    for i, j in np.argwhere(np.abs(starts[:, np.newaxis] - starts) > zone):
        sums[i, j] = dtw(windows[i], windows[j], metric="sqeuclidean", window=window)
    indices = np.argmin(sums, axis=1)
    least = sums[starts, indices]
    return MatrixProfile(np.sqrt(least), np.where(np.isinf(least), -1, indices), zone)


def dtw_mean(
    curves: Curves,
    initial: CurveLike,
    *,
    weights: Sequence[float] | None = None,
    window: Window = None,
    iterations: int = 30,
    tolerance: float = 1e-6,
) -> DtwMean:
    """Average along the best paths, round after round, in the order of the curves."""
    given = [as_curve(curve, f"curves[{i}]") for i, curve in enumerate(curves)]
    shares = [1.0] * len(given) if weights is None else list(weights)
    mean = as_curve(initial, "initial")
    moved, cost = _averaged(mean, given, shares, window)
    costs, converged = [cost], False
    for _ in range(iterations):
        candidate = moved
        moved, cost = _averaged(candidate, given, shares, window)
        converged = not costs[-1] - cost > tolerance * costs[-1]
        if cost > costs[-1]:
            break
        costs.append(cost)
        mean = candidate
        if converged:
            break
    return DtwMean(mean, np.array(costs), converged)


def _all_distances(X: Curves, curves: Curves, measure: str, options: dict[str, Any]) -> Array:
    function: Callable[..., float] = getattr(import_module("curvewise.reference"), measure)
    return np.array([[function(P, Q, **options) for Q in curves] for P in X])


def _best_run(
    ground: Array, measure: WarpingName, root: Root | None, begin: int, end: int
) -> tuple[float, int, int, int, int]:
    """Return value, start and stop of the best run of a piece, and the piece.

    Row by row, every cell has the value of the best path that begins anywhere in the first row,
    and where it begins. Among equal predecessors: the diagonal, then (i-1, j), then (i, j-1).
    Where the ground distances are under a root, the runs are compared by the roots of their values.
    """
    piece = ground[:, begin:end]
    values = [float(d) for d in piece[0]]
    starts = list(range(begin, end))
    for costs in piece[1:]:
        above, above_starts = values, starts
        values, starts = [], []
        for j, d in enumerate(float(d) for d in costs):
            before = [(above[j], above_starts[j])]
            if j > 0:
                before = [(above[j - 1], above_starts[j - 1]), *before, (values[-1], starts[-1])]
            if measure == "dtw":
                steps = [(value + d, start) for value, start in before]
                # The choice between up and left is by their values before d is added.
                side = min(before[-2:] if j > 0 else before, key=lambda step: step[0])
                best = (side[0] + d, side[1])
                if j > 0 and steps[0][0] <= best[0]:
                    best = steps[0]
            else:
                best = min(before, key=lambda step: step[0])
                best = (max(d, best[0]), best[1])
            values.append(best[0])
            starts.append(best[1])
    distances = root(np.array(values)) if root else np.array(values)
    stop = int(np.argmin(distances))
    return float(distances[stop]), starts[stop], begin + stop, begin, end


def _averaged(
    mean: Array, curves: list[Array], weights: list[float], window: Any
) -> tuple[Array, float]:
    """Return the mean, moved, and the cost of the mean as it was."""
    sums, shares = np.zeros_like(mean), np.zeros(len(mean))
    cost = 0.0
    for curve, weight in zip(curves, weights, strict=True):
        alignment = dtw_path(mean, curve, metric="sqeuclidean", window=window)
        cost += weight * alignment.distance
        for i, j in alignment.path:
            sums[i] += weight * curve[j]
            shares[i] += weight
    with np.errstate(invalid="ignore", over="ignore"):
        return sums / (shares if mean.ndim == 1 else shares[:, np.newaxis]), cost
