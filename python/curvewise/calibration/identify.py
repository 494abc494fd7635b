"""Identify the parameters of a model from measured curves, and what comes of it.

`identify` puts together what the other modules do: an objective, a space, a pool of processes that
runs the model, a store, and a method that searches. Almost all time is the model's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from inspect import signature
from typing import Any

from .._bounds import Bounds
from .answers.identification import Identification
from .answers.search import Plan, identification_of
from .methods import method_of
from .methods.method import Method
from .models.forward import ForwardModel, Selection, SingleModel
from .models.pool import Model
from .objective.cases import Case, Cases
from .objective.criterion import Measure, criterion_of
from .objective.noisy_tests import warn_of_noise
from .objective.objective import Objective
from .problem.evaluations import Progress
from .problem.execution import Execution
from .problem.problem import Problem
from .problem.space import Space
from .records.store import StoreOrPath

__all__ = ["identify"]


def identify(
    model: Model | Selection | Sequence[Case],
    experiments: Any = None,
    bounds: Bounds | None = None,
    *,
    measure: Measure = "area",
    method: str | Method = "auto",
    store: StoreOrPath | None = None,
    workers: int = 1,
    executor: Executor | None = None,
    seed: int = 0,
    start: Mapping[str, float] | None = None,
    max_runs: int | None = None,
    progress: bool = True,
    callback: Callable[[Progress], Any] | None = None,
    **options: Any,
) -> Identification:
    """Identify the parameters with which a model best reproduces measured curves.

    Parameters
    ----------
    model : callable, or sequence of Case
        ``model(parameters: dict) -> curve``, or a list of curves, one for every experiment.
        Exceptions, and curves without a value, count as failed simulations. For tests of different
        kinds, pass a list of :class:`Case` instead of model, experiments and measure.
    experiments : array_like, shape (n, d), or sequence of such
        One measured curve or several.
    bounds : mapping of str to (low, high)
        The parameters and their search ranges. Instead of a pair: a number for a fixed parameter,
        :class:`Log`, :class:`Below` another parameter, or :class:`Tied`.
    measure : str, callable or Criterion, default "area"
        The measure to minimise. A :class:`Criterion` also sets its preset, weights and other
        options.
    method : str or method, default "auto"
        "trust-region" is :class:`TrustRegion`: several starts on a surrogate, for expensive models.
        "least-squares" is :class:`LeastSquares`, the same for sums of squares. "auto" uses the
        second for "sum_of_squares", else the first. "global" is :class:`Global`, for models of
        milliseconds. Others are "sdrm" (:class:`SDRM`), "de" (:class:`DifferentialEvolution`),
        "sdrm+de" (the second after the first) and "nelder-mead" (:class:`NelderMead`). Pass an
        object of these classes to set options: ``method=TrustRegion(starts=5)``.
    store : path-like or SimulationStore, optional
        A file with the curves of every run, by model and parameters. Runs that it holds are read,
        whichever search made them. New ones are added at once, so that an interrupted search
        continues from the stored runs when it is repeated. A Python function needs
        ``SimulationStore(path, version="1")``, with another version whenever it changes; a
        :class:`CommandModel` does not.
    workers : int, default 1
        Number of processes in which the model runs at the same time; -1 for one per core. The model
        must be picklable, and a script must have its ``if __name__ == "__main__":``.
    executor : concurrent.futures.Executor, optional
        Runs the model instead of processes of this machine: ``MPIPoolExecutor()``, or
        ``Client(...).get_executor()`` of dask. It is not shut down.
    seed : int, default 0
        Seed of all random numbers. The same seed gives bitwise identical results after any
        interruption, and with any number of workers above one (and the same versions of numpy and
        scipy). One worker makes starts one after the other: see `starts_at_once` of
        :class:`TrustRegion`.
    start : mapping of str to float, optional
        Begin a single local search at this point. By default the search has several starts; the
        first is the middle of the bounds.
    max_runs : int, optional
        Maximum number of parameter sets to evaluate, including those read from `store`.
    progress : bool, default True
        Whether to show a progress bar (tqdm).
    callback : callable, optional
        Called with a :class:`Progress` after every batch of runs of one start. A true result ends
        the search; runs of other starts that have begun by then do not count.
    **options
        Options of the measure, if `measure` is not a criterion.

    Returns
    -------
    Identification
        The parameters, their value, the curves, every run; prints as a table, plots itself.

    Raises
    ------
    ValueError
        If bounds, options or experiments are invalid. If simulations do not fit the experiments. If
        the model cannot be pickled (workers > 1). If a store is given for a model without identity
        or version, or its runs are of other code of that version.
    RuntimeError
        If no simulation of the first batch succeeds; the message has the first reason.
    ImportError
        If scipy or tqdm is missing: ``pip install "curvewise[calibration]"``.
    KeyboardInterrupt
        If Ctrl-C is pressed, after the processes have been stopped. The store holds the finished
        runs.

    Warns
    -----
    NoisyTestWarning
        If a test has noise that the measure does not average out ("curve_length", "pcm",
        "frechet").
    FirstRunWarning
        If the first simulation of a solver does not look like its test: other units, swapped
        columns, the opposite sign.
    WideBoundsWarning
        If bounds span more than a decade; use :class:`Log` for them.

    Notes
    -----
    Cost: the runs of the model; see each method for their number. The search uses the unit cube, so
    the units of parameters do not matter. Failures are logged under "curvewise.calibration", the
    first as a warning.

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
    execution = Execution(store, workers, executor)
    plan = Plan(method_of(method), seed, start, progress, callback, max_runs, execution)
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
            raise ValueError(
                f"{', '.join(given)} given together with cases; give them to each Case"
            )
        objective = cases.objective()
    plan = replace(plan, method=plan.method.chosen_for(objective))
    for one in objective.measures:
        plan.method.check(one)
    if not isinstance(model, Selection):  # cross_validate has warned about these tests already
        warn_of_noise([objective])
        space.warn_of_wide_bounds()
    forward: Any = model if cases is None else cases
    if not isinstance(forward, ForwardModel):
        forward = SingleModel(forward, len(objective.experiments))
    return identification_of(Problem(objective, space, forward), plan)


def _cases_of(model: Any) -> Cases | None:
    """Return the cases if they are given instead of a model, else None."""
    if isinstance(model, (list, tuple)) and model and all(isinstance(c, Case) for c in model):
        return Cases(model)
    return None
