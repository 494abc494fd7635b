"""How long does a search of 300 runs take where each takes a second: eight workers against one?

A material point (`searches.problem`) that sleeps for a second, by area, with the default search, on
a pool of threads. One worker would take as many seconds as there are runs, and what the search
takes beside the model; the pool is timed. Also counted: the batches that the search asked for, how
long they last on so many workers if nothing is taken beside the model, and whether the history is
that of one worker without the sleep, bit for bit.

    python benchmarks/validation/eight_workers.py --workers 8 --test eddq-3
"""

from __future__ import annotations

import argparse
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from searches import LIMIT, TESTS, problem

from curvewise.calibration import identify


def main() -> None:
    """Search with the pool and with one worker, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--workers", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=1.0, help="of a run")
    parser.add_argument("--test", default="eddq-3", choices=list(TESTS))
    parser.add_argument("--runs", type=int, default=LIMIT)
    options = parser.parse_args()
    model, test, bounds = problem(options.test)
    keywords: dict[str, Any] = {"max_runs": options.runs, "progress": False}
    done = [0]

    def slow(parameters: dict[str, float]) -> Any:
        time.sleep(options.seconds)
        return model(parameters)

    began, cpu = time.perf_counter(), time.process_time()
    with ThreadPoolExecutor(options.workers) as threads:
        found = identify(
            slow,
            test,
            bounds,
            executor=threads,
            callback=lambda progress: done.append(progress.evaluations),
            **keywords,
        )
    seconds, cpu = time.perf_counter() - began, time.process_time() - cpu
    batches = np.diff(done)
    rounds = int(np.ceil(batches / options.workers).sum())
    alone = identify(lambda parameters: model(parameters), test, bounds, **keywords)
    same = all(
        np.array_equal(alone.history[name], found.history[name])
        for name in ("evaluation", "value", *found.parameters)
    )
    print(
        f"{options.test}: {found.evaluations} runs, value {found.value:.6g}; {options.workers} "
        f"workers {seconds:.0f} s, of which {cpu:.0f} s of CPU; {len(batches)} batches in {rounds} "
        f"rounds of the model; same bits as one worker: {same}"
    )
    print(found.message)


if __name__ == "__main__":
    main()
