"""Timing for the benchmarks: curves, samples taken in turn, fresh processes, the machine.

What is compared is timed in alternation, one sample of each and then the next of each, so that a
machine that slows down slows all of them; the median of the samples is reported. A sample is as
many calls as fill `SAMPLE_SECONDS`. curvewise fixes its instruction-set level at import, so another
level, or a peak memory that nothing else has raised, needs a process of its own: `FreshProcess`
runs this file, which imports curvewise, makes the same curves, and times calls when told to.

Importing this module restricts numpy, numba and the others to one thread; import it first.
"""

from __future__ import annotations

import os

os.environ["OMP_NUM_THREADS"] = "1"
os.environ["OPENBLAS_NUM_THREADS"] = "1"
os.environ["MKL_NUM_THREADS"] = "1"
os.environ["NUMBA_NUM_THREADS"] = "1"
os.environ["RAYON_NUM_THREADS"] = "1"

import datetime
import functools
import importlib
import importlib.metadata
import json
import platform
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

import curvewise

Array = npt.NDArray[np.float64]
Key = TypeVar("Key", bound=Hashable)
Sampler = Callable[[int], float]  # number of calls -> seconds per call

SAMPLE_SECONDS = 0.02
WARM_SECONDS = 0.2  # a call longer than this is its own warm-up
RESULTS = Path(__file__).parent / "results"
ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("CURVEWISE_DATA", ROOT.parent / "shared" / "data"))


@dataclass(frozen=True)
class Timing:
    """Median seconds per call, and of how many samples of how many calls."""

    seconds: float
    samples: int
    calls: int


@dataclass(frozen=True)
class Task:
    """One measure on the curves of :func:`curve_pair`."""

    measure: str
    n: int
    m: int
    dim: int
    options: Mapping[str, object]

    def call(self) -> Callable[[], object]:
        """Return the call to time, its curves made."""
        P, Q = curve_pair(self.n, self.m, self.dim)
        return functools.partial(getattr(curvewise, self.measure), P, Q, **self.options)


def curve_pair(n: int, m: int, dim: int) -> tuple[Array, Array]:
    """Make a measured and a simulated hysteresis loop of n and m points, scaled by P's box.

    curvewise's built-in pair, resampled by index, with a little noise so that no two points
    coincide; `dim` 1 is the stress alone, shape (n,).
    """
    random = np.random.Generator(np.random.PCG64(0))
    scaled = curvewise.normalize(*curvewise.datasets.hysteresis_pair())
    curves = []
    for curve, count in zip(scaled, (n, m), strict=True):
        index = np.linspace(0.0, len(curve) - 1.0, count)
        points = np.column_stack([np.interp(index, np.arange(len(curve)), x) for x in curve.T])
        curves.append(points + random.normal(0.0, 0.002, points.shape))
    P, Q = (curve if dim == 2 else np.ascontiguousarray(curve[:, 1]) for curve in curves)
    return P, Q


def sampler(function: Callable[[], object]) -> Sampler:
    """Return what times a number of calls of `function` and gives the seconds of one."""

    def sample(calls: int) -> float:
        repeats = range(calls)
        start = time.perf_counter()
        for _ in repeats:
            function()
        return (time.perf_counter() - start) / calls

    return sample


def alternate(samplers: Mapping[Key, Sampler], rounds: Callable[[float], int]) -> dict[Key, Timing]:
    """Time all samplers in turn, again and again.

    `rounds` gives the number of samples of each from the seconds that one round takes.
    """
    first = {name: sample(1) for name, sample in samplers.items()}
    # A second look at short calls: the first was slowed by cold caches.
    estimate = {
        name: seconds if seconds > WARM_SECONDS else min(seconds, samplers[name](1))
        for name, seconds in first.items()
    }
    calls = {name: max(1, round(SAMPLE_SECONDS / t)) for name, t in estimate.items()}
    count = rounds(sum(estimate[name] * calls[name] for name in samplers))
    samples = {name: [t] if t > WARM_SECONDS else [] for name, t in first.items()}
    for _ in range(count):
        for name, sample in samplers.items():
            if len(samples[name]) < count:
                samples[name].append(sample(calls[name]))
    return {
        name: Timing(statistics.median(taken), len(taken), calls[name])
        for name, taken in samples.items()
    }


class FreshProcess:
    """A process of its own, at an instruction-set level, that times a task when told to."""

    def __init__(self, task: Task | None, level: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, __file__, json.dumps(task and vars(task))],
            env={**os.environ, "CURVEWISE_ISA": level},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            bufsize=1,
        )

    def __enter__(self) -> FreshProcess:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        assert self._process.stdin
        assert self._process.stdout
        self._process.stdin.close()
        self._process.stdout.close()
        self._process.wait()

    def sample(self, calls: int) -> float:
        """Make this many calls there; return the seconds of one."""
        return self._ask(str(calls))

    def peak_megabytes(self) -> float:
        """Return the most memory that the process has held so far, in 10^6 bytes."""
        return self._ask("peak") / 1e6

    def _ask(self, question: str) -> float:
        assert self._process.stdin
        assert self._process.stdout
        self._process.stdin.write(question + "\n")
        answer = self._process.stdout.readline()
        if not answer:
            raise RuntimeError("a process that measures curvewise has ended; see its error above")
        return float(answer)


def _serve(task: dict[str, Any] | None) -> None:
    """Answer the questions of `FreshProcess`, one per line, until there are no more."""
    sample = sampler(Task(**task).call()) if task else None
    for question in sys.stdin:
        if question.strip() == "peak":
            print(peak_bytes(), flush=True)
        elif sample:
            print(sample(int(question)), flush=True)


def peak_bytes() -> int:
    """Return the peak resident memory of this process.

    Linux hands ru_maxrss down from the process that started this one, whose peak may be larger;
    the high-water mark in /proc belongs to this program alone.
    """
    status = Path("/proc/self/status")
    if status.exists():
        for line in status.read_text().splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) * 1024
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else peak * 1024


def levels() -> list[str]:
    """Return the instruction-set levels of this machine, the fastest first."""
    return curvewise.installation.build_info()["instruction_sets"][::-1]


def active_level() -> str:
    """Return the level at which curvewise runs in this process."""
    return curvewise.installation.build_info()["active"]


def machine(packages: Sequence[str]) -> dict[str, object]:
    """Describe where and with what the numbers were measured."""
    build = curvewise.installation.build_info()
    return {
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "commit": _commit(),
        "cpu": _cpu_model(),
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "load": os.getloadavg(),
        "level": build["active"],
        "levels": build["instruction_sets"],
        "compiler": build["compiler"],
        "eigen": build["eigen"],
        "versions": {
            "python": platform.python_version(),
            "curvewise": build["version"],
            **{name: _version(name) for name in ("numpy", *packages)},
        },
    }


def _cpu_model() -> str:
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text().splitlines() if cpuinfo.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def _commit() -> str | None:
    """Return the commit of the source tree, with "+" where it was changed since."""

    def git(*words: str) -> str:
        command = ["git", "-C", str(Path(__file__).parent), *words]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()

    try:
        changed = git("status", "--porcelain", "--untracked-files=no")
        return git("rev-parse", "HEAD") + ("+" if changed else "")
    except (OSError, subprocess.CalledProcessError):
        return None


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


def progress(steps: Iterable[Any], label: str) -> Iterable[Any]:
    """Show how far a loop is, where tqdm is installed and someone is watching."""
    try:
        tqdm: Any = importlib.import_module("tqdm")
    except ImportError:
        return steps
    shown: Iterable[Any] = tqdm.tqdm(
        steps, desc=label, leave=False, disable=not sys.stderr.isatty()
    )
    return shown


def print_table(title: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print rows in columns, numbers to the right."""
    widths = [max(len(row[k]) for row in (header, *rows)) for k in range(len(header))]
    print(f"\n{title}")
    for row in (header, *rows):
        cells = [
            cell.rjust(width) if all(_is_number(r[k]) for r in rows) else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        print("  " + "  ".join(cells).rstrip())


def _is_number(cell: str) -> bool:
    return not cell or cell[0].isdigit()


def duration(seconds: float) -> str:
    """Return seconds with a unit that reads well, e.g. "9.61 ms"."""
    for unit, factor in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= factor:
            return f"{seconds / factor:.3g} {unit}"
    return f"{seconds * 1e6:.3g} µs"


if __name__ == "__main__":
    _serve(json.loads(sys.argv[1]))
