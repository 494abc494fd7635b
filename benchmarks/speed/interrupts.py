"""How long Ctrl-C takes: SIGINT at a random moment of every long call there is, again and again.

The calls are those of long_calls.py. The moment is drawn from all of a call, or from its first
seconds where it is longer than --longest, so that the reading, packing and writing of curves is
met as well as the work itself. The latency is the time from the signal to the KeyboardInterrupt;
after each call, a short one is compared with its value from before.

    python benchmarks/speed/interrupts.py [--times 20] [--longest 4] [--only area] [--part 1/8]
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
from long_calls import CALLS, walk

import curvewise

LIMIT = 0.2  # seconds, promised


def latency(call: Callable[[], object], delay: float) -> float | None:
    """Return the seconds from SIGINT, sent `delay` seconds into the call, to its exception.

    None where the call was over before, or had not begun.
    """
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(delay, interrupt)
    is_begun = False
    try:
        timer.start()
        is_begun = True
        call()
        if sent and time.perf_counter() - sent[0] > LIMIT:
            return time.perf_counter() - sent[0]  # it went on to its end
        timer.cancel()
        timer.join()  # the signal may come here
    except KeyboardInterrupt:
        if is_begun:
            return time.perf_counter() - sent[0]
    return None


def duration(call: Callable[[], object], longest: float) -> float:
    """Return how many seconds the call takes, at most `longest`."""
    start = time.perf_counter()
    latency(call, longest)
    return min(longest, time.perf_counter() - start)


def latencies_of(
    call: Callable[[], object], times: int, longest: float, rng: random.Random
) -> tuple[float, list[float]]:
    """Return how long the call takes, and the latencies."""
    seconds = duration(call, longest)
    found: list[float] = []
    for _ in range(10 * times):
        measured = latency(call, rng.uniform(0.0, 0.95 * seconds))
        if measured is not None:
            found.append(measured)
        if len(found) == times:
            break
    return seconds, found


def chosen(only: str, part: str) -> list[str]:
    """Return the names of part "k/n" of the calls whose names hold `only`."""
    k, n = (int(number) for number in part.split("/"))
    return [name for name in CALLS if only in name][k - 1 :: n]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument(
        "--longest", type=float, default=4.0, help="seconds of a call to choose from"
    )
    parser.add_argument("--only", default="", help="calls whose name holds this text")
    parser.add_argument("--part", default="1/1", help="k/n: every n-th call, from the k-th on")
    arguments = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
    P, Q = walk(500, 5), walk(400, 6)
    expected = curvewise.dtw(P, Q), curvewise.frechet(P, Q)
    rng = random.Random(1)
    late = 0
    for name in chosen(arguments.only, arguments.part):
        call = CALLS[name]()
        seconds, latencies = latencies_of(call, arguments.times, arguments.longest, rng)
        if (curvewise.dtw(P, Q), curvewise.frechet(P, Q)) != expected:
            raise RuntimeError(f"a wrong value after interrupting {name}")
        in_time = sum(seconds < LIMIT for seconds in latencies)
        late += arguments.times - in_time
        print(
            f"{name:<46} {seconds:4.1f} s  median {np.median(latencies):.3f}  "
            f"max {max(latencies):.3f}  within {LIMIT} s: {in_time} of {len(latencies)}",
            flush=True,
        )
    raise SystemExit(1 if late else 0)


if __name__ == "__main__":
    main()
