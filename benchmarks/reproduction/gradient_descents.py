"""Section 4's advice: gradient-based searches for smooth objectives, put to the test.

The hardening loops without noise, by scipy's L-BFGS-B with forward differences, from starts drawn
within Table 2's bounds, the same for every measure; and how much of what the paper's search found
each reaches. Area by the paper's rearrangement of crossing quadrilaterals, and "split". Forward
differences with a step of 1e-4 of the range see a rough objective's roughness as a user's would. CB
begins above SIGY's upper bound, so that every point has a response. Cost: some 1,000 runs a start.
"""

from __future__ import annotations

import numpy as np
from hardening import CLEAN, fits, model, tests
from problems import MEASURES, TITLES, Array, hardening_bounds
from report import Run, table
from scipy.optimize import minimize

from curvewise.calibration import Criterion, Objective

STEP = 1e-4  # of the range
STARTS = 10
CRITERIA = {
    **{TITLES[m]: (m, Criterion(m, preset="paper", min_coverage=0.0)) for m in MEASURES},
    "Area, split": ("area", Criterion("area", preset="paper", crossing="split")),
}


def main() -> None:
    """Descend, compare, write."""
    run = Run(__doc__, workers=1)
    found = fits(run, [CLEAN])[CLEAN]
    rows = []
    for name, (measure, criterion) in CRITERIA.items():
        objective = Objective(tests(CLEAN), criterion)
        optimum = objective(model()(found[measure].parameters))
        ends = descents(objective, 1 if run.quick else STARTS)
        ratios = np.array([value for value, _ in ends]) / optimum
        cells = [f"{(ratios < limit).sum()} of {len(ends)}" for limit in (1.01, 1.05)]
        shares = [f"{np.median(ratios):.3f}", f"{ratios.min():.3f}"]
        rows.append([name, *cells, *shares, f"{np.median([runs for _, runs in ends]):.0f}"])
    header = ["objective", "within 1 %", "within 5 %", "median over optimum", "least", "runs"]
    run.section("gradient_descents", table(header, rows))


def descents(objective: Objective, count: int) -> list[tuple[float, int]]:
    """Return value and runs at the end of a descent from each start."""
    bounds = hardening_bounds()
    bounds["CB"] = (bounds["SIGY"][1] + 1.0, bounds["CB"][1])
    low, high = np.array(list(bounds.values())).T

    def value(unit: Array) -> float:
        parameters = dict(zip(bounds, low + unit * (high - low), strict=True))
        return objective(model()(parameters))

    random = np.random.Generator(np.random.PCG64(4))
    options = {"eps": STEP, "maxfun": 3000}
    limits = [(0.0, 1.0)] * len(bounds)
    ends = []
    for start in random.uniform(size=(count, len(bounds))):
        result = minimize(value, start, method="L-BFGS-B", bounds=limits, options=options)
        ends.append((float(result.fun), int(result.nfev)))
    return ends


if __name__ == "__main__":
    main()
