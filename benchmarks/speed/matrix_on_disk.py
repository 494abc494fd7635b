"""A matrix larger than memory, cut short by SIGKILL and begun again: is it whole, and is it right?

    python benchmarks/speed/matrix_on_disk.py --store /somewhere/with/20/GB/d.zarr

A process computes all dtw distances of --curves random walks of --points points with
``curvewise.dask.cdist(..., store=)``. It is killed as soon as a quarter, a half and three quarters
of the blocks are there, and begun again each time. Then all blocks are counted, and --pairs pairs
drawn at random are compared, bit by bit, with ``curvewise.dtw``. What is printed: the seconds of
each run, the blocks there at its end, and the largest memory that any run held, without what the
operating system keeps of files.
"""

from __future__ import annotations

import argparse
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import curvewise


def walks(count: int, points: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.random.default_rng(32).normal(size=(count, points, 2)).cumsum(axis=1)


def fill(given: argparse.Namespace) -> None:
    import dask

    import curvewise.dask

    with dask.config.set(scheduler="threads", num_workers=given.threads):
        curvewise.dask.cdist(walks(given.curves, given.points), measure="dtw", store=given.store)


def blocks_of(store: Path) -> int:
    return sum(1 for file in store.glob("c/*/*") if file.suffix != ".partial")


def run(given: argparse.Namespace, until: float) -> bool:
    """Run until so many blocks are there, or to the end; say whether it came to its end."""
    begun = time.perf_counter()
    process = subprocess.Popen([sys.executable, __file__, "--fill", *sys.argv[1:]])
    while process.poll() is None and blocks_of(given.store) < until:
        time.sleep(0.02)
    killed = process.poll() is None
    if killed:
        process.send_signal(signal.SIGKILL)
    process.wait()
    halves = sum(1 for _ in given.store.rglob("*.partial"))
    print(
        f"{'killed' if killed else 'ended'} after {time.perf_counter() - begun:.1f} s: "
        f"{blocks_of(given.store)} blocks, {halves} half written",
        flush=True,
    )
    assert killed or process.returncode == 0
    return not killed


def check(given: argparse.Namespace) -> None:
    """Compare pairs drawn at random with their distances, computed one by one."""
    import zarr

    curves = walks(given.curves, given.points)
    pairs = np.random.default_rng(0).integers(given.curves, size=(2, given.pairs))
    stored = zarr.open_array(given.store, mode="r").vindex[pairs[0], pairs[1]]
    earlier, later = np.sort(pairs, axis=0)
    computed = [curvewise.dtw(curves[i], curves[j]) for i, j in zip(earlier, later, strict=True)]
    wrong = int(np.sum(stored != computed))
    print(f"{given.pairs} pairs drawn at random: {wrong} differ")
    assert wrong == 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--curves", type=int, default=50_000)
    parser.add_argument("--points", type=int, default=10)
    parser.add_argument("--pairs", type=int, default=100_000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--store", type=Path, required=True)
    parser.add_argument("--fill", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.fill:
        fill(given)
        return
    side = -(-given.curves // min(2048, 32_000 // given.points))
    for quarter in (1, 2, 3):
        assert not run(given, quarter * side**2 / 4), "it came to its end before it was killed"
    assert run(given, np.inf)
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    assert blocks_of(given.store) == side**2
    size = sum(os.path.getsize(file) for file in given.store.rglob("*") if file.is_file())
    print(f"{side**2} of {side**2} blocks, {size / 1e9:.2f} GB; peak memory {peak:.0f} MB")
    check(given)


if __name__ == "__main__":
    main()
