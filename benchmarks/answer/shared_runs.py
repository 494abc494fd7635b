"""Four measures on CalculiX, with a shared store and without: how many runs of the solver.

The problem of benchmarks/paper/femu_calculix.py: two tension–compression tests of DP780 sheet, an
element each, seven parameters; area, dtw, frechet and pcm in the paper's conditions. There four
searches by "sdrm" took 751 runs. Prints a table and, with --output, writes it as JSON with a
picture. The optima of the stored JSON of that script are beside it.
"""

from __future__ import annotations

import argparse
import json
import logging
import time
from pathlib import Path

import numpy as np
from paper_problems import cube, femu

from curvewise import read_curve
from curvewise.calibration import identify, identify_each, rescore

HERE = Path(__file__).resolve().parent


def main() -> None:
    """Identify with and without sharing, print, write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--alone", action="store_true", help="each measure by itself, too")
    parser.add_argument("--store", type=Path, default=femu.ROOT / "build" / "shared_runs.db")
    parser.add_argument("--output", type=Path, metavar="DIR", default=HERE)
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    samples = [femu.sampled(read_curve(femu.DATA / name), 200) for name in femu.TESTS]
    tests, paths = [test for test, _ in samples], [path for _, path in samples]
    model = cube.CubeModel(paths, femu.ROOT / "build" / "paper" / "femu_runs")
    shared = {"preset": "paper", "workers": options.workers}
    before = json.loads((HERE.parent / "paper" / "femu_calculix.json").read_text())["measures"]

    started = time.monotonic()
    found = identify_each(
        model, tests, femu.BOUNDS, measures=femu.MEASURES, store=options.store, **shared
    )
    print(found, f"in {time.monotonic() - started:.0f} s")
    result = {"shared": {}, "runs": found.runs, "sdrm_runs": 0}
    for measure, one in found.items():
        old = before[measure]
        result["sdrm_runs"] += old["evaluations"]
        row = {"value": one.value, "runs": one.runs, "sdrm": old["objective"]}
        if options.alone:
            alone = identify(
                model, tests, femu.BOUNDS, measure=measure, method="trust-region", **shared
            )
            row |= {"alone": alone.value, "alone_runs": alone.runs}
        result["shared"][measure] = row
        print(measure, row, flush=True)
    runs = len(rescore(options.store, tests, "curve_length").history)
    print(f"rescore of {runs} runs by another measure, without a solver")
    assert np.isfinite(found.optima).all()
    if options.output:
        options.output.mkdir(exist_ok=True)
        (options.output / "shared_runs.json").write_text(json.dumps(result, indent=1) + "\n")
        found.plot().savefig(options.output / "shared_runs.png", dpi=80)


if __name__ == "__main__":
    main()
