"""Identify the parameters of a model from measured curves, and what comes of it.

`identify` puts together what the other modules do: an objective, a space, a pool of processes that
runs the model, a history file, and a method that searches. Almost all time is the model's.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .._curves import Array
from .._options import Preset
from ..deviations import Deviation, deviation
from ..measures.registry import Condition, default_measures
from ._extra import required
from .curve_list import as_points, curve_list
from .evaluations import Evaluations, Finish, Progress, SearchEndedError
from .history import Evaluation, History, as_records
from .loop_measure import Measure, Part
from .methods import METHODS, search
from .model_pool import Model, ModelPool
from .objective import LEAST_SQUARES, Objective
from .parameters import Space
from .pictures import loops_and_convergence

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Identification", "identify"]

# A parameter this near to a bound, as a fraction of the range, is said to be at the bound.
_AT_BOUND = 1e-3


@dataclass(frozen=True, eq=False)
class Identification:
    """Identified parameters and how they were found.

    Attributes
    ----------
    parameters : dict of str to float
        The best parameters found.
    value : float
        The objective there.
    measures : dict of str to float
        The optimum under every measure that the curves' dimension allows: the identification's
        own with its options, the others with the preset's; nan where a measure refuses.
    simulations : tuple of ndarray
        The simulated curves at the optimum.
    experiments : tuple of ndarray
        The measured curves.
    history : numpy.recarray
        Every evaluation: its number, the parameters, value, failed and seconds.
    failures : tuple of (int, str)
        Number of every evaluation that failed, and why.
    converged : bool
        Whether the method met its tolerances.
    message : str
        How the search ended.
    method, seed, bounds, measure, preset, part
        As asked for.
    condition : Condition or None
        Whether the measure is computed on scaled curves, and its options, the preset's included;
        None for "sum_of_squares" and for a function.
    """

    parameters: dict[str, float]
    value: float
    measures: dict[str, float]
    simulations: tuple[Array, ...] = field(repr=False)
    experiments: tuple[Array, ...] = field(repr=False)
    history: np.recarray[Any, Any] = field(repr=False)
    failures: tuple[tuple[int, str], ...] = field(repr=False)
    converged: bool
    message: str
    method: str
    seed: int
    bounds: dict[str, tuple[float, float]]
    measure: str
    preset: Preset

    part: Part
    condition: Condition | None = field(repr=False)

    @property
    def deviations(self) -> tuple[Deviation | None, ...]:
        """How far each simulation is from its experiment, in units of y, as the measure sees it.

        Computed when asked for. None for curve_length, sum_of_squares and functions, and where a
        simulation has failed. See :class:`curvewise.deviations.Deviation`.
        """
        if self.condition is None or len(self.simulations) < len(self.experiments):
            return (None,) * len(self.experiments)
        pairs = zip(self.experiments, self.simulations, strict=True)
        return tuple(self._deviation(self.condition, *pair) for pair in pairs)

    def _deviation(self, condition: Condition, P: Array, Q: Array) -> Deviation | None:
        try:
            return deviation(self.measure, condition, P, Q, part=self.part)
        except ValueError:  # the measure refuses the simulation, which the objective calls failed
            return None

    @property
    def evaluations(self) -> int:
        """How many parameter sets were evaluated."""
        return len(self.history)

    def __str__(self) -> str:
        return self.summary()

    def summary(self) -> str:
        """Return a table of the parameters, of the measures, and of how the search went."""
        width = max(map(len, (*self.parameters, *self.measures)))
        lines = [f"{'parameter':<{width}}  {'value':>12}  {'from':>12}  {'to':>12}"]
        for name, value in self.parameters.items():
            low, high = self.bounds[name]
            near = _AT_BOUND * (high - low)
            note = "  at its lower bound" if value - low < near else ""
            note = "  at its upper bound" if high - value < near else note
            lines.append(f"{name:<{width}}  {value:>12.6g}  {low:>12.6g}  {high:>12.6g}{note}")
        lines += ["", f"{'measure':<{width}}  {'value':>12}  (preset {self.preset})"]
        for name, value in self.measures.items():
            note = "  minimised" if name == self.measure else ""
            lines.append(f"{name:<{width}}  {value:>12.6g}{note}")
        deviations = [f"curve {k}: {d}" for k, d in enumerate(self.deviations) if d is not None]
        if deviations:
            lines += ["", f"deviation of {self.measure}, in units of y", *deviations]
        failed = f", {len(self.failures)} failed" if self.failures else ""
        lines += [
            "",
            f"{self.method}, seed {self.seed}: {self.evaluations} evaluations{failed}",
            f"{'converged' if self.converged else 'not converged'}: {self.message}",
        ]
        return "\n".join(lines)

    def plot(self) -> Figure:
        """Return a matplotlib Figure of the loops and of the convergence.

        Raises
        ------
        ImportError
            matplotlib is not installed: ``pip install "curvewise[plot]"``.
        """
        objective = f"{self.measure} ({self.preset})"
        return loops_and_convergence(self.experiments, self.simulations, self.history, objective)


def identify(
    model: Model,
    experiments: Any,
    bounds: Mapping[str, tuple[float, float]],
    *,
    measure: Measure = "area",
    preset: Preset = "scaled",
    method: str = "sdrm+de",
    seed: int = 0,
    workers: int = 1,
    progress: bool = True,
    callback: Callable[[Progress], Any] | None = None,
    history: str | os.PathLike[str] | None = None,
    start: Mapping[str, float] | None = None,
    max_evaluations: int | None = None,
    weights: Sequence[float] | None = None,
    failure_value: float | None = None,
    min_coverage: float = 0.5,
    part: Part = "experiment",
    method_options: Mapping[str, Any] | None = None,
    **options: Any,
) -> Identification:
    """Find the parameters with which a model's curves are most like the measured ones.

    Parameters
    ----------
    model : callable
        ``model(parameters: dict) -> curve``, or a list of curves, one for every experiment. What
        it raises, and curves that have no value, count as failed simulations.
    experiments : array_like, shape (n, d), or sequence of such
        The measured curve, or curves.
    bounds : mapping of str to (low, high)
        The parameters and where to search.
    measure, preset, weights, failure_value, min_coverage, part, **options
        The objective: see :class:`Objective`.
    method : {"sdrm+de", "de", "sdrm", "nelder-mead", "least_squares"}
        "de": differential evolution, global. "sdrm": successive linear response surfaces with
        domain reduction, few evaluations and robust to noise. "sdrm+de": the best point of
        "sdrm" joins the first population of "de". "nelder-mead": local, from `start`.
        "least_squares": local, fast and exact where the model is smooth, for the measures
        "curve_length" and "sum_of_squares"; of several loops it minimises the weighted sum of
        squares.
    seed : int, default 0
        Of all random numbers. The same seed gives the same result, bit for bit, with any number
        of workers and after any interruption (and the same versions of numpy and scipy).
    workers : int, default 1
        Processes in which the model runs at the same time; -1 for one per core. The model must
        be picklable, and a script must have its ``if __name__ == "__main__":``. "nelder-mead"
        asks for one simulation at a time.
    progress : bool, default True
        Show a progress bar (tqdm).
    callback : callable, optional
        Told a :class:`Progress` after every batch of evaluations; a true result ends the search.
    history : path-like, optional
        A CSV file to which every evaluation is appended at once. If it exists, the search is
        resumed: it runs again with the evaluations that the file holds looked up instead of
        computed, and goes on from there. Of a callable measure it knows the name alone.
    start : mapping of str to float, optional
        Where the search starts: the middle of the bounds if not given; for "de" one member of
        the first population.
    max_evaluations : int, optional
        End the search after so many parameter sets.
    method_options : mapping, optional
        Passed on. "de": those of `scipy.optimize.differential_evolution` (popsize, tol, atol,
        maxiter, ...), and stall: (improvement, generations), with which the search ends once the
        best value has improved by less than that fraction over so many generations, as
        (0.001, 100) in the paper. "sdrm": gamma_osc, gamma_pan, eta, initial_range, tol, maxiter.
        "nelder-mead": size (of the simplex, 0.1), restarts (10), and scipy's options (xatol,
            fatol, ...). "least_squares": those of `scipy.optimize.least_squares`. "sdrm+de": a
        mapping for each, ``{"sdrm": {...}, "de": {...}}``.

    Returns
    -------
    Identification
        The parameters, their value, the simulations, the history; prints as a table, plots
        itself.

    Raises
    ------
    ValueError
        Wrong bounds, options or experiments; simulations of another number or dimension than the
        experiments; a history of another search; a model that cannot be pickled (workers > 1).
    RuntimeError
        No simulation of the first batch has succeeded: the message has the first reason.
    ImportError
        scipy or tqdm is missing: ``pip install "curvewise[calibration]"``.
    KeyboardInterrupt
        Ctrl-C, after the processes have been stopped. The history file holds what was finished.

    Notes
    -----
    Evaluations: "sdrm" takes 5, 9 or 17 an iteration (for up to 3, 7 or 15 parameters), in 14 to
    some 30 iterations with its default options (50 at most); "de" takes 15 k a generation for k
    parameters, in some 100 generations. Memory: the history. The search is over the unit cube, so
    that the units of parameters do not matter. Sources: Storn & Price (1997) for "de", in the
    place of the paper's genetic algorithm; Stander & Craig (2002) for "sdrm"; Nelder & Mead
    (1965). Failures are logged under "curvewise.calibration", the first as a warning.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import identify
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x + p["intercept"]))
    >>> experiment = line({"slope": 2.0, "intercept": 1.0})
    >>> found = identify(
    ...     line, experiment, {"slope": (0, 10), "intercept": (-5, 5)}, method="de", progress=False
    ... )
    >>> round(found.parameters["slope"], 4), round(found.parameters["intercept"], 4)
    (2.0, 1.0)
    """
    method_options = dict(method_options or {})
    _check_method(method, measure, method_options)
    if max_evaluations is not None and max_evaluations < 1:
        raise ValueError(f"max_evaluations is {max_evaluations}; give at least 1")
    space = Space(bounds)
    start_unit = None if start is None else space.unit(start)
    objective = Objective(
        experiments,
        measure,
        preset=preset,
        weights=weights,
        failure_value=failure_value,
        min_coverage=min_coverage,
        part=part,
        **options,
    )
    required("scipy.optimize")
    tqdm = required("tqdm.auto").tqdm
    settings = {
        **_settings(objective),
        "bounds": space.bounds,
        "method": method,
        "method_options": method_options,
        "seed": seed,
        "start": None if start is None else dict(start),
    }
    record = History(history, settings, space.names)
    try:
        with ModelPool(model, workers) as pool:
            with tqdm(total=max_evaluations, unit="run", disable=not progress) as bar:
                evaluations = Evaluations(
                    pool,
                    objective,
                    space,
                    record,
                    limit=max_evaluations,
                    callback=callback,
                    bar=bar,
                )
                try:
                    finish = search(evaluations, method, start_unit, seed, method_options)
                except SearchEndedError as end:
                    finish = Finish(False, str(end))
            simulations = evaluations.best_simulations()
    finally:
        record.close()
    return _result(evaluations, finish, simulations, objective, space, method, seed)


def _result(
    evaluations: Evaluations,
    finish: Finish,
    simulations: Any,
    objective: Objective,
    space: Space,
    method: str,
    seed: int,
) -> Identification:
    done: list[Evaluation] = evaluations.done
    best = evaluations.best
    return Identification(
        parameters=space.dictionary(best.point),
        value=best.value,
        measures=_measures(objective, simulations, best.value),
        simulations=tuple(
            as_points(curve, "Q").copy() for curve in curve_list(simulations) if curve is not None
        ),
        experiments=objective.experiments,
        history=as_records(done, space.names),
        failures=tuple((e.number, e.message) for e in done if e.failed),
        converged=finish.converged,
        message=finish.message,
        method=method,
        seed=seed,
        bounds=space.bounds,
        measure=objective.measure,
        preset=objective.preset,
        part=objective.part,
        condition=objective.condition,
    )


def _check_method(method: str, measure: Measure, method_options: dict[str, Any]) -> None:
    if method not in METHODS:
        raise ValueError(f"unknown method {method!r}; choose from {', '.join(METHODS)}")
    if method == "least_squares" and measure not in LEAST_SQUARES:
        raise ValueError(
            f"measure {measure!r} is not a sum of squares; method 'least_squares' needs "
            f"measure={' or '.join(map(repr, LEAST_SQUARES))}"
        )
    stages = METHODS[method]
    if len(stages) > 1 and not set(method_options) <= set(stages):
        raise ValueError(
            f"method_options has {', '.join(method_options)}; "
            f"method {method!r} takes a dict for each of {', '.join(stages)}"
        )


def _settings(objective: Objective) -> dict[str, Any]:
    """Return what decides the value of a simulation, for the history file."""
    digest = hashlib.sha256()
    for curve in objective.experiments:
        digest.update(repr(curve.shape).encode() + curve.tobytes())
    options = dict(objective.options)
    if objective.part != "experiment":  # histories from before this option have none
        options["part"] = objective.part
    return {
        "measure": objective.measure,
        "preset": objective.preset,
        "options": options,
        "weights": objective.weights.tolist(),
        "failure_value": objective.failure_value.tolist(),
        "min_coverage": objective.min_coverage,
        "experiments": digest.hexdigest(),
    }


def _measures(objective: Objective, simulations: Any, value: float) -> dict[str, float]:
    """Return the value of simulations under every measure."""
    values = {}
    for name in default_measures(objective.experiments[0]):
        if name == objective.measure:
            values[name] = value
            continue
        try:
            other = Objective(
                objective.experiments,
                name,
                preset=objective.preset,
                weights=objective.weights.tolist(),
                min_coverage=objective.min_coverage,
                part=objective.part if name == "pcm" else "experiment",
            )
        except ValueError:  # e.g. curve_length, raw, of a loop centred on zero
            values[name] = np.nan
            continue
        score = other.score(simulations)
        values[name] = np.nan if score.failures else score.value
    values.setdefault(objective.measure, value)
    return values
