"""Objectives along the straight line between two sets of parameters.

The number of minima of a measure and its smoothness decide which optimiser works. The line between
the optima of two measures shows both (the paper's appendix B). Cost: one run of the model for every
point of the line, whatever the number of measures.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .._extras import required
from ..curves.inputs import Array
from ..drawing.figures import new_figure
from ..drawing.palette import series_colours
from .models.pool import Model, ModelPool
from .objective.criterion import Measure
from .objective.objective import Objective, objectives_of

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["LinePlot", "line_plot"]


class LinePlot(NamedTuple):
    """Result of `line_plot`.

    Attributes
    ----------
    data : numpy.recarray
        A row for every point. The first column is ``t`` (0 at `a`, 1 at `b`). Every objective has
        its value, and its value scaled to [0, 1] as ``<name>_scaled``; nan if it failed.
    figure : matplotlib.figure.Figure
        The scaled values against t.
    """

    data: np.recarray[Any, Any]
    figure: Picture

    def __repr__(self) -> str:
        return f"LinePlot({len(self.data)} points, {len(self.data.dtype.names) // 2} objectives)"

    def _repr_png_(self) -> bytes:
        return self.figure.png()


def line_plot(
    objectives: Any,
    model: Model,
    a: Mapping[str, float],
    b: Mapping[str, float],
    *,
    points: int = 101,
    measures: Sequence[Measure] | None = None,
    workers: int = 1,
    progress: bool = True,
) -> LinePlot:
    """Compute and draw objectives along the line between two parameter sets.

    Parameters
    ----------
    objectives : mapping of str to Objective, or array_like, or sequence of array_like
        The objectives by name; or the experiments, from which one is made for each of
        `measures`.
    model : callable
        As for :func:`identify`.
    a, b : mapping of str to float
        The ends of the line, with the same parameters.
    points : int, default 101
        Number of points of the line, including its ends.
    measures : sequence of str, callable or Criterion, optional
        For experiments: by default all five in the plane, frechet and dtw otherwise.
    workers : int, default 1
        Processes in which the model runs at the same time; -1 for one per core.
    progress : bool, default True
        Show a progress bar (tqdm).

    Returns
    -------
    LinePlot
        The data and the figure.

    Raises
    ------
    ValueError
        If `a` and `b` differ in their parameters, or `points` is below 2; as for
        :class:`Objective`.
    ImportError
        If matplotlib or tqdm is missing.

    Notes
    -----
    Scaled means: minus its smallest value on the line, divided by its range on the line, so that
    all objectives go from 0 to 1 whatever their units.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import line_plot
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x))
    >>> data, figure = line_plot(
    ...     line({"slope": 2}), line, {"slope": 1}, {"slope": 3}, points=5, progress=False
    ... )
    >>> data.area_scaled.round(3).tolist()
    [1.0, 0.5, 0.0, 0.5, 1.0]
    """
    if set(a) != set(b):
        raise ValueError(f"a has parameters {', '.join(a)} and b {', '.join(b)}; give the same")
    if points < 2:
        raise ValueError(f"points is {points}; give at least 2")
    is_named = isinstance(objectives, Mapping)
    named = objectives if is_named else objectives_of(objectives, measures)
    t = np.linspace(0.0, 1.0, points)
    line = [{key: (1.0 - s) * a[key] + s * b[key] for key in a} for s in t.tolist()]
    values = _values(named, model, line, workers, progress)
    data = _records(t, values)
    figure = new_figure(figsize=(7, 4.2), layout="constrained")
    ax = figure.subplots()
    for name, colour in zip(named, series_colours(len(named)), strict=True):
        ax.plot(t, data[f"{name}_scaled"], color=colour, linewidth=1.2, label=name)
    ax.set(xlabel="position on the line from a to b", ylabel="objective, scaled on the line")
    figure.legend(loc="outside upper center", ncols=len(named), frameon=False)
    return LinePlot(data, figure)


def _values(
    objectives: dict[str, Objective],
    model: Model,
    line: list[dict[str, float]],
    workers: int,
    progress: bool,
) -> dict[str, Array]:
    """Run the model along the line, and return the values of every objective."""
    values = {name: np.full(len(line), np.nan) for name in objectives}
    with ModelPool(model, workers) as pool:
        outcomes = pool.run(line)
        if progress:
            outcomes = required("tqdm").tqdm(outcomes, total=len(line), unit="run")
        for parameters, outcome in outcomes:
            here = [parameters == other for other in line]
            for name, objective in objectives.items():
                score = objective.score(outcome.simulations)
                if not score.failures:
                    values[name][here] = score.value
    return values


def _records(t: Array, values: dict[str, Array]) -> np.recarray[Any, Any]:
    columns = {"t": t}
    for name, raw in values.items():
        columns |= {name: raw, f"{name}_scaled": _scaled(raw)}
    data = np.empty(len(t), dtype=[(name, np.float64) for name in columns])
    for name, column in columns.items():
        data[name] = column
    return data.view(np.recarray)


def _scaled(values: Array) -> Array:
    """Return values minus their minimum, over their range; failed ones are left out."""
    good = values[np.isfinite(values)]
    if not good.size:
        return values
    extent = np.ptp(good)
    scaled: Array = (values - good.min()) / (extent if extent > 0 else 1.0)
    return scaled
