"""Other packages on curves that are alike, at growing n, beside curvewise with pruning."""

from __future__ import annotations

import importlib
import math
import multiprocessing
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from typing import Any

from pruning_curves import LOOPS, pair

import curvewise

BYTES = 3 << 30


@dataclass(frozen=True)
class Peer:
    """Another package's call, and curvewise's for the same definition."""

    package: str
    module: str
    measure: str
    call: Callable[[Any, Any, Any], Any]
    dim: int = 2
    metric: str = "euclidean"
    as_lists: bool = False


# fastdtw gives an approximation; tsdistances has one dimension and squares.
PEERS = (
    Peer(
        "dtaidistance",
        "dtaidistance.dtw_ndim",
        "dtw",
        lambda m, P, Q: m.distance_fast(P, Q, inner_dist="euclidean", use_pruning=True),
    ),
    Peer(
        "fastdtw",
        "fastdtw",
        "dtw",
        lambda m, P, Q: m.fastdtw(P, Q, radius=1, dist=math.dist)[0],
        as_lists=True,
    ),
    Peer(
        "tsdistances",
        "tsdistances",
        "dtw",
        lambda m, P, Q: m.dtw_distance(P, Q, par=False),
        dim=1,
        metric="sqeuclidean",
    ),
    Peer("traj-dist-rs", "traj_dist_rs", "dtw", lambda m, P, Q: m.dtw(P, Q, "euclidean").distance),
    Peer(
        "traj-dist-rs",
        "traj_dist_rs",
        "frechet",
        lambda m, P, Q: m.discret_frechet(P, Q, "euclidean").distance,
    ),
)


def peers(seconds: float) -> list[dict[str, Any]]:
    """Time every package at growing n, as long as the next call is expected to be short enough.

    Each has a process with little memory, which ends where the package keeps a whole table.
    """
    results = []
    context = multiprocessing.get_context("spawn")
    for k, peer in enumerate(PEERS):
        try:
            importlib.import_module(peer.module)
        except ImportError as error:
            print(f"skipped: {peer.package} ({error})")
            continue
        n, previous, result = 1000, 0.0, None
        with ProcessPoolExecutor(1, context, initializer=limit_memory) as process:
            # The first call compiles and loads.
            process.submit(measure_peer, k, 100).result()
            while result is None or growing(previous, result) <= seconds:
                previous = result["peer_seconds"] if result else 0.0
                try:
                    result = process.submit(measure_peer, k, n).result()
                except (BrokenProcessPool, MemoryError):
                    print(f"{peer.package}, {peer.measure}: no memory for n = {n}")
                    break
                results.append(result)
                n *= 2
    return results


def limit_memory() -> None:
    """Let this process have so much memory, where the system can limit it."""
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))


def growing(previous: float, result: dict[str, Any]) -> float:
    """Return the seconds that a call of twice the points is expected to take."""
    seconds: float = result["peer_seconds"]
    return seconds * (min(max(seconds / previous, 2.0), 4.0) if previous else 4.0)


def measure_peer(which: int, n: int) -> dict[str, Any]:
    """Time a package and curvewise once each on a pair of similar curves."""
    peer = PEERS[which]
    module = importlib.import_module(peer.module)
    P, Q = (c if peer.dim == 2 else c[:, 1].copy() for c in pair(LOOPS[0], n))
    given = [c.tolist() if peer.as_lists else c for c in (P, Q)]
    start = time.perf_counter()
    value = float(peer.call(module, *given))
    middle = time.perf_counter()
    exact = getattr(curvewise, peer.measure)(P, Q, metric=peer.metric)
    end = time.perf_counter()
    return {
        "curves": LOOPS[0],
        "package": peer.package,
        "measure": peer.measure,
        "dim": peer.dim,
        "metric": peer.metric,
        "n": n,
        "m": len(Q),
        "peer_seconds": middle - start,
        "seconds": end - middle,
        "relative_error": value / exact - 1.0,
    }
