"""Stored results drawn at random, made again and compared: ends with status 1 where one differs.

Drawn in turn from the results of searches that begin with SDRM and from the others, of which there
are ten times as many; and only those that take some ten seconds of one core at most, so that three
fit into a minute. What takes longer (SDRM by PCM, the cross-validations, searches of more than
20,000 runs) is made again by regenerate.py alone. The seed of the draw is printed.

Equal means every bit: parameters, values, numbers of runs, on every x86-64 processor with AVX2
(arithmetic.py). Messages decide no number and are not stored. On other processors or with other
libraries exp, log and BLAS round differently. A search compares values, so it may go another way
there: every stage must end within 1 % of the stored value, the accuracy of what the verdicts say.
Below 1e-6 of the value in the middle of the bounds all values are 0, to a search that has a
perfect model. A third of these results may miss that: 4 of 60 did with the arithmetic of AVX-512,
some lower and some higher, by 2 % and more.
"""

from __future__ import annotations

import argparse
import itertools
import json
import random
import time
from collections.abc import Mapping

import cross_validation
import hardening
import known_parameters
import load_unload
import partial
import table6
from arithmetic import begin_again_held
from digests import made_with
from report import HERE
from stores import Stored, make, quiet, read, say_stale, stale_parts
from studies import Task

from curvewise.calibration import Objective

TOLERANCE = 0.01
ELSEWHERE = 1 / 3  # of what was made with another arithmetic, so much may differ by more
NOTHING = 1e-6  # as a share of the value in the middle of the bounds
MOST_RUNS = 21_000

Tasks = dict[str, dict[str, Task]]
"""Tasks by their names, for each store."""


def main() -> None:
    """Draw, make again, compare."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--sample", type=int, default=3, help="how many, default 3")
    parser.add_argument("--seed", type=int, help="of the draw; default: another in every run")
    options = parser.parse_args()
    begin_again_held()
    seed = random.randrange(10**6) if options.seed is None else options.seed
    quiet()
    tasks = all_tasks()
    stored = {store: read(HERE / "optima" / f"{store}.json.xz") for store in tasks}
    say_what_is_old(tasks, stored)
    print(f"{options.sample} stored results, drawn with --seed {seed}", flush=True)
    drawn = draw(tasks, stored, options.sample, seed)
    differing = []
    for store, name in drawn:
        began = time.perf_counter()
        difference = difference_from(tasks[store][name], stored[store][name])
        seconds = f"[{time.perf_counter() - began:.0f} s]"
        print(f"{store}, {name}: {difference or 'equal'} {seconds}", flush=True)
        differing += [(store, name)] if difference else []
    here = {(store, name) for store, name in drawn if was_made_here(stored[store][name])}
    if here & {*differing} or len(differing) > (len(drawn) - len(here)) * ELSEWHERE:
        raise SystemExit(f"not what is stored: {', '.join(name for _, name in differing)}")


def all_tasks() -> Tasks:
    """Return every task whose result may be stored."""
    noisy = [name for names in hardening.data_sets().values() for name in names]
    tasks = {
        "hardening": [
            *hardening.tasks_of([hardening.CLEAN, *noisy]).values(),
            *known_parameters.tasks_of().values(),
            *cross_validation.tasks_of().values(),
        ],
        "load_unload": [
            *load_unload.exact_tasks(load_unload.SEEDS).values(),
            *load_unload.noisy_tasks().values(),
        ],
        "partial": [
            *partial.branch_tasks().values(),
            *partial.piece_tasks(partial.SEEDS, noise=False).values(),
            *partial.piece_tasks(partial.SEEDS, noise=True).values(),
        ],
        "table6": [
            table6.task(name, case, number, attempt)
            for name in table6.SHIFTED
            for case in table6.CASES
            for number in range(table6.SAMPLES)
            for attempt in range(table6.ATTEMPTS)
        ],
    }
    return {store: {task.name: task for task in several} for store, several in tasks.items()}


def say_what_is_old(tasks: Tasks, stored: Mapping[str, Mapping[str, Stored]]) -> None:
    """Print which results are stale, or of no task, and what to do about it."""
    for store, results in stored.items():
        known = {name: one for name, one in results.items() if name in tasks[store]}
        old = {
            name: parts
            for name, one in known.items()
            if (parts := stale_parts(tasks[store][name], one))
        }
        if old:
            say_stale(store, old, len(known))
            print("regenerate.py makes them again", flush=True)
        if len(known) < len(results):
            print(f"{store}: {len(results) - len(known)} stored results are of no task")


def draw(
    tasks: Tasks, stored: Mapping[str, Mapping[str, Stored]], count: int, seed: int
) -> list[tuple[str, str]]:
    """Return store and name of results, in turn of searches with SDRM and of others."""
    short = [
        (store, name)
        for store, results in stored.items()
        for name, one in results.items()
        if name in tasks[store] and is_short(tasks[store][name], one)
    ]
    random.Random(seed).shuffle(short)
    with_sdrm = [one for one in short if begins_with_sdrm(tasks, *one)]
    others = [one for one in short if not begins_with_sdrm(tasks, *one)]
    in_turn = itertools.chain.from_iterable(itertools.zip_longest(with_sdrm, others))
    return list(itertools.islice(filter(None, in_turn), count))


def begins_with_sdrm(tasks: Tasks, store: str, name: str) -> bool:
    """Return whether the first stage of a task is SDRM."""
    return next(iter(tasks[store][name].effort)) == "sdrm"


def is_short(task: Task, stored: Stored) -> bool:
    """Return whether a result is made again in some ten seconds."""
    if task.folds or ("sdrm" in task.effort and task.measure == "pcm"):
        return False
    return sum(stage["evaluations"] for stage in stored["stages"]) < MOST_RUNS


def was_made_here(stored: Stored) -> bool:
    """Return whether a result was made with the same libraries and arithmetic."""
    return bool(stored["made_with"] == made_with())


def difference_from(task: Task, stored: Stored) -> str:
    """Return how a result made again differs from the stored one; nothing if it is equal."""
    again = json.loads(json.dumps(make(task)))
    if again["stages"] == stored["stages"]:
        return ""
    pairs = list(zip(again["stages"], stored["stages"], strict=True))
    if not was_made_here(stored):
        objective = Objective(task.experiments, task.keywords()["measure"])
        nothing = NOTHING * objective(task.model(task.middle()))
        pairs = [
            (a, b)
            for a, b in pairs
            if abs(a["value"] - b["value"]) > TOLERANCE * b["value"]
            and max(a["value"], b["value"]) > nothing
        ]
    for a, b in pairs:
        fields = [field for field in b if a[field] != b[field]]
        if fields:
            values = f"value {a['value']!r}, stored {b['value']!r}"
            return f"{b['method']} differs in {', '.join(fields)}: {values}"
    return ""


if __name__ == "__main__":
    main()
