"""Which package computes what: the workloads of peers.py, and every peer's call for each.

A workload is a measure of curvewise with options, on the two loops of `timing.curve_pair`. A peer
has the same definition, or the nearest one that its package offers, stated as the options with
which curvewise computes the same thing: so a peer's value can be checked in both cases. Each peer
is called the fastest way that its documentation offers, on curves converted beforehand.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from timing import Array, Task

from curvewise import compat

EUCLIDEAN: Mapping[str, object] = {}
SQUARED: Mapping[str, object] = {"metric": "sqeuclidean"}


def band_radius(n: int) -> int:
    """Return the radius of the Sakoe-Chiba band at n points."""
    return max(1, n // 10)


def as_is(module: Any, P: Array) -> Any:
    """Leave a curve as it is."""
    return P


def as_columns(module: Any, P: Array) -> Any:
    """Turn a curve into coordinates by points."""
    return np.ascontiguousarray(P.T)


def as_linestring(module: Any, P: Array) -> Any:
    """Turn a curve into a shapely geometry."""
    return module.linestrings(P)


@dataclass(frozen=True)
class Peer:
    """What another package computes: `call(module, P, Q)`, on curves that `convert` made.

    `options` are those with which curvewise computes the same. `value` does so where curvewise
    itself has no such definition.
    """

    package: str
    module: str
    definition: str
    options: Mapping[str, object]
    call: Callable[[Any, Any, Any], Any]
    convert: Callable[[Any, Array], Any] = as_is
    value: Callable[[Array, Array], float] | None = None

    def prepare(self, module: Any, P: Array, Q: Array) -> Callable[[], Any]:
        """Return the call to time."""
        curves = (self.convert(module, curve) for curve in (P, Q))
        return functools.partial(self.call, module, *curves)


@dataclass(frozen=True)
class Workload:
    """A measure of curvewise with options, the n it is timed and tabulated at, and its peers."""

    name: str
    title: str
    measure: str
    peers: tuple[Peer, ...]
    options: Mapping[str, object] = field(default_factory=dict)
    sizes: tuple[int, ...] = (100, 500, 1000, 4000)
    shown: tuple[int, ...] = (100, 4000)
    dim: int = 2
    banded: bool = False

    @property
    def has_table(self) -> bool:
        """Whether the cost is that of a table's cells."""
        return self.measure in ("dtw", "frechet", "dtw_path")

    def task(self, n: int, options: Mapping[str, object] | None = None) -> Task:
        """Return the task at n points, with the workload's options or a peer's."""
        m = n if self.has_table else round(0.9 * n)
        return Task(self.measure, n, m, self.dim, self.with_band(n, options))

    def with_band(self, n: int, options: Mapping[str, object] | None = None) -> dict[str, object]:
        """Return the workload's options or a peer's, with the band if there is one."""
        band = {"window": band_radius(n)} if self.banded else {}
        return {**(self.options if options is None else options), **band}

    def cells(self, n: int) -> int | None:
        """Return the number of cells of the table, or of its band."""
        if not self.has_table:
            return None
        outside = n - 1 - band_radius(n) if self.banded else 0
        return n * n - outside * (outside + 1)

    def is_same(self, peer: Peer) -> bool:
        """Whether the peer computes what curvewise is timed at."""
        return peer.value is None and peer.options == self.options


# dtaidistance and tslearn take the square root of a sum of squares: undone here, which costs
# nothing beside the table. dtaidistance counts the diagonal in its window; aeon and tsdistances
# want a fraction of n.
DTAI_ND, DTAI_1D = ("dtaidistance", "dtaidistance.dtw_ndim"), ("dtaidistance", "dtaidistance.dtw")
DTW_PYTHON, TSLEARN, TRAJ = ("dtw-python", "dtw"), ("tslearn", "tslearn.metrics"), "traj-dist-rs"
AEON, CURVESIM = ("aeon", "aeon.distances"), ("curvesimilarities", "curvesimilarities")
SIMILARITY = ("similaritymeasures", "similaritymeasures")


def dtai_squared(m: Any, P: Array, Q: Array) -> float:
    """Call dtaidistance, squared."""
    return float(m.distance_fast(P, Q) ** 2)


def dtw_python(metric: str) -> Callable[[Any, Array, Array], float]:
    """Return dtw-python's call without the path; like curvewise, it doubles no diagonal step."""

    def call(m: Any, P: Array, Q: Array) -> float:
        found = m.dtw(P, Q, dist_method=metric, step_pattern="symmetric1", distance_only=True)
        return float(found.distance)

    return call


def dtw_python_band(m: Any, P: Array, Q: Array) -> float:
    """Call dtw-python in a Sakoe-Chiba band."""
    found = m.dtw(
        P,
        Q,
        step_pattern="symmetric1",
        distance_only=True,
        window_type="sakoechiba",
        window_args={"window_size": band_radius(len(P))},
    )
    return float(found.distance)


def dtw_python_path(m: Any, P: Array, Q: Array) -> Any:
    """Call dtw-python with its path."""
    found = m.dtw(P, Q, step_pattern="symmetric1")
    return np.column_stack([found.index1, found.index2])


DTW = Workload(
    "dtw",
    "DTW, 2-D, Euclidean",
    "dtw",
    (
        Peer(
            *DTAI_ND,
            "Euclidean",
            EUCLIDEAN,
            lambda m, P, Q: m.distance_fast(P, Q, inner_dist="euclidean"),
        ),
        Peer(
            TRAJ,
            "traj_dist_rs",
            "Euclidean",
            EUCLIDEAN,
            lambda m, P, Q: m.dtw(P, Q, "euclidean").distance,
        ),
        Peer(*DTW_PYTHON, "Euclidean", EUCLIDEAN, dtw_python("euclidean")),
        Peer(
            *TSLEARN,
            "Euclidean, with the path",
            EUCLIDEAN,
            lambda m, P, Q: m.dtw_path_from_metric(P, Q)[1],
        ),
        Peer(*CURVESIM, "Euclidean", EUCLIDEAN, lambda m, P, Q: m.dtw(P, Q)),
        Peer(*SIMILARITY, "Euclidean, with the table", EUCLIDEAN, lambda m, P, Q: m.dtw(P, Q)[0]),
        Peer(*AEON, "squared", SQUARED, lambda m, P, Q: m.dtw_distance(P, Q), as_columns),
    ),
    sizes=(100, 200, 500, 1000, 2000, 4000, 10_000),
)

DTW_SQUARED = Workload(
    "dtw-squared",
    "DTW, 2-D, squared Euclidean",
    "dtw",
    (
        Peer(*DTAI_ND, "squared", SQUARED, dtai_squared),
        Peer(*AEON, "squared", SQUARED, lambda m, P, Q: m.dtw_distance(P, Q), as_columns),
        Peer(*DTW_PYTHON, "squared", SQUARED, dtw_python("sqeuclidean")),
        Peer(*TSLEARN, "squared", SQUARED, lambda m, P, Q: m.dtw(P, Q) ** 2),
        Peer(*CURVESIM, "squared", SQUARED, lambda m, P, Q: m.dtw(P, Q, "squared_euclidean")),
        Peer(
            *SIMILARITY,
            "squared, with the table",
            SQUARED,
            lambda m, P, Q: m.dtw(P, Q, metric="sqeuclidean")[0],
        ),
        Peer(
            TRAJ,
            "traj_dist_rs",
            "Euclidean",
            EUCLIDEAN,
            lambda m, P, Q: m.dtw(P, Q, "euclidean").distance,
        ),
    ),
    SQUARED,
)

DTW_1D = Workload(
    "dtw-1d",
    "DTW, 1-D, absolute difference",
    "dtw",
    (
        Peer(
            *DTAI_1D,
            "absolute",
            EUCLIDEAN,
            lambda m, P, Q: m.distance_fast(P, Q, inner_dist="euclidean"),
        ),
        Peer(*DTW_PYTHON, "absolute", EUCLIDEAN, dtw_python("euclidean")),
        Peer(*AEON, "squared", SQUARED, lambda m, P, Q: m.dtw_distance(P, Q)),
        Peer(
            "tsdistances",
            "tsdistances",
            "squared, pruned",
            SQUARED,
            lambda m, P, Q: m.dtw_distance(P, Q, par=False),
        ),
        Peer(*TSLEARN, "squared", SQUARED, lambda m, P, Q: m.dtw(P, Q) ** 2),
    ),
    dim=1,
)

DTW_1D_SQUARED = Workload(
    "dtw-1d-squared",
    "DTW, 1-D, squared difference",
    "dtw",
    (
        Peer(*DTAI_1D, "squared, pruned", SQUARED, dtai_squared),
        Peer(
            *DTAI_1D,
            "squared",
            SQUARED,
            lambda m, P, Q: m.distance_fast(P, Q, use_pruning=False) ** 2,
        ),
        Peer(*DTW_PYTHON, "squared", SQUARED, dtw_python("sqeuclidean")),
        Peer(*AEON, "squared", SQUARED, lambda m, P, Q: m.dtw_distance(P, Q)),
        Peer(
            "tsdistances",
            "tsdistances",
            "squared, pruned",
            SQUARED,
            lambda m, P, Q: m.dtw_distance(P, Q, par=False),
        ),
        Peer(*TSLEARN, "squared", SQUARED, lambda m, P, Q: m.dtw(P, Q) ** 2),
    ),
    SQUARED,
    dim=1,
)

DTW_WINDOW = Workload(
    "dtw-window",
    "DTW, 2-D, Euclidean, Sakoe–Chiba band of n/10",
    "dtw",
    (
        Peer(
            *DTAI_ND,
            "Euclidean",
            EUCLIDEAN,
            lambda m, P, Q: m.distance_fast(
                P, Q, inner_dist="euclidean", window=band_radius(len(P)) + 1
            ),
        ),
        Peer(*DTW_PYTHON, "Euclidean", EUCLIDEAN, dtw_python_band),
        Peer(
            *AEON,
            "squared",
            SQUARED,
            lambda m, P, Q: m.dtw_distance(P, Q, window=band_radius(P.shape[1]) / P.shape[1]),
            as_columns,
        ),
        Peer(
            *TSLEARN,
            "squared",
            SQUARED,
            lambda m, P, Q: m.dtw(P, Q, sakoe_chiba_radius=band_radius(len(P))) ** 2,
        ),
    ),
    banded=True,
)

DTW_PATH = Workload(
    "dtw-path",
    "DTW with its path, 2-D, Euclidean",
    "dtw_path",
    (
        Peer(*DTW_PYTHON, "Euclidean", EUCLIDEAN, dtw_python_path),
        Peer(*TSLEARN, "Euclidean", EUCLIDEAN, lambda m, P, Q: m.dtw_path_from_metric(P, Q)[0]),
        Peer(*CURVESIM, "Euclidean", EUCLIDEAN, lambda m, P, Q: m.dtw_owp(P, Q)[1]),
        Peer(*SIMILARITY, "Euclidean", EUCLIDEAN, lambda m, P, Q: m.dtw_path(m.dtw(P, Q)[1])),
        Peer(*AEON, "squared", SQUARED, lambda m, P, Q: m.dtw_alignment_path(P, Q)[0], as_columns),
        # Its compiled path is that of the squared distance, whatever inner_dist says.
        Peer(*DTAI_ND, "squared", SQUARED, lambda m, P, Q: m.warping_path(P, Q, use_c=True)),
    ),
    sizes=(100, 300, 1000),
    shown=(100, 1000),
)

FRECHET = Workload(
    "frechet",
    "Discrete Fréchet distance, 2-D, Euclidean",
    "frechet",
    (
        Peer(
            TRAJ,
            "traj_dist_rs",
            "Euclidean",
            EUCLIDEAN,
            lambda m, P, Q: m.discret_frechet(P, Q, "euclidean").distance,
        ),
        Peer(*CURVESIM, "Euclidean", EUCLIDEAN, lambda m, P, Q: m.dfd(P, Q)),
        Peer(*TSLEARN, "Euclidean", EUCLIDEAN, lambda m, P, Q: m.frechet(P, Q)),
        Peer(*SIMILARITY, "Euclidean", EUCLIDEAN, lambda m, P, Q: m.frechet_dist(P, Q)),
        Peer(
            "shapely",
            "shapely",
            "Euclidean",
            EUCLIDEAN,
            lambda m, P, Q: m.frechet_distance(P, Q),
            as_linestring,
        ),
    ),
    sizes=DTW.sizes,
)

AREA = Workload(
    "area",
    "Area between curves, n and 0.9 n points",
    "area",
    (
        Peer(
            *SIMILARITY,
            "lengths recomputed",
            {},
            lambda m, P, Q: m.area_between_two_curves(P, Q),
            value=lambda P, Q: float(compat.area_between_two_curves(P, Q)),
        ),
    ),
    sizes=(100, 1000),
    shown=(100, 1000),
)

PCM = Workload(
    "pcm",
    "Partial curve mapping, n and 0.9 n points, 200 offsets",
    "pcm",
    (
        Peer(
            *SIMILARITY,
            "not the paper's",
            {},
            lambda m, P, Q: m.pcm(P, Q),
            value=lambda P, Q: float(compat.pcm(P, Q)),
        ),
    ),
    sizes=(100, 1000),
    shown=(100, 1000),
)

CURVE_LENGTH = Workload(
    "curve-length",
    "Curve length measure, n and 0.9 n points",
    "curve_length",
    (Peer(*SIMILARITY, "the same", {}, lambda m, P, Q: m.curve_length_measure(P, Q)),),
    sizes=(100, 1000),
    shown=(100, 1000),
)

_DTW_ONLY = (DTW, DTW_SQUARED, DTW_1D, DTW_1D_SQUARED, DTW_WINDOW, DTW_PATH)
WORKLOADS = {work.name: work for work in (*_DTW_ONLY, FRECHET, AREA, PCM, CURVE_LENGTH)}

FASTDTW = Peer(
    "fastdtw",
    "fastdtw",
    "approximate, radius 1, math.dist",
    EUCLIDEAN,
    lambda m, P, Q: m.fastdtw(P, Q, dist=math.dist)[0],
    lambda m, P: P.tolist(),
)
