"""Two seeds that disagree: a Chaboche model of six parameters on a cycle of TR1180 sheet.

What a new user would try: area, successive response surfaces, seeds 1 and 2. Both searches end by
their tolerances, with values less than 1 % apart and moduli an order of magnitude apart. The
summary has to say "undetermined", not "converged". Prints both and what the uncertainty says.
"""

from __future__ import annotations

import argparse

from femu_calculix import sampled
from material_points import SIX_BOUNDS, material_point, of_six
from places import LOOPS

from curvewise import read_curve
from curvewise.calibration import identify


def main() -> None:
    """Identify twice, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--method", default="sdrm")
    options = parser.parse_args()
    test, path = sampled(read_curve(LOOPS / "tr1180_tct_3pct.csv"), 200)

    model = material_point(of_six, path)
    for seed in (1, 2):
        found = identify(
            model,
            [test],
            SIX_BOUNDS,
            measure="area",
            method=options.method,
            seed=seed,
            progress=False,
        )
        print(found, "\n")
        print(found.uncertainty(samples=200), "\n")


if __name__ == "__main__":
    main()
