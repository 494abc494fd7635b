"""Is a problem that its tests do not determine told from one that they do?

The paper's problem, nine parameters of five tension–compression loops, from its own optimum for the
area (Table 3); and three parameters of a loop with noise. Prints what the uncertainty says of both.
"""

from __future__ import annotations

import argparse
import itertools

import numpy as np
from paper_problems import problems

from curvewise import datasets
from curvewise.calibration import identify

CYCLE = np.concatenate(
    [np.linspace(a, b, 40, endpoint=False) for a, b in itertools.pairwise((0.0, 0.02, -0.02, 0.02))]
)
TRUTH = {"E": 200e3, "yield": 300.0, "C": 80e3}
BOUNDS = {"E": (150e3, 260e3), "yield": (150.0, 500.0), "C": (20e3, 200e3)}


def three(p):
    stress = datasets.kinematic_hardening(
        CYCLE,
        youngs_modulus=p["E"],
        yield_stress=p["yield"],
        backstresses=((p["C"], 400.0), (5e3, 20.0)),
    )
    return np.column_stack((CYCLE, stress))


def main() -> None:
    """Identify both, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--samples", type=int, default=100, help="of each bootstrap")
    options = parser.parse_args()
    test = three(TRUTH)
    test[:, 1] += np.random.default_rng(1).normal(0.0, 4.0, len(test))
    nine = identify(
        problems.HardeningModel.of_the_paper(),
        problems.test_loops(),
        problems.hardening_bounds(),
        start=problems.paper_parameters("area"),
        progress=False,
    )
    for found in (nine, identify(three, test, BOUNDS, progress=False)):
        print(found, found.uncertainty(samples=options.samples), sep="\n\n", end="\n\n\n")


if __name__ == "__main__":
    main()
