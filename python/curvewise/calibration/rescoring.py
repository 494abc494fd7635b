"""Look at the runs of a store with another measure, other weights or another part of the test.

The curves are stored, so no model runs. Cost: the measure, for every run and loop.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..curves.inputs import Array
from ..curves.several_curves import as_points, curve_list
from .models.identity import model_identity
from .objective.criterion import Measure
from .objective.objective import Objective
from .records.evaluation import Evaluation, as_records
from .records.store import SimulationStore, StoreOrPath
from .records.stored_run import StoredRun

__all__ = ["Rescored", "rescore"]


@dataclass(frozen=True, eq=False)
class Rescored:
    """Result of `rescore`.

    Attributes
    ----------
    parameters : dict of str to float
        The best of the stored runs.
    value : float
        The objective there.
    simulations : tuple of ndarray
        Its curves.
    history : numpy.recarray
        Every run in the order of the store: its number, the parameters, value, failed, seconds.
    failures : tuple of (int, str)
        Number of every run that failed, and why.
    measure, preset
        The arguments of the call.
    """

    parameters: dict[str, float]
    value: float
    simulations: tuple[Array, ...] = field(repr=False)
    history: np.recarray[Any, Any] = field(repr=False)
    failures: tuple[tuple[int, str], ...] = field(repr=False)
    measure: str
    preset: str


def rescore(
    store: StoreOrPath,
    experiments: Any,
    measure: Measure = "area",
    *,
    model: Any = None,
    **options: Any,
) -> Rescored:
    """Evaluate an objective for every stored run of a model, without new runs.

    Parameters
    ----------
    store : path-like or SimulationStore
        A store that `identify` has filled.
    experiments : array_like, shape (n, d), or sequence of such
        The measured curves.
    measure, **options
        As for :class:`Objective`.
    model : callable or str, optional
        The model of the runs, or its identity as :meth:`SimulationStore.models` lists it. Required
        if the store has runs of several. If the model is a function, `store` must be a
        :class:`SimulationStore` with its version.

    Returns
    -------
    Rescored
        The best run, and the value of every run.

    Raises
    ------
    ValueError
        If the store is empty, or has runs of several models and `model` is missing. If an option is
        wrong.
    FileNotFoundError
        If the file does not exist.

    Notes
    -----
    Time: that of the measure for every run; memory: the curves of the best.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from curvewise.calibration import SimulationStore, identify, rescore
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x))
    >>> folder = tempfile.TemporaryDirectory()
    >>> store = SimulationStore(Path(folder.name, "lines.db"), version="1")
    >>> keywords = {"method": "sdrm", "store": store, "progress": False}
    >>> found = identify(line, line({"slope": 2.0}), {"slope": (0, 10)}, **keywords)
    >>> again = rescore(store, line({"slope": 2.0}), "dtw")
    >>> len(again.history) == found.evaluations, round(again.parameters["slope"], 3)
    (True, 2.0)
    >>> folder.cleanup()
    """
    objective = Objective(experiments, measure, **options)
    evaluations: list[Evaluation] = []
    best: StoredRun | None = None
    lowest = np.inf
    names: tuple[str, ...] = ()
    file = SimulationStore(store).path
    if not file.is_file():
        raise FileNotFoundError(f"there is no store {str(file)!r}; give identify(..., store=...)")
    with SimulationStore(store) as runs:
        for number, run in enumerate(runs.runs(_identity(runs, model)), 1):
            names = names or tuple(run.parameters)
            score = objective.score(run.simulations)
            message = run.message or "; ".join(score.failures)
            point = tuple(run.parameters[name] for name in names)
            evaluations.append(
                Evaluation(number, point, score.value, bool(message), run.seconds, message)
            )
            if score.value < lowest and not message:
                best, lowest = run, score.value
    if best is None or best.simulations is None:
        raise ValueError(f"{file} has no run of that model that succeeded")
    return Rescored(
        best.parameters,
        lowest,
        tuple(as_points(curve, "Q") for curve in curve_list(best.simulations)),
        as_records(evaluations, names),
        tuple((e.number, e.message) for e in evaluations if e.failed and not e.outside),
        objective.measure,
        objective.preset,
    )


def _identity(runs: SimulationStore, model: Any) -> str:
    known = runs.models()
    if model is None:
        if len(known) != 1:
            listed = "; ".join(known) or "none"
            raise ValueError(
                f"{runs.path} has runs of {len(known)} models ({listed}); name one: model=..."
            )
        return known[0]
    wanted = model if isinstance(model, str) else model_identity(model, runs.version).text
    if wanted not in known:
        raise ValueError(
            f"{runs.path} has no runs of {wanted}; it has those of: {'; '.join(known) or 'none'}"
        )
    return wanted
