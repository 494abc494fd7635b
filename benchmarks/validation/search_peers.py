"""What other packages need for the searches of `searches.py`: same tests, same start.

Each has the middle of the bounds to begin with, the unit cube with Space's logarithms, and the same
limit of runs; the seed is that of its random numbers, if it has any. Otherwise its defaults, except
for a first region of trust of 0.1 of the bounds (DFO-LS, Py-BOBYQA). Those of
OF_SQUARES are given residuals, the others values. A run that fails is what `Objective` makes of it.

    pip install DFO-LS Py-BOBYQA lmfit cma optuna    # in an environment of their own
    python benchmarks/validation/search_peers.py --measures sum_of_squares

takes the options of `searches.py`, and adds to its tables. POUNDERS (ibcdfo, MIT) is left out: it
needs MINQ, which no registry of packages has. None of these packages is needed by
curvewise, and no line of theirs is in it.

| peer | package | licence |
|---|---|---|
| DFO-LS | DFO-LS 1.6.5 | GPL 3 or later |
| scipy, lmfit | scipy 1.17.1 (least_squares), lmfit 1.3.4 (leastsq) | BSD 3-clause |
| Py-BOBYQA | Py-BOBYQA 1.5.0 | GPL 3 or later |
| CMA-ES | cma 4.5.0 | BSD 3-clause |
| optuna | optuna 5.0.0 (TPE) | MIT |
| Nelder-Mead | scipy 1.17.1 | BSD 3-clause |
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import searches

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.problem.space import Space

REGION = 0.1  # of the first steps, of the bounds


class OverError(Exception):
    """The limit of runs is reached."""


class Runs:
    """A problem as a function of a point of the unit cube, which counts."""

    def __init__(self, model: Any, test: np.ndarray, bounds: Any, measure: str) -> None:
        options = {"abscissa": "points"} if measure == "sum_of_squares" else {}
        self._model, self._space = model, Space(bounds)
        self._objective = Objective(test, Criterion(measure, **options))
        self.middle = np.full(len(self._space.names), 0.5)
        self.values: list[float] = []
        self.inside = 0.0

    def _curves(self, unit: np.ndarray) -> Any:
        if len(self.values) == searches.LIMIT:
            raise OverError
        started = time.process_time()
        try:
            curves = self._model(self._space.dictionary(self._space.point(np.asarray(unit))))
        except ValueError as error:
            curves = error
        self.inside += time.process_time() - started
        self.values.append(self._objective(curves))
        return curves

    def residuals(self, unit: np.ndarray) -> np.ndarray:
        return self._objective.residuals(self._curves(unit))

    def value(self, unit: np.ndarray) -> float:
        self._curves(unit)
        return self.values[-1]


Peer = Callable[[Runs, int], None]


def by(peer: Peer) -> searches.Search:
    """Return a search by a peer, as `searches` has them."""

    def search(model: Any, test: Any, bounds: Any, measure: str, seed: int) -> dict[str, Any]:
        runs = Runs(model, test, bounds, measure)
        message = "ended by itself"
        started = time.process_time()
        try:
            peer(runs, seed)
        except OverError:
            message = "the limit of runs"
        seconds = time.process_time() - started - runs.inside
        return {
            "values": runs.values,
            "converged": message != "the limit of runs",
            "message": message,
            "seconds": seconds,
        }

    return search


def dfols(runs: Runs, seed: int) -> None:
    import dfols

    np.random.seed(seed)  # noqa: NPY002 (the package draws from it)
    box = np.zeros_like(runs.middle), np.ones_like(runs.middle)
    limit = searches.LIMIT
    dfols.solve(runs.residuals, runs.middle, bounds=box, rhobeg=REGION, maxfun=limit)


def scipy_least_squares(runs: Runs, seed: int) -> None:
    from scipy.optimize import least_squares

    least_squares(runs.residuals, runs.middle, bounds=(0.0, 1.0))


def lmfit(runs: Runs, seed: int) -> None:
    from lmfit import Parameters, minimize

    parameters = Parameters()
    for i, place in enumerate(runs.middle):
        parameters.add(f"p{i}", value=place, min=0.0, max=1.0)
    minimize(lambda p: runs.residuals(np.array(list(p.valuesdict().values()))), parameters)


def pybobyqa(runs: Runs, seed: int) -> None:
    import pybobyqa

    np.random.seed(seed)  # noqa: NPY002 (the package draws from it)
    box = np.zeros_like(runs.middle), np.ones_like(runs.middle)
    limit = searches.LIMIT
    pybobyqa.solve(runs.value, runs.middle, bounds=box, rhobeg=REGION, maxfun=limit)


def cma_es(runs: Runs, seed: int) -> None:
    import cma

    options = {"bounds": [0, 1], "seed": seed + 1, "verbose": -9}
    cma.fmin2(runs.value, runs.middle, 0.25, options)


def optuna_tpe(runs: Runs, seed: int) -> None:
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=seed))
    names = [f"p{i}" for i in range(runs.middle.size)]
    study.enqueue_trial(dict.fromkeys(names, 0.5))
    study.optimize(
        lambda trial: runs.value(np.array([trial.suggest_float(n, 0.0, 1.0) for n in names])),
        n_trials=searches.LIMIT,
    )


def nelder_mead(runs: Runs, seed: int) -> None:
    from scipy.optimize import minimize

    box = [(0.0, 1.0)] * runs.middle.size
    minimize(runs.value, runs.middle, method="Nelder-Mead", bounds=box, options={"adaptive": True})


OF_SQUARES: dict[str, searches.Search] = {
    "DFO-LS": by(dfols),
    "scipy": by(scipy_least_squares),
    "lmfit": by(lmfit),
}
OF_VALUES: dict[str, searches.Search] = {
    "Py-BOBYQA": by(pybobyqa),
    "CMA-ES": by(cma_es),
    "optuna": by(optuna_tpe),
    "Nelder-Mead": by(nelder_mead),
}


if __name__ == "__main__":
    searches.METHODS.update(OF_SQUARES | OF_VALUES)
    searches.SQUARES_ONLY.update(OF_SQUARES)
    searches.main()
