"""A full disk: a search whose store can no longer be written.

It must end with an OSError that names the file, and all data written before must be whole. With
space again, the search continues. It repeats no stored run, and gives the bits of a search without
interruption. A file may not grow (RLIMIT_FSIZE) beyond a limit drawn at random. If the script runs
as root, a file system of 256 kB is also filled except for a random rest.

    python tests/faults/disks.py [--times 20]
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import numpy as np

from curvewise.calibration import SDRM, Identification, SimulationStore, identify

# Leaves that number of bytes for a folder's files.
Full = Callable[[Path, int], AbstractContextManager[None]]

X = np.linspace(0.0, 1.0, 25)
BOUNDS = {"a": (0.0, 10.0), "b": (-5.0, 5.0)}


class Line:
    identity = "line"
    runs = 0

    def __call__(self, parameters: dict[str, float]) -> np.ndarray:
        self.runs += 1
        return np.column_stack((X, parameters["a"] * X + parameters["b"]))


def search(model: Line, store: Path | None = None) -> Identification:
    experiment = Line()({"a": 2.0, "b": 1.0})
    method = SDRM(maxiter=8)
    return identify(model, experiment, BOUNDS, method=method, store=store, progress=False)


@contextmanager
def no_growth(folder: Path, room: int) -> Iterator[None]:
    """Let no file of this process grow beyond `room` bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@contextmanager
def little_room(folder: Path, room: int) -> Iterator[None]:
    """Fill the file system of the folder but for `room` bytes."""
    ballast = folder / "ballast"
    with ballast.open("wb") as file:
        free = os.statvfs(folder).f_bavail * os.statvfs(folder).f_frsize
        file.write(bytes(max(free - room, 0)))
    try:
        yield
    finally:
        ballast.unlink()


def kept(file: Path) -> int:
    """Return how many runs a store holds."""
    if not file.exists():
        return 0
    with SimulationStore(file) as store:
        return len(store)


def tried_once(file: Path, room: int, full: Full, whole: Identification) -> str:
    """Search on a full disk, then again with space; return "full", "enough", or the error."""
    result = "enough"
    try:
        with full(file.parent, room):
            search(Line(), file)
    except OSError as error:
        result = "full"
        if str(file) not in str(error):
            return f"{error!r} does not name the file"
    before = kept(file)
    model = Line()
    found = search(model, file)
    if found.value != whole.value or found.parameters != whole.parameters:
        return f"{found.value.hex()} with room again, not {whole.value.hex()}"
    if model.runs != whole.evaluations - before:
        return f"{model.runs} runs, though {before} of {whole.evaluations} were kept"
    return result


def tried(name: str, folder: Path, full: Full, most: int, times: int) -> int:
    """Search again and again; return how many went wrong."""
    rng = random.Random(times)
    whole = search(Line())
    results = []
    for _ in range(times):
        file = folder / "search.db"
        results.append(tried_once(file, rng.randrange(most), full, whole))
        file.unlink()
    bad = [result for result in results if result not in ("full", "enough")]
    print(
        f"{name}: {times} searches, {results.count('full')} ended by OSError, "
        f"{results.count('enough')} had room; {len(bad)} wrong",
        *bad,
        sep="\n    ",
        flush=True,
    )
    return len(bad)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=20)
    times = parser.parse_args().times
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        wrong = tried("a file that may not grow", folder, no_growth, 80_000, times)
        mount = ["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", name]
        if os.getuid() != 0 or subprocess.run(mount, check=False, capture_output=True).returncode:
            print("a full file system: left out, since nobody here may mount one")
            return 1 if wrong else 0
        try:
            wrong += tried("a full file system", folder, little_room, 120_000, times)
        finally:
            subprocess.run(["umount", name], check=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
