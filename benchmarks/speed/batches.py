"""Which package compares many curves, and how: the workloads of pairwise.py.

A batch is a number of loops, of one length or ragged, and a measure between every two of them. A
contender is a package's batch function, called as its documentation says is fastest, on curves
converted beforehand; it has the same ground distance as curvewise, or states as curvewise's options
what it computes instead. The number of threads is fixed when libraries load, so each contender at
each number of threads has a process of its own, which runs this file: `BatchProcess`.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import importlib
import json
import os
import subprocess
import sys
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from timing import Array

import curvewise

THREAD_VARIABLES = ("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "RAYON_NUM_THREADS")
EUCLIDEAN: Mapping[str, object] = {}
SQUARED: Mapping[str, object] = {"metric": "sqeuclidean"}


def loops(lengths: tuple[int, ...]) -> list[Array]:
    """Make loops of so many points: the built-in pair in turn, resampled, stresses scattered.

    Scaled by the experiment's box; each has its own factor on the stress and its own noise.
    """
    random = np.random.Generator(np.random.PCG64(0))
    pair = curvewise.normalize(*curvewise.datasets.hysteresis_pair())
    curves = []
    for i, count in enumerate(lengths):
        loop = pair[i % 2] * [1.0, random.normal(1.0, 0.1)]
        index = np.linspace(0.0, len(loop) - 1.0, count)
        points = np.column_stack([np.interp(index, np.arange(len(loop)), x) for x in loop.T])
        curves.append(points + random.normal(0.0, 0.002, points.shape))
    return curves


def equal(count: int, n: int) -> tuple[int, ...]:
    """Return `count` equal lengths."""
    return (n,) * count


def ragged(count: int, least: int, most: int) -> tuple[int, ...]:
    """Return `count` lengths, evenly from `least` to `most`, shuffled."""
    lengths = np.linspace(least, most, count).round().astype(int)
    return tuple(np.random.Generator(np.random.PCG64(1)).permutation(lengths).tolist())


def cells(lengths: tuple[int, ...]) -> int:
    """Return the cells of the tables of all pairs."""
    return (sum(lengths) ** 2 - sum(n * n for n in lengths)) // 2


@dataclass(frozen=True)
class Contender:
    """A package's batch function, `call(module, curves, threads)` on what `convert` made.

    It returns a condensed or a square matrix. `options` are those with which curvewise computes
    the same.
    """

    package: str
    module: str
    definition: str
    options: Mapping[str, object]
    call: Callable[[Any, Any, int], Any]
    convert: Callable[[list[Array]], Any] = list

    def values(self, curves: list[Array], threads: int) -> Array:
        """Return the condensed matrix."""
        module = importlib.import_module(self.module)
        found = np.asarray(self.call(module, self.convert(curves), threads), dtype=np.float64)
        return found[np.triu_indices(len(curves), 1)] if found.ndim == 2 else found


@dataclass(frozen=True)
class Batch:
    """Loops, a measure between every two of them, and who computes it."""

    name: str
    title: str
    measure: str
    lengths: tuple[int, ...]
    peers: tuple[Contender, ...]
    options: Mapping[str, object] = field(default_factory=dict)

    def contenders(self) -> tuple[Contender, ...]:
        """Return curvewise and the others."""
        return (self.own(), *self.peers)

    def own(self) -> Contender:
        """Return curvewise as a contender."""

        def call(module: Any, curves: list[Array], threads: int) -> Any:
            return module.pdist(curves, self.measure, workers=threads, **self.options)

        return Contender("curvewise", "curvewise", "", self.options, call)

    def smaller(self, count: int) -> Batch:
        """Return the batch with the first `count` loops."""
        return Batch(
            self.name, self.title, self.measure, self.lengths[:count], self.peers, self.options
        )


def stacked(curves: list[Array]) -> Any:
    """Return curves of one length as one array."""
    return np.stack(curves) if len({curve.shape for curve in curves}) == 1 else curves


def as_columns(curves: list[Array]) -> Any:
    """Return each curve as coordinates by points, in one array if the lengths are equal."""
    return stacked([np.ascontiguousarray(curve.T) for curve in curves])


def dtai(inner: str) -> Callable[[Any, list[Array], int], Any]:
    """Return dtaidistance's call; the root that it takes of a sum of squares is undone."""

    def call(m: Any, curves: list[Array], threads: int) -> Any:
        found = m.distance_matrix_fast(curves, compact=True, inner_dist=inner, parallel=threads > 1)
        values = np.frombuffer(found, dtype=np.float64)
        return values if inner == "euclidean" else values**2

    return call


def traj(metric: str) -> Callable[[Any, list[Array], int], Any]:
    """Return traj-dist-rs's call."""
    return lambda m, curves, threads: m.pdist(
        curves, getattr(m.Metric, metric)(type_d="euclidean"), parallel=threads > 1
    )


DTAI, TRAJ = ("dtaidistance", "dtaidistance.dtw_ndim"), ("traj-dist-rs", "traj_dist_rs")
AEON = Contender(
    "aeon",
    "aeon.distances",
    "squared",
    SQUARED,
    lambda m, curves, threads: m.dtw_pairwise_distance(curves, n_jobs=threads),
    as_columns,
)
TSLEARN = Contender(
    "tslearn",
    "tslearn.metrics",
    "squared",
    SQUARED,
    lambda m, curves, threads: m.cdist_dtw(curves, n_jobs=threads) ** 2,
    stacked,
)
DTAI_EUCLIDEAN = Contender(*DTAI, "Euclidean", EUCLIDEAN, dtai("euclidean"))
DTAI_SQUARED = Contender(*DTAI, "squared", SQUARED, dtai("squared euclidean"))
TRAJ_DTW = Contender(*TRAJ, "Euclidean", EUCLIDEAN, traj("dtw"))
TSLEARN_FRECHET = Contender(
    "tslearn",
    "tslearn.metrics",
    "Euclidean",
    EUCLIDEAN,
    lambda m, curves, threads: m.cdist_frechet(curves, n_jobs=threads),
    stacked,
)

DTW = Batch(
    "dtw",
    "DTW, Euclidean",
    "dtw",
    equal(100, 200),
    (DTAI_EUCLIDEAN, TRAJ_DTW, AEON, TSLEARN),
)
DTW_RAGGED = Batch(
    "dtw-ragged",
    "DTW, Euclidean, ragged",
    "dtw",
    ragged(100, 100, 300),
    (DTAI_EUCLIDEAN, TRAJ_DTW, AEON),
)
DTW_SQUARED = Batch(
    "dtw-squared",
    "DTW, squared",
    "dtw",
    equal(100, 200),
    (DTAI_SQUARED, AEON, TSLEARN, TRAJ_DTW),
    SQUARED,
)
FRECHET = Batch(
    "frechet",
    "discrete Fréchet",
    "frechet",
    equal(200, 100),
    (Contender(*TRAJ, "Euclidean", EUCLIDEAN, traj("discret_frechet")), TSLEARN_FRECHET),
)
# Too many pairs for the others to be waited for.
FRECHET_LARGE = Batch("frechet-large", "discrete Fréchet", "frechet", equal(2000, 100), ())

BATCHES = {b.name: b for b in (DTW, DTW_RAGGED, DTW_SQUARED, FRECHET, FRECHET_LARGE)}


class BatchProcess(timing.FreshProcess):
    """A process that times one contender of a batch at one number of threads."""

    def __init__(self, batch: Batch, package: str, threads: int) -> None:
        task = json.dumps([batch.name, len(batch.lengths), package, threads])
        self._process = subprocess.Popen(
            [sys.executable, __file__, task],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            bufsize=1,
        )

    def save_values(self, file: str) -> None:
        """Write the contender's condensed matrix as an .npy file; its compilers run here."""
        self._ask(f"values {file}")

    def memory_beyond(self, expected: int) -> float:
        """Return by how many bytes one call raised the peak memory, less the bytes `expected`."""
        return self._ask("memory") - expected


def _serve(name: str, count: int, package: str, threads: int) -> None:
    """Answer the questions of `BatchProcess`, one per line, until there are no more."""
    for variable in THREAD_VARIABLES:  # for what is imported from here on
        os.environ[variable] = str(threads)
    warnings.simplefilter("ignore")
    batch = BATCHES[name].smaller(count)
    chosen = next(c for c in batch.contenders() if c.package == package)
    curves = loops(batch.lengths)
    module, converted = importlib.import_module(chosen.module), chosen.convert(curves)
    call = timing.sampler(lambda: chosen.call(module, converted, threads))
    for line in sys.stdin:
        question, _, argument = line.strip().partition(" ")
        if question == "values":
            np.save(argument, chosen.values(curves, threads))
            print(0, flush=True)
        elif question == "memory":
            before = _reset_peak()
            call(1)
            print(timing.peak_bytes() - before, flush=True)
        else:
            print(call(int(question)), flush=True)


def _reset_peak() -> int:
    """Set this process's peak memory to what it holds now, and return it. Linux only."""
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")
    return timing.peak_bytes()


if __name__ == "__main__":
    _serve(*json.loads(sys.argv[1]))
