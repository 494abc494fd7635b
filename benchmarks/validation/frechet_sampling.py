"""What a search by the discrete Fréchet distance finds in tests that are sampled otherwise.

The tests of `searches.py` have some 300 rows, every so many-th of the file: along steep branches a
step is longer than the distances that a search ends at, and then which points fall together decides
(`curvewise.calibration.problem.endings`). The same files are resampled evenly along their arc
length; bounds, limit and method are the same. Each model that is found is compared with all rows of
the file by the continuous Fréchet distance, which does not go by points.

    python benchmarks/validation/frechet_sampling.py --seeds 2 --workers 2

Prints a line for each search, and for each test where searches have ended. Some 25 s a search of
rows, 40 s of a resampled test.
"""

from __future__ import annotations

import argparse
import itertools
from concurrent.futures import ProcessPoolExecutor
from typing import NamedTuple

import numpy as np
import searches

import curvewise
from curvewise.calibration import identify


class Found(NamedTuple):
    """The end of a search: its distance, and the continuous one to all rows, in sides of boxes."""

    runs: int
    within: int  # runs until it was within 1 % of its own end
    distance: float
    to_all_rows: float


def searched(task: tuple[int, str]) -> Found:
    """Search once."""
    searches.say_nothing()
    seed, name = task
    model, test, bounds = searches.problem(name)
    found = identify(
        searches.Timed(model, has_slopes=False),
        test,
        bounds,
        measure="frechet",
        seed=seed,
        max_runs=searches.LIMIT,
        progress=False,
    )
    whole = searches.whole_test(name)
    curve = np.reshape(searches.driven_model(name, whole)(found.parameters), whole.shape)
    box = np.ptp(whole, axis=0)
    values = np.minimum.accumulate(found.history.value)
    return Found(
        len(values),
        int(np.argmax(values <= 1.01 * values[-1])) + 1,
        found.value,
        curvewise.frechet_continuous(whole / box, curve / box),
    )


def longest_step(test: np.ndarray) -> float:
    """Return it in sides of the test's box."""
    return float(np.linalg.norm(np.diff(test, axis=0) / np.ptp(test, axis=0), axis=1).max())


def main() -> None:
    """Search and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--tests", nargs="+", default=list(searches.TESTS))
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    tasks = list(itertools.product(range(options.seeds), options.tests))
    with ProcessPoolExecutor(options.workers) as pool:
        ends = {}
        for task, found in zip(tasks, pool.map(searched, tasks), strict=True):
            print(*task, found, flush=True)
            ends[task] = found
    print("| test | longest step | distances | to all rows, continuous | runs |")
    print("|---|---:|---|---|---|")
    for name in options.tests:
        of_test = [ends[seed, name] for seed in range(options.seeds)]
        distances = ", ".join(f"{one.distance:.4f}" for one in of_test)
        to_all = ", ".join(f"{one.to_all_rows:.4f}" for one in of_test)
        runs = ", ".join(str(one.within) for one in of_test)
        step = longest_step(searches.problem(name)[1])
        print(f"| {name} | {step:.3f} | {distances} | {to_all} | {runs} |")


if __name__ == "__main__":
    main()
