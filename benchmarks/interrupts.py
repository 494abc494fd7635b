"""How long Ctrl-C takes: SIGINT at a random moment of every long call there is, again and again.

The moment is drawn from all of the call (from its first four seconds where it is longer), so that
the reading, packing and writing of curves is met as well as the work itself. The latency is the
time from the signal to the KeyboardInterrupt; after each, a short call is compared with its value
from before.

    python benchmarks/interrupts.py [--times 20] [--only area]
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
import curvewise.dask
from curvewise.calibration import identify

Calls = dict[str, Callable[[], object]]

LIMIT = 0.2  # seconds, promised
LONGEST = 4.0


def random_walk(n: int, dim: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(n, dim)).cumsum(axis=0)


def loop(n: int, seed: int) -> np.ndarray:
    """Return a noisy loop: like another one, so that dtw and frechet prune."""
    t = np.linspace(0, 12 * np.pi, n)
    noise = np.random.default_rng(seed).normal(scale=0.002, size=(n, 2))
    return np.column_stack((np.cos(t) * (1 + 0.01 * t), np.sin(t))) * (1 + 0.01 * seed) + noise


def warping_calls() -> Calls:
    P, Q = random_walk(100_000, 2, 1), random_walk(100_000, 2, 2)
    high, other_high = random_walk(5_000, 1000, 3), random_walk(5_000, 1000, 4)
    long, short = random_walk(3_000_000, 3, 5), random_walk(160, 3, 6)
    p, q = loop(1_000_000, 1), loop(900_000, 2)
    table = P[:12_000]
    return {
        "dtw": lambda: curvewise.dtw(P, Q),
        "dtw, 2 workers": lambda: curvewise.dtw(P, Q, workers=2),
        "dtw, window": lambda: curvewise.dtw(P, Q, window=20_000),
        "dtw, open ends": lambda: curvewise.dtw(P, Q, open_begin=True, open_end=True),
        "dtw, 1000-D, minkowski": lambda: curvewise.dtw(high, other_high, metric="minkowski", p=3),
        "dtw, 3,000,000 against 160 points, minkowski": lambda: curvewise.dtw(
            long, short, metric="minkowski", p=3
        ),
        "dtw, pruned, 1,000,000 points": lambda: curvewise.dtw(p, q),
        "dtw_path, 2 workers": lambda: curvewise.dtw_path(P, Q, workers=2),
        "dtw_path, pruned": lambda: curvewise.dtw_path(p[::5], q[::5]),
        "dtw_info": lambda: curvewise.dtw_info(P, Q),
        "dtw_table, 12,000 points, window": lambda: curvewise.dtw_table(table, table, window=9),
        "frechet": lambda: curvewise.frechet(P, Q, prune=False),
        "frechet, minkowski, 2 workers": lambda: curvewise.frechet(
            P, Q, metric="minkowski", p=3, workers=2
        ),
        "frechet, pruned, 1,000,000 points": lambda: curvewise.frechet(p, q),
        "frechet_path": lambda: curvewise.frechet_path(P, Q),
        "frechet_path, pruned": lambda: curvewise.frechet_path(p, q),
        "frechet_info": lambda: curvewise.frechet_info(P, Q),
        "frechet_table, 12,000 points": lambda: curvewise.frechet_table(table, table),
    }


def planar_calls() -> Calls:
    huge = random_walk(5_000_000, 2, 7)
    less = huge[:4_000_000]
    zigzag = np.column_stack((np.arange(8801) % 2, np.zeros(8801)))
    endless = np.broadcast_to(np.array([1.0, 2.0]), (400_000_000, 2))  # takes no memory
    far = 1e200 * np.array([(-3, 0.1), (0.1, 0.1), (0.1, 0)])
    return {
        "area, 5,000,000 points": lambda: curvewise.area(huge, less),
        "area, arc length, 5,000,000 points": lambda: curvewise.area(
            huge, less, spacing="arc_length"
        ),
        "area, 2 against 5,000,000 points": lambda: curvewise.area(huge, huge[:2]),
        "area_quads, 5,000,000 points": lambda: curvewise.area_quads(huge, less),
        "pcm, 5,000,000 points": lambda: curvewise.pcm(huge, less),
        "pcm_match, 5,000,000 points": lambda: curvewise.pcm_match(huge, less),
        "pcm, continuous, 5,000,000 points": lambda: curvewise.pcm(
            huge, less, offsets="continuous"
        ),
        "pcm, continuous, on a zigzag": lambda: curvewise.pcm(
            zigzag, zigzag[:4401], offsets="continuous"
        ),
        "cdist of pcm, continuous, of curves far apart": lambda: curvewise.cdist(
            [[(-1, -1), (0, 0)]] * 300, [far] * 300, "pcm", offsets="continuous"
        ),
        "cdist of pcm, 10,000,000 offsets": lambda: curvewise.cdist(
            [huge[:100]], [huge[:50]], "pcm", offsets=10**7
        ),
        "curve_length, 5,000,000 points": lambda: curvewise.curve_length(huge, huge, scale="range"),
        "curve_length_residuals, 5,000,000 points": lambda: curvewise.curve_length_residuals(
            huge, huge, scale="range"
        ),
        "sum_of_squares": lambda: curvewise.sum_of_squares(endless, endless),
        "mse": lambda: curvewise.mse(endless, endless),
        "mae": lambda: curvewise.mae(endless, endless),
        "normalize, 5,000,000 points": lambda: curvewise.normalize(huge, less),
        "compare, 5,000,000 points": lambda: curvewise.compare(huge, less),
    }


def model(parameters: dict[str, float]) -> np.ndarray:
    t = np.linspace(0, 1, 500)
    time.sleep(0.01)
    return np.column_stack((t, parameters["a"] * t))


def batch_calls() -> Calls:
    P, Q = random_walk(100_000, 2, 1), random_walk(100_000, 2, 2)
    many = [random_walk(100, 2, seed) for seed in range(20_000)]
    long = [random_walk(30_000, 2, seed) for seed in range(20)]
    long_3d, short_3d = random_walk(3_000_000, 3, 5), random_walk(160, 3, 6)
    huge = random_walk(20_000_000, 2, 7)
    bounds = {"a": (0.0, 1.0), "b": (0.0, 1.0)}
    experiment = model({"a": 0.5})
    return {
        "pdist, 20,000 x 100 points": lambda: curvewise.pdist(many, "frechet"),
        "pdist, 20,000 x 100 points, 2 workers": lambda: curvewise.pdist(many, workers=2),
        "pdist, 20 x 30,000 points, 2 workers": lambda: curvewise.pdist(long, workers=2),
        "cdist of one pair, 2 workers": lambda: curvewise.cdist([P], [Q], workers=2),
        "cdist of pcm, 2 workers": lambda: curvewise.cdist(many, measure="pcm", workers=2),
        "cdist of a callable": lambda: curvewise.cdist(
            many, measure=lambda P, Q: curvewise.area(P, Q)
        ),
        "Prepared, of a few points": lambda: curvewise.Prepared(
            long_3d, "dtw", metric="minkowski", p=3
        )(short_3d),
        "Prepared, of a list": lambda: curvewise.Prepared(P, "frechet")([Q] * 3, workers=2),
        "Prepared, its making, of 20,000,000 points": lambda: curvewise.Prepared(huge, "pcm"),
        "dask.cdist, its making": lambda: curvewise.dask.cdist([huge], measure="dtw"),
        "dask.cdist, blocks in threads": lambda: curvewise.dask.cdist(long, block=10).compute(
            scheduler="threads"
        ),
        "dask.cdist, blocks in turn": lambda: curvewise.dask.cdist(long, block=10).compute(
            scheduler="synchronous"
        ),
        "identify": lambda: identify(
            model, experiment, bounds, method="de", progress=False, max_evaluations=2000
        ),
    }


def latency(call: Callable[[], object], delay: float) -> float | None:
    """Return the seconds from SIGINT, sent `delay` seconds into the call, to its exception.

    None where the call was over before.
    """
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(delay, interrupt)
    timer.start()
    try:
        call()
        timer.cancel()
        timer.join()  # the signal may come here
    except KeyboardInterrupt:
        return time.perf_counter() - sent[0]
    return None


def duration(call: Callable[[], object]) -> float:
    """Return how many seconds the call takes, at most LONGEST."""
    start = time.perf_counter()
    latency(call, LONGEST)
    return min(LONGEST, time.perf_counter() - start)


def latencies_of(call: Callable[[], object], times: int, rng: random.Random) -> list[float]:
    seconds = duration(call)
    found: list[float] = []
    while len(found) < times:
        measured = latency(call, rng.uniform(0.0, 0.95 * seconds))
        if measured is not None:
            found.append(measured)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--only", default="", help="calls whose name holds this text")
    arguments = parser.parse_args()
    P, Q = random_walk(500, 2, 5), random_walk(400, 2, 6)
    expected = curvewise.dtw(P, Q), curvewise.frechet(P, Q)
    rng = random.Random(1)
    print(f"SIGINT during a call, {arguments.times} times: seconds until KeyboardInterrupt")
    late = 0
    for calls in (warping_calls, planar_calls, batch_calls):
        for name, call in calls().items():
            if arguments.only not in name:
                continue
            latencies = latencies_of(call, arguments.times, rng)
            if (curvewise.dtw(P, Q), curvewise.frechet(P, Q)) != expected:
                raise RuntimeError(f"a wrong value after interrupting {name}")
            in_time = sum(seconds < LIMIT for seconds in latencies)
            late += arguments.times - in_time
            print(
                f"{name:<46} median {np.median(latencies):.3f}  max {max(latencies):.3f}  "
                f"within {LIMIT} s: {in_time} of {arguments.times}",
                flush=True,
            )
    raise SystemExit(1 if late else 0)


if __name__ == "__main__":
    main()
