"""Every long call there is, for interrupts.py: a name, and how to make the call ready.

Each entry returns the call, with its curves made: ``CALLS["dtw"]()()``. Sizes are such that most
take a second or two, so that a signal meets every stage of them: reading, packing, searching,
following the path back, writing.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np

import curvewise
import curvewise.dask
from curvewise.calibration import Objective, identify, identify_each
from curvewise.curves import resample, smooth, turning_points
from curvewise.sklearn import CurveKNeighborsClassifier

Call = Callable[[], object]
Calls = dict[str, Callable[[], Call]]


@cache
def walk(n: int, seed: int = 1, dim: int = 2) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(n, dim)).cumsum(axis=0)


@cache
def loop(n: int, seed: int = 1) -> np.ndarray:
    """Return a noisy loop: like another one, so that dtw and frechet prune."""
    t = np.linspace(0, 12 * np.pi, n)
    noise = np.random.default_rng(seed).normal(scale=0.002, size=(n, 2))
    return np.column_stack((np.cos(t) * (1 + 0.01 * t), np.sin(t))) * (1 + 0.01 * seed) + noise


@cache
def smooth_loop(n: int, factor: float = 1.0) -> np.ndarray:
    t = np.linspace(0, 6 * np.pi, n)
    return np.column_stack((np.cos(t) * (1 + 0.05 * t), np.sin(t) + 0.02 * t)) * factor


@cache
def many(count: int, points: int) -> list[np.ndarray]:
    return [walk(points, seed) for seed in range(count)]


@cache
def index(measure: str) -> curvewise.Index:
    return curvewise.Index([walk(5000)[i : i + 300] for i in range(2000)], measure)


def on(function: Callable[..., object], *arguments: Any, **options: Any) -> Callable[[], Call]:
    """Return what makes a call ready: arguments that can be called are made first."""

    def ready() -> Call:
        made = [argument() if callable(argument) else argument for argument in arguments]
        return partial(function, *made, **options)

    return ready


A, B = partial(walk, 40_000, 1), partial(walk, 40_000, 2)
HIGH, OTHER_HIGH = partial(walk, 2_000, 3, 1000), partial(walk, 2_000, 4, 1000)
LONG_3D, SHORT_3D = partial(walk, 3_000_000, 5, 3), partial(walk, 160, 6, 3)
LOOP, OTHER_LOOP = partial(loop, 1_000_000, 1), partial(loop, 900_000, 2)
HUGE, LESS = partial(walk, 5_000_000, 7), partial(walk, 4_000_000, 7)
MINKOWSKI = {"metric": "minkowski", "p": 3}

WARPING: Calls = {
    "dtw": on(curvewise.dtw, A, B),
    "dtw, 2 workers": on(curvewise.dtw, A, B, workers=2),
    "dtw, window": on(curvewise.dtw, A, B, window=8_000),
    "dtw, open ends": on(curvewise.dtw, A, B, open_begin=True, open_end=True),
    "dtw, cutoff": on(curvewise.dtw, A, B, cutoff=1e9),
    "dtw, 1000-D, minkowski": on(curvewise.dtw, HIGH, OTHER_HIGH, **MINKOWSKI),
    "dtw, 3,000,000 against 160 points": on(curvewise.dtw, LONG_3D, SHORT_3D, **MINKOWSKI),
    "dtw, pruned, 1,000,000 points": on(curvewise.dtw, LOOP, OTHER_LOOP),
    "dtw_path, 2 workers": on(curvewise.dtw_path, A, B, workers=2),
    "dtw_path, pruned, 1,000,000 points": on(curvewise.dtw_path, LOOP, OTHER_LOOP),
    "dtw_info": on(curvewise.dtw_info, A, B),
    "dtw_table, 12,000 points, window": on(
        curvewise.dtw_table, partial(walk, 12_000), partial(walk, 12_000), window=9
    ),
    "frechet": on(curvewise.frechet, A, B, prune=False),
    "frechet, minkowski, 2 workers": on(curvewise.frechet, A, B, workers=2, **MINKOWSKI),
    "frechet, pruned, 1,000,000 points": on(curvewise.frechet, LOOP, OTHER_LOOP),
    "frechet_path": on(curvewise.frechet_path, A, B),
    "frechet_path, pruned, 1,000,000 points": on(curvewise.frechet_path, LOOP, OTHER_LOOP),
    "frechet_info": on(curvewise.frechet_info, A, B),
    "frechet_table, 12,000 points": on(
        curvewise.frechet_table, partial(walk, 12_000), partial(walk, 12_000)
    ),
}

CONTINUOUS: Calls = {
    "frechet_continuous": on(curvewise.frechet_continuous, partial(walk, 10_000), B),
    "frechet_continuous, bounds": on(
        curvewise.frechet_continuous, partial(walk, 10_000), B, bounds=True
    ),
    "frechet_continuous, 1,000,000 points": on(curvewise.frechet_continuous, LOOP, OTHER_LOOP),
    "frechet_continuous, 100-D": on(
        curvewise.frechet_continuous, partial(walk, 3_000, 3, 100), partial(walk, 3_000, 4, 100)
    ),
    "frechet_continuous_path": on(
        curvewise.frechet_continuous_path, partial(walk, 10_000), partial(walk, 10_000, 2)
    ),
    "frechet_continuous_path, 1,000,000 points": on(
        curvewise.frechet_continuous_path, LOOP, OTHER_LOOP
    ),
    "frechet_within, walks": on(curvewise.frechet_within, A, B, 600.0),
    "frechet_within, 1,000,000 points": on(curvewise.frechet_within, LOOP, OTHER_LOOP, 0.05),
    "frechet_within, discrete": on(curvewise.frechet_within, A, B, 600.0, continuous=False),
    "cdist of frechet_continuous": on(
        curvewise.cdist, partial(many, 40, 2_000), measure="frechet_continuous"
    ),
    "cdist of frechet_continuous, 2 workers": on(
        curvewise.cdist, partial(many, 40, 2_000), measure="frechet_continuous", workers=2
    ),
}


def zigzag(n: int) -> np.ndarray:
    return np.column_stack((np.arange(n) % 2, np.zeros(n)))


def endless() -> np.ndarray:
    return np.broadcast_to(np.array([1.0, 2.0]), (400_000_000, 2))  # takes no memory


FAR = 1e200 * np.array([(-3, 0.1), (0.1, 0.1), (0.1, 0)])

PLANAR: Calls = {
    "area, 5,000,000 points": on(curvewise.area, HUGE, LESS),
    "area, x, split": on(curvewise.area, HUGE, LESS, spacing="x", crossing="split"),
    "area, arc length": on(curvewise.area, HUGE, LESS, spacing="arc_length"),
    "area, 2 against 5,000,000 points": on(curvewise.area, HUGE, partial(walk, 2)),
    "area, matched, 5,000,000 points": on(curvewise.area, HUGE, LESS, spacing="matched"),
    "area, matched, loops": on(curvewise.area, LOOP, OTHER_LOOP, spacing="matched"),
    "area_quads": on(curvewise.area_quads, HUGE, LESS),
    "area_quads, matched": on(curvewise.area_quads, HUGE, LESS, spacing="matched"),
    "pcm, 5,000,000 points": on(curvewise.pcm, HUGE, LESS),
    "pcm_match": on(curvewise.pcm_match, HUGE, LESS),
    "pcm, continuous, 5,000,000 points": on(curvewise.pcm, HUGE, LESS, offsets="continuous"),
    "pcm, continuous, on a zigzag": on(
        curvewise.pcm, partial(zigzag, 8801), partial(zigzag, 4401), offsets="continuous"
    ),
    "curve_length": on(curvewise.curve_length, HUGE, HUGE, scale="range"),
    "curve_length_residuals": on(curvewise.curve_length_residuals, HUGE, HUGE, scale="range"),
    "sum_of_squares": on(curvewise.sum_of_squares, endless, endless),
    "mse": on(curvewise.mse, endless, endless),
    "mae": on(curvewise.mae, endless, endless),
    "normalize": on(curvewise.normalize, HUGE, LESS),
    "compare, 5,000,000 points": on(curvewise.compare, HUGE, LESS),
    "compare of area, its deviations": on(
        lambda P, Q: curvewise.compare(P, Q, measures=["area"]).deviations, LOOP, OTHER_LOOP
    ),
}

GRADIENTS: Calls = {
    "value_and_gradient, dtw": on(curvewise.value_and_gradient, A, B, "dtw"),
    "value_and_gradient, frechet": on(curvewise.value_and_gradient, A, B, "frechet"),
    "value_and_gradient, area": on(curvewise.value_and_gradient, HUGE, LESS, "area"),
    "value_and_gradient, area, matched": on(
        curvewise.value_and_gradient, LOOP, OTHER_LOOP, "area", spacing="matched"
    ),
    "value_and_gradient, curve_length": on(
        curvewise.value_and_gradient, HUGE, LESS, "curve_length", scale="range"
    ),
    "value_and_gradient, sum_of_squares": on(
        curvewise.value_and_gradient, HUGE, HUGE, "sum_of_squares"
    ),
}


def area_of(P: np.ndarray, Q: np.ndarray) -> float:
    return curvewise.area(P, Q)


BATCHES: Calls = {
    "pdist, 3,000 x 100 points": on(curvewise.pdist, partial(many, 3_000, 100), "frechet"),
    "pdist, 3,000 x 100 points, 2 workers": on(
        curvewise.pdist, partial(many, 3_000, 100), workers=2
    ),
    "pdist, 10 x 10,000 points, 2 workers": on(
        curvewise.pdist, partial(many, 10, 10_000), workers=2
    ),
    "cdist of one pair, 2 workers": on(lambda P, Q: curvewise.cdist([P], [Q], workers=2), A, B),
    "cdist of pcm, 2 workers": on(
        curvewise.cdist, partial(many, 300, 100), measure="pcm", workers=2
    ),
    "cdist of area, matched": on(
        curvewise.cdist, partial(many, 100, 100), measure="area", spacing="matched"
    ),
    "cdist of area, 1,000,000 points": on(
        lambda P, Q: curvewise.cdist([P] * 10, [Q] * 10, "area"), LOOP, OTHER_LOOP
    ),
    "cdist of pcm, continuous, of curves far apart": on(
        curvewise.cdist, [[(-1, -1), (0, 0)]] * 300, [FAR] * 300, "pcm", offsets="continuous"
    ),
    "cdist of pcm, 10,000,000 offsets": on(
        curvewise.cdist, [zigzag(50)], [zigzag(25)], "pcm", offsets=10**7
    ),
    "cdist of a callable": on(curvewise.cdist, partial(many, 400, 100), measure=area_of),
    "Prepared, of a few points": on(
        lambda P, Q: curvewise.Prepared(P, "dtw", **MINKOWSKI)(Q), LONG_3D, SHORT_3D
    ),
    "Prepared, of a list": on(
        lambda P, Q: curvewise.Prepared(P, "frechet")([Q] * 3, workers=2), A, B
    ),
    "Prepared, its making, of 20,000,000 points": on(
        lambda P: curvewise.Prepared(P, "pcm"), partial(walk, 20_000_000, 7)
    ),
}

NEAREST: Calls = {
    "Index, its making, of 10,000,000 points": on(
        lambda P: curvewise.Index([P[:i] for i in range(1_000_000, 5_000_000, 1_000_000)]),
        HUGE,
    ),
    "Index of area, matched, its making": on(
        lambda P: curvewise.Index([P] * 4, "area", spacing="matched"), LOOP
    ),
    "Index.kneighbors, all": on(lambda i: i.kneighbors(n_neighbors=1999), partial(index, "dtw")),
    "Index.kneighbors, 2 workers": on(
        lambda i: i.kneighbors(n_neighbors=3, workers=2), partial(index, "dtw")
    ),
    "Index.kneighbors of frechet_continuous": on(
        lambda i: i.kneighbors(n_neighbors=3), partial(index, "frechet_continuous")
    ),
    "Index.kneighbors of a long curve": on(
        lambda P, Q: curvewise.Index([P]).kneighbors([Q], n_neighbors=1), A, B
    ),
    "Index.radius_neighbors, of pcm": on(
        lambda i: i.radius_neighbors(radius=0.5), partial(index, "pcm")
    ),
    "Index.kneighbors_graph": on(
        lambda i: i.kneighbors_graph(n_neighbors=1000), partial(index, "frechet")
    ),
    "CurveKNeighborsClassifier": on(
        lambda X: CurveKNeighborsClassifier(2).fit(X, np.arange(len(X)) % 3).predict(X),
        partial(many, 1_000, 300),
    ),
    "subsequence": on(curvewise.subsequence, partial(walk, 10_000), partial(walk, 100_000, 2), k=3),
    "subsequence, of frechet, 2 workers": on(
        curvewise.subsequence,
        partial(walk, 10_000),
        partial(walk, 100_000, 2),
        measure="frechet",
        workers=2,
    ),
    "subsequence, path": on(
        curvewise.subsequence, partial(walk, 1_000), partial(walk, 1_000_000, 2), path=True
    ),
    "dtw_mean": on(curvewise.dtw_mean, partial(many, 10, 5_000)),
    "dtw_mean, of alike curves, 2 workers": on(
        lambda P, Q: curvewise.dtw_mean([P[::5], Q[::5]], workers=2), LOOP, OTHER_LOOP
    ),
    "medoid": on(curvewise.medoid, partial(many, 1_000, 200), "frechet", **MINKOWSKI),
}


def blocks(scheduler: str, **options: Any) -> Callable[[], Call]:
    def compute(curves: list[np.ndarray]) -> object:
        return curvewise.dask.cdist(curves, block=5, **options).compute(scheduler=scheduler)

    return on(compute, partial(many, 10, 10_000))


DASK: Calls = {
    "dask.cdist, its making": on(
        lambda P: curvewise.dask.cdist([P], measure="dtw"), partial(walk, 20_000_000, 7)
    ),
    "dask.cdist, blocks in threads": blocks("threads"),
    "dask.cdist, blocks in turn": blocks("synchronous"),
    "dask.cdist of continuous, blocks in threads": blocks("threads", measure="frechet_continuous"),
    "dask.cdist of pcm, continuous, in threads": blocks(
        "threads", measure="pcm", offsets="continuous"
    ),
    "dask.kneighbors, blocks in threads": on(
        lambda X: [
            part.compute(scheduler="threads")
            for part in curvewise.dask.kneighbors(X, X, 2, block=5)
        ],
        partial(many, 10, 10_000),
    ),
}


def model(parameters: dict[str, float]) -> np.ndarray:
    t = np.linspace(0, 1, 500)
    time.sleep(0.01)
    return np.column_stack((t, parameters["a"] * t + parameters.get("b", 0.0) * t * t))


BOUNDS = {"a": (0.0, 1.0), "b": (0.0, 1.0)}
SEARCH = {"progress": False, "method": "de", "max_runs": 150}
EXPERIMENT = partial(model, {"a": 0.5})


def searched(**options: Any) -> Callable[[], Call]:
    return on(lambda experiment: identify(model, experiment, BOUNDS, **options), EXPERIMENT)


CALIBRATION: Calls = {
    "identify": searched(**SEARCH),
    "identify, 2 workers": searched(workers=2, **SEARCH),
    "identify, trust-region": searched(progress=False),
    "identify_each": on(
        lambda experiment: identify_each(
            model, experiment, BOUNDS, measures=["area", "dtw"], **SEARCH
        ),
        EXPERIMENT,
    ),
    "uncertainty": on(
        lambda experiment: identify(model, experiment, BOUNDS, progress=False).uncertainty(),
        EXPERIMENT,
    ),
    "Objective": on(lambda P, Q: Objective([P])([Q]), HUGE, LESS),
    "turning_points": on(turning_points, LOOP),
    "resample": on(resample, LOOP, 900_000),
    "smooth": on(smooth, LOOP, 101),
}

CALLS: Calls = {
    **WARPING, **CONTINUOUS, **PLANAR, **GRADIENTS, **BATCHES, **NEAREST, **DASK, **CALIBRATION,
}  # fmt: skip
