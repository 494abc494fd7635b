"""No memory: every kind of call with limits of the address space, from almost zero up.

A call must raise MemoryError, or return its usual result, and a short call after it must be right.
Linux only: RLIMIT_AS has no effect elsewhere.

    python tests/faults/memory.py [--limits 40] [--points 200000]
"""

from __future__ import annotations

import argparse
import gc
import os
import resource
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

import curvewise

# Otherwise glibc keeps freed memory, and memory for threads, for the next call.
GIVEN_BACK = {
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_MMAP_THRESHOLD_": "8192",
    "MALLOC_TRIM_THRESHOLD_": "0",
}


def walk(n: int, seed: int, dim: int = 2) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(n, dim)).cumsum(axis=0)


def calls(points: int) -> dict[str, Callable[[], object]]:
    P, Q = walk(points, 1), walk(points, 1) + 0.01
    few, some = walk(300, 3), walk(2_000, 4)
    many = [walk(20_000, seed)[: 50 + seed] for seed in range(40)]
    index = curvewise.Index(many)
    return {
        "area": lambda: curvewise.area(P, Q[::3]),
        "area, matched": lambda: curvewise.area(P, Q, spacing="matched"),
        "area_quads": lambda: curvewise.area_quads(P, Q).areas[-1],
        "pcm": lambda: curvewise.pcm(P, Q[::3], offsets=2),
        "pcm_match": lambda: curvewise.pcm_match(P, Q[::3], offsets=2).points[-1],
        "curve_length_residuals": lambda: curvewise.curve_length_residuals(
            P, Q, scale="range"
        ).sum(),
        "dtw": lambda: curvewise.dtw(P, few),
        "dtw, pruned": lambda: curvewise.dtw(P, Q),
        "dtw, 3 workers": lambda: curvewise.dtw(some, P[:10_000], workers=3, prune=False),
        "dtw_path": lambda: curvewise.dtw_path(few, P[:10_000]).path[1234],
        "dtw_table": lambda: curvewise.dtw_table(some, some[:1_000])[-1, -1],
        "frechet_path": lambda: curvewise.frechet_path(P, Q).path[1234],
        "frechet_continuous": lambda: curvewise.frechet_continuous(P, Q),
        "frechet_continuous_path": lambda: curvewise.frechet_continuous_path(
            P[:5_000], Q[:5_000]
        ).parameters[-2],
        "normalize": lambda: curvewise.normalize(P, Q)[1][7],
        "value_and_gradient": lambda: curvewise.value_and_gradient(P, Q, "area")[1][7],
        "cdist": lambda: curvewise.cdist(many, measure="frechet").sum(),
        "cdist, 3 workers": lambda: curvewise.cdist(many, workers=3).sum(),
        "pdist": lambda: curvewise.pdist(many).sum(),
        "Prepared": lambda: curvewise.Prepared(P, "frechet")(few),
        "Index": lambda: len(curvewise.Index([P, Q])),
        "kneighbors, 2 workers": lambda: index.kneighbors(n_neighbors=3, workers=2)[0].sum(),
        "subsequence": lambda: curvewise.subsequence(few, P[:10_000], k=2)[1].start,
        "dtw_mean": lambda: curvewise.dtw_mean(many[:5], iterations=2).costs[-1],
        "compare": lambda: curvewise.compare(P[:5_000], Q[:5_000]).to_dict()["dtw"],
    }


def address_space() -> int:
    """Return the bytes of address space in use."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    return pages * resource.getpagesize()


def limited(call: Callable[[], object], extra: int) -> object:
    """Return the result of the call with that many more bytes, or MemoryError if it raises that."""
    gc.collect()
    unlimited = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (address_space() + extra, unlimited[1]))
    try:
        return call()
    except MemoryError:
        return MemoryError
    finally:
        resource.setrlimit(resource.RLIMIT_AS, unlimited)


def main() -> int:
    if any(os.environ.get(name) != value for name, value in GIVEN_BACK.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | GIVEN_BACK)
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--limits", type=int, default=40)
    parser.add_argument("--points", type=int, default=200_000)
    arguments = parser.parse_args()
    limits = arguments.limits
    P, Q = walk(100, 8), walk(90, 9)
    expected = curvewise.dtw(P, Q), curvewise.area(P, Q)
    tried = refused = wrong = 0
    for name, call in calls(arguments.points).items():
        value = call()
        refusals = 0
        # From 0 to 64 MB, most of them small.
        for extra in np.geomspace(2**14, 2**26, limits).astype(int) - 2**14:
            try:
                found = limited(call, int(extra))
            except Exception as error:
                print(f"WRONG: {name} with {extra} bytes raised {error!r}")
                wrong += 1
                continue
            tried += 1
            refusals += found is MemoryError
            if found is not MemoryError and not np.array_equal(found, value):
                print(f"WRONG: {name} with {extra} bytes returned {found}, not {value}")
                wrong += 1
            if (curvewise.dtw(P, Q), curvewise.area(P, Q)) != expected:
                print(f"WRONG: the call after {name} with {extra} bytes")
                wrong += 1
        refused += refusals
        print(f"{name:<26} {limits} limits: {refusals} MemoryError", flush=True)
    print(f"memory: {tried} calls, {refused} MemoryError, {tried - refused} with their value,")
    print(f"        {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
