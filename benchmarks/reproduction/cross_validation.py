"""Each loop predicted from the other four: the cross-validation of section 3.3.

As in the paper by SDRM alone, and beside the SDRM fits of all five loops.
"""

from __future__ import annotations

import numpy as np
from hardening import CLEAN, QUICK, SEARCH, all_measures, fits, model, number
from problems import LOOPS, MEASURES, TITLES, hardening_bounds, test_loops
from report import Run, table
from stores import cross_validate_all
from studies import Fold, Found, Task


def main() -> None:
    """Identify, predict, print, write."""
    run = Run(__doc__, workers=1)
    tasks = tasks_of(quick=run.quick)
    folds = cross_validate_all(list(tasks.values()), run.store("hardening"), run.options.workers)
    fitted = fits(run, [CLEAN])[CLEAN]
    text = cross_table({m: folds[task.name] for m, task in tasks.items()}, fitted)
    run.section("hardening_cross_validation", text)


def tasks_of(*, quick: bool = False) -> dict[str, Task]:
    """Return the cross-validation by each measure, with SDRM alone."""
    effort = QUICK if quick else SEARCH
    return {
        measure: Task(
            f"folds_{measure}",
            model(),
            test_loops(),
            hardening_bounds(),
            measure,
            {"sdrm": effort["sdrm"]},
            folds=True,
            material=True,
        )
        for measure in (MEASURES[:1] if quick else MEASURES)
    }


def cross_table(folds: dict[str, list[Fold]], fitted: dict[str, Found]) -> str:
    """Return each loop's value when it was left out, and when SDRM fitted all loops."""
    rows = []
    for measure, several in folds.items():
        responses = model()(fitted[measure].stages[0].parameters)
        pairs = zip(test_loops(), responses, strict=True)
        included = np.array([all_measures([P], [Q])[measure] for P, Q in pairs])
        left_out = np.array([fold.value for fold in several])
        cells = [
            f"{number(a, measure)} ({number(b, measure)})"
            for a, b in zip(left_out, included, strict=True)
        ]
        worse = int((left_out > included).sum())
        rows.append(
            [TITLES[measure], *cells, f"{worse} of 5", f"{left_out.sum() / included.sum():.2f}"]
        )
    header = ["left out (fitted)", *(f"loop {k}" for k in LOOPS), "worse left out", "ratio of sums"]
    return table(header, rows)


if __name__ == "__main__":
    main()
