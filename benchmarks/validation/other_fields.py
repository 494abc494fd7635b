"""How near searches come to the best value within 300 runs, on problems of other fields.

The twelve problems of ../shared/problems/fields.py (load-unload, Bouc-Wen, soil, viscoelasticity,
oscillators, a voltammogram) with the best values known there. A search hits if it ends within 1 %
of the best value; 10 % with a solver's noise of 0.5 %. Prints for each measure: the hits; the
median runs to the first hit and to the end; the CPU time next to the model, a run; the hits that
are reported as converged; and the others that are, which is untrue.

    python benchmarks/validation/other_fields.py --seeds 3
    python benchmarks/validation/other_fields.py --seeds 1 --measures area --beside-cma

With --beside-cma the wall time to the first hit is compared with that of plain CMA-ES on the same
`Objective`, one after the other. The default takes about half an hour. The problems need numba.
"""

from __future__ import annotations

import argparse
import logging
import sys
import time
import warnings
from dataclasses import dataclass, field
from typing import Any

import cma
import numpy as np
from places import ROOT

from curvewise.calibration import Criterion, Objective, identify
from curvewise.calibration.problem.space import Space

MEASURES = ("area", "dtw", "frechet", "sum_of_squares")
RUNS, CMA_RUNS = 300, 3000
PERFECT = 1e-4  # of a problem without noise, whose best value is 0
NOISY = {"bwjit": 1.10}  # times the best value


@dataclass
class Search:
    """A problem, a measure and a seed; then what the search has found."""

    name: str
    measure: str
    seed: int
    problem: Any
    best: float
    values: list[float] = field(default_factory=list)
    converged: bool = False
    cpu: float = 0.0  # seconds next to the model, a run
    seconds: tuple[float, float] = (np.nan, np.nan)  # to the first hit: the default's, CMA-ES's

    @property
    def limit(self) -> float:
        """The largest value that is a hit."""
        return self.best * NOISY.get(self.name, 1.01) if self.best > 0.0 else PERFECT

    @property
    def options(self) -> dict[str, Any]:
        """The options of the objective."""
        squares = {"abscissa": self.problem.squares}
        return {"measure": self.measure, **(squares if self.measure == "sum_of_squares" else {})}

    @property
    def hits(self) -> bool:
        """Whether the search ends within the limit."""
        return min(self.values) <= self.limit

    def runs_to_hit(self) -> int:
        """Return the number of the first run within the limit."""
        return next(i for i, value in enumerate(self.values, 1) if value <= self.limit)

    def search(self) -> None:
        """Search with the default method."""
        in_model, stamps = 0.0, []

        def timed(parameters: dict[str, float]) -> Any:
            nonlocal in_model
            begin = time.process_time()
            try:
                return self.problem.model(parameters)
            finally:
                in_model += time.process_time() - begin
                stamps.append(time.perf_counter())

        begin, cpu = time.perf_counter(), time.process_time()
        found = identify(
            timed,
            self.problem.tests,
            self.problem.bounds,
            seed=self.seed,
            max_runs=RUNS,
            progress=False,
            **self.options,
        )
        self.values = [float(value) for value in found.history["value"]]
        self.cpu = (time.process_time() - cpu - in_model) / len(self.values)
        self.converged = found.converged
        if self.hits:
            self.seconds = (stamps[self.runs_to_hit() - 1] - begin, np.nan)

    def search_by_cma(self) -> None:
        """Time plain CMA-ES, with restarts, to its first hit."""
        space, k = Space(self.problem.bounds), len(self.problem.bounds)
        objective = Objective(self.problem.tests, Criterion(**self.options))

        def value(unit: Any) -> float:
            try:
                return objective(self.problem.model(space.dictionary(space.point(unit))))
            except Exception:  # a failed run
                return objective(None)

        begin = time.perf_counter()
        left, seed = CMA_RUNS, self.seed
        while left > 0:
            seed += 1
            options = {"bounds": [0, 1], "verbose": -9, "seed": seed, "maxfevals": left}
            # cma needs two parameters at least.
            method = cma.CMAEvolutionStrategy(max(k, 2) * [0.5], 0.25, options)
            while not method.stop():
                points = method.ask()
                values = [value(np.asarray(point[:k])) for point in points]
                method.tell(points, values)
                left -= len(points)
                if min(values) <= self.limit:
                    self.seconds = (self.seconds[0], time.perf_counter() - begin)
                    return


def row(measure: str, searches: list[Search]) -> str:
    """Return the counts of a measure as a row of a table."""
    hits = [search for search in searches if search.hits]
    untrue = [f"{s.name} {s.seed}" for s in searches if s.converged and not s.hits]
    cells = (
        measure,
        f"{len(hits)} of {len(searches)}",
        f"{np.median([search.runs_to_hit() for search in hits]):.0f}",
        f"{np.median([len(search.values) for search in searches]):.0f}",
        f"{1e3 * np.median([search.cpu for search in searches]):.1f}",
        f"{sum(search.converged for search in hits)} of {len(hits)}",
        ", ".join(untrue) or "0",
    )
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Search, print each search, then the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--measures", nargs="+", choices=MEASURES, default=MEASURES)
    parser.add_argument("--beside-cma", action="store_true")
    options = parser.parse_args()
    sys.path.insert(0, str(ROOT.parent / "shared" / "problems"))
    import fields

    warnings.simplefilter("ignore")
    logging.disable(logging.WARNING)
    problems = fields.problems()
    rows = []
    for measure in options.measures:
        searches = []
        for name, bests in fields.BEST.items():
            for seed in range(options.seeds) if measure in bests else ():
                search = Search(name, measure, seed, problems[name], bests[measure])
                search.search()
                if options.beside_cma:
                    search.search_by_cma()
                searches.append(search)
                print(
                    name, measure, seed, f"{min(search.values):.6g} of {search.best:.6g}", end=", "
                )
                print(f"{len(search.values)} runs, converged {search.converged}", end=", ")
                print(
                    "seconds to the hit {:.2f}, by CMA-ES {:.2f}".format(*search.seconds),
                    flush=True,
                )
        rows.append(row(measure, searches))
        if options.beside_cma:
            ratios = [search.seconds[0] / search.seconds[1] for search in searches]
            print(f"{measure}: wall time by that of CMA-ES, median {np.nanmedian(ratios):.2f}")
    print("| measure | hits | runs to a hit | runs | CPU, ms a run | converged | untrue |")
    print("|---|---|---:|---:|---:|---|---|")
    print("\n".join(rows))


if __name__ == "__main__":
    main()
