"""Write results.md from what run.py --json wrote: packages by checks, and what differs.

python conformance/report.py results.json > conformance/results.md
"""

from __future__ import annotations

import argparse
import datetime
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from run import shown
from verify import CHECKS

HEADS = {
    "frechet": "Fréchet",
    "frechet-continuous": "Fréchet, cont.",
    "hausdorff": "Hausd.",
    "hausdorff-directed": "Hausd., dir.",
    "area": "area",
    "dtw": "dtw",
    "dtw-squared": "sq.",
    "dtw-squared-root": "root",
    "dtw-symmetric2": "sym.2",
    "dtw-asymmetric": "asym.",
    "dtw-window": "window",
    "dtw-window-difference": "w. diff.",
    "dtw-window-scaled": "w. scaled",
    "dtw-window-widened": "w. widened",
    "dtw-penalty": "penalty",
    "dtw-open-end": "open end",
    "dtw-subsequence": "subseq.",
}
INTRODUCTION = """\
# Results

Written by `report.py` on {date} from `run.py --random {random}`: the cases, and that many random
pairs of lattice points a check. Each number was compared with its exact value, to 1e-9 of it. Each
counterexample below was shortened by deleting points and coordinates, with the value of exact
arithmetic. A package that differs may have another definition; the row then gives it. If an adapter
calls your package in a wrong way, please tell us: the adapters are short.
"""


def cell_of_values(counts: dict[str, int]) -> str:
    """Return how many numbers pass, of those that the package gave or should have given."""
    asked = {key: k for key, k in counts.items() if key not in ("not offered", "not run")}
    total, right = sum(asked.values()), asked.get("pass", 0)
    if not total:
        return "–"
    refused = asked.get("raises", 0)
    text = "all" if right == total else f"{right}/{total - refused}"
    faults = [f"{asked[key]} {key}" for key in ("crashed", "hung") if key in asked]
    return ", ".join([text, *([f"refuses {refused}"] if refused else []), *faults])


def cell_of_refusals(counts: dict[str, int]) -> str:
    """Return what becomes of curves that are none."""
    asked = {key: k for key, k in counts.items() if key not in ("not offered", "not run")}
    total = sum(asked.values())
    if asked.get("raises", 0) == total:
        return "all" if total else "–"
    others = [f"{k} {key}" for key, k in asked.items() if key != "raises"]
    return ", ".join([f"{asked.get('raises', 0)}/{total}", *sorted(others)])


def table(
    results: list[dict[str, Any]], kind: str, cell: Callable[[dict[str, int]], str]
) -> list[str]:
    """Return a table of packages by checks."""
    told = {name for r in results for name, c in r["checks"].items() if kind in c["counts"]}
    asked = [name for name in CHECKS if name in told]
    lines = ["| package | " + " | ".join(HEADS[name] for name in asked) + " |"]
    lines.append("|---" * (len(asked) + 1) + "|")
    for result in results:
        cells = []
        for name in asked:
            counts = result["checks"].get(name, {"counts": {}})["counts"].get(kind, {})
            mark = "*" if name in result["other"] and counts else ""
            cells.append(cell(counts) + mark)
        lines.append(f"| {result['package']} | " + " | ".join(cells) + " |")
    return lines


def differences(results: list[dict[str, Any]], kind: str) -> list[str]:
    """Return a line for each shortest counterexample."""
    lines = []
    for result in results:
        for name, found in result["checks"].items():
            example = found["examples"].get(kind)
            if not example:
                continue
            note = result["notes"].get(name, "")
            if name in result["other"]:
                note = f"another definition: {result['other'][name]}"
            lines.append(
                f"- **{result['package']}**, {name}: {example['found']} for {example['exact']}; "
                f"{shown(example)}." + (f" {note[0].upper()}{note[1:]}." if note else "")
            )
    return lines


def main() -> None:
    """Print the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("--random", type=int, default=200, help="what run.py was given")
    arguments = parser.parse_args()
    results = json.loads(arguments.results.read_text(encoding="utf-8"))
    results = [r for r in results if "checks" in r]
    print(INTRODUCTION.format(date=datetime.date.today(), random=arguments.random))
    print("| package | version | licence |\n|---|---|---|")
    for r in results:
        print(f"| {r['package']} | {r['version']} | {r['licence']} |")
    print("\n## Values\n\n`all`: every number passes; `–`: not offered; `*`: another definition.\n")
    print("\n".join(table(results, "usual", cell_of_values)))
    print("\n## Where numbers differ\n")
    print("\n".join(differences(results, "usual")))
    print("\n## Ends of a double's range\n\nSquares that overflow or vanish, last bits.\n")
    print("\n".join(table(results, "extreme", cell_of_values)))
    print("\n## Invalid curves\n\nNaN, infinity, no points, other dimensions: `all` raise.\n")
    print("\n".join(table(results, "refused", cell_of_refusals)))


if __name__ == "__main__":
    main()
