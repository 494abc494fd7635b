"""How near a search comes to the best value within 300 runs, and whether it knows: measured loops.

A material point (`curvewise.materials.ChabocheVoce`, two back stresses, eight parameters; for the
cyclic tests of structural steel a third, linear one, nine) is fitted to measured loops of tension
and compression, each a search of its own, by every measure, from five seeds. Tests are thinned to
300 points, every so many-th row, or, of the same names with "even" or "fine" behind them, resampled
to 600 or 3,000 at equal steps along the curve, as a search by frechet asks for where points are too
far apart; the model is driven by their strains. Bounds follow from one number, S, the largest
stress of the 300 points, and the elastic modulus of the metal:

    E 0.6 to 1.4 of the modulus, yield 0.05 to 1 S, Q -0.04 to 1 S, b 0.1 to 100 (logarithmic),
    C1 20 to 2000 S, gamma1 20 to 2000, C2 1 to 100 S, gamma2 1 to 100 (all logarithmic),
    and of three back stresses C3 0 to 5 S, gamma3 = 0.

The rules of the package's methods were chosen on the tests of CHOSEN_ON; the table is of SHOWN.
The best value of a test and measure is the best that any search of it has found, those included
that take a thousand runs and more (REFERENCES), which are made once.

    python benchmarks/validation/searches.py --seeds 5 --workers 2
    python benchmarks/validation/searches.py --tests eddq-5 --measures area --methods trust-region
    python benchmarks/validation/searches.py --tests "dp780 fine" --measures frechet

Adds what searches.json.xz does not have to it, and writes searches.md.
"""

from __future__ import annotations

import argparse
import logging
import time
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import Any

import numpy as np
from places import DATA, RESULTS
from stored import read_json, write_json

from curvewise import read_curve
from curvewise.calibration import DifferentialEvolution, Log, TrustRegion, identify
from curvewise.curves import resample
from curvewise.materials import ChabocheVoce

POINTS = 300
LIMIT = 300  # runs of a search
STEEL, ALUMINIUM = 205e3, 70e3
# Of each test: its file, the columns of strain and stress, what strain and stress are multiplied
# by, the modulus of the metal, and the number of back stresses.
_FILES: dict[str, tuple[str, tuple[Any, Any], tuple[float, float], float, int]] = {
    "eddq-5": ("loops/eddq_tct_5pct.csv", (1, 2), (1.0, 1.0), STEEL, 2),
    "eddq-3": ("loops/eddq_tct_3pct.csv", (1, 2), (1.0, 1.0), STEEL, 2),
    "random": ("loops/resslab_random_protocol.csv", (1, 2), (1.0, 1.0), STEEL, 3),
    "dp780": ("loops/dp780_tct_6pct.csv", (1, 2), (1.0, 1.0), STEEL, 2),
    "tr1180": ("loops/tr1180_tct_3pct.csv", (1, 2), (1.0, 1.0), STEEL, 2),
    "structural": ("loops/resslab_cyclic_2pct.csv", (1, 2), (1.0, 1.0), STEEL, 3),
}
# Points at equal steps: the most of which a search leaves none out on its surfaces; and so many
# that a step is a third at most of the distances that searches by frechet end at.
EVENLY = {" even": 600, " fine": 3000}
TESTS = {name + sampling: test for name, test in _FILES.items() for sampling in ("", *EVENLY)}
CHOSEN_ON, SHOWN = ("eddq-5", "eddq-3", "random"), ("dp780", "tr1180", "structural")
MEASURES = ("area", "dtw", "frechet", "pcm", "curve_length", "sum_of_squares")


def whole_test(name: str) -> np.ndarray:
    """Return all rows of a test."""
    file, columns, factors, *_ = TESTS[name]
    return read_curve(DATA / file, columns=columns) * factors


def driven_model(name: str, test: np.ndarray) -> Any:
    """Return the model of a test's metal, driven by the strains of a curve."""
    return ChabocheVoce(backstresses=TESTS[name][4]).driven_by(test)


def problem(name: str) -> tuple[Any, np.ndarray, dict[str, Any]]:
    """Return model, test and bounds."""
    *_, modulus, backstresses = TESTS[name]
    whole = whole_test(name)
    test = whole[:: max(1, len(whole) // POINTS)]
    S = float(np.abs(test[:, 1]).max())
    bounds = {
        "E": (0.6 * modulus, 1.4 * modulus),
        "yield": (0.05 * S, S),
        "Q": (-0.04 * S, S),
        "b": Log(0.1, 100.0),
        "C1": Log(20.0 * S, 2000.0 * S),
        "gamma1": Log(20.0, 2000.0),
        "C2": Log(S, 100.0 * S),
        "gamma2": Log(1.0, 100.0),
        **({"C3": (0.0, 5.0 * S), "gamma3": 0.0} if backstresses == 3 else {}),
    }
    for sampling, points in EVENLY.items():
        if name.endswith(sampling):
            test = resample(whole, points)
    return driven_model(name, test), test, bounds


Search = Callable[[Any, np.ndarray, dict[str, Any], str, int], dict[str, Any]]


class Timed:
    """A model that adds up its seconds; with its slopes, or as one that does not know them."""

    def __init__(self, model: Any, *, has_slopes: bool) -> None:
        self._model, self.seconds = model, 0.0
        if has_slopes:
            self.jacobian = self._jacobian

    def __call__(self, parameters: dict[str, float]) -> Any:
        return self._timed(self._model, parameters)

    def _jacobian(self, parameters: dict[str, float]) -> Any:
        return self._timed(self._model.jacobian, parameters)

    def _timed(self, function: Callable[[dict[str, float]], Any], parameters: Any) -> Any:
        started = time.process_time()
        try:
            return function(parameters)
        finally:
            self.seconds += time.process_time() - started


def by_curvewise(method: Any, limit: int | None = LIMIT, *, has_slopes: bool = False) -> Search:
    """Return a search by a method of `identify`; with the slopes that the model knows, if asked."""

    def search(model: Any, test: Any, bounds: Any, measure: str, seed: int) -> dict[str, Any]:
        options = {"abscissa": "points"} if measure == "sum_of_squares" else {}
        timed = Timed(model, has_slopes=has_slopes)
        started = time.process_time()
        found = identify(
            timed,
            test,
            bounds,
            measure=measure,
            method=method,
            seed=seed,
            max_runs=limit,
            progress=False,
            **options,
        )
        seconds = time.process_time() - started - timed.seconds
        return {
            "values": found.history.value.tolist(),
            "converged": found.converged,
            "message": found.message,
            "seconds": seconds,
        }

    return search


# What is searched by. Peers take the same arguments and return the same dict.
METHODS: dict[str, Search] = {
    "trust-region": by_curvewise("trust-region"),
    "trust-region, 1 start": by_curvewise(TrustRegion(starts=1)),
    "trust-region, slopes": by_curvewise("trust-region", has_slopes=True),
    "least-squares": by_curvewise("least-squares"),
}
SQUARES_ONLY = {"least-squares"}  # of these, those that take sums of squares alone
# For the best value: many runs.
REFERENCES: dict[str, Search] = {
    "10 starts": by_curvewise(TrustRegion(starts=10, most_starts=10), None),
    "20 starts, slopes": by_curvewise(
        TrustRegion(starts=20, most_starts=20, gain=1e-4), None, has_slopes=True
    ),
    "de": by_curvewise(DifferentialEvolution(popsize=10, tol=1e-4), 20000),
}


def say_nothing() -> None:
    """Leave out what a search logs, and warns of."""
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    warnings.simplefilter("ignore")


def searched(task: tuple[str, str, str, int]) -> dict[str, Any]:
    """Search once; return what came of it, its values as the steps of the best."""
    say_nothing()
    name, measure, label, seed = task
    done = (METHODS | REFERENCES)[label](*problem(name), measure, seed)
    values = np.minimum.accumulate(done.pop("values"))
    improved = np.flatnonzero(np.diff(values, prepend=np.inf))
    steps = [[int(i) + 1, float(values[i])] for i in improved]
    return {**done, "runs": len(values), "steps": steps}


def tasks(options: argparse.Namespace) -> list[tuple[str, str, str, int]]:
    """Return test, measure, method and seed of every search that is asked for."""
    asked = [
        (name, measure, label, seed)
        for name in options.tests
        for measure in options.measures
        for label in options.methods or [*METHODS, *REFERENCES]
        if measure == "sum_of_squares" or label not in SQUARES_ONLY
        for seed in range(1 if label in REFERENCES else options.seeds)
    ]
    # The first seeds of all first, so that what was interrupted is of use.
    return sorted(asked, key=lambda task: task[3])


def table(results: dict[str, dict[str, Any]]) -> str:
    """Return how many searches came within 1 % of the best value, after how many runs."""
    by_case: dict[tuple[str, str], dict[str, list[dict[str, Any]]]] = {}
    for key, result in sorted(results.items()):
        name, measure, label, _ = key.split(" | ")
        by_case.setdefault((name, measure), {}).setdefault(label, []).append(result)
    lines = [
        "| test | measure | best value | method | within 1 % | median runs to it | runs | furthest "
        '| false "converged" | seconds beside the model |',
        "|---|---|---:|---|---:|---:|---:|---:|---:|---:|",
    ]
    for (name, measure), by_label in sorted(by_case.items()):
        best = min(r["steps"][-1][1] for found in by_label.values() for r in found)
        for label, found in by_label.items():
            lines.append(f"| {name} | {measure} | {best:.5g} | {label} | {row(found, best)} |")
    return "\n".join(lines) + "\n"


def row(found: list[dict[str, Any]], best: float) -> str:
    """Return the columns of the searches of a method."""
    arrived = [next((n for n, v in r["steps"] if v <= 1.01 * best), np.inf) for r in found]
    rises = [r["steps"][-1][1] / best - 1.0 for r in found]
    wrong = sum(r["converged"] and rise > 0.01 for r, rise in zip(found, rises, strict=True))
    median = float(np.median(arrived))
    return " | ".join(
        (
            f"{int(np.isfinite(arrived).sum())} of {len(found)}",
            "-" if np.isinf(median) else f"{median:.0f}",
            f"{np.median([r['runs'] for r in found]):.0f}",
            f"{100.0 * max(rises):.1f} %",
            f"{wrong}",
            f"{np.median([r['seconds'] for r in found]):.1f}",
        )
    )


def main() -> None:
    """Search, print, write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--tests", nargs="+", default=list(SHOWN), choices=list(TESTS))
    parser.add_argument("--measures", nargs="+", default=list(MEASURES))
    parser.add_argument("--methods", nargs="+", help="of METHODS and REFERENCES; all if not given")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    path = RESULTS / "searches.json.xz"
    results = read_json(path)
    with ProcessPoolExecutor(options.workers) as pool:
        asked = {" | ".join(map(str, task)): task for task in tasks(options)}
        futures = {
            pool.submit(searched, task): key for key, task in asked.items() if key not in results
        }
        for future in as_completed(futures):
            key, result = futures[future], future.result()
            results[key] = result
            write_json(path, results)
            print(key, result["steps"][-1], result["message"], flush=True)
    (RESULTS / "searches.md").write_text(table(results))
    print(table(results))


if __name__ == "__main__":
    main()
