"""Many curves at once: curvewise.pdist against the batch functions of other packages.

For each batch of batches.py the values are compared first; then every package at one and at two
threads is timed in alternation, each in a process of its own. Then what concerns curvewise alone:
ragged curves per cell, the discrete Fréchet distance of 2,000 curves against a single pair timed in
C++ (bench_kernels), the memory beyond input and output, what progress costs, and whether it is
steady. Prints tables; writes pairwise.json.xz.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import importlib.util
import math
import re
import statistics
import subprocess
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import batches
import numpy as np
from batches import BATCHES, FRECHET_LARGE, Batch, BatchProcess, Contender
from stored import write_json
from timing import Array

import curvewise

TOLERANCE = 1e-9
THREADS = (1, 2)
KERNELS = Path(__file__).parents[2] / "build/dev/benchmarks/speed/cpp/bench_kernels"
QUICK_COUNT = 12
PROGRESS_PAIRS = 9
# A rate is taken over so many reports, some twenty of which come in a second.
RATE_REPORTS = 5


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help=f"{QUICK_COUNT} curves, no results")
    parser.add_argument("--output", type=Path, default=timing.RESULTS, metavar="DIR")
    parser.add_argument("--batches", nargs="+", choices=BATCHES, default=list(BATCHES))
    parser.add_argument("--kernels", type=Path, default=KERNELS, metavar="bench_kernels")
    arguments = parser.parse_args()

    packages = {peer.package for batch in BATCHES.values() for peer in batch.peers}
    machine = timing.machine(sorted(packages))
    print(
        f"{machine['cpu']}, {machine['cores']} cores; curvewise at {timing.active_level()}; "
        f"commit {machine['commit']}"
    )
    results: list[dict[str, Any]] = []
    for name in timing.progress(arguments.batches, "batches"):
        batch = BATCHES[name].smaller(QUICK_COUNT) if arguments.quick else BATCHES[name]
        found = measure_batch(batch)
        print_batch(batch, found)
        results += found
    large = FRECHET_LARGE.smaller(QUICK_COUNT) if arguments.quick else FRECHET_LARGE
    count = QUICK_COUNT if arguments.quick else 300
    content = {
        "machine": machine,
        "results": results,
        "single_pair": single_pair(arguments.kernels, machine["level"]),
        "memory": [memory(large, threads) for threads in THREADS],
        "progress_cost": progress_cost(batches.equal(count, 200)),
        "progress_rate": progress_rate(batches.ragged(2 * count, 20, 500)),
    }
    print_own(content)
    write_json(arguments.output / "pairwise.json.xz", content)


def measure_batch(batch: Batch) -> list[dict[str, Any]]:
    """Compare the values of every package with curvewise's, then time them in turn."""
    contenders = {c.package: c for c in batch.contenders() if is_installed(c)}
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        processes = {
            (package, threads): stack.enter_context(BatchProcess(batch, package, threads))
            for package in contenders
            for threads in THREADS
        }
        checks = {
            key: check(batch, contenders[key[0]], process, folder / "values.npy")
            for key, process in processes.items()
        }
        samplers = {key: process.sample for key, process in processes.items()}
        timings = timing.alternate(samplers, rounds)
    cells = batches.cells(batch.lengths)
    return [
        {
            "batch": batch.name,
            "curves": len(batch.lengths),
            "cells": cells,
            "package": package,
            "definition": contenders[package].definition,
            "check": checks[package, threads],
            "threads": threads,
            **vars(taken),
            "cells_per_second": cells / taken.seconds,
            "times_curvewise": taken.seconds / timings["curvewise", threads].seconds,
            "speedup": timings[package, 1].seconds / taken.seconds,
        }
        for (package, threads), taken in timings.items()
    ]


def is_installed(contender: Contender) -> bool:
    """Whether a package can be imported; if not, say so."""
    found = importlib.util.find_spec(contender.module.partition(".")[0]) is not None
    if not found:
        print(f"skipped: {contender.package} (not installed)")
    return found


def check(batch: Batch, contender: Contender, process: BatchProcess, file: Path) -> str:
    """Say whether all values are what curvewise gives for the contender's definition."""
    process.save_values(str(file))
    values: Array = np.load(file)
    right = curvewise.pdist(
        batches.loops(batch.lengths), batch.measure, workers=-1, **contender.options
    )
    wrong = ~np.isclose(values, right, rtol=TOLERANCE, atol=0.0)
    if wrong.any():
        k = int(wrong.argmax())
        return f"WRONG {wrong.sum()}/{len(right)}: {values[k]:.6g} for {right[k]:.6g}"
    return "equal" if contender.options == batch.options else "other definition"


def rounds(seconds: float) -> int:
    """Return the number of samples, from the seconds that one of each takes."""
    return max(5, min(15, int(60 / seconds)))


def print_batch(batch: Batch, results: list[dict[str, Any]]) -> None:
    """Print the table of a batch, and who is the fastest with the same definition."""
    header = ["package", "definition", "value", "threads", "time", "samples", "10^9 cells/s"]
    header += ["x curvewise", "x 1 thread"]
    rows = [
        [
            r["package"],
            r["definition"],
            r["check"],
            str(r["threads"]),
            timing.duration(r["seconds"]),
            str(r["samples"]),
            f"{r['cells_per_second'] / 1e9:.4f}",
            f"{r['times_curvewise']:.3g}",
            f"{r['speedup']:.2f}",
        ]
        for r in results
    ]
    lengths = sorted(set(batch.lengths))
    points = f"{lengths[0]}" if len(lengths) == 1 else f"{lengths[0]} to {lengths[-1]}"
    title = f"{batch.title}: all pairs of {len(batch.lengths)} curves of {points} points"
    timing.print_table(title, header, rows)
    for threads in THREADS:
        same = [
            r
            for r in results
            if (r["threads"], r["check"]) == (threads, "equal") and r["package"] != "curvewise"
        ]
        if same:
            fastest = min(same, key=lambda r: r["seconds"])
            print(
                f"  {threads} thread{'s' * (threads > 1)}: the fastest with the same definition is "
                f"{fastest['package']}, {fastest['times_curvewise']:.2f} x curvewise's time"
            )


def single_pair(kernels: Path, level: object) -> float | None:
    """Return cells per second of one Fréchet sweep of 100 by 100 points, in C++ alone."""
    if not kernels.exists():
        print(f"\nskipped: the single pair in C++ (no {kernels}; benchmarks/README.md builds it)")
        return None
    printed = subprocess.run([kernels], capture_output=True, text=True, check=True).stdout
    line = next(x for x in printed.splitlines() if re.match(r"frechet .* 100 x 2-D", x))
    found = re.search(rf" {level} +[\d.]+ us +([\d.]+)", line)
    assert found, f"bench_kernels prints no rate of level {level}: {line}"
    return float(found[1]) * 1e9


def memory(batch: Batch, threads: int) -> dict[str, float]:
    """Return the bytes of a call's packed input and output, and those of its peak beyond them."""
    count = len(batch.lengths)
    packed = 2 * 8 * 2 * sum(batch.lengths)  # a copy as rows, one as columns; two coordinates
    output = 8 * count * (count - 1) // 2
    with BatchProcess(batch, "curvewise", threads) as process:
        beyond = process.memory_beyond(packed + output)
    return {"threads": threads, "packed": packed, "output": output, "beyond": beyond}


def progress_cost(lengths: tuple[int, ...]) -> dict[str, float]:
    """Return the share by which a progress function makes a call longer: the median of pairs."""
    curves = batches.loops(lengths)
    plain = timing.sampler(lambda: curvewise.pdist(curves))
    watched = timing.sampler(lambda: curvewise.pdist(curves, progress=lambda done, total: None))
    shares = []
    for k in range(PROGRESS_PAIRS + 1):
        # Each goes first in turn: what the first call leaves behind weighs on neither.
        first, second = (plain, watched) if k % 2 else (watched, plain)
        seconds = {id(first): first(1), id(second): second(1)}
        shares.append(seconds[id(watched)] / seconds[id(plain)] - 1.0)
    return {
        "median": statistics.median(shares[1:]),
        "least": min(shares[1:]),
        "most": max(shares[1:]),
        "pairs": PROGRESS_PAIRS,
        "seconds": seconds[id(plain)],
    }


def progress_rate(lengths: tuple[int, ...]) -> list[dict[str, Any]]:
    """Record what progress reports of very unequal curves, and how straight a line it makes."""
    curves = batches.loops(lengths)
    found = []
    for threads in THREADS:
        reports: list[tuple[float, int, int]] = []
        start = time.perf_counter()
        curvewise.pdist(
            curves,
            workers=threads,
            progress=lambda done, total, reports=reports, start=start: reports.append(
                (time.perf_counter() - start, done, total)
            ),
        )
        found.append({"threads": threads, **steadiness(reports)})
    return found


def steadiness(reports: list[tuple[float, int, int]]) -> dict[str, Any]:
    """Return the spread of the rate, and how far from the truth the reports' forecast is."""
    seconds, done, total = (
        np.array(column, dtype=np.float64) for column in zip(*reports, strict=True)
    )
    share = done / total
    step = min(RATE_REPORTS, len(reports) - 1)
    if step == 0:
        return {"reports": len(reports), "seconds": float(seconds[-1])}
    slopes = (share[step:] - share[:-step]) / (seconds[step:] - seconds[:-step])
    middle = float(np.median(slopes))
    return {
        "reports": len(reports),
        "seconds": float(seconds[-1]),
        "slope_5_percent": float(np.quantile(slopes, 0.05)) / middle,
        "slope_95_percent": float(np.quantile(slopes, 0.95)) / middle,
        "largest_gap_from_line": float(np.abs(share - seconds / seconds[-1]).max()),
        "curve": [[round(float(t), 4), float(s)] for t, s in zip(seconds, share, strict=True)],
    }


def print_own(content: dict[str, Any]) -> None:
    """Print what concerns curvewise alone."""
    rates = {
        (r["batch"], r["threads"]): r["cells_per_second"]
        for r in content["results"]
        if r["package"] == "curvewise"
    }
    print("\ncurvewise alone")
    for threads in THREADS:
        whole, pieces = (rates.get((name, threads), math.nan) for name in ("dtw", "dtw-ragged"))
        print(
            f"  ragged: {pieces / whole:.3f} of equal curves' cells per second, {threads} threads"
        )
    if content["single_pair"]:
        share = rates.get(("frechet-large", 1), math.nan) / content["single_pair"]
        print(f"  pdist frechet, cells per second over those of one pair in C++: {share:.3f}")
    for m in content["memory"]:
        megabytes = (f"{m[key] / 1e6:.1f} MB" for key in ("packed", "output", "beyond"))
        print(
            "  memory with {} threads: packed {}, output {}, beyond {}".format(
                m["threads"], *megabytes
            )
        )
    cost = content["progress_cost"]
    print(
        f"  progress costs {100 * cost['median']:.2f} % of {timing.duration(cost['seconds'])} "
        f"({100 * cost['least']:.2f} to {100 * cost['most']:.2f} %, {cost['pairs']} pairs of calls)"
    )
    for rate in content["progress_rate"]:
        print(f"  progress of {rate['threads']} threads: {rate['reports']} reports", end="")
        if "curve" in rate:
            print(
                f", 90 % of the rates within {rate['slope_5_percent']:.2f} to "
                f"{rate['slope_95_percent']:.2f} of their median, at most "
                f"{100 * rate['largest_gap_from_line']:.1f} % of the whole from a straight line",
                end="",
            )
        print()


if __name__ == "__main__":
    main()
