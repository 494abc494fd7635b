"""How curvewise's time and memory grow with n: by instruction-set level and by threads.

dtw, frechet and their paths on two curves of n points each, n from 10^2 to 10^5 (paths to 5·10^4).
Each combination of level and threads has a fresh process, whose peak memory is reported beside
that of a process which only imports curvewise; the processes of one n take their samples in turn.
Writes scaling.json.xz and scaling.webp.
"""

from __future__ import annotations

import argparse
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import timing
from stored import save_picture, write_json

SIZES = [100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000]
QUICK_SIZES = [100, 1000, 5000]
PATH_LARGEST = 50_000
MEASURES = ("dtw", "frechet", "dtw_path", "frechet_path")
THREADS = (1, 2)
LEVEL_COLOURS = {"v4": "#0072B2", "v3": "#009E73", "baseline": "#E69F00"}


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="three small n")
    parser.add_argument("--output", type=Path, default=timing.RESULTS, metavar="DIR")
    arguments = parser.parse_args()

    machine = timing.machine([])
    baseline = import_megabytes()
    print(f"{machine['cpu']}, {machine['cores']} cores; commit {machine['commit']}")
    print(f"peak memory of a process that only imports curvewise: {baseline:.0f} MB")
    tasks = [
        (measure, n)
        for measure in MEASURES
        for n in (QUICK_SIZES if arguments.quick else SIZES)
        if n <= PATH_LARGEST or not measure.endswith("_path")
    ]
    results: list[dict[str, Any]] = []
    for measure, n in timing.progress(tasks, "scaling"):
        results += measure_size(measure, n)
    add_ratios(results)
    for measure in MEASURES:
        print_measure(measure, results)
    content = {"machine": machine, "import_megabytes": baseline, "results": results}
    write_json(arguments.output / "scaling.json.xz", content)
    draw(results, machine, arguments.output / "scaling.webp")


def import_megabytes() -> float:
    """Return the peak memory of a process that has imported curvewise and does nothing."""
    with timing.FreshProcess(None, timing.active_level()) as process:
        return process.peak_megabytes()


def measure_size(measure: str, n: int) -> list[dict[str, Any]]:
    """Time one measure at one n, every level and number of threads in turn."""
    with ExitStack() as stack:
        processes = {
            (level, threads): stack.enter_context(
                timing.FreshProcess(timing.Task(measure, n, n, 2, {"workers": threads}), level)
            )
            for level in timing.levels()
            for threads in THREADS
        }
        samplers = {key: process.sample for key, process in processes.items()}
        timings = timing.alternate(samplers, rounds)
        return [
            {
                "measure": measure,
                "n": n,
                "level": level,
                "threads": threads,
                **vars(timings[level, threads]),
                "cells_per_second": n * n / timings[level, threads].seconds,
                "peak_megabytes": process.peak_megabytes(),
            }
            for (level, threads), process in processes.items()
        ]


def rounds(seconds: float) -> int:
    """Take fewer samples of what takes long."""
    if seconds <= 3:
        return 7
    return 3 if seconds <= 10 else 1


def add_ratios(results: list[dict[str, Any]]) -> None:
    """Add the speed-up over one thread, and a path's time over that of its distance."""
    keys = ("measure", "n", "level", "threads")
    seconds = {tuple(result[key] for key in keys): result["seconds"] for result in results}
    for result in results:
        measure, n, level, threads = (result[key] for key in keys)
        result["speedup"] = seconds[measure, n, level, 1] / result["seconds"]
        distance = seconds[measure.removesuffix("_path"), n, level, threads]
        result["times_distance"] = result["seconds"] / distance


def print_measure(measure: str, results: list[dict[str, Any]]) -> None:
    """Print the table of one measure."""
    is_path = measure.endswith("_path")
    header = ["n", "level", "threads", "time", "samples", "10^9 cells/s", "x 1 thread"]
    header += ["x distance"] * is_path + ["peak MB"]
    rows = [
        [
            str(r["n"]),
            r["level"],
            str(r["threads"]),
            timing.duration(r["seconds"]),
            str(r["samples"]),
            f"{r['cells_per_second'] / 1e9:.3f}",
            f"{r['speedup']:.2f}",
            *([f"{r['times_distance']:.2f}"] * is_path),
            f"{r['peak_megabytes']:.0f}",
        ]
        for r in results
        if r["measure"] == measure
    ]
    timing.print_table(f"{measure}, 2-D Euclidean, n = m", header, rows)


def draw(results: list[dict[str, Any]], machine: dict[str, object], file: Path) -> None:
    """Draw cells per second against n, a panel for each measure."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 7.5), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for panel, measure in zip(panels.flat, MEASURES, strict=True):
        for level in timing.levels():
            for threads in THREADS:
                points = [
                    (r["n"], r["cells_per_second"])
                    for r in results
                    if (r["measure"], r["level"], r["threads"]) == (measure, level, threads)
                ]
                panel.loglog(
                    *zip(*points, strict=True),
                    marker="o",
                    markersize=3.5,
                    linestyle="-" if threads == 1 else "--",
                    color=LEVEL_COLOURS.get(level, "black"),
                    label=f"{level}, {threads} thread{'s' * (threads > 1)}",
                )
        panel.set_title(measure)
        panel.grid(which="both", linewidth=0.4, alpha=0.5)
    for panel in panels[1]:
        panel.set_xlabel("n = m")
    for panel in panels[:, 0]:
        panel.set_ylabel("cells of the table per second")
    panels[0, 0].legend(fontsize=8)
    figure.suptitle(str(machine["cpu"]), fontsize=9)
    save_picture(figure, file, dpi=130)
    print(f"written: {file}")


if __name__ == "__main__":
    main()
