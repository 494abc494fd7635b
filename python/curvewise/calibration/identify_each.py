"""Identification by several measures with shared runs.

The paper's section 4 suggests: "Use several measures; their spread indicates the uncertainty." The
measures search one after the other. All use one store, so that no run is repeated. Each search but
the first begins at the best of all runs so far under its own measure, in a small region. With
"trust-region", each then continues from the best of all runs with smaller tolerances, as long as it
gains anything. Cost: the first search in full; the others cost a fraction of it with the methods
that use known runs ("trust-region", "sdrm").
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .._bounds import Bounds
from .answers.identification import Identification
from .answers.joined_searches import continued
from .answers.search import Plan, identification_of
from .answers.several_measures import SeveralMeasures
from .methods import method_of
from .methods.method import Method
from .models.forward import SingleModel
from .models.pool import Model
from .objective.criterion import Measure
from .objective.noisy_tests import warn_of_noise
from .objective.objective import objectives_of
from .problem.execution import Execution
from .problem.problem import Problem
from .problem.space import Space
from .records.evaluation import Run
from .records.store import SimulationStore, StoreOrPath

__all__ = ["identify_each"]

# After the first round, every measure continues from the best of all runs with smaller tolerances,
# until no search has gained more than this fraction of its value.
_WORTH_A_ROUND, _ROUNDS = 1e-3, 4


def identify_each(
    model: Model,
    experiments: Any,
    bounds: Bounds,
    *,
    measures: Sequence[Measure] | None = None,
    method: str | Method = "auto",
    seed: int = 0,
    workers: int = 1,
    executor: Any = None,
    progress: bool = True,
    store: StoreOrPath | None = None,
    start: Mapping[str, float] | None = None,
    max_runs: int | None = None,
) -> SeveralMeasures:
    """Identify the parameters by each of several measures, with shared runs.

    Parameters
    ----------
    model, experiments, bounds
        As for :func:`identify`.
    measures : sequence of str, callable or Criterion, optional
        By default every measure that the curves' dimension allows. Each search begins where the
        previous ones have been, so put the smoothest measure first.
    method : str or method
        As for :func:`identify`; :class:`TrustRegion` and :class:`SDRM` gain most. The searches
        after the first have `initial_range` 0.1 unless it has been changed.
    store
        As for :func:`identify`. Without a store, a temporary one shares the runs and is deleted
        afterwards.
    max_runs : int, optional
        Maximum number of parameter sets for each measure.
    seed, workers, executor, progress, start
        As for :func:`identify`, for all measures.

    Returns
    -------
    SeveralMeasures
        A mapping of measures to identifications; prints as a table, plots itself.

    Raises
    ------
    ValueError, RuntimeError, ImportError, KeyboardInterrupt
        As for :func:`identify`; ValueError also if a measure is given twice.

    Warns
    -----
    NoisyTestWarning, FirstRunWarning, WideBoundsWarning
        As for :func:`identify`, once for all searches.

    Notes
    -----
    Runs: the four measures of `benchmarks/validation/shared_runs.py`, with 7 parameters, take 393,
    while four searches by "sdrm" take 751. Three optima agree with those of "sdrm" to 0.02 %. That
    of frechet, which has several, is 4 % above.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import identify_each
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x + p["intercept"]))
    >>> experiment = line({"slope": 2.0, "intercept": 1.0})
    >>> found = identify_each(
    ...     line,
    ...     experiment,
    ...     {"slope": (0, 10), "intercept": (-5, 5)},
    ...     measures=["area", "dtw"],
    ...     progress=False,
    ... )
    >>> [round(one.parameters["slope"], 2) for one in found.values()]
    [2.0, 2.0]
    """
    objectives = objectives_of(experiments, measures)
    space = Space(bounds)
    searching = method_of(method)
    afterwards = Execution(store, workers, executor)
    for objective in objectives.values():
        searching.check(objective.measures[0])
    warn_of_noise(objectives.values())
    space.warn_of_wide_bounds()
    found: dict[str, Identification] = {}
    with ExitStack() as stack:
        if afterwards.store is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="curvewise_"))
            store = SimulationStore(Path(folder, "runs.db"), version="of this call")
        execution = replace(afterwards, store=store)
        plan = Plan(searching, seed, start, progress, None, max_runs, execution)
        known: tuple[Run, ...] = ()
        for name, objective in objectives.items():
            problem = Problem(objective, space, SingleModel(model, len(objective.experiments)))
            chosen = searching.chosen_for(objective)
            plan = replace(plan, method=chosen)
            if known:  # a start is given from here on: one search a measure
                begin = _best_known(known, problem)
                plan = replace(plan, start=begin, method=chosen.near_optimum())
            found[name] = identification_of(problem, plan, known)
            known = found[name].runs_with_curves
        _go_on(found, replace(plan, method=searching), known)
    # A temporary store has been deleted; later runs do not use it.
    return SeveralMeasures({n: replace(one, execution=afterwards) for n, one in found.items()})


def _go_on(found: dict[str, Identification], plan: Plan, known: tuple[Run, ...]) -> None:
    """Repeat the searches from the best of all, while one of them gains."""
    closer = {n: plan.method.chosen_for(f.problem.objective).closer() for n, f in found.items()}
    waiting = [name for name, method in closer.items() if method is not None]
    for _ in range(_ROUNDS):
        gained = []
        for name in waiting:
            before = found[name]
            left = None if plan.max_runs is None else plan.max_runs - len(before.history)
            if left is not None and left < 1:
                continue
            begin, method = _best_known(known, before.problem), closer[name]
            assert method is not None
            again = replace(plan, method=method, start=begin, max_runs=left)
            after = identification_of(before.problem, again, known)
            known = after.runs_with_curves
            found[name] = continued(before, after)
            if before.value - after.value > _WORTH_A_ROUND * before.value:
                gained.append(name)
        waiting = gained


def _best_known(known: Sequence[Run], problem: Problem) -> dict[str, float]:
    """Return the parameters of the run that is best under an objective."""
    values = [problem.objective.predicted(run.simulations).value for _, run in known]
    return dict(zip(problem.space.names, known[int(np.argmin(values))][1].point, strict=True))
