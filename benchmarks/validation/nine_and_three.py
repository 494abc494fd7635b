"""Is a problem that its tests do not determine told from one that they do?

The paper's problem, nine parameters of five tension–compression loops, from its own optimum for the
area (Table 3); and three parameters of a loop with noise. Prints what the uncertainty says of both.
"""

from __future__ import annotations

import argparse

import numpy as np
import places  # noqa: F401 (it makes problems importable)
from material_points import THREE, THREE_BOUNDS, material_point, of_three, strain_path
from problems import HardeningModel, hardening_bounds, paper_parameters, test_loops

from curvewise.calibration import identify

CYCLE = strain_path(0.0, 0.02, -0.02, 0.02, points=40)


def main() -> None:
    """Identify both, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--samples", type=int, default=100, help="of each bootstrap")
    options = parser.parse_args()
    three = material_point(of_three, CYCLE)
    (test,) = three(THREE)
    test[:, 1] += np.random.default_rng(1).normal(0.0, 4.0, len(test))
    nine = identify(
        HardeningModel.of_the_paper(),
        test_loops(),
        hardening_bounds(),
        start=paper_parameters("area"),
        progress=False,
    )
    for found in (nine, identify(three, [test], THREE_BOUNDS, progress=False)):
        print(found, found.uncertainty(samples=options.samples), sep="\n\n", end="\n\n\n")


if __name__ == "__main__":
    main()
