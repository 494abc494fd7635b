"""The kinds of means that clusters have: their distances, and how a mean is moved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from .._core import dtw_mean as compiled_dtw_mean
from ..curves.inputs import Array
from ..curves.z_normalization import z_normalized
from ..many.averages import soft_mean
from ..many.pairwise import Measure, cdist
from ..many.shape_means import moved_shape, shape_distances
from ..measures.soft_dtw import soft_dtw

__all__ = ["MEANS", "MOVES", "Curves", "Mean", "MeanName"]

MeanName: TypeAlias = Literal["dtw", "soft_dtw", "frechet", "sbd"]
Curves: TypeAlias = list[Array]

MOVES = 10  # of a mean in a round
_STILL = 1e-6  # a part of the sum that no move is made for


@dataclass(frozen=True)
class Mean:
    """A kind of mean.

    Attributes
    ----------
    options : tuple of str, or None
        What it can be told; None for all options of the measure.
    distances : callable
        Of (curves, centers, workers, **options): the distances, shape (k, number of centers).
    moved : callable
        Of (center, its curves, their weights, workers, **options): the center, nearer to them.
    prepared : callable
        Of a curve: what is compared of it.
    """

    options: tuple[str, ...] | None
    distances: Callable[..., Array]
    moved: Callable[..., Array]
    prepared: Callable[[Array], Array] = np.asarray


def _distances(curves: Curves, centers: Curves, measure: Measure, **options: Any) -> Array:
    return np.asarray(cdist(curves, centers, measure, layout="channels_last", **options))


def _dtw_distances(curves: Curves, centers: Curves, workers: Any, **options: Any) -> Array:
    return _distances(curves, centers, "dtw", metric="sqeuclidean", workers=workers, **options)


def _dtw_moved(
    center: Array, curves: Curves, weights: Array, workers: Any, *, window: Any = None
) -> Array:
    counts = weights.tolist()
    mean, _, _ = compiled_dtw_mean(curves, counts, center, window, MOVES, _STILL, workers, None)
    return np.asarray(mean)


def _soft_distances(curves: Curves, centers: Curves, workers: Any, **options: Any) -> Array:
    return _distances(curves, centers, soft_dtw, **options)


def _soft_moved(
    center: Array, curves: Curves, weights: Array, workers: Any, **options: Any
) -> Array:
    told = {"gamma": 1.0, "window": None, "workers": workers, **options}
    mean, _, _ = soft_mean(curves, weights, center, MOVES, _STILL, told)
    return mean


def _frechet_distances(curves: Curves, centers: Curves, workers: Any, **options: Any) -> Array:
    return _distances(curves, centers, "frechet", workers=workers, **options)


def _frechet_moved(
    center: Array, curves: Curves, weights: Array, workers: Any, **options: Any
) -> Array:
    told = {"workers": workers, "layout": "channels_last", **options}
    return curves[int(np.argmin(weights @ np.asarray(cdist(curves, None, "frechet", **told))))]


def _shape_distances(curves: Curves, centers: Curves, workers: Any) -> Array:
    return shape_distances(curves, centers)


def _shape_moved(center: Array, curves: Curves, weights: Array, workers: Any) -> Array:
    return moved_shape(center, curves, weights)


MEANS: dict[str, Mean] = {
    "dtw": Mean(("window",), _dtw_distances, _dtw_moved),
    "soft_dtw": Mean(("gamma", "window"), _soft_distances, _soft_moved),
    "frechet": Mean(None, _frechet_distances, _frechet_moved),
    "sbd": Mean((), _shape_distances, _shape_moved, z_normalized),
}
