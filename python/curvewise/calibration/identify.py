"""Identify the parameters of a model from measured curves, and what comes of it.

`identify` puts together what the other modules do: an objective, a space, a pool of processes that
runs the model, a store, and a method that searches. Almost all time is the model's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from inspect import signature
from typing import Any

from .answers.ended_search import identification_of
from .answers.identification import Identification
from .methods.search import Plan, run_search
from .models.pool import Model
from .objective.cases import Case, Cases
from .objective.criterion import Measure, criterion_of
from .objective.objective import Objective
from .problem.evaluations import Progress
from .problem.problem import Problem, models_of
from .problem.selection import Selection
from .problem.space import Bounds, Space
from .records.store import StoreOrPath

__all__ = ["identify"]


def identify(
    model: Model | Selection | Sequence[Case],
    experiments: Any = None,
    bounds: Bounds | None = None,
    *,
    measure: Measure = "area",
    method: str = "trust-region",
    seed: int = 0,
    workers: int = 1,
    executor: Executor | None = None,
    progress: bool = True,
    callback: Callable[[Progress], Any] | None = None,
    store: StoreOrPath | None = None,
    start: Mapping[str, float] | None = None,
    max_evaluations: int | None = None,
    method_options: Mapping[str, Any] | None = None,
    **options: Any,
) -> Identification:
    """Find the parameters with which a model's curves are most like the measured ones.

    Parameters
    ----------
    model : callable, or sequence of Case
        ``model(parameters: dict) -> curve``, or a list of curves, one for every experiment. What
        it raises, and curves that have no value, count as failed simulations. Tests of different
        kinds are given as a list of :class:`Case` in the place of model, experiments and measure.
    experiments : array_like, shape (n, d), or sequence of such
        The measured curve, or curves.
    bounds : mapping of str to (low, high)
        The parameters and where to search. In the place of a pair: a number for a parameter that
        stays what it is, :class:`Log`, :class:`Below` another parameter, or :class:`Tied`.
    measure : str, callable or Criterion, default "area"
        What is minimised: see :class:`Criterion`, which has the preset, weights and what else
        there is to say.
    method : {"sdrm+de", "trust-region", "de", "sdrm", "nelder-mead", "least_squares"}
        "trust-region": linear surfaces of the curves, on which the measure is minimised within a
        region around the best run: local, for expensive models; with the option slopes="fresh"
        Gauss and Newton's method on these surfaces, for any measure. "de": differential evolution,
        global. "sdrm": successive linear response surfaces with domain reduction, few evaluations
        and robust to noise. "sdrm+de": the best point of "sdrm" joins the first population of
        "de". "nelder-mead": local, from `start`. "least_squares": local, fast and exact where the
        model is smooth, for the measures "curve_length" and "sum_of_squares"; of several loops it
        minimises the weighted sum of squares.
    seed : int, default 0
        Of all random numbers. The same seed gives the same result, bit for bit, with any number
        of workers and after any interruption (and the same versions of numpy and scipy).
    workers : int, default 1
        Processes in which the model runs at the same time; -1 for one per core. The model must
        be picklable, and a script must have its ``if __name__ == "__main__":``. "nelder-mead"
        asks for one simulation at a time.
    executor : concurrent.futures.Executor, optional
        Runs the model in the place of processes of this machine: ``MPIPoolExecutor()``, or
        ``Client(...).get_executor()`` of dask. It is not shut down. After Ctrl-C nothing more is
        given to it; what it is running goes on until it ends.
    progress : bool, default True
        Show a progress bar (tqdm).
    callback : callable, optional
        Told a :class:`Progress` after every batch of evaluations; a true result ends the search.
    store : path-like or SimulationStore, optional
        A file with the curves of every run, by model and parameters. Runs that it holds are
        looked up, for whichever measure, method, weights or fold they were made; new ones are
        added at once, so that an interrupted search goes on where it was. Several searches may
        use it at a time. A Python function needs ``SimulationStore(path, version="1")``, with
        another version whenever it changes; a :class:`CommandModel` does not.
    start : mapping of str to float, optional
        Where the search starts: the middle of the bounds if not given; for "de" one member of
        the first population.
    max_evaluations : int, optional
        End the search after so many parameter sets.
    method_options : mapping, optional
        Passed on. "de": those of `scipy.optimize.differential_evolution` (popsize, tol, atol,
        maxiter, ...), and stall: (improvement, generations), with which the search ends once the
        best value has improved by less than that fraction over so many generations, as (0.001,
        100) in the paper. "sdrm": gamma_osc, gamma_pan, eta, initial_range, tol, maxiter.
        "nelder-mead": size (of the simplex, 0.1), restarts (10), and scipy's options (xatol,
        fatol, ...). "least_squares": diff_step (of the derivatives, as a fraction of the bounds'
        range, 1e-6; 1e-4 to 1e-3 for a solver that prints seven digits) and those of
        `scipy.optimize.least_squares`, e.g. loss and f_scale for a robust sum, of which the result
        is then the minimum (residuals are in units of the experiment's height). "trust-region":
        starts (3, where none is given), initial_range (0.5), diff_step (0.02), tol (1e-3), gain
        (1e-3: the least that is worth going on for), maxiter, and slopes: "broyden", of the runs
        that are made anyway, renewed by k runs for k parameters where they mislead, or "fresh",
        renewed after every step; with k workers, which run these side by side, it may be faster.
        "sdrm+de": a mapping for each, ``{"sdrm": {...}, "de": {...}}``.
    **options
        Options of the measure, where `measure` is no criterion.

    Returns
    -------
    Identification
        The parameters, their value, the simulations, every evaluation; prints as a table, plots
        itself.

    Raises
    ------
    ValueError
        Wrong bounds, options or experiments; simulations of another number or dimension than the
        experiments; a model that cannot be pickled (workers > 1); a store for a model without
        identity or version, or with runs of other code of that version.
    RuntimeError
        No simulation of the first batch has succeeded: the message has the first reason.
    ImportError
        scipy or tqdm is missing: ``pip install "curvewise[calibration]"``.
    KeyboardInterrupt
        Ctrl-C, after the processes have been stopped. The store holds what was finished.

    Notes
    -----
    Evaluations: "trust-region" takes 10 to 30 a start for 3 parameters, 45 to 95 for 7. "sdrm"
    takes 5, 9 or 17 an iteration (for up to 3, 7 or 15 parameters), in 14 to some 30 iterations
    with its default options (50 at most); "de" takes 15 k a generation for k parameters, in some
    100 generations.
    Memory: all evaluations. The search is over the unit cube, so that the units of parameters do
    not matter. Sources: Storn & Price (1997) for "de", in the place of the paper's genetic
    algorithm; Stander & Craig (2002) for "sdrm"; Nelder & Mead (1965). Failures are logged under
    "curvewise.calibration", the first as a warning.

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
    plan = Plan(
        method,
        dict(method_options or {}),
        seed,
        start,
        progress,
        callback,
        max_evaluations,
    )
    if bounds is None:
        raise TypeError("identify needs bounds: a dict of name: (low, high)")
    space = Space(bounds)
    if start is not None:
        space.unit(start)
    cases = _cases_of(model)
    if cases is None:
        criterion = criterion_of(measure, options, signature(identify).parameters)
        objective = Objective(experiments, criterion)
    else:
        beside = {"experiments": experiments is not None, "measure": measure != "area"}
        if given := [name for name, is_given in beside.items() if is_given] + list(options):
            raise ValueError(f"{', '.join(given)} given beside cases; give them to each Case")
        objective = cases.objective()
    for one in objective.measures:
        plan.check(one)
    models, assemble = models_of(model if cases is None else cases)
    problem = Problem(models, assemble, objective, space, store, workers, executor)
    return identification_of(problem, plan, run_search(problem, plan))


def _cases_of(model: Any) -> Cases | None:
    """Return the cases, if it is those that are given in the place of a model."""
    if isinstance(model, (list, tuple)) and model and all(isinstance(c, Case) for c in model):
        return Cases(model)
    return None
