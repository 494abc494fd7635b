"""Seconds that an identification takes beside the model: a test of thousands of points.

A Chaboche model of six parameters on a test of DP780 (7,816 points, taken as they are), area, by
"sdrm" and by "trust-region". The model runs along 400 points of the test's strain, and its own time
is taken off.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from material_points import SIX_BOUNDS, material_point, of_six
from places import LOOPS

from curvewise import read_curve
from curvewise.calibration import identify


def main() -> None:
    """Identify by two methods, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--file", default="dp780_tct_6pct.csv")
    parser.add_argument("--methods", nargs="+", default=["sdrm", "trust-region"])
    options = parser.parse_args()
    test = read_curve(LOOPS / options.file)
    strain = test[np.linspace(0, len(test) - 1, 400).astype(int), 0]
    seconds = 0.0

    point = material_point(of_six, strain)

    def model(p):
        nonlocal seconds
        begin = time.perf_counter()
        curves = point(p)
        seconds += time.perf_counter() - begin
        return curves

    print(f"{options.file}: {len(test)} points")
    for method in options.methods:
        seconds, begin = 0.0, time.perf_counter()
        found = identify(model, [test], SIX_BOUNDS, measure="area", method=method, progress=False)
        total = time.perf_counter() - begin
        print(
            f"{method}: value {found.value:.5g}, {found.evaluations} runs, "
            f"{total - seconds:.2f} s outside the model, {seconds:.2f} s in it"
        )


if __name__ == "__main__":
    main()
