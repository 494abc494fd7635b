"""Seconds that an identification takes beside the model: a test of thousands of points.

A Chaboche model of six parameters on a test of DP780 (7,816 points, taken as they are), area, by
"sdrm" and by "trust-region". The model runs along 400 points of the test's strain, and its own time
is taken off.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "paper"))

import femu_calculix as femu  # noqa: E402 (a folder beside this one)
from two_seeds import BOUNDS  # noqa: E402

from curvewise import datasets, read_curve  # noqa: E402
from curvewise.calibration import identify  # noqa: E402


def main() -> None:
    """Identify by two methods, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--file", default="dp780_tct_6pct.csv")
    parser.add_argument("--methods", nargs="+", default=["sdrm", "trust-region"])
    options = parser.parse_args()
    test = read_curve(femu.DATA / options.file)
    strain = test[np.linspace(0, len(test) - 1, 400).astype(int), 0]
    seconds = 0.0

    def model(p):
        nonlocal seconds
        begin = time.perf_counter()
        stress = datasets.kinematic_hardening(
            strain,
            youngs_modulus=p["E"],
            yield_stress=p["yield"],
            backstresses=((p["C1"], p["gamma1"]), (p["C2"], p["gamma2"])),
        )
        seconds += time.perf_counter() - begin
        return np.column_stack((strain, stress))

    print(f"{options.file}: {len(test)} points")
    for method in options.methods:
        seconds, begin = 0.0, time.perf_counter()
        found = identify(model, test, BOUNDS, measure="area", method=method, progress=False)
        total = time.perf_counter() - begin
        print(
            f"{method}: value {found.value:.5g}, {found.evaluations} runs, "
            f"{total - seconds:.2f} s outside the model, {seconds:.2f} s in it"
        )


if __name__ == "__main__":
    main()
