"""Four measures on CalculiX, with a shared store and without: how many runs of the solver.

The problem of femu_calculix.py: two tension–compression tests of DP780 sheet, an
element each, seven parameters; area, dtw, frechet and pcm. There, in the conditions of the paper,
four searches by "sdrm" took 751 runs; first it is made sure that their optima still have the values
that are stored. With --separate, every measure is searched for by itself, too, by the methods that
are named. Ends with a table, shared_runs.json and, for the conditions of the paper, a picture.

    python benchmarks/validation/shared_runs.py --separate trust-region

All runs are in stores in build/: a script that was interrupted goes on where it was. A search by
itself counts all of its evaluations, so that nothing is shared among these.
"""

from __future__ import annotations

import argparse
import json
import logging
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import calculix_cube as cube
import femu_calculix as femu
from places import BUILD, LOOPS, RESULTS

from curvewise import read_curve
from curvewise.calibration import (
    Criterion,
    Objective,
    SimulationStore,
    identify,
    identify_each,
    rescore,
)

SAME = 1e-9  # of a value, where the same code is computed anew


def main() -> None:
    """Identify with and without sharing, print, write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--preset", choices=("paper", "scaled"), default="paper")
    parser.add_argument("--separate", nargs="+", metavar="METHOD", default=[])
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--stores", type=Path, default=BUILD, metavar="DIR")
    parser.add_argument("--output", type=Path, metavar="DIR", default=RESULTS)
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    samples = [femu.sampled(read_curve(LOOPS / name), 200) for name in femu.TESTS]
    tests, paths = [test for test, _ in samples], [path for _, path in samples]
    options.stores.mkdir(parents=True, exist_ok=True)
    model = cube.CubeModel(paths, options.stores / "femu_runs")
    study = {"workers": options.workers, "progress": False}
    store = options.stores / f"shared_runs_{options.preset}.db"
    alone = options.stores / f"separate_runs_{options.preset}.db"

    started = time.monotonic()
    criteria = [Criterion(measure, preset=options.preset) for measure in femu.MEASURES]
    found = identify_each(model, tests, femu.BOUNDS, measures=criteria, store=store, **study)
    with SimulationStore(store) as runs:  # those of an interrupted script, too
        count = len(runs)
    print(found, f"{count} with those before; {time.monotonic() - started:.0f} s")
    shared = {"runs": count, "values": {measure: one.value for measure, one in found.items()}}
    results: dict[str, Any] = {"shared": shared}
    if options.preset == "paper":
        results["sdrm, stored"] = stored_searches(model, tests)
    for method in options.separate:
        one_by_one = [
            identify(
                model, tests, femu.BOUNDS, measure=criterion, method=method, store=alone, **study
            )
            for criterion in criteria
        ]
        results[method] = {
            "runs": sum(one.evaluations for one in one_by_one),
            "values": {one.measure: one.value for one in one_by_one},
        }
    print(table(results))
    rescored = rescore(store, tests, Criterion("curve_length", preset="scaled"))
    print(f"rescore of {len(rescored.history)} runs by another measure, without a solver")
    options.output.mkdir(exist_ok=True)
    path = options.output / "shared_runs.json"
    everything = json.loads(path.read_text()) if path.exists() else {}
    before = everything.get(options.preset, {})
    everything[options.preset] = {**before, **results}
    path.write_text(json.dumps(everything, indent=1) + "\n")
    if options.preset == "paper":
        found.plot().savefig(options.output / "shared_runs.png", dpi=80)


def stored_searches(model: Any, tests: Sequence[Any]) -> dict[str, Any]:
    """Return what femu_calculix.py found by "sdrm", having run its optima anew."""
    file = RESULTS / "femu_calculix.json"
    before = json.loads(file.read_text())["measures"]
    values = {}
    for measure, old in before.items():
        values[measure] = Objective(tests, Criterion(measure, preset="paper"))(
            model(old["parameters"])
        )
        if abs(values[measure] / old["objective"] - 1.0) > SAME:
            raise SystemExit(
                f"the optimum of {measure} is {values[measure]}, and {old['objective']} in {file}: "
                "run femu_calculix.py first"
            )
    return {"runs": sum(old["evaluations"] for old in before.values()), "values": values}


def table(results: dict[str, Any]) -> str:
    """Return runs and values, and how far those of the shared runs are above the others."""
    shared = results["shared"]["values"]
    lines = [
        "| searches | runs | " + " | ".join(shared) + " |",
        "|---|" + "---:|" * (1 + len(shared)),
    ]
    for name, row in results.items():
        values = " | ".join(f"{value:.6g}" for value in row["values"].values())
        lines.append(f"| {name} | {row['runs']} | {values} |")
    for name, row in results.items():
        if name != "shared":
            above = (100.0 * (shared[m] / value - 1.0) for m, value in row["values"].items())
            cells = " | ".join(f"{x:+.3f} %" for x in above)
            lines.append(f"| shared above {name} | | {cells} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
