"""How long does a search of 300 runs take where each takes a second: eight workers against one?

A material point (`searches.problem`) that sleeps for a second, by area, with the default search, on
a pool of threads. One worker would take as many seconds as there are runs, and what the search
takes beside the model; the pool is timed. Also counted: how many runs were under way at a time, in
the mean. Then the same search without the sleep, by one worker, by threads, and by processes: the
history has to be the same, bit for bit.

    python benchmarks/validation/eight_workers.py --workers 8 --test eddq-5
"""

from __future__ import annotations

import argparse
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from searches import LIMIT, TESTS, problem

from curvewise.calibration import Identification, identify


class Slow:
    """A model that sleeps before it answers."""

    def __init__(self, model: Any, seconds: float) -> None:
        self._model, self._seconds = model, seconds

    def __call__(self, parameters: dict[str, float]) -> Any:
        time.sleep(self._seconds)
        return self._model(parameters)


def main() -> None:
    """Search with the pool, and with others without the sleep, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--workers", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=1.0, help="of a run")
    parser.add_argument("--test", default="eddq-5", choices=list(TESTS))
    parser.add_argument("--runs", type=int, default=LIMIT)
    options = parser.parse_args()
    model, test, bounds = problem(options.test)

    def searched(seconds: float, **workers: Any) -> Identification:
        slow = Slow(model, seconds)
        return identify(slow, test, bounds, max_runs=options.runs, progress=False, **workers)

    with ThreadPoolExecutor(2) as two, ThreadPoolExecutor(options.workers) as threads:
        began, cpu = time.perf_counter(), time.process_time()
        found = searched(options.seconds, executor=threads)
        seconds, cpu = time.perf_counter() - began, time.process_time() - cpu
        print(
            f"{options.test}: {found.evaluations} runs, value {found.value:.6g}; {options.workers} "
            f"workers {seconds:.0f} s, of which {cpu:.0f} s of CPU; "
            f"{found.history.seconds.sum() / seconds:.1f} runs at a time"
        )
        print(found.message, flush=True)
        for name, workers in {
            "one worker": {},
            "2 threads": {"executor": two},
            "2 processes": {"workers": 2},
            f"{options.workers} processes": {"workers": options.workers},
        }.items():
            other = searched(0.0, **workers)
            columns = [name for name in found.history.dtype.names if name != "seconds"]
            same = all(np.array_equal(other.history[c], found.history[c]) for c in columns)
            print(f"same bits by {name}: {same}", flush=True)


if __name__ == "__main__":
    main()
