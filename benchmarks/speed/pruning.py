"""How much time it saves to leave out what cannot matter of the table, and on which curves.

dtw and frechet with prune=True and prune=False in alternation, one thread, on three sorts of
pairs: *similar*, a real loop against itself with 0.9 n points, 3 % larger, with noise of 0.001;
*moderate*, two tests of one material at other strain ranges; *unrelated*, random walks, white
noise, two materials. The tests are those of CURVEWISE_DATA/loops, scaled by the first one's box
and resampled along their index. Also both paths, the time and memory of a million points (in a
process of its own), files of tests as they are, and other packages at the largest n that they do
in a given time. Full sweeps of more than 20,000 points are extrapolated by n m, except for one.

Each part is measured in one run, most of them in less than a minute, and put into pruning.json.xz
beside the parts that are there; pruning.webp is drawn from all that is there.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import functools
import itertools
import multiprocessing
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pruning_curves import LOOPS, MATERIALS, MODERATE, NOISE, WALKS, data_dir, pair, read
from pruning_peers import peers
from stored import read_json, save_picture, write_json
from timing import Array

import curvewise

MEASURES = ("frechet", "dtw")
PACKAGES = ("dtaidistance", "fastdtw", "tsdistances", "traj-dist-rs")
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

    file = arguments.output / "pruning.json.xz"
    content: dict[str, Any] = read_json(file)
    for part in arguments.part:
        start = time.perf_counter()
        results = PARTS[part](effort)
        took = time.perf_counter() - start
        content[part] = {"machine": timing.machine(PACKAGES), "took": took, "results": results}
        print_results(f"{part} ({took:.0f} s)", results)
        write_json(file, content)
    draw(content, arguments.output / "pruning.webp")


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


PARTS = {
    "similar": similar,
    "million": million,
    "unrelated": unrelated,
    "paths": paths,
    "files": files,
    "growth": growth,
    "peers": lambda effort: peers(effort.peer_seconds),
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
    figure.suptitle(machine["cpu"], fontsize=9)
    file.parent.mkdir(parents=True, exist_ok=True)
    save_picture(figure, file, dpi=130)
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
