"""Global search by scipy's differential evolution, a generation at a time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..problem.ledger import Course, Finish, Ledger
from .called_back import Evaluate, course_of
from .method import Method, check_passed_on, taken_by

__all__ = ["DifferentialEvolution"]

# Arguments of scipy's function that users cannot set: the objective and fixed settings.
_SET_HERE = ("func", "bounds", "args", "x0", "vectorized", "workers", "seed", "rng")


@dataclass(frozen=True, kw_only=True, repr=False)
class DifferentialEvolution(Method, name="de", keeps_curves=False, needs_squares=False):
    """Differential evolution: global, for models that cost milliseconds.

    It replaces the genetic algorithm of the paper and uses scipy without its polish. It takes
    `popsize` k runs in each generation for k parameters, in about 100 generations.

    Parameters
    ----------
    popsize : int, default 15
        Members of the population for every parameter.
    tol : float, default 0.01
        The search ends if the values of the population spread by less than this fraction.
    maxiter : int, default 1000
        Maximum number of generations.
    stall : (improvement, generations), optional
        End the search if the best value has improved by less than this fraction over this number of
        generations, as (0.001, 100) in section 3.3 of the paper.
    after : Method, optional
        A method that runs first; its best point joins the first population.
        ``DifferentialEvolution(after=SDRM())`` is the method "sdrm+de".
    options : mapping, optional
        Other arguments of ``scipy.optimize.differential_evolution``: atol, mutation, recombination,
        ...

    Raises
    ------
    ValueError
        If an option is out of its range, or scipy does not have it.

    Notes
    -----
    The result is not polished, because scipy's polish needs gradients, but objectives have kinks
    and jumps. The smallest value of a perfect model is 0. Therefore `atol` is the negligible
    difference of the objective. The search also ends if all values of the population are equal.

    R. Storn, K. Price, "Differential evolution - a simple and efficient heuristic for global
    optimization over continuous spaces", J. Global Optimization 11 (1997) 341-359.

    Examples
    --------
    >>> from curvewise.calibration import DifferentialEvolution
    >>> DifferentialEvolution(popsize=8, stall=(0.001, 100))
    DifferentialEvolution(popsize=8, stall=(0.001, 100))
    """

    popsize: int = 15
    tol: float = 0.01
    maxiter: int = 1000
    stall: tuple[float, int] | None = None
    after: Method | None = None
    options: Mapping[str, Any] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        if self.stall is not None:
            if np.shape(self.stall) != (2,) or not (0.0 <= self.stall[0] < 1.0 <= self.stall[1]):
                raise ValueError(
                    f"stall is {self.stall!r}; give (improvement, generations), for example "
                    "(0.001, 100)"
                )
            if "callback" in self.options:
                raise ValueError(
                    "give either stall or callback to 'de': stall is a callback itself"
                )
        if self.options:
            known = taken_by(required("scipy.optimize").differential_evolution, _SET_HERE)
            check_passed_on(self, self.options, known)

    def __str__(self) -> str:
        return self.name if self.after is None else f"{self.after}+{self.name}"

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of two generations, and of the search before."""
        own = 2 * max(5, self.popsize * parameters)
        if self.after is None:
            return own
        return own + self.after.fewest_runs(parameters, has_start=has_start)

    def near_optimum(self) -> DifferentialEvolution:
        """Return the same after a search that begins there."""
        return self if self.after is None else replace(self, after=self.after.near_optimum())

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise by generations, from the best point of the search before if there is one."""
        if self.after is not None:
            yield from self.after.staged(ledger, start, seed)
            start = ledger.best_unit
            ledger.begin_stage(self.name, keeps_curves=self.keeps_curves)
        return (yield from course_of(partial(self._minimised, ledger, start, seed)))

    def _minimised(
        self, ledger: Ledger, start: Array | None, seed: int, evaluate: Evaluate
    ) -> Finish:
        function = required("scipy.optimize").differential_evolution
        best: list[float] = []  # of each generation

        def callback(xk: Array, convergence: float) -> bool:
            best.append(ledger.best.value)
            return self._has_stalled(best)

        # scipy 1.15 renamed `seed`; a Generator means the same under both names.
        seed_name = "rng" if "rng" in taken_by(function) else "seed"
        settings = {
            "x0": start,
            "popsize": self.popsize,
            "tol": self.tol,
            "maxiter": self.maxiter,
            "atol": ledger.negligible,
            "updating": "deferred",
            "polish": False,
            "callback": None if self.stall is None else callback,
            **self.options,
            "vectorized": True,
            seed_name: np.random.default_rng(seed),
        }

        def values(units: Array) -> Array:
            return np.array([run.value for run in evaluate(np.atleast_2d(units.T))])

        result = function(values, [(0.0, 1.0)] * ledger.dimensions, **settings)
        if self.stall is not None and self._has_stalled(best):
            gain, generations = float(self.stall[0]), int(self.stall[1])
            message = f"improved by less than {gain:.3g} over {generations} generations"
            return Finish(True, message)
        return Finish(bool(result.success), str(result.message))

    def _has_stalled(self, best: Sequence[float]) -> bool:
        """Return whether the best values of the generations have stopped improving."""
        if self.stall is None or len(best) <= self.stall[1]:
            return False
        before = best[-1 - int(self.stall[1])]
        return before - best[-1] <= self.stall[0] * abs(before)
