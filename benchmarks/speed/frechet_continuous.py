"""The continuous Fréchet distance: certified against whole numbers, and how fast it is.

Four parts, each printed as a table: (1) random pairs of up to 12 vertices against exact decisions
of `curvewise.reference`; (2) measured loops against themselves resampled, 3 % larger and with
noise, where ../shared/data or CURVEWISE_DATA has them, and curvesimilarities, if it is installed;
(3) decisions on simulated roads of 250 points; (4) walks of 1,000 points that have nothing to do
with each other. One thread; medians.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import importlib.util
import itertools
import math
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from timing import DATA, Array

import curvewise
from curvewise import reference

SIZES = (1_000, 4_000, 20_000, 100_000)
PEER_SIZES = (200, 1_000)


def main() -> None:
    """Check, measure, print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--pairs", type=int, default=20_000, help="random pairs to certify")
    parser.add_argument("--sizes", type=int, nargs="*", default=SIZES)
    arguments = parser.parse_args()
    print(f"curvewise {curvewise.__version__}, {timing.machine([])['cpu']}")
    certify(arguments.pairs)
    loops(arguments.sizes)
    roads()
    walks()


def median(call: Callable[[], object], runs: int = 5) -> float:
    """Return the median time of a call in milliseconds."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return 1e3 * statistics.median(times)


def random_curve(rng: np.random.Generator, kind: int, n: int, d: int) -> Array:
    """Return points on grids, on one line, repeated, on spikes, of one decimal, far away."""
    if kind == 0:
        return rng.integers(0, 4, (n, d)).astype(float)
    if kind == 1:
        return rng.integers(-9, 10, (n, d)).astype(float)
    if kind == 2:
        ends = rng.integers(-3, 4, (2, d))
        return np.asarray(ends[0] + np.outer(rng.integers(0, 8, n), ends[1]), float)
    if kind == 3:
        points = rng.integers(0, 3, (n, d)).astype(float)
        return np.repeat(points, rng.integers(1, 4, n), axis=0)[:n]
    if kind == 4:
        curve = np.zeros((n, d))
        curve[:, 0] = np.arange(n)
        curve[rng.integers(0, n, 1 + n // 3), -1] += rng.integers(-4, 5)
        return curve
    if kind == 5:
        return rng.normal(size=(n, d)).round(1)
    if kind == 6:
        return np.asarray(rng.integers(0, 3, (n, d)) + rng.integers(-1, 2, (n, d)) * 1e-9)
    if kind == 7:
        return np.asarray(rng.normal(size=(n, d)) * 1e-3 + 1e8)
    return rng.normal(size=(n, d))


def certify(pairs: int) -> None:
    """Compare values with exact decisions about them and the doubles below them."""
    outside = wide = equal = 0
    for seed in timing.progress(range(pairs), "pairs"):
        rng = np.random.default_rng([15, seed])
        d, kind = int(rng.integers(1, 5)), int(rng.integers(0, 9))
        P, Q = (random_curve(rng, kind, int(rng.integers(1, 13)), d) for _ in range(2))
        if seed % 4 == 0:  # a part of P, which goes back and forth
            Q = P[rng.integers(0, len(P), len(Q))]
        low, high = curvewise.frechet_continuous(P, Q, bounds=True)  # type: ignore[misc]
        below = math.nextafter(high, -math.inf)
        holds = reference.frechet_within(P, Q, high)
        holds &= high == 0 or not reference.frechet_within(P, Q, below)
        outside += not holds
        wide += low < below and high > 0
        equal += low == high
    print(f"\n{pairs} pairs: the interval misses the real number in {outside}, is wider than two")
    print(f"neighbouring doubles in {wide}, and is one double in {equal}")


def resampled(curve: Array, n: int) -> Array:
    """Return n points at equal distances along a curve."""
    steps = np.hypot(*np.diff(curve, axis=0).T)
    keep = np.concatenate([[True], steps > 0])
    s, curve = np.concatenate([[0.0], np.cumsum(steps)])[keep], curve[keep]
    places = np.linspace(0, s[-1], n)
    return np.column_stack([np.interp(places, s, x) for x in curve.T])


def loop_pair(file: Path, n: int) -> tuple[Array, Array]:
    """Return a loop, and itself with 0.9 n points, 3 % larger and with noise."""
    curve = np.loadtxt(file, delimiter=",", skiprows=int("resslab" in file.name))
    curve = (curve - curve.min(axis=0)) / np.ptp(curve, axis=0)
    rng = np.random.default_rng(n)
    P, Q = resampled(curve, n), 1.03 * resampled(curve, round(0.9 * n))
    return P, Q + rng.normal(0, 0.001, Q.shape)


def loops(sizes: tuple[int, ...]) -> None:
    """Time measured loops."""
    files = sorted((DATA / "loops").glob("*.csv"))
    if not files:
        print(f"\nno loops in {DATA}: skipped")
        return
    print("\nmilliseconds     " + "".join(f"n = {n:<10}" for n in sizes))
    for file in files:
        times = []
        for n in sizes:
            P, Q = loop_pair(file, n)
            times.append(median(lambda P=P, Q=Q: curvewise.frechet_continuous(P, Q), 3))  # type: ignore[misc]
        print(f"{file.stem[:16]:<17}" + "".join(f"{t:<14.3g}" for t in times))
    if importlib.util.find_spec("curvesimilarities"):
        against_curvesimilarities(files[0])


def against_curvesimilarities(file: Path) -> None:
    """Time the other package on the first loop."""
    import curvesimilarities

    curvesimilarities.fd(*loop_pair(file, 10))  # numba compiles
    for n in PEER_SIZES:
        P, Q = loop_pair(file, n)
        ours = median(lambda P=P, Q=Q: curvewise.frechet_continuous(P, Q))  # type: ignore[misc]
        start = time.perf_counter()
        value = curvesimilarities.fd(P, Q)
        theirs = 1e3 * (time.perf_counter() - start)
        difference = value - curvewise.frechet_continuous(P, Q)
        print(
            f"curvesimilarities, n = {n}: {theirs:.4g} ms, here {ours:.3g} ms: "
            f"{theirs / ours:.0f} times; values differ by {difference:.1e}"
        )


def road(rng: np.random.Generator, n: int = 250) -> Array:
    """Return a road of straight stretches and bends, as a receiver with 5 m of noise has it."""
    heading = np.cumsum(rng.normal(0, 0.3, n) * (rng.random(n) < 0.15)) + rng.uniform(0, 6.3)
    steps = rng.uniform(10, 30, n)[:, np.newaxis]
    track = np.cumsum(steps * np.column_stack([np.cos(heading), np.sin(heading)]), axis=0)
    return np.asarray(track + rng.normal(0, 5, (n, 2)))


def roads() -> None:
    """Count decisions a second: the same road driven twice, and different roads."""
    rng = np.random.default_rng(1)
    bases = [road(rng) for _ in range(40)]
    same = [(P, P + rng.normal(0, 5, P.shape)) for P in bases]
    started_alike = [(P - P[0], Q - Q[0]) for P, Q in itertools.pairwise(bases)]
    print("\ndecisions a second, roads of 250 points")
    for name, pairs, radii in (
        ("driven twice", same, (15.0, 20.0, 25.0)),
        ("two roads from one place", started_alike, (25.0, 500.0, 2000.0)),
    ):
        for radius in radii:
            yes = sum(curvewise.frechet_within(P, Q, radius) for P, Q in pairs)
            ms = median(
                lambda pairs=pairs, radius=radius: [  # type: ignore[misc]
                    curvewise.frechet_within(P, Q, radius) for P, Q in pairs
                ]
            )
            rate = 1e3 * len(pairs) / ms
            print(f"{name}, {radius:g} m: {rate:,.0f} ({yes} of {len(pairs)} within)")


def walks() -> None:
    """Time walks that have nothing to do with each other."""
    rng = np.random.default_rng(2)
    times = []
    for _ in range(5):
        P, Q = np.cumsum(rng.normal(size=(2, 1000, 2)), axis=1)
        times.append(median(lambda P=P, Q=Q: curvewise.frechet_continuous(P, Q), 3))  # type: ignore[misc]
    print("\nunrelated walks of 1,000 points, ms: " + ", ".join(f"{t:.3g}" for t in times))


if __name__ == "__main__":
    main()
