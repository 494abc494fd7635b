"""The trade-off between two measures: which of the runs of a store are good for both.

A run belongs to the front if no other one is better by one measure and not worse by the other. The
search for one measure passes where another one is low, and `identify_each` leaves the runs of both,
so nothing is run for it. Cost: both measures, for every stored run; O(n log n) for the front.

K. Miettinen, "Nonlinear Multiobjective Optimization", Kluwer (1999), part I (the front, and the
point of it whose largest loss is smallest).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ..curves.inputs import Array
from ..drawing.fronts import front_and_parameters
from ..showing.result import Result, Table
from .objective.criterion import Measure
from .problem.tables import digits
from .records.store import StoreOrPath
from .rescoring import Rescored, rescore

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["Front", "front"]

_MOST_ROWS = 12  # of the table


@dataclass(frozen=True, eq=False)
class Front(Result):
    """Result of `front`: the Pareto-optimal runs for two measures.

    Attributes
    ----------
    measures : (str, str)
        The names of the two measures.
    values : ndarray, shape (n, 2)
        The values of the runs on the front for both; the first column rises, the second falls.
    losses : ndarray, shape (n, 2)
        The excess of each over the best run of that measure, as a fraction of the best value.
    parameters : tuple of dict of str to float
        The parameters of each run on the front.
    compromise : int
        The index of the run with the smallest larger loss: good for both measures.
    all_values : ndarray, shape (runs, 2)
        The values of every run that succeeded.
    """

    measures: tuple[str, str]
    values: Array = field(repr=False)
    losses: Array = field(repr=False)
    parameters: tuple[dict[str, float], ...] = field(repr=False)
    compromise: int
    all_values: Array = field(repr=False)

    picture_shows = "The runs by both measures with the front, and the parameters along it"

    def parts(self) -> Sequence[Table | str]:
        """Return the runs of the front, and what the one in the middle costs each measure."""
        names = list(self.parameters[0])
        rows = []
        for i in self._shown():
            losses = [f"{100.0 * loss:.2g}" for loss in self.losses[i]]
            values = [digits(self.parameters[i][name], 4) for name in names]
            rows.append([*losses, *values, "compromise" if i == self.compromise else ""])
        header = [*(f"{name}, % above its best" for name in self.measures), *names, ""]
        one, other = 100.0 * self.losses[self.compromise]
        said = (
            f"{len(self.values)} of {len(self.all_values)} runs are on the front; the compromise "
            f"is {one:.2g} % above the best {self.measures[0]} and {other:.2g} % above the best "
            f"{self.measures[1]}"
        )
        return [Table(rows, header), said]

    def _shown(self) -> list[int]:
        """Return which runs the table has: both ends, the compromise, and some between."""
        some = np.linspace(0, len(self.values) - 1, min(_MOST_ROWS, len(self.values)))
        return sorted({*some.round().astype(int).tolist(), self.compromise})

    def plot(self) -> Picture:
        """Return a matplotlib Figure: all runs by both measures, and parameters along the front.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        names = list(self.parameters[0])
        table = np.array([[one[name] for name in names] for one in self.parameters])
        return front_and_parameters(
            self.all_values, self.values, self.compromise, self.measures, names, table
        )


def front(
    store: StoreOrPath,
    experiments: Any,
    measures: Sequence[Measure] = ("area", "frechet"),
    *,
    model: Any = None,
) -> Front:
    """Return the stored runs that are Pareto-optimal for two measures.

    Parameters
    ----------
    store : path-like or SimulationStore
        A store that `identify` or `identify_each` has filled; best by both measures.
    experiments : array_like, shape (n, d), or sequence of such
        The measured curves.
    measures : sequence of two of str, callable or Criterion, default ("area", "frechet")
        As for :class:`Objective`.
    model : callable or str, optional
        The model of the runs, as for :func:`rescore`.

    Returns
    -------
    Front
        Prints as a table, plots itself.

    Raises
    ------
    ValueError
        If the number of measures is not two, or no run is valid for both of them; as for
        :func:`rescore`.
    FileNotFoundError
        If the file does not exist.

    Notes
    -----
    The front contains existing runs only. A search by each of the two measures makes the ends
    exact; the middle depends on the runs in between. Time: that of both measures for every run.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from curvewise.calibration import SimulationStore, front, identify_each
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x))
    >>> test = np.column_stack((x, 2 * x + 0.5 * x**3))
    >>> folder = tempfile.TemporaryDirectory()
    >>> store = SimulationStore(Path(folder.name, "lines.db"), version="1")
    >>> keywords = {"measures": ["area", "frechet"], "store": store, "progress": False}
    >>> each = identify_each(line, test, {"slope": (0, 10)}, **keywords)
    >>> found = front(store, test)
    >>> bool(found.losses[0, 0] == 0.0 and found.losses[-1, 1] == 0.0)
    True
    >>> folder.cleanup()
    """
    if len(measures) != 2:
        raise ValueError(f"there are {len(measures)} measures; give two")
    one, other = (rescore(store, experiments, measure, model=model) for measure in measures)
    good = ~(one.history.failed | other.history.failed)
    if not good.any():
        raise ValueError(f"no run of the store has both {one.measure} and {other.measure}")
    values = np.column_stack((one.history.value[good], other.history.value[good]))
    chosen = _not_dominated(values)
    on_front, best = values[chosen], values.min(axis=0)
    losses = (on_front - best) / np.where(best > 0.0, best, 1.0)
    rows = np.flatnonzero(good)[chosen]
    return Front(
        (one.measure, other.measure),
        on_front,
        losses,
        tuple(_parameters(one, row) for row in rows),
        int(losses.max(axis=1).argmin()),
        values,
    )


def _not_dominated(values: Array) -> np.ndarray[Any, np.dtype[np.intp]]:
    """Return the rows that no other one dominates, by the first column; of equal ones the first."""
    order = np.lexsort((values[:, 1], values[:, 0]))
    second = values[order, 1]
    lowest_before = np.concatenate(([np.inf], np.minimum.accumulate(second)[:-1]))
    chosen: np.ndarray[Any, np.dtype[np.intp]] = order[second < lowest_before]
    return chosen


def _parameters(rescored: Rescored, row: int) -> dict[str, float]:
    """Return the parameters of a run."""
    names = [n for n in rescored.history.dtype.names or () if n in rescored.parameters]
    return {name: float(rescored.history[name][row]) for name in names}
