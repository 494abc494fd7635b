"""Identifications by the dozen: each in a process of its own, stored, with a progress bar.

The models here take a millisecond, so whole identifications run side by side, not the simulations
of one. What every stage found is stored as JSON, compressed (xzcat shows it). Tables and pictures
are drawn from that: a run that was interrupted is started again, and repeats nothing that is stored
for the same task and the same code (digests.py). What is of another task or other code is stale: it
is said, and made anew.
"""

from __future__ import annotations

import json
import logging
import lzma
import warnings
from collections import Counter
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any, TypeAlias

from digests import code_digests, made_with
from studies import Fold, Found, Stage, Task, found
from tqdm.auto import tqdm

from curvewise.calibration import NoisyTestWarning

Stored: TypeAlias = dict[str, Any]
"""A result, with the digests of its task and of its code, and what it was made with."""


def identify_all(tasks: Sequence[Task], store: Path, workers: int = 1) -> dict[str, Found]:
    """Return what every task finds, by its name; `workers` of them at a time."""
    stored = _all(tasks, store, workers)
    return {name: as_found(one) for name, one in stored.items()}


def as_found(stored: Stored) -> Found:
    """Return a stored identification."""
    return Found(tuple(Stage(**stage) for stage in stored["stages"]))


def cross_validate_all(
    tasks: Sequence[Task], store: Path, workers: int = 1
) -> dict[str, list[Fold]]:
    """Return the folds of every task, by its name."""
    stored = _all(tasks, store, workers)
    return {name: [Fold(**fold) for fold in one["folds"]] for name, one in stored.items()}


def read(store: Path) -> dict[str, Stored]:
    """Return all that is stored in a file, by the tasks' names; nothing where there is none."""
    results: dict[str, Stored] = (
        json.loads(lzma.decompress(store.read_bytes())) if store.exists() else {}
    )
    return results


def digests(task: Task) -> dict[str, str]:
    """Return the digests of a task and of each part of the code that its result depends on."""
    code = code_digests(task.effort, folds=task.folds, material=task.material)
    return {"task": task.digest(), **code}


def stale_parts(task: Task, stored: Mapping[str, Any]) -> list[str]:
    """Return which digests of a stored result are not those of today; none if it is current."""
    before = stored.get("digests", {})
    return [part for part, digest in digests(task).items() if before.get(part) != digest]


def make(task: Task) -> Stored:
    """Search, and return the result as it is stored."""
    return {"digests": digests(task), "made_with": made_with(), **found(task)}


def say_stale(name: str, stale: Mapping[str, Sequence[str]], total: int) -> None:
    """Print how many results of a store are stale, and which parts of the code changed."""
    parts = Counter(part for several in stale.values() for part in several)
    changed = ", ".join(f"{part} {count}" for part, count in parts.items())
    print(f"{name}: {len(stale)} of {total} stored results are stale ({changed})", flush=True)


def _all(tasks: Sequence[Task], store: Path, workers: int) -> dict[str, Stored]:
    stored = read(store)
    stale = {t.name: parts for t in tasks if (parts := stale_parts(t, stored.get(t.name, {})))}
    known = {name: parts for name, parts in stale.items() if name in stored}
    if known:
        say_stale(store.name.partition(".")[0], known, len(tasks))
    missing = [task for task in tasks if task.name in stale]
    if missing:
        with (
            ProcessPoolExecutor(workers, initializer=quiet) as pool,
            tqdm(total=len(missing), unit="task", desc=store.name) as bar,
        ):
            running = {pool.submit(make, task): task.name for task in missing}
            try:
                for future in as_completed(running):
                    stored[running[future]] = future.result()
                    _write(store, stored)
                    bar.update()
            except BaseException:  # Ctrl-C above all: the pool would finish what is queued
                pool.shutdown(cancel_futures=True)
                raise
    return {task.name: stored[task.name] for task in tasks}


def _write(store: Path, stored: Mapping[str, Stored]) -> None:
    """Write the store, a line for every task, so that no interruption leaves half of it."""
    lines = (f"{json.dumps(name)}: {json.dumps(stored[name])}" for name in sorted(stored))
    store.parent.mkdir(parents=True, exist_ok=True)
    unfinished = store.with_suffix(".part")
    text = "{\n" + ",\n".join(lines) + "\n}\n"
    unfinished.write_bytes(lzma.compress(text.encode(), preset=9))
    unfinished.replace(store)


def quiet() -> None:
    """Say nothing of failed simulations, of which wide bounds always have some, nor of noise."""
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    warnings.simplefilter("ignore", NoisyTestWarning)
