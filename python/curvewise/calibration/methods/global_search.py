"""Global search by CMA-ES, for models of milliseconds; without it by differential evolution."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Course, Finish, Ledger
from ..surfaces.steps import SMALL
from .differential_evolution import DifferentialEvolution
from .method import Method

__all__ = ["Global"]

_WIDTH = 0.25  # the first standard deviation, as a fraction of the bounds' range
_SETTLED = 0.1  # a round ends where its best changes by less than this part of the tolerance
_WITHOUT = 'by differential evolution, since cma is missing (pip install "curvewise[global]"): '


@dataclass(frozen=True, kw_only=True, repr=False)
class Global(Method, name="global", keeps_curves=False, needs_squares=False):
    """Global search by CMA-ES with growing populations.

    It suits models that take milliseconds. The package ``cma`` is used if it is installed (``pip
    install "curvewise[global]"``). Otherwise scipy's differential evolution is used, which needs
    more runs and succeeds less often; the message of the result reports it. For any measure. The
    points of a generation may run in parallel.

    Parameters
    ----------
    popsize : int, optional
        Points of a generation in the first round; every further round has twice as many. By default
        twice cma's own, 2 (4 + 3 log k) for k parameters; at least 4.
    tol : float, default 1e-3
        The search ends where two rounds end within this fraction of the best value.
    rounds : int, default 5
        The most rounds.

    Raises
    ------
    ValueError
        If an option is out of its range.

    Notes
    -----
    A round ends when the best values of its generations no longer change. Each further round
    doubles the population, because larger populations follow the overall shape rather than shallow
    local minima. The search has converged when two rounds end at the same value. Cost: about 5,000
    to 20,000 runs for 8 parameters; an overhead of about 30 microseconds per run.

    N. Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772; A. Auger, N. Hansen, "A
    restart CMA evolution strategy with increasing population size", Proc. IEEE CEC (2005)
    1769-1776.

    Examples
    --------
    >>> from curvewise.calibration import Global
    >>> Global(tol=1e-4)
    Global(tol=0.0001)
    """

    popsize: int | None = None
    tol: float = 1e-3
    rounds: int = 5

    def __post_init__(self) -> None:
        if self.popsize is not None and self.popsize < 4:
            raise ValueError(f"popsize is {self.popsize}; give at least 4")
        if not 0.0 < self.tol < 1.0:
            raise ValueError(f"tol is {self.tol}; give a fraction of the value, such as 1e-3")
        if self.rounds < 1:
            raise ValueError(f"rounds is {self.rounds}; give at least 1")

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of two generations."""
        return 2 * self._generation(parameters)

    def _generation(self, parameters: int) -> int:
        """Return how many points a generation of the first round has."""
        return self.popsize or 2 * (4 + int(3.0 * math.log(parameters)))

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise by rounds of CMA-ES."""
        if find_spec("cma") is None:
            evolution = DifferentialEvolution(tol=SMALL)
            finish = yield from evolution.course(ledger, start, seed)
            return finish._replace(message=f"{_WITHOUT}{finish.message}")
        random = np.random.default_rng(seed)
        ends: list[float] = []
        for number in range(self.rounds):
            place = random.random(ledger.dimensions) if number else start
            ends.append((yield from self._round(ledger, place, number, random)))
            good = sum(end <= min(ends) + self._enough(ledger, min(ends)) for end in ends)
            if good > 1:
                rounds = f"{good} of {len(ends)} rounds within {100 * self.tol:g} %"
                return Finish(True, f"CMA-ES: {rounds}")
        reason = f"the best of {self.rounds} rounds was found only once"
        return Finish(False, f"CMA-ES: {reason}", reason=reason)

    def _enough(self, ledger: Ledger, value: float) -> float:
        """Return the largest difference between values that count as equal."""
        return max(self.tol * abs(value), ledger.negligible)

    def _round(self, ledger: Ledger, place: Array | None, number: int, random: Any) -> Any:
        """Run a round from a place (default: the middle); return its best value."""
        k = ledger.dimensions
        generation = self._generation(k) * 2**number
        # cma refuses a single parameter: a second one, which nothing depends on, is added then.
        width = max(k, 2)
        strategy = import_module("cma").CMAEvolutionStrategy(
            np.full(width, 0.5) if place is None else np.append(place, [0.5] * (width - k)),
            _WIDTH,
            {
                "bounds": [0.0, 1.0],
                "popsize": generation,
                "randn": lambda *shape: random.standard_normal(shape),
                "seed": math.nan,  # leaves numpy's own generator alone
                "verbose": -9,
            },
        )
        values: list[float] = []  # the best of every generation
        patience = 10 + math.ceil(30 * k / generation)
        while not strategy.stop():
            drawn = strategy.ask()
            done = yield np.array(drawn)[:, :k]
            strategy.tell(drawn, [evaluation.value for evaluation in done])
            values.append(min(evaluation.value for evaluation in done))
            last = values[-patience:]
            enough = _SETTLED * self._enough(ledger, min(last))
            if len(values) > patience and max(last) - min(last) <= enough:
                break
        return min(values)
