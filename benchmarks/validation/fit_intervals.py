"""Are the intervals of `fit_material` as wide as its estimates scatter, if the model is wrong?

A Chaboche material with two back stresses is fitted to each measured loop. Its parameters are the
truth. The test of a draw is the fitted curve plus the residuals of this fit, shifted by a random
number of points, reversed and with the other sign at random, plus white noise of 2 MPa.
`fit_material` fits each draw from nothing: bounds, starts, intervals. Prints for each loop and
parameter the share of intervals that hold the truth, the median width in units of the 5 to 95 %
spread of the estimates, this spread in per cent of the value, the share of draws that do not
determine the parameter, and the share of intervals with an end at a bound. Such an end says that
values beyond it are possible. So the interval holds a truth beyond it.

    python benchmarks/validation/fit_intervals.py --draws 100
    python benchmarks/validation/fit_intervals.py --draws 40 --loop dp780_tct_3pct

A draw takes 0.5 to 2.5 s. Writes nothing: results/fit_intervals.md is its output.
"""

from __future__ import annotations

import argparse
import logging
import time
import warnings
from pathlib import Path

import numpy as np
from places import DATA

import curvewise
from curvewise.fitting import BeginningWarning, MaterialFit, UnitsWarning, fit_material
from curvewise.materials import ChabocheVoce

MATERIAL = ChabocheVoce(backstresses=2)
# Columns of files with more than strain and stress, and their factors.
COLUMNS = {"lcf_machine_3cycles": ["Strain 1 (%)", "Stress"]}
FACTORS = {"lcf_machine_3cycles": (0.01, 1.0)}
WHITE = 2.0  # MPa


def loops() -> dict[str, Path]:
    """Return the files of the measured loops by name."""
    files = [*(DATA / "loops").glob("*.csv"), *(DATA / "cyclic").glob("*.csv")]
    return {file.stem: file for file in sorted(files)}


def loop_of(file: Path) -> np.ndarray:
    """Return strain and stress of a file."""
    columns = COLUMNS.get(file.stem, ["e_true", "Sigma_true"] if "resslab" in file.stem else None)
    read = curvewise.read_curve(file, columns, factors=FACTORS.get(file.stem))
    return np.asarray(read)[:, :2]


def draw_of(truth: MaterialFit, seed: int) -> np.ndarray:
    """Return the test of one draw."""
    random, (test,) = np.random.default_rng(seed), truth.tests
    fitted = MATERIAL.stress(test[:, 0], truth.parameters)
    error = np.roll(test[:, 1] - fitted, random.integers(len(test)))
    error = error[::-1] if random.random() < 0.5 else error
    noise = error * random.choice((-1, 1)) + random.normal(0.0, WHITE, len(test))
    return np.column_stack((test[:, 0], fitted + noise))


def main() -> None:
    """Count and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--draws", type=int, default=100)
    parser.add_argument("--loop", action="append", choices=list(loops()), help="no others")
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    for ignored in (BeginningWarning, UnitsWarning):
        warnings.simplefilter("ignore", ignored)
    names = MATERIAL.names
    print(f"| loop | | {' | '.join(names)} | s a fit |\n|---|---|{'---:|' * (len(names) + 1)}")
    for loop, file in loops().items():
        if options.loop and loop not in options.loop:
            continue
        truth = fit_material(loop_of(file), MATERIAL, progress=False)
        begin = time.perf_counter()
        fits = [
            fit_material(draw_of(truth, seed), MATERIAL, progress=False)
            for seed in range(options.draws)
        ]
        seconds = (time.perf_counter() - begin) / options.draws
        right = np.array([truth.parameters[name] for name in names])
        found = np.array([[fit.parameters[name] for name in names] for fit in fits])
        said = [fit.uncertainty for fit in fits]
        low, high = np.array([[one.intervals[name] for name in names] for one in said]).T
        is_open = np.array([[one.open_ends[name] for name in names] for one in said])
        from_low = (right >= low.T) | is_open[:, :, 0]
        held = 100.0 * (from_low & ((right <= high.T) | is_open[:, :, 1])).mean(axis=0)
        spread = np.quantile(found, 0.95, axis=0) - np.quantile(found, 0.05, axis=0)
        widths = np.median(high - low, axis=1) / spread
        loose = 100.0 * np.mean([[not one.determined[name] for name in names] for one in said], 0)
        rows = {
            "held, %": [f"{share:.0f}" for share in held],
            "width / spread": [f"{width:.2f}" for width in widths],
            "spread, %": [f"{100.0 * one:.0f}" for one in spread / np.abs(right)],
            "not determined, %": [f"{share:.0f}" for share in loose],
            "ends at a bound, %": [f"{s:.0f}" for s in 100.0 * is_open.any(axis=2).mean(axis=0)],
        }
        for title, cells in rows.items():
            last = f"{seconds:.1f}" if title == "held, %" else ""
            print(f"| {loop} | {title} | {' | '.join(cells)} | {last} |", flush=True)


if __name__ == "__main__":
    main()
