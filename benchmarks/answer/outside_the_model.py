"""Seconds that an identification takes beside the model: a test of thousands of points.

A Chaboche model of six parameters on a test of DP780 (7,816 points, taken as they are), area, by
"sdrm" and by "trust-region". The model runs along 400 points of the test's strain, and its own time
is taken off.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from paper_problems import femu
from two_seeds import BOUNDS

from curvewise import datasets, read_curve
from curvewise.calibration import identify


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
