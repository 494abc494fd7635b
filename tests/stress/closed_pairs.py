"""Random closed curves against all beginnings: python tests/stress/closed_pairs.py [pairs] [seed].

Each pair is measured by dtw and frechet with closed=True, and by brute force: open curves from each
point of P and each point of Q. Fréchet distances must be equal, and sums to 1e-13. 100,000 pairs
take about a quarter of an hour. Then the script prints times, next to those of the open measure.
"""

from __future__ import annotations

import sys
import time
import warnings

import numpy as np
import numpy.typing as npt

import curvewise

METRICS = ("euclidean", "sqeuclidean", "cityblock", "chebyshev")


def curve(rng: np.random.Generator, kind: int) -> npt.NDArray[np.float64]:
    n, d = int(rng.integers(1, 13)), 2
    if kind == 0:
        return rng.normal(size=(n, d))
    if kind == 1:  # ties
        return rng.integers(0, 4, (n, d)).astype(float)
    turns = np.linspace(0, 2 * np.pi, n, endpoint=False) + rng.uniform(0, 7)
    return np.column_stack([np.cos(turns), np.sin(2 * turns)]) + rng.normal(0, 0.1, (n, d))


def ring(points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return a curve without a last point that only closes it."""
    closes = len(points) > 1 and np.array_equal(points[0], points[-1])
    return points[:-1] if closes else points


def wrong_pairs(pairs: int, seed: int) -> int:
    warnings.simplefilter("ignore", curvewise.LayoutWarning)
    rng = np.random.default_rng(seed)
    wrong = 0
    for number in range(pairs):
        P, Q = curve(rng, number % 3), curve(rng, number % 3)
        metric = METRICS[number % 4]
        turned = [np.roll(ring(P), i, axis=0) for i in range(len(ring(P)))]
        others = [np.roll(ring(Q), j, axis=0) for j in range(len(ring(Q)))]
        for name in ("dtw", "frechet"):
            expected = curvewise.cdist(turned, others, name, metric=metric).min()
            value = getattr(curvewise, name)(P, Q, closed=True, metric=metric)
            room = 1e-13 * expected if name == "dtw" else 0.0
            if not abs(value - expected) <= room:
                wrong += 1
                print(f"{name} {metric}: {value!r}, not {expected!r}, of {P.tolist()} {Q.tolist()}")
    return wrong


def print_times(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for n in (100, 300, 1000):
        loops = [
            np.column_stack([np.cos(t), np.sin(2 * t)]) + rng.normal(0, 0.02, (len(t), 2))
            for t in (
                np.linspace(begin, begin + 2 * np.pi, size, endpoint=False)
                for begin, size in ((0.0, n), (1.0, 9 * n // 10))
            )
        ]
        walks = [np.cumsum(rng.normal(size=(size, 2)), axis=0) for size in (n, 9 * n // 10)]
        for kind, (P, Q) in (("loops", loops), ("walks", walks)):
            for name in ("dtw", "frechet"):
                measure = getattr(curvewise, name)
                times = []
                for options in ({"closed": True}, {"prune": False}):
                    begun = time.process_time()
                    measure(P, Q, **options)
                    times.append(1e3 * (time.process_time() - begun))
                starts = times[1] * len(Q)
                print(
                    f"{n} {kind} {name}: closed {times[0]:.2f} ms, open, whole table "
                    f"{times[1]:.2f} ms, from each point of Q {starts:.0f} ms"
                )


if __name__ == "__main__":
    pairs, seed = (*map(int, sys.argv[1:]), *(100_000, 0)[len(sys.argv) - 1 :])
    found = wrong_pairs(pairs, seed)
    print(f"{pairs} pairs, each by dtw and frechet: {found} wrong")
    print_times(seed)
    sys.exit(found > 0)
