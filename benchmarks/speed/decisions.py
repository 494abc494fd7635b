"""Decisions and distances of the continuous Fréchet distance, beside an older library's.

    cmake --build build --target bench_decisions
    python benchmarks/speed/decisions.py PROGRAM --before OLDER_PROGRAM --output decisions.md

The older program is built in the older sources, into which `cpp/bench_decisions.cpp`,
`cpp/plain_decision.hpp` and their target are copied.

Pairs of walks, of white noise and of loops are decided at 0.9, 1 and 1.1 of their distance. The
programs take turns, some pairs at a time. Each also times a plain decision that is not exact, the
yardstick (`cpp/plain_decision.hpp`): CGAL's Frechet_distance has the same filters, and is not in
Debian's CGAL 5. Where its rounded answer is another one, a pair does not count in the ratios.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
from pathlib import Path

import timing

FACTORS = ("0.9", "1.0", "1.1")
AT_A_TIME = 10
# A decision of white noise with 1,000 points takes 50 ms.
FEWER = {("noise", 1000): 5}
Row = list[float]


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--before", type=Path, help="the program of an older library")
    parser.add_argument("--pairs", type=int, default=100)
    parser.add_argument("--output", type=Path, help="a file for the tables")
    arguments = parser.parse_args()
    programs = [p for p in (arguments.before, arguments.program) if p is not None]
    decisions, distances = [], []
    cases = [
        (kind, n, dim) for kind in ("walk", "noise", "loop") for n in (100, 1000) for dim in (2, 3)
    ]
    for kind, n, dim in timing.progress(cases, "cases"):
        pairs = arguments.pairs // FEWER.get((kind, n), 1)
        results = measured(programs, (kind, str(n), str(dim)), pairs)
        case = [kind, str(n), str(dim), str(pairs)]
        decisions += [
            [*case, factor, *decision_cells(results, 1 + 3 * k)] for k, factor in enumerate(FACTORS)
        ]
        distances.append(case + [cell for rows in results for cell in spread(column(rows, 10))])
    names = ["before, µs", "µs"][-len(programs) :]
    spreads = [title for name in names for title in (name, "worst")]
    case_titles = ["curves", "points", "d", "pairs"]
    ratios = ["plain, µs", "worst", "ratio", "worst", "agree"]
    tables = table([*case_titles, "of the distance", *spreads, *ratios], decisions)
    tables += "\n" + table([*case_titles, *spreads], distances)
    print(tables)
    if arguments.output:
        arguments.output.write_text(tables, encoding="utf-8")


def measured(programs: list[Path], case: tuple[str, ...], pairs: int) -> list[list[Row]]:
    """Return the numbers of every pair, by program."""
    results: list[list[Row]] = [[] for _ in programs]
    for first in range(1, pairs + 1, AT_A_TIME):
        count = min(AT_A_TIME, pairs + 1 - first)
        for program, rows in zip(programs, results, strict=True):
            command = [str(program.resolve()), *case, str(count), str(first)]
            lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout
            rows += [[float(number) for number in line.split()] for line in lines.splitlines()]
    return results


def column(rows: list[Row], k: int) -> Row:
    """Return one of the numbers of every pair."""
    return [row[k] for row in rows]


def spread(values: Row) -> list[str]:
    """Return the median and the largest."""
    return [f"{statistics.median(values):.3g}", f"{max(values):.3g}"]


def decision_cells(results: list[list[Row]], k: int) -> list[str]:
    """Return times of the programs, of the plain decision, and ratios to it."""
    rows = results[-1]
    agreeing = [row for row in rows if row[k + 2]]
    ratios = [row[k] / row[k + 1] for row in agreeing]
    cells = [cell for one in results for cell in spread(column(one, k))]
    return [*cells, *spread(column(rows, k + 1)), *spread(ratios), f"{len(agreeing)}/{len(rows)}"]


def table(titles: list[str], rows: list[list[str]]) -> str:
    """Return a table in Markdown."""
    lines = [titles, ["---"] * len(titles), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


if __name__ == "__main__":
    main()
