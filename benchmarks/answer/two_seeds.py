"""Two seeds that disagree: a Chaboche model of six parameters on a cycle of TR1180 sheet.

What a new user would try: area, successive response surfaces, seeds 1 and 2. Both searches end by
their tolerances, with values less than 1 % apart and moduli an order of magnitude apart. The
summary has to say "undetermined", not "converged". Prints both and what the uncertainty says.
"""

from __future__ import annotations

import argparse

import numpy as np
from paper_problems import femu

from curvewise import datasets, read_curve
from curvewise.calibration import identify

BOUNDS = {
    "E": (150e3, 230e3),
    "yield": (200.0, 1000.0),
    "C1": (10e3, 500e3),
    "gamma1": (50.0, 2000.0),
    "C2": (500.0, 50e3),
    "gamma2": (0.0, 200.0),
}


def main() -> None:
    """Identify twice, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--method", default="sdrm")
    options = parser.parse_args()
    test, path = femu.sampled(read_curve(femu.DATA / "tr1180_tct_3pct.csv"), 200)

    def model(p):
        stress = datasets.kinematic_hardening(
            path,
            youngs_modulus=p["E"],
            yield_stress=p["yield"],
            backstresses=((p["C1"], p["gamma1"]), (p["C2"], p["gamma2"])),
        )
        return np.column_stack((path, stress))

    for seed in (1, 2):
        found = identify(
            model, test, BOUNDS, measure="area", method=options.method, seed=seed, progress=False
        )
        print(found, "\n")
        print(found.uncertainty(samples=200), "\n")


if __name__ == "__main__":
    main()
