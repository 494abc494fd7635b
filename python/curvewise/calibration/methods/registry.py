"""The methods that `identify` knows, each of one or two stages that minimise over the unit cube.

scipy does the work, except for the response surfaces. What is set here differently from scipy's
defaults follows from the objective: it has kinks (a sum of absolute values, a maximum) and jumps,
so only least squares takes its gradient; and its smallest value is 0 for a perfect model,
so that a tolerance relative to the value alone would never be met.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..problem.evaluations import Evaluations, Finish
from ..surfaces.nelder_mead import nelder_mead
from .domain_reduction import domain_reduction
from .trust_region import trust_region

__all__ = ["METHODS", "options_of", "search"]


def search(
    evaluations: Evaluations,
    method: str,
    start: Array | None,
    seed: int,
    options: Mapping[str, Any],
) -> Finish:
    """Run a method's stages, each from the best point of the one before."""
    stages = METHODS[method]
    for name, stage in stages.items():
        evaluations.stage(name)
        chosen = options if len(stages) == 1 else options.get(name, {})
        finish = stage(evaluations, start, seed, **chosen)
        start = evaluations.best_unit
    return finish


def _differential_evolution(
    evaluations: Evaluations,
    start: Array | None,
    seed: int,
    *,
    stall: tuple[float, int] | None = None,
    **options: Any,
) -> Finish:
    """Global search by scipy's differential evolution, a generation at a time.

    The result is not polished, since scipy's polish takes gradients. The tolerance `atol` on the
    spread of the population ends the search where it would only go on halving a value that is 0 to
    all purposes. A population on one level of a landscape of steps has no spread, which ends the
    search too. `stall` is the paper's rule (its section 3.3): (0.001, 100) ends the search once the
    best value has improved by less than 0.1 % over 100 generations.
    """
    function = required("scipy.optimize").differential_evolution
    stalled = None
    if stall is not None:
        if "callback" in options:
            raise ValueError("give either stall or callback to 'de': stall is a callback itself")
        stalled = _Stall(evaluations, stall)
        options["callback"] = stalled
    # scipy 1.15 renamed `seed`; a Generator means the same under both names.
    seed_name = "rng" if "rng" in inspect.signature(function).parameters else "seed"
    settings = {
        "x0": start,
        "atol": evaluations.negligible,
        "updating": "deferred",
        "polish": False,
        **options,
        "vectorized": True,
        seed_name: np.random.default_rng(seed),
    }
    wrong: list[Exception] = []

    def values(units: Array) -> Array:
        try:
            return evaluations.values(np.atleast_2d(units.T))
        except (TypeError, ValueError) as error:
            wrong.append(error)
            raise

    try:
        result = function(values, [(0.0, 1.0)] * evaluations.dimensions, **settings)
    except (RuntimeError, TypeError):
        if wrong:  # with the model; scipy takes it for a mistake in calling scipy
            raise wrong[0] from None
        raise
    if stalled is not None and stalled.ended:
        return Finish(True, stalled.message)
    return Finish(bool(result.success), str(result.message))


class _Stall:
    """Ends differential evolution where the best value hardly improves any more.

    scipy calls it after every generation.
    """

    def __init__(self, evaluations: Evaluations, stall: tuple[float, int]) -> None:
        if np.shape(stall) != (2,) or not (0.0 <= stall[0] < 1.0 and stall[1] >= 1):
            raise ValueError(
                f"stall is {stall!r}; give (improvement, generations), for example (0.001, 100)"
            )
        self._evaluations = evaluations
        self._improvement, self._generations = float(stall[0]), int(stall[1])
        self._best: list[float] = []
        self.ended = False

    def __call__(self, xk: Array, convergence: float) -> bool:
        """Return whether the search ends after this generation."""
        self._best.append(self._evaluations.best.value)
        if len(self._best) > self._generations:
            before = self._best[-1 - self._generations]
            self.ended = before - self._best[-1] <= self._improvement * abs(before)
        return self.ended

    @property
    def message(self) -> str:
        """How the search ended."""
        return f"improved by less than {self._improvement:.3g} over {self._generations} generations"


def _nelder_mead(
    evaluations: Evaluations,
    start: Array | None,
    seed: int,
    *,
    size: float = 0.1,
    restarts: int = 10,
    **options: Any,
) -> Finish:
    """Local search by Nelder and Mead's simplex, restarted."""
    k = evaluations.dimensions
    negligible = evaluations.negligible
    _, converged, message = nelder_mead(
        evaluations.value,
        np.full(k, 0.5) if start is None else start,
        (np.zeros(k), np.ones(k)),
        np.random.default_rng(seed),
        negligible=negligible,
        size=size,
        restarts=restarts,
        **{"xatol": 1e-6, "fatol": negligible, **options},
    )
    return Finish(converged, message)


def _least_squares(
    evaluations: Evaluations,
    start: Array | None,
    seed: int,
    *,
    diff_step: float = 1e-6,
    **options: Any,
) -> Finish:
    """Local search by scipy's trust-region least squares on the terms of the measure.

    Derivatives are differences over `diff_step` of the bounds' range. The default is for models in
    double precision; a solver that prints seven digits needs 1e-4 to 1e-3.
    """
    if not 0.0 < diff_step < 1.0:
        raise ValueError(f"diff_step is {diff_step}; give a fraction of the bounds, such as 1e-3")
    k = evaluations.dimensions
    step = diff_step
    objective = evaluations.objective

    def residuals(unit: Array) -> Array:
        (evaluation,) = evaluations.evaluated(unit[np.newaxis], keep_simulations=True)
        return objective.residuals(evaluation.simulations)

    def jacobian(unit: Array) -> Array:
        # All columns in one batch; backwards at the upper bound.
        steps = np.where(unit + step > 1.0, -step, step)
        units = np.vstack((unit, unit + np.diag(steps)))
        base, *moved = (
            objective.residuals(e.simulations)
            for e in evaluations.evaluated(units, keep_simulations=True)
        )
        return np.column_stack([(r - base) / h for r, h in zip(moved, steps, strict=True)])

    result = required("scipy.optimize").least_squares(
        residuals,
        np.full(k, 0.5) if start is None else start,
        jacobian,
        bounds=(0.0, 1.0),
        **{"x_scale": "jac", "xtol": 1e-9, "ftol": 1e-12, "gtol": 1e-12, **options},
    )
    if (
        options.get("loss", "linear") != "linear"
    ):  # the smallest sum of squares is not what is wanted
        evaluations.settle(result.x)
    return Finish(bool(result.success), str(result.message))


METHODS: dict[str, dict[str, Callable[..., Finish]]] = {
    "sdrm+de": {"sdrm": domain_reduction, "de": _differential_evolution},
    "de": {"de": _differential_evolution},
    "sdrm": {"sdrm": domain_reduction},
    "trust-region": {"trust-region": trust_region},
    "nelder-mead": {"nelder-mead": _nelder_mead},
    "least_squares": {"least_squares": _least_squares},
}

# What of scipy's functions is not for users: the objective, and what a method sets itself.
_SET_HERE = {
    "de": {"func", "bounds", "args", "x0", "vectorized", "workers", "seed", "rng"},
    "least_squares": {"fun", "x0", "jac", "bounds", "args", "kwargs", "diff_step", "workers"},
}
_OF_NELDER_MEAD = ("xatol", "fatol", "maxiter", "maxfev", "adaptive", "disp", "return_all")


def options_of(name: str, stage: Callable[..., Finish]) -> list[str]:
    """Return the names of a stage's options, those that scipy takes included."""
    parameters = inspect.signature(stage).parameters.values()
    own = [p.name for p in parameters if p.kind is p.KEYWORD_ONLY]
    if name == "nelder-mead":
        return [*own, *_OF_NELDER_MEAD]
    if name not in _SET_HERE:
        return own
    optimize = required("scipy.optimize")
    function = optimize.differential_evolution if name == "de" else optimize.least_squares
    passed_on = [p for p in inspect.signature(function).parameters if p not in _SET_HERE[name]]
    return [*own, *passed_on]
