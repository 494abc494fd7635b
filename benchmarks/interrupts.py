"""How long Ctrl-C takes: SIGINT at a random moment of a long call, again and again.

Every call would go on for seconds at least. The latency is the time from the signal to the
KeyboardInterrupt; after each, a short call is compared with its value from before.

    python benchmarks/interrupts.py [--times 20]
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import threading
import time
from collections.abc import Callable

import numpy as np

import curvewise


def random_walk(n: int, dim: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(n, dim)).cumsum(axis=0)


def calls() -> dict[str, Callable[[], object]]:
    P, Q = random_walk(100_000, 2, 1), random_walk(100_000, 2, 2)
    high, other_high = random_walk(5_000, 1000, 3), random_walk(5_000, 1000, 4)
    many = [random_walk(100, 2, seed) for seed in range(20_000)]
    long = [random_walk(30_000, 2, seed) for seed in range(20)]
    zigzag = np.column_stack((np.arange(8801) % 2, np.zeros(8801)))
    table = P[:20_000]
    huge = random_walk(5_000_000, 2, 7)
    return {
        "dtw, 100,000 points": lambda: curvewise.dtw(P, Q),
        "dtw, 100,000 points, 2 workers": lambda: curvewise.dtw(P, Q, workers=2),
        "frechet, minkowski, 2 workers": lambda: curvewise.frechet(
            P, Q, metric="minkowski", p=3, workers=2
        ),
        "dtw, 5,000 points, 1000-D, minkowski": lambda: curvewise.dtw(
            high, other_high, metric="minkowski", p=3
        ),
        "dtw_path, 100,000 points, 2 workers": lambda: curvewise.dtw_path(P, Q, workers=2),
        "frechet_table, 20,000 points": lambda: curvewise.frechet_table(table, table),
        "pcm continuous on a zigzag": lambda: curvewise.pcm(
            zigzag, zigzag[:4401], offsets="continuous"
        ),
        "pdist, 20,000 x 100 points": lambda: curvewise.pdist(many, "frechet"),
        "pdist, 20,000 x 100 points, 2 workers": lambda: curvewise.pdist(many, workers=2),
        "pdist, 20 x 30,000 points, 2 workers": lambda: curvewise.pdist(long, workers=2),
        "cdist of one pair, 100,000 points, 2 workers": lambda: curvewise.cdist(
            [P], [Q], workers=2
        ),
        "cdist with pcm, 2 workers": lambda: curvewise.cdist(many, measure="pcm", workers=2),
        "area, 5,000,000 points": lambda: [curvewise.area(huge, huge[:4_000_000]) for _ in "ab"],
        "pcm, 5,000,000 points": lambda: curvewise.pcm(huge, huge[:4_000_000]),
        "curve_length, 5,000,000 points": lambda: [
            curvewise.curve_length(huge, huge, scale="range") for _ in "ab"
        ],
        "Prepared, 100,000 points": lambda: curvewise.Prepared(P, "frechet")(Q),
    }


def latency(call: Callable[[], object], delay: float) -> float:
    """Return the seconds from SIGINT, sent `delay` seconds into the call, to its exception."""
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(delay, interrupt)
    timer.start()
    try:
        call()
    except KeyboardInterrupt:
        return time.perf_counter() - sent[0]
    finally:
        timer.join()
    raise RuntimeError("the call was over before it was interrupted")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=20)
    times = parser.parse_args().times
    P, Q = random_walk(500, 2, 5), random_walk(400, 2, 6)
    expected = curvewise.dtw(P, Q), curvewise.frechet(P, Q)
    rng = random.Random(1)
    print(f"SIGINT during a call, {times} times: seconds until KeyboardInterrupt")
    for name, call in calls().items():
        latencies = []
        for _ in range(times):
            latencies.append(latency(call, rng.uniform(0.05, 0.4)))
            if (curvewise.dtw(P, Q), curvewise.frechet(P, Q)) != expected:
                raise RuntimeError(f"a wrong value after interrupting {name}")
        in_time = sum(seconds < 0.2 for seconds in latencies)
        print(
            f"{name:<46} median {np.median(latencies):.3f}  max {max(latencies):.3f}  "
            f"within 0.2 s: {in_time} of {times}",
            flush=True,
        )


if __name__ == "__main__":
    main()
