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
from .answers.ended_search import identification_of
from .answers.identification import Identification
from .methods import method_of
from .methods.method import Method
from .methods.search import Plan
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
    method : str or method, default "auto"
        "trust-region" (:class:`TrustRegion`: several starts on a surrogate, for expensive
        models), "least-squares" (:class:`LeastSquares`: the same for sums of squares), "auto": the
        second for "sum_of_squares", else the first; "global" (:class:`Global`, for models of
        milliseconds); "sdrm" (:class:`SDRM`), "de" (:class:`DifferentialEvolution`), "sdrm+de" (the
        second after the first), "nelder-mead" (:class:`NelderMead`). An object of these classes has
        options of its own:
        ``method=TrustRegion(starts=5)``.
    store : path-like or SimulationStore, optional
        A file with the curves of every run, by model and parameters. Runs that it holds are
        looked up, whichever search made them; new ones are added at once, so that an interrupted
        search goes on where it was. A Python function needs ``SimulationStore(path, version="1")``,
        with another version whenever it changes; a :class:`CommandModel` does not.
    workers : int, default 1
        Processes in which the model runs at the same time; -1 for one per core. The model must
        be picklable, and a script must have its ``if __name__ == "__main__":``.
    executor : concurrent.futures.Executor, optional
        Runs the model in the place of processes of this machine: ``MPIPoolExecutor()``, or
        ``Client(...).get_executor()`` of dask. It is not shut down.
    seed : int, default 0
        Of all random numbers. The same seed gives the same result, bit for bit, after any
        interruption, and with any number of workers above one (and the same versions of numpy and
        scipy). One worker makes starts one after the other: see `starts_at_once` of
        :class:`TrustRegion`.
    start : mapping of str to float, optional
        Begin a single local search at this point. By default the search begins at several points,
        the first of which is the middle of the bounds.
    max_runs : int, optional
        End the search after so many parameter sets, those that are looked up included; no run is
        begun beyond them.
    progress : bool, default True
        Show a progress bar (tqdm).
    callback : callable, optional
        Told a :class:`Progress` after every batch of runs, those of one start; a true result ends
        the search, and runs that have been begun by then for others do not count.
    **options
        Options of the measure, where `measure` is no criterion.

    Returns
    -------
    Identification
        The parameters, their value, the curves, every run; prints as a table, plots itself.

    Raises
    ------
    ValueError
        Wrong bounds, options or experiments; simulations that do not fit the experiments; a model
        that cannot be pickled (workers > 1); a store for a model without identity or version, or
        with runs of other code of that version.
    RuntimeError
        No simulation of the first batch has succeeded: the message has the first reason.
    ImportError
        scipy or tqdm is missing: ``pip install "curvewise[calibration]"``.
    KeyboardInterrupt
        Ctrl-C, after the processes have been stopped. The store holds what was finished.

    Warns
    -----
    NoisyTestWarning
        A test has noise that the measure does not average out ("curve_length", "pcm", "frechet").
    WideBoundsWarning
        Bounds go over more than a decade, for which there is :class:`Log`.

    Notes
    -----
    Cost: the runs of the model; how many they are stands with each method. The search is over the
    unit cube, so that the units of parameters do not matter. Failures are logged under
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
            raise ValueError(f"{', '.join(given)} given beside cases; give them to each Case")
        objective = cases.objective()
    plan = replace(plan, method=plan.method.chosen_for(objective))
    for one in objective.measures:
        plan.method.check(one)
    if not isinstance(model, Selection):  # of whose tests cross_validate has warned
        warn_of_noise([objective])
        space.warn_of_wide_bounds()
    forward: Any = model if cases is None else cases
    if not isinstance(forward, ForwardModel):
        forward = SingleModel(forward, len(objective.experiments))
    return identification_of(Problem(objective, space, forward), plan)


def _cases_of(model: Any) -> Cases | None:
    """Return the cases, if it is those that are given in the place of a model."""
    if isinstance(model, (list, tuple)) and model and all(isinstance(c, Case) for c in model):
        return Cases(model)
    return None
