"""Searches that are killed: kill -9, or Ctrl-C, at a random moment, and two processes on one store.

A search with a store is restarted until it has run to its end. Each time but the last, it is killed
at a random moment of its life: while Python starts, while the store is made, while a model runs,
while a row is written. In the end it must have the bits of an undisturbed search. It must not
repeat a stored run, the database must be whole (SQLite's own check), and all processes must have
ended. The same holds for two processes that search with one store, one of them killed.

    python tests/faults/searches.py [--times 20]
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from contextlib import closing
from pathlib import Path

SEARCH = """
import signal, sys, time
import numpy as np
from curvewise.calibration import SDRM, identify

X = np.linspace(0.0, 1.0, 25)
store, workers = sys.argv[1:]


class Line:
    identity = "slow line"

    def __call__(self, parameters):
        time.sleep(0.005)
        with open(store + ".runs", "a") as file:
            file.write("run\\n")
        return np.column_stack((X, parameters["a"] * X + parameters["b"]))


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
    found = identify(
        Line(), np.column_stack((X, 2.0 * X + 1.0)), {"a": (0.0, 10.0), "b": (-5.0, 5.0)},
        store=store, workers=int(workers), progress=False, method=SDRM(maxiter=8),
    )
    print(found.value.hex(), *(value.hex() for value in found.parameters.values()))
    print(found.evaluations)
"""


class Searches:
    """A folder with the script, and what a search that is left alone finds."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.script = folder / "search.py"
        self.script.write_text(SEARCH)
        begun = time.monotonic()
        self.whole = self.finished(self.started("whole"))
        self.seconds = time.monotonic() - begun

    def started(self, name: str, *, workers: int = 1) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, str(self.script), str(self.folder / f"{name}.db"), str(workers)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def finished(self, process: subprocess.Popen[str]) -> list[str]:
        """Return what a search prints, the errors where it fails."""
        out, errors = process.communicate(timeout=120)
        return out.splitlines() if process.returncode == 0 else [errors]

    def runs(self, name: str) -> int:
        """Return how many models were begun and ended."""
        file = self.folder / f"{name}.db.runs"
        return file.read_text().count("\n") if file.exists() else 0


def stored(file: Path) -> int:
    """Return how many runs a store holds, or -1 where the database is damaged."""
    if not file.exists():
        return 0
    with closing(sqlite3.connect(file, timeout=60)) as database:
        if database.execute("PRAGMA integrity_check").fetchone() != ("ok",):
            return -1
        tables = database.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        return database.execute("SELECT count(*) FROM runs").fetchone()[0] if tables else 0


def is_group_left(group: int) -> bool:
    """Say whether a process of the group is alive after five seconds."""
    for _ in range(50):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return False
        time.sleep(0.1)
    return True


def killed_and_resumed(
    searches: Searches, name: str, number: int, rng: random.Random, kills: int
) -> str:
    """Kill a search `kills` times; return the error at the end, or nothing."""
    workers = rng.choice([1, 2])
    for _ in range(kills):
        process = searches.started(name, workers=workers)
        time.sleep(rng.uniform(0.0, searches.seconds))
        os.kill(process.pid, number)
        _, errors = process.communicate(timeout=60)
        if is_group_left(process.pid):
            return "a process is left"
        # Before Python has a handler for it, and after, the signal ends a process without a word.
        is_wordless = process.returncode == -number and not errors
        # While numpy is imported, the KeyboardInterrupt becomes an ImportError of numpy's.
        is_said = "KeyboardInterrupt" in errors or "numpy C-extensions failed" in errors
        is_ended = process.returncode == 0 or is_wordless or is_said
        if number == signal.SIGINT and not is_ended:
            return f"Ctrl-C ended in status {process.returncode}, {errors!r}"
    before = stored(searches.folder / f"{name}.db")
    if before < 0:
        return "the database is damaged"
    runs = searches.runs(name)
    out = searches.finished(searches.started(name))
    if out != searches.whole:
        return f"resumed: {out}, not {searches.whole}"
    more = searches.runs(name) - runs
    if more != int(searches.whole[1]) - before:
        return f"{more} runs more, though {before} of {searches.whole[1]} were stored"
    return ""


def two_on_one_store(searches: Searches, name: str, rng: random.Random) -> str:
    """Search twice at once with one store, and kill one of them; return the error."""
    both = [searches.started(name) for _ in range(2)]
    time.sleep(rng.uniform(0.0, searches.seconds))
    if rng.randrange(2):
        both[1].kill()
        both[1].communicate()
        both.pop()
    for process in both:
        out = searches.finished(process)
        if out != searches.whole:
            return f"{out}, not {searches.whole}"
    if stored(searches.folder / f"{name}.db") != int(searches.whole[1]):
        return "runs are missing in the store"
    return ""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    failures: list[str] = []
    with tempfile.TemporaryDirectory() as name:
        searches = Searches(Path(name))
        for what, number in (("kill -9", signal.SIGKILL), ("Ctrl-C", signal.SIGINT)):
            kills = 0
            wrong = []
            for k in range(arguments.times):
                count = rng.choice([1, 1, 2, 3])
                wrong.append(killed_and_resumed(searches, f"{number}-{k}", number, rng, count))
                kills += count
            failures += filter(None, wrong)
            same = wrong.count("")
            print(
                f"{what}: {kills} times, of {len(wrong)} searches; {same} ended with the same bits"
            )
        wrong = [two_on_one_store(searches, f"two-{k}", rng) for k in range(arguments.times)]
        failures += filter(None, wrong)
        print(f"two processes on one store: {len(wrong)} times, {wrong.count('')} right")
    print(*failures, sep="\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
