"""curvewise against the other packages that compute these measures.

For each workload of workloads.py, values are compared first, on the timed curves and on small
random pairs. Then all are timed in alternation in this process, on one thread; curvewise's other
instruction-set levels take their samples in the same turn, in processes of their own. A peer too
slow for an n is quoted at the largest n that it is fast enough for. Last, the n up to which exact
curvewise is faster than approximate fastdtw. Prints tables; writes peers.json.xz and peers.webp.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import contextlib
import importlib
import io
import math
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from stored import save_picture, write_json
from timing import Array
from workloads import DTW, FASTDTW, FRECHET, WORKLOADS, Peer, Workload

import curvewise

TOLERANCE = 1e-9
RANDOM_PAIRS = 40
FASTDTW_SIZES = (100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000, 200_000)
PACKAGE_COLOURS = {
    "dtaidistance": "#0072B2",
    "traj-dist-rs": "#D55E00",
    "aeon": "#009E73",
    "dtw-python": "#CC79A7",
    "tslearn": "#E69F00",
    "curvesimilarities": "#56B4E9",
    "similaritymeasures": "#F0E442",
    "shapely": "#666666",
}
# On this pair GEOS, and so shapely, is known to be wrong: the discrete Fréchet distance is 5.
GEOS_PAIR = (
    np.array([(2, 5), (3, 3), (4, 3), (5, 4), (0, 0), (3, 4)], dtype=np.float64),
    np.array([(0, 4), (4, 4), (5, 1)], dtype=np.float64),
)


@dataclass(frozen=True)
class Effort:
    """How much time to spend: the n allowed, seconds per call, seconds per n, for fastdtw."""

    largest: int
    call_seconds: float
    size_seconds: float
    fastdtw_seconds: float

    def rounds(self, seconds: float) -> int:
        """Return the number of samples, from the seconds that one of each takes."""
        return max(5, min(25, int(self.size_seconds / seconds)))


FULL = Effort(10_000, 0.5, 2.0, 75.0)
QUICK = Effort(1000, 0.05, 0.2, 3.0)


@dataclass
class Contender:
    """A peer in a workload: its module, what its values were found to be, its last time."""

    peer: Peer
    module: Any
    same: bool
    compared: int = 0
    wrong: list[tuple[float, float]] = field(default_factory=list)  # its value, the right one
    value: float = math.nan
    seconds: float = 0.0
    size: int = 0

    @property
    def check(self) -> str:
        """Return what the comparison of values says."""
        if self.wrong:
            value, right = self.wrong[-1]
            return f"WRONG {len(self.wrong)}/{self.compared}: {value:.6g} for {right:.6g}"
        return "equal" if self.same else "other definition"


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="small n, under a minute")
    parser.add_argument("--output", type=Path, default=timing.RESULTS, metavar="DIR")
    names = [*WORKLOADS, "fastdtw"]
    parser.add_argument("--workloads", nargs="+", choices=names, default=names, metavar="NAME")
    arguments = parser.parse_args()
    effort = QUICK if arguments.quick else FULL

    packages = {peer.package for work in WORKLOADS.values() for peer in work.peers} | {"fastdtw"}
    machine = timing.machine(sorted(packages))
    print(
        f"{machine['cpu']}, {machine['cores']} cores; curvewise at {timing.active_level()}, "
        f"one thread; commit {machine['commit']}"
    )
    print("x <level>: the time divided by that of curvewise at this level and n")
    print(f"*: a call at the table's n would take over {effort.call_seconds} s; timed at this n")
    modules = load_modules()
    results: list[dict[str, Any]] = []
    for name in (name for name in arguments.workloads if name in WORKLOADS):
        found = measure_workload(WORKLOADS[name], modules, effort)
        print_workload(WORKLOADS[name], found)
        results += found
    content: dict[str, object] = {"machine": machine, "results": results}
    if "fastdtw" in arguments.workloads and FASTDTW.module in modules:
        fastdtw = measure_fastdtw(modules[FASTDTW.module], effort.fastdtw_seconds)
        print_fastdtw(fastdtw)
        content["fastdtw"] = fastdtw
    write_json(arguments.output / "peers.json.xz", content)
    drawn = [work for work in (DTW, FRECHET) if work.name in arguments.workloads]
    if drawn:
        draw(drawn, results, machine, arguments.output / "peers.webp")


def load_modules() -> dict[str, Any]:
    """Import the peers; those that are missing are skipped with the reason."""
    peers = [*(peer for work in WORKLOADS.values() for peer in work.peers), FASTDTW]
    modules = {}
    for name, package in {peer.module: peer.package for peer in peers}.items():
        try:
            # dtw-python greets whoever imports it.
            with contextlib.redirect_stdout(io.StringIO()):
                modules[name] = importlib.import_module(name)
        except ImportError as error:
            print(f"skipped: {package} ({error})")
    return modules


def measure_workload(
    workload: Workload, modules: dict[str, Any], effort: Effort
) -> list[dict[str, Any]]:
    """Compare values, then time everything that is fast enough at each n."""
    contenders = [
        Contender(peer, modules[peer.module], workload.is_same(peer))
        for peer in workload.peers
        if peer.module in modules
    ]
    for P, Q in small_pairs(workload):
        contenders = [c for c in contenders if compare(workload, c, P, Q)]
    results: list[dict[str, Any]] = []
    for n in (n for n in workload.sizes if n <= effort.largest):
        power = 2 if workload.has_table else 1
        taking_part = [c for c in contenders if expected(c, n, power) <= effort.call_seconds]
        results += measure_size(workload, taking_part, n, effort)
    # Only now is it known on how many pairs a peer was wrong.
    checks = {(c.peer.package, c.peer.definition): c.check for c in contenders}
    for result in results:
        result["check"] = checks.get((result["package"], result["definition"]), "")
    return results


def small_pairs(workload: Workload) -> Iterator[tuple[Array, Array]]:
    """Make pairs that are small enough for all cases to occur, as random walks."""
    random = np.random.Generator(np.random.PCG64(1))
    if workload is FRECHET:
        yield GEOS_PAIR
    for _ in range(RANDOM_PAIRS):
        n, m = random.integers(3, 12, 2)
        # A mean below zero makes similaritymeasures' curve length nan: keep away from it.
        curves = [
            20 + np.cumsum(random.normal(size=(count, 2)), axis=0)
            for count in (n, n if workload.banded else m)
        ]
        P, Q = (np.ascontiguousarray(c[:, 0]) if workload.dim == 1 else c for c in curves)
        yield P, Q


def compare(workload: Workload, contender: Contender, P: Array, Q: Array) -> bool:
    """Compare a peer's value with curvewise's for the peer's definition; False if it fails."""
    peer = contender.peer
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = peer.prepare(contender.module, P, Q)()
    except Exception as error:  # a peer may fail in any way of its own
        print(f"skipped: {peer.package} in {workload.name} ({type(error).__name__}: {error})")
        return False
    options = workload.with_band(len(P), peer.options)
    if workload.measure == "dtw_path":
        result = path_cost(np.asarray(result), P, Q, squared="metric" in options)
    measure = getattr(curvewise, workload.measure.removesuffix("_path"))
    right = peer.value(P, Q) if peer.value else measure(P, Q, **options)
    contender.compared += 1
    contender.value = float(result)
    if not math.isclose(contender.value, right, rel_tol=TOLERANCE):
        contender.wrong.append((contender.value, right))
    return True


def path_cost(path: Array, P: Array, Q: Array, *, squared: bool) -> float:
    """Return the sum of ground distances along a path, nan if it is not a warping path."""
    steps = np.diff(path, axis=0)
    ends = path[0].tolist() == [0, 0] and path[-1].tolist() == [len(P) - 1, len(Q) - 1]
    if not ends or steps.min() < 0 or steps.max() > 1 or not steps.any(axis=1).all():
        return math.nan
    distances = ((P[path[:, 0]] - Q[path[:, 1]]) ** 2).sum(axis=1)
    return float(distances.sum() if squared else np.sqrt(distances).sum())


def expected(contender: Contender, n: int, power: int) -> float:
    """Return the seconds a call will take if they grow as n ** power; 0 if nothing is known."""
    return contender.seconds * (n / contender.size) ** power if contender.size else 0.0


def measure_size(
    workload: Workload, contenders: list[Contender], n: int, effort: Effort
) -> list[dict[str, Any]]:
    """Time curvewise at every level and the given peers at one n."""
    task = workload.task(n)
    P, Q = timing.curve_pair(task.n, task.m, task.dim)
    contenders = [c for c in contenders if compare(workload, c, P, Q)]
    active = timing.active_level()
    others = [level for level in timing.levels() if level != active]
    with contextlib.ExitStack() as stack:
        samplers: dict[Any, timing.Sampler] = {active: timing.sampler(task.call())}
        for level in others:
            process = stack.enter_context(timing.FreshProcess(task, level))
            samplers[level] = process.sample
        for k, contender in enumerate(contenders):
            call = contender.peer.prepare(contender.module, P, Q)
            samplers[k] = timing.sampler(call)
        timings = timing.alternate(samplers, effort.rounds)

    def result(package: str, definition: str, value: float, key: object) -> dict[str, Any]:
        cells, seconds = workload.cells(n), timings[key].seconds
        return {
            "workload": workload.name,
            "package": package,
            "definition": definition,
            "check": "",
            "value": value,
            "n": n,
            "m": task.m,
            **vars(timings[key]),
            "cells_per_second": cells / seconds if cells else None,
            "times_curvewise": {lv: seconds / timings[lv].seconds for lv in (active, *others)},
        }

    for k, contender in enumerate(contenders):
        contender.seconds, contender.size = timings[k].seconds, n
    found: Any = task.call()()
    own = found.distance if workload.measure == "dtw_path" else found
    return [result(f"curvewise {lv}", "", own, lv) for lv in (active, *others)] + [
        result(c.peer.package, c.peer.definition, c.value, k) for k, c in enumerate(contenders)
    ]


def print_workload(workload: Workload, results: list[dict[str, Any]]) -> None:
    """Print a table for each n that is shown, slow peers at the largest n they were timed at."""
    levels = list(results[0]["times_curvewise"])
    largest = max(r["n"] for r in results)
    for n in sorted({min(n, largest) for n in workload.shown}):
        latest = {(r["package"], r["definition"]): r for r in results if r["n"] <= n}
        rows = [
            [
                r["package"],
                r["definition"],
                r["check"],
                f"{r['n']}{'' if r['n'] == n else ' *'}",
                timing.duration(r["seconds"]),
                f"{r['cells_per_second'] / 1e9:.4f}" if r["cells_per_second"] else "",
                *(ratio(r["times_curvewise"][level]) for level in levels),
            ]
            for r in latest.values()
        ]
        header = ["package", "definition", "value", "n", "time", "10^9 cells/s"]
        header += [f"x {level}" for level in levels]
        timing.print_table(f"{workload.title}; n = {n}", header, rows)


def ratio(times: float) -> str:
    """Return a ratio with three digits, or more before the point."""
    return f"{times:.3g}" if times < 1000 else f"{times:.0f}"


def measure_fastdtw(module: Any, budget: float) -> list[dict[str, Any]]:
    """Time fastdtw and curvewise at growing n, until fastdtw is faster or the time is spent."""
    start = time.perf_counter()
    results: list[dict[str, Any]] = []
    for n in FASTDTW_SIZES:
        calls = {
            "curvewise": DTW.task(n).call(),
            "fastdtw": FASTDTW.prepare(module, *timing.curve_pair(n, n, 2)),
        }
        values: dict[str, Any] = {}
        samplers = {name: timing.sampler(kept(name, call, values)) for name, call in calls.items()}
        timings = timing.alternate(samplers, lambda seconds: 5 if seconds < 2 else 1)
        exact, approximate = (timings[name].seconds for name in calls)
        results.append(
            {
                "n": n,
                **{name: vars(timings[name]) for name in calls},
                "times_curvewise": approximate / exact,
                "relative_error": values["fastdtw"] / values["curvewise"] - 1,
            }
        )
        following = 2.5**2 * exact + 2.5 * approximate
        if approximate < exact or time.perf_counter() - start + following > budget:
            break
    return results


def kept(name: str, call: Callable[[], Any], values: dict[str, Any]) -> Callable[[], None]:
    """Return a call that keeps its value, so that a long one need not be repeated."""

    def keep() -> None:
        values[name] = call()

    return keep


def print_fastdtw(results: list[dict[str, Any]]) -> None:
    """Print the times of both, and up to which n the exact one is the faster."""
    rows = [
        [
            str(r["n"]),
            timing.duration(r["curvewise"]["seconds"]),
            timing.duration(r["fastdtw"]["seconds"]),
            str(r["fastdtw"]["samples"]),
            ratio(r["times_curvewise"]),
            f"{100 * r['relative_error']:.3g} %",
        ]
        for r in results
    ]
    header = ["n", "curvewise, exact", "fastdtw", "samples", "x curvewise", "fastdtw's error"]
    timing.print_table(f"DTW, 2-D, Euclidean, against {FASTDTW.definition}", header, rows)
    faster = [r["n"] for r in results if r["times_curvewise"] > 1]
    slower = [r["n"] for r in results if r["times_curvewise"] <= 1]
    print(f"  exact is faster up to n = {max(faster, default=0)}", end="")
    print(f", approximate at n = {min(slower)}" if slower else "; larger n were not tried")


def draw(
    workloads: list[Workload],
    results: list[dict[str, Any]],
    machine: dict[str, object],
    file: Path,
) -> None:
    """Draw time against n, a panel for each workload, a line for each package."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.2 * len(workloads), 7), layout="constrained")
    panels = figure.subplots(1, len(workloads), sharey=True, squeeze=False)[0]
    for panel, workload in zip(panels, workloads, strict=True):
        lines: dict[str, list[dict[str, Any]]] = {}
        for r in results:
            if r["workload"] == workload.name:
                nearest = f" ({r['definition']})" * (r["check"] == "other definition")
                wrong = " (wrong on some pairs)" * r["check"].startswith("WRONG")
                lines.setdefault(r["package"] + nearest + wrong, []).append(r)
        for label, line in lines.items():
            package, n = line[0]["package"], [r["n"] for r in line]
            panel.loglog(n, [r["seconds"] for r in line], label=label, **line_style(label, package))
        panel.set_title(workload.title)
        panel.set_xlabel("n = m")
        panel.grid(which="both", linewidth=0.4, alpha=0.5)
        panel.legend(fontsize=8, ncols=2, loc="upper center", bbox_to_anchor=(0.5, -0.12))
    panels[0].set_ylabel("seconds per call from Python, one thread")
    figure.suptitle(str(machine["cpu"]), fontsize=9)
    file.parent.mkdir(parents=True, exist_ok=True)
    save_picture(figure, file, dpi=130)
    print(f"written: {file}")


def line_style(label: str, package: str) -> dict[str, Any]:
    """Return a colour for each package, the same in all panels; dashed if not comparable."""
    levels = {"curvewise v4": "-", "curvewise v3": "--"}
    if package.startswith("curvewise"):
        return {"color": "black", "linewidth": 1.8, "linestyle": levels.get(package, ":")}
    colour = PACKAGE_COLOURS.get(package, "grey")
    return {
        "color": colour,
        "marker": "o",
        "markersize": 3.5,
        "linewidth": 1.2,
        "linestyle": "-" if label == package else (0, (2, 2)),
    }


if __name__ == "__main__":
    main()
