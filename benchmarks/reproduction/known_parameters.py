"""Known parameters found again: the additional optimisation at the end of section 3.3.

The tests are the model's own response, so that a perfect fit exists. By SDRM and the evolution
from its optimum, as in the paper, and by the evolution alone, which SDRM cannot lead into a side
valley; Nelder–Mead after both.
"""

from __future__ import annotations

from collections.abc import Sequence

from hardening import SDRM, model, paper_values, parameter_error
from problems import MEASURES, TITLES, hardening_bounds
from report import Run, table
from stores import identify_all
from studies import Effort, Found, Task, evolution

TRUTH = {
    "CB": 700.0,
    "SIGY": 480.0,
    "C": 180.0,
    "K": 25.0,
    "RSAT": 400.0,
    "SB": 200.0,
    "H": 0.7,
    "C1": 0.03,
    "C2": 0.25,
}
SEARCHES = {"SDRM, DE": ("sdrm", "de", "nelder-mead"), "DE": ("de", "nelder-mead")}
QUICK_STAGES = {
    "sdrm": {"maxiter": 1},
    "de": evolution(2, 3),
    "nelder-mead": {"restarts": 0, "maxfev": 50},
}


def main() -> None:
    """Identify, print, write; fail where no search finds the parameters."""
    run = Run(__doc__, workers=1)
    found = fits(run)
    run.section("hardening_virtual", virtual_table(found))
    if run.quick:
        return
    lost = [m for m in MEASURES if min(final_error(found[e, m]) for e in SEARCHES) > 1e-3]
    if lost:
        raise SystemExit(f"known parameters not found to 0.1 % of their range: {', '.join(lost)}")


def tasks_of(*, quick: bool = False) -> dict[tuple[str, str], Task]:
    """Return the identification of the known parameters by each search and measure."""
    return {
        (name, measure): Task(
            f"known_{name}_{measure}".replace(", ", "+"),
            model(),
            model()(TRUTH),
            hardening_bounds(),
            measure,
            stages(methods, measure, quick=quick),
            material=True,
        )
        for name, methods in SEARCHES.items()
        for measure in MEASURES
    }


def fits(run: Run) -> dict[tuple[str, str], Found]:
    """Return what each search finds by each measure."""
    tasks = tasks_of(quick=run.quick)
    found = identify_all(list(tasks.values()), run.store("hardening"), run.options.workers)
    return {key: found[task.name] for key, task in tasks.items()}


def stages(methods: Sequence[str], measure: str, *, quick: bool) -> Effort:
    """Return the options of each stage, with more members for Fréchet, of many valleys, and DTW.

    DTW's valley along RSAT, C1 and C2 is so flat that differential evolution takes its population
    for settled there: without `atol` it goes on to its last generation.
    """
    if quick:
        return {method: QUICK_STAGES[method] for method in methods}
    large = measure in ("frechet", "dtw")
    members, generations = (10, 300) if large else (5, 200)
    options = {
        "sdrm": SDRM,
        "de": evolution(members, generations, **({"atol": 0.0} if measure == "dtw" else {})),
        "nelder-mead": {"restarts": 10 if large else 4},
    }
    return {method: options[method] for method in methods}


def final_error(found: Found) -> float:
    """Return the largest parameter error at the end of a search, as a share of its range."""
    return parameter_error(found.parameters, TRUTH)


def virtual_table(found: dict[tuple[str, str], Found]) -> str:
    """Return every stage's value, as a share of the paper's optimum of the real tests."""
    rows = []
    for (name, measure), fit in found.items():
        real = paper_values(measure)[measure]
        values = {stage.method: f"{stage.value / real:.0e}" for stage in fit.stages}
        local = fit.stages[-2]
        cells = [values.get(method, "–") for method in ("sdrm", "de", "nelder-mead")]
        errors = [parameter_error(local.parameters, TRUTH), final_error(fit)]
        rows.append(
            [
                name,
                TITLES[measure],
                *cells,
                *(f"{error:.0e}" for error in errors),
                f"{fit.evaluations}",
            ]
        )
    header = [
        "search",
        "measure",
        *(f"value after {stage}" for stage in ("SDRM", "DE", "Nelder–Mead")),
        "parameter error after DE",
        "after Nelder–Mead",
        "runs",
    ]
    return table(header, rows)


if __name__ == "__main__":
    main()
