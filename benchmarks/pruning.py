"""How much time it saves to leave out what cannot matter of the table, and on which curves.

dtw and frechet with prune=True and prune=False in alternation, one thread, on three sorts of
pairs: *similar*, a real loop against itself with 0.9 n points, 3 % larger, with noise of 0.001;
*moderate*, two tests of one material at other strain ranges; *unrelated*, random walks, white
noise, two materials. The tests are those of CURVEWISE_DATA/loops, scaled by the first one's box
and resampled along their index. Also both paths, the time and memory of a million points (in a
process of its own), files of tests as they are, and other packages at the largest n that they do
in a given time. Full sweeps of more than 20,000 points are extrapolated by n m, except for one.

Each part is measured in one run, most of them in less than a minute, and put into pruning.json
beside the parts that are there; pruning.png is drawn from all that is there.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import functools
import importlib
import itertools
import json
import math
import multiprocessing
import os
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from timing import Array

import curvewise

MEASURES = ("frechet", "dtw")
LOOPS = (
    "dp780_tct_6pct",
    "eddq_tct_5pct",
    "tr1180_tct_3pct",
    "resslab_cyclic_2pct",
    "resslab_random_protocol",
)
PEER_BYTES = 3 << 30
PACKAGES = ("dtaidistance", "fastdtw", "tsdistances", "traj-dist-rs")
MODERATE, WALKS, NOISE, MATERIALS = "moderate", "walks", "noise", "two materials"
COLOURS = {
    "similar": "#0072B2",
    MODERATE: "#009E73",
    WALKS: "#D55E00",
    NOISE: "#E69F00",
    MATERIALS: "#CC79A7",
}
MARKERS = dict(zip(PACKAGES, "sD^v", strict=True))


@dataclass(frozen=True)
class Effort:
    """How much to measure: sizes by part, and the seconds that another package's call may take."""

    similar: tuple[int, ...] = (4000, 20_000, 100_000)
    growth: tuple[int, ...] = (1000, 3000, 10_000, 30_000, 300_000)
    moderate: tuple[int, ...] = (1000, 3000, 10_000, 30_000, 100_000)
    unrelated: tuple[int, ...] = (100, 300, 1000, 3000, 10_000, 20_000)
    million: int = 1_000_000
    paths: int = 100_000
    largest_full: int = 20_000
    files: int | None = None  # how many, or all
    peer_seconds: float = 60.0


QUICK = Effort(
    (1000,), (300, 1000), (300, 1000), (100, 300), 3000, 1000, 1000, files=2, peer_seconds=0.01
)


def main() -> None:
    """Measure the parts that are asked for, print them, write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="tiny curves, a few seconds in all")
    parser.add_argument("--part", nargs="+", choices=PARTS, default=list(PARTS), metavar="PART")
    parser.add_argument("--peer-seconds", type=float, metavar="S", help="of the longest call")
    parser.add_argument("--output", type=Path, default=timing.RESULTS, metavar="DIR")
    arguments = parser.parse_args()
    effort = QUICK if arguments.quick else Effort()
    if arguments.peer_seconds is not None:
        effort = Effort(peer_seconds=arguments.peer_seconds)

    file = arguments.output / "pruning.json"
    content: dict[str, Any] = json.loads(file.read_text("utf-8")) if file.exists() else {}
    for part in arguments.part:
        start = time.perf_counter()
        results = PARTS[part](effort)
        took = time.perf_counter() - start
        content[part] = {"machine": timing.machine(PACKAGES), "took": took, "results": results}
        print_results(f"{part} ({took:.0f} s)", results)
        timing.write_json(file, content)
    draw(content, arguments.output / "pruning.png")


def data_dir() -> Path:
    """Return the folder of the data."""
    root = Path(__file__).resolve().parents[1]
    folder = Path(os.environ.get("CURVEWISE_DATA", root.parent / "shared" / "data"))
    if not (folder / "loops").is_dir():
        raise SystemExit(
            f"no loops in {folder}: set CURVEWISE_DATA to the folder that holds loops/"
        )
    return folder


@functools.cache
def read(file: Path) -> Array:
    """Read a curve, with or without a line of names."""
    has_names = (
        not file.read_text("utf-8").partition(",")[0].lstrip("-").startswith(tuple("0123456789"))
    )
    return np.loadtxt(file, delimiter=",", skiprows=int(has_names))


def loop(name: str) -> Array:
    """Return a test by its name."""
    return read(data_dir() / "loops" / f"{name}.csv")


def resampled(curve: Array, count: int) -> Array:
    """Take `count` points along the index, linearly between points."""
    index = np.linspace(0.0, len(curve) - 1.0, count)
    return np.column_stack([np.interp(index, np.arange(len(curve)), x) for x in curve.T])


def pair(curves: str, n: int) -> tuple[Array, Array]:
    """Make a pair: a loop's name for similar curves, or one of the other sorts."""
    random = np.random.Generator(np.random.PCG64(n))
    m = round(0.9 * n)
    if curves in (WALKS, NOISE):
        points = [random.normal(size=(count, 2)) for count in (n, m)]
        P, Q = (np.cumsum(p, axis=0) if curves == WALKS else p for p in points)
        return P, Q
    names = {
        MODERATE: ("dp780_tct_3pct", "dp780_tct_6pct"),
        MATERIALS: ("eddq_tct_5pct", "tr1180_tct_3pct"),
    }
    if curves in names:
        first, second = map(loop, names[curves])
        P, Q = curvewise.normalize(first, second)
        return resampled(P, n), resampled(Q, m)
    P, Q = curvewise.normalize(loop(curves), 1.03 * loop(curves))
    return resampled(P, n), resampled(Q, m) + random.normal(0.0, 0.001, (m, 2))


def rounds(seconds: float) -> int:
    """Return the number of samples, from the seconds that one of each takes."""
    return 15 if seconds < 0.15 else 9 if seconds < 0.6 else 3 if seconds < 2.0 else 1


def measure(curves: str, name: str, n: int, *, full: bool) -> dict[str, Any]:
    """Time a measure on a pair with pruning and, if `full`, without."""
    P, Q = pair(curves, n)
    function = getattr(curvewise, name)
    modes = (True, False) if full else (True,)
    samplers = {
        mode: timing.sampler(functools.partial(function, P, Q, prune=mode)) for mode in modes
    }
    timings = timing.alternate(samplers, rounds)
    result: dict[str, Any] = {
        "curves": curves,
        "measure": name,
        "n": n,
        "m": len(Q),
        "seconds": timings[True].seconds,
        "samples": timings[True].samples,
    }
    if full:
        result |= {"full_seconds": timings[False].seconds, "full": "measured"}
    if not name.endswith("_path"):
        info = getattr(curvewise, f"{name}_info")(P, Q)
        result |= {"share": info.share, "pruned": info.pruned}
    return result


def extrapolate(results: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Fill in the full sweeps that were not timed, by n m from the largest that was."""
    for result in results:
        same = [
            r
            for r in results
            if "full_seconds" in r and r["full"] == "measured" and r["measure"] == result["measure"]
        ]
        if "full_seconds" not in result and same:
            largest = max(same, key=lambda r: r["n"] * r["m"])
            cells = result["n"] * result["m"] / (largest["n"] * largest["m"])
            result |= {"full_seconds": largest["full_seconds"] * cells, "full": "extrapolated"}
    return results


def similar(effort: Effort) -> list[dict[str, Any]]:
    """Time each loop at each size; of the largest, one full sweep in all."""
    return extrapolate(
        [
            measure(curves, name, n, full=n <= effort.largest_full or curves == LOOPS[0])
            for n in effort.similar
            for curves in LOOPS
            for name in MEASURES
        ]
    )


def growth(effort: Effort) -> list[dict[str, Any]]:
    """Time one loop, and the moderately different pair, from short to long."""
    sizes = {LOOPS[0]: effort.growth, MODERATE: effort.moderate}
    return extrapolate(
        [
            measure(curves, name, n, full=n <= effort.largest_full)
            for curves, ns in sizes.items()
            for n in ns
            for name in MEASURES
        ]
    )


def unrelated(effort: Effort) -> list[dict[str, Any]]:
    """Time curves of which nothing can be left out."""
    return [
        measure(curves, name, n, full=True)
        for curves in (WALKS, NOISE, MATERIALS)
        for n in effort.unrelated
        for name in MEASURES
    ]


def paths(effort: Effort) -> list[dict[str, Any]]:
    """Time both paths, with pruning at the size, without at the largest that is allowed."""
    sizes = sorted({min(effort.paths, effort.largest_full), effort.paths})
    return extrapolate(
        [
            measure(LOOPS[0], f"{name}_path", n, full=n <= effort.largest_full)
            for n in sizes
            for name in MEASURES
        ]
    )


def million(effort: Effort) -> list[dict[str, Any]]:
    """Time the longest curves once each, in fresh processes, whose peak memory is reported."""
    context = multiprocessing.get_context("spawn")
    results = []
    for name in MEASURES:
        with context.Pool(1) as pool:
            results.append(pool.apply(measure_long, (LOOPS[0], name, effort.million)))
    return results


def measure_long(curves: str, name: str, n: int) -> dict[str, Any]:
    """Call the info function of a measure once."""
    P, Q = pair(curves, n)
    before = timing.peak_bytes()
    start = time.perf_counter()
    info = getattr(curvewise, f"{name}_info")(P, Q)
    return {
        "curves": curves,
        "measure": name,
        "n": n,
        "m": len(Q),
        "seconds": time.perf_counter() - start,
        "samples": 1,
        "share": info.share,
        "pruned": info.pruned,
        "phases": info.seconds,
        "megabytes": timing.peak_bytes() / 1e6,
        "megabytes_before": before / 1e6,
    }


def files(effort: Effort) -> list[dict[str, Any]]:
    """Time the paper's responses against their tests, and all loops against each other."""
    paper = data_dir() / "paper"
    sets = {
        "paper's responses": [
            (read(paper / "test" / f"loop_{file.stem[-1]}.csv"), read(file))
            for file in sorted((paper / "model").glob("*.csv"))
        ],
        "loops as they are": list(
            itertools.combinations(map(read, sorted((data_dir() / "loops").glob("*.csv"))), 2)
        ),
    }
    results = []
    for curves, pairs in sets.items():
        scaled = (curvewise.normalize(P, Q) for P, Q in pairs[: effort.files])
        chosen = [(P, Q) for P, Q in scaled]
        for name in MEASURES:
            samplers = {
                mode: timing.sampler(functools.partial(compute_all, name, chosen, mode))
                for mode in (True, False)
            }
            timings = timing.alternate(samplers, rounds)
            infos = [getattr(curvewise, f"{name}_info")(P, Q) for P, Q in chosen]
            cells = sum(len(P) * len(Q) for P, Q in chosen)
            results.append(
                {
                    "curves": curves,
                    "measure": name,
                    "pairs": len(chosen),
                    "seconds": timings[True].seconds,
                    "samples": timings[True].samples,
                    "full_seconds": timings[False].seconds,
                    "full": "measured",
                    "share": sum(info.cells_swept for info in infos) / cells,
                    "pruned": any(info.pruned for info in infos),
                }
            )
    return results


def compute_all(name: str, pairs: Sequence[tuple[Array, Array]], prune: bool) -> None:
    """Compute a measure of all pairs, one after the other."""
    function = getattr(curvewise, name)
    for P, Q in pairs:
        function(P, Q, prune=prune)


@dataclass(frozen=True)
class Peer:
    """Another package's call, and curvewise's for the same definition."""

    package: str
    module: str
    measure: str
    call: Callable[[Any, Any, Any], Any]
    dim: int = 2
    metric: str = "euclidean"
    as_lists: bool = False


# fastdtw gives an approximation; tsdistances has one dimension and squares.
PEERS = (
    Peer(
        "dtaidistance",
        "dtaidistance.dtw_ndim",
        "dtw",
        lambda m, P, Q: m.distance_fast(P, Q, inner_dist="euclidean", use_pruning=True),
    ),
    Peer(
        "fastdtw",
        "fastdtw",
        "dtw",
        lambda m, P, Q: m.fastdtw(P, Q, radius=1, dist=math.dist)[0],
        as_lists=True,
    ),
    Peer(
        "tsdistances",
        "tsdistances",
        "dtw",
        lambda m, P, Q: m.dtw_distance(P, Q, par=False),
        dim=1,
        metric="sqeuclidean",
    ),
    Peer("traj-dist-rs", "traj_dist_rs", "dtw", lambda m, P, Q: m.dtw(P, Q, "euclidean").distance),
    Peer(
        "traj-dist-rs",
        "traj_dist_rs",
        "frechet",
        lambda m, P, Q: m.discret_frechet(P, Q, "euclidean").distance,
    ),
)


def peers(effort: Effort) -> list[dict[str, Any]]:
    """Time every package at growing n, as long as the next call is expected to be short enough.

    Each has a process with little memory, which ends where the package keeps a whole table.
    """
    results = []
    context = multiprocessing.get_context("spawn")
    for k, peer in enumerate(PEERS):
        try:
            importlib.import_module(peer.module)
        except ImportError as error:
            print(f"skipped: {peer.package} ({error})")
            continue
        n, previous, result = 1000, 0.0, None
        with ProcessPoolExecutor(1, context, initializer=limit_memory) as process:
            # The first call compiles and loads.
            process.submit(measure_peer, k, 100).result()
            while result is None or growing(previous, result) <= effort.peer_seconds:
                previous = result["peer_seconds"] if result else 0.0
                try:
                    result = process.submit(measure_peer, k, n).result()
                except (BrokenProcessPool, MemoryError):
                    print(f"{peer.package}, {peer.measure}: no memory for n = {n}")
                    break
                results.append(result)
                n *= 2
    return results


def limit_memory() -> None:
    """Let this process have so much memory, where the system can limit it."""
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (PEER_BYTES, PEER_BYTES))


def growing(previous: float, result: dict[str, Any]) -> float:
    """Return the seconds that a call of twice the points is expected to take."""
    seconds: float = result["peer_seconds"]
    return seconds * (min(max(seconds / previous, 2.0), 4.0) if previous else 4.0)


def measure_peer(which: int, n: int) -> dict[str, Any]:
    """Time a package and curvewise once each on a pair of similar curves."""
    peer = PEERS[which]
    module = importlib.import_module(peer.module)
    P, Q = (c if peer.dim == 2 else c[:, 1].copy() for c in pair(LOOPS[0], n))
    given = [c.tolist() if peer.as_lists else c for c in (P, Q)]
    start = time.perf_counter()
    value = float(peer.call(module, *given))
    middle = time.perf_counter()
    exact = getattr(curvewise, peer.measure)(P, Q, metric=peer.metric)
    end = time.perf_counter()
    return {
        "curves": LOOPS[0],
        "package": peer.package,
        "measure": peer.measure,
        "dim": peer.dim,
        "metric": peer.metric,
        "n": n,
        "m": len(Q),
        "peer_seconds": middle - start,
        "seconds": end - middle,
        "relative_error": value / exact - 1.0,
    }


PARTS = {
    "similar": similar,
    "million": million,
    "unrelated": unrelated,
    "paths": paths,
    "files": files,
    "growth": growth,
    "peers": peers,
}


def print_results(title: str, results: Sequence[dict[str, Any]]) -> None:
    """Print a part's results."""
    header = ["curves", "measure", "n", "pruned", "other", "which", "ratio", "share", "MB, error"]
    rows = []
    for r in results:
        other = r.get("full_seconds", r.get("peer_seconds"))
        rows.append(
            [
                r["curves"],
                r["measure"],
                str(r.get("n", f"{r.get('pairs')} pairs")),
                timing.duration(r["seconds"]),
                timing.duration(other) if other else "",
                r.get("package", r.get("full", "")),
                f"{other / r['seconds']:.3g}" if other else "",
                f"{100 * r['share']:.3g} %" if "share" in r else "",
                f"{r['megabytes']:.0f}"
                if "megabytes" in r
                else f"{r['relative_error']:.2g}"
                if "relative_error" in r
                else "",
            ]
        )
    timing.print_table(title, header, rows)


def draw(content: dict[str, Any], file: Path) -> None:
    """Draw time against n, a panel for each measure, from the parts that are there."""
    from matplotlib.figure import Figure

    found = [r for part in content.values() for r in part["results"] if "n" in r]
    figure = Figure(figsize=(12, 6.4), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    for panel, name in zip(panels, MEASURES, strict=True):
        own = [r for r in found if r["measure"] == name and "package" not in r]
        for curves in (*LOOPS, *COLOURS):
            line = sorted((r for r in own if r["curves"] == curves), key=lambda r: r["n"])
            if line:
                draw_line(panel, curves, line)
        full = {r["n"]: r["full_seconds"] for r in own if r.get("full") == "measured"}
        if full:
            panel.loglog(*zip(*sorted(full.items()), strict=True), "k--", label="prune=False")
        for package in PACKAGES:
            line = [r for r in found if r.get("package") == package and r["measure"] == name]
            if line:
                label = package + " (approximate)" * (package == "fastdtw")
                label += " (1-D, squared)" * (package == "tsdistances")
                panel.loglog(
                    [r["n"] for r in line],
                    [r["peer_seconds"] for r in line],
                    color="#666666",
                    linestyle=(0, (2, 2)),
                    marker=MARKERS[package],
                    markersize=4,
                    label=label,
                )
        panel.set_title({"dtw": "DTW", "frechet": "Discrete Fréchet distance"}[name])
        panel.set_xlabel("n (m = 0.9 n)")
        panel.grid(which="both", linewidth=0.4, alpha=0.5)
        panel.legend(fontsize=8, loc="upper left")
    panels[0].set_ylabel("seconds per call from Python, one thread")
    machine = next(iter(content.values()))["machine"]
    figure.suptitle(f"curvewise {machine['commit']}, {machine['cpu']}", fontsize=9)
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=130)
    print(f"written: {file}")


def draw_line(panel: Any, curves: str, line: Sequence[dict[str, Any]]) -> None:
    """Draw the times of one pair of curves; similar loops share a colour and a label."""
    is_similar = curves in LOOPS
    panel.loglog(
        [r["n"] for r in line],
        [r["seconds"] for r in line],
        color=COLOURS["similar" if is_similar else curves],
        linewidth=1.2,
        marker="o",
        markersize=3.5,
        label="_" * (is_similar and curves != LOOPS[0])
        + ("similar (five loops)" if is_similar else curves),
    )


if __name__ == "__main__":
    main()
