"""The parameters by several measures, from shared runs: what the paper's section 4 asks for.

"Use several measures; their spread indicates the uncertainty." The measures search one after the
other. All use one store, so that no run is made twice, and each but the first begins at the best
of all runs so far under its own measure, in a small region. With "trust-region" each then goes on
from the best of all runs for smaller gains, as long as it finds any. Cost: the first search in
full, the others a fraction of it with the methods that begin from what is known ("trust-region",
"sdrm").
"""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._curves import Array
from ..measures.registry import default_measures
from ..plotting import drawing
from ..plotting.palette import GROUND_COLOUR, series_colours
from .curve_list import as_points, curve_list
from .history import Evaluation
from .identification import Identification, identification_of
from .loop_measure import measure_name
from .model_pool import Model
from .objective import Objective
from .parameters import Bounds, Space
from .pictures import axes_of, drawn, labels, titles_of
from .running import Plan, run_search
from .store import StorePath
from .study import Study, models_of

if TYPE_CHECKING:
    from ..plotting.picture import Picture

__all__ = ["SeveralMeasures", "identify_each"]

# The first region of a search that begins where others have ended, for methods that have one.
_WARM_RANGE = 0.1
# After the first round every measure goes on from the best of all runs, and on for less, until no
# search has gained more than this fraction of its value.
_WORTH_A_ROUND, _ROUNDS = 1e-3, 4
# Of "trust-region": wider than where it began, to leave a valley of other measures.
_CLOSER = {"initial_range": 0.3, "gain": 2e-5, "tol": 1e-4}


class SeveralMeasures(Mapping[str, Identification]):
    """What `identify_each` returns: an :class:`Identification` for every measure, by its name.

    Attributes
    ----------
    runs : int
        How many runs of the model all searches made together.
    optima : ndarray, shape (measures, measures)
        Row i has the optimum of measure i under every measure (the paper's Table 4); nan where
        one refuses.
    """

    def __init__(self, found: Mapping[str, Identification]) -> None:
        self._found = dict(found)
        self.runs = sum(one.runs for one in self._found.values())
        self.optima = np.array(
            [[_value(two, one) for two in found.values()] for one in found.values()]
        )

    def __getitem__(self, measure: str) -> Identification:
        return self._found[measure]

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def __str__(self) -> str:
        return self.table()

    @property
    def spread(self) -> dict[str, tuple[float, float]]:
        """The smallest and the largest value of every parameter, over the measures."""
        names = next(iter(self._found.values())).parameters
        columns = {name: [one.parameters[name] for one in self._found.values()] for name in names}
        return {name: (min(column), max(column)) for name, column in columns.items()}

    def __repr__(self) -> str:
        return f"SeveralMeasures({', '.join(self._found)}: {self.runs} runs)"

    def _repr_html_(self) -> str:
        from .in_notebooks import several_html

        return several_html(self)

    def rows(self) -> tuple[list[list[str]], list[list[str]]]:
        """Return the rows of both parts of the table, the headers first."""
        names = list(self.spread)
        bounds = next(iter(self._found.values())).bounds
        rows = [["", *names]]
        for measure, one in self._found.items():
            rows.append([measure, *(f"{one.parameters[name]:.5g}" for name in names)])
        spread = ["spread, % of bounds"]
        for name, (low, high) in self.spread.items():
            width = bounds[name][1] - bounds[name][0] if name in bounds else math.nan
            spread.append("" if math.isnan(width) else f"{100.0 * (high - low) / width:.2g}")
        rows.append(spread)
        values = [["optimum of", *self._found, "runs"]]
        for (measure, one), row in zip(self._found.items(), self.optima, strict=True):
            values.append([measure, *(f"{value:.5g}" for value in row), f"{one.runs}"])
        return rows, values

    def table(self) -> str:
        """Return the parameters by measure with their spread, and every optimum by every measure.

        The spread is the largest minus the smallest, in % of the bounds' range.
        """
        parameters, optima = self.rows()
        return f"{_aligned(parameters)}\n\n{_aligned(optima)}\n\n{self.runs} runs of the model"

    def plot(self, *, names: Sequence[str] | None = None) -> Picture:
        """Return a matplotlib Figure: the loops of every measure, and the parameters.

        Parameters
        ----------
        names : sequence of str, optional
            As for :meth:`Identification.plot`.

        Raises
        ------
        ImportError
            matplotlib is not installed: ``pip install "curvewise[plot]"``.
        """
        first = next(iter(self._found.values()))
        axes = axes_of(first.study.objective, names)
        titles = titles_of(first.study.objective)
        count = len(first.experiments) + 1
        columns = math.ceil(math.sqrt(count))
        rows = math.ceil(count / columns)
        figure = drawing.new_figure(figsize=(4.6 * columns, 3.6 * rows), layout="constrained")
        panels = figure.subplots(rows, columns, squeeze=False).ravel().tolist()
        for ax in panels[count:]:
            ax.remove()
        for i, experiment in enumerate(first.experiments):
            ax = panels[i]
            ax.plot(
                *drawn(experiment), ".", color=drawing.FILL_COLOUR, markersize=3, label="experiment"
            )
            for colour, (measure, one) in zip(
                series_colours(len(self)), self._found.items(), strict=True
            ):
                ax.plot(*drawn(one.simulations[i]), color=colour, linewidth=1.1, label=measure)
            drawing.label_axes(ax, *labels(axes[i]))
            if count > 2:
                ax.set_title(titles[i])
        handles, texts = panels[0].get_legend_handles_labels()
        figure.legend(handles, texts, loc="outside upper left", ncols=len(texts), frameon=False)
        self._draw_parameters(panels[count - 1])
        return figure

    def report(self, path: str | os.PathLike[str]) -> None:
        """Write all identifications down as one page of HTML; see :meth:`Identification.report`.

        Parameters
        ----------
        path : path-like
            The file; what is there is replaced.

        Raises
        ------
        ImportError, ValueError, OSError
            As :meth:`Identification.report`.
        """
        from .report import write_report
        from .report.ending import record_of

        write_report(path, [record_of(one, None) for one in self._found.values()])

    def _draw_parameters(self, ax: Any) -> None:
        """Draw every parameter within its bounds, a row each."""
        bounds = next(iter(self._found.values())).bounds
        rows = range(len(bounds))
        ax.hlines(rows, 0.0, 1.0, color=GROUND_COLOUR, linewidth=4, zorder=0)
        for colour, one in zip(series_colours(len(self)), self._found.values(), strict=True):
            units = one.study.space.unit_of(one.parameters)
            ax.plot(units, rows, "o", color=colour, markersize=5, markerfacecolor="none")
        ax.set_yticks(list(rows), list(bounds))
        ax.invert_yaxis()
        ax.set(xlim=(-0.03, 1.03), xlabel="place between the bounds", title="Parameters")


def identify_each(
    model: Model,
    experiments: Any,
    bounds: Bounds,
    *,
    measures: Sequence[str] | None = None,
    method: str = "trust-region",
    method_options: Mapping[str, Any] | None = None,
    seed: int = 0,
    workers: int = 1,
    executor: Any = None,
    progress: bool = True,
    store: StorePath | None = None,
    version: str | None = None,
    start: Mapping[str, float] | None = None,
    max_evaluations: int | None = None,
    **keywords: Any,
) -> SeveralMeasures:
    """Find the parameters by each of several measures, with runs shared among them.

    Parameters
    ----------
    model, experiments, bounds
        As for :func:`identify`.
    measures : sequence of str or callable, optional
        By default every measure that the curves' dimension allows. Each search begins where the
        ones before have been, so put the smoothest first.
    method, method_options
        As for :func:`identify`; the methods "trust-region" and "sdrm" gain most. The searches
        after the first have `initial_range` 0.1 unless it is given.
    store, version
        As for :func:`identify`. Without a store runs are shared all the same, through a temporary
        one, and forgotten.
    max_evaluations : int, optional
        Of each measure.
    seed, workers, executor, progress, start, **keywords
        As for :func:`identify`, for all measures. Options of one measure alone are not taken here:
        use :func:`identify` with a `store` for those.

    Returns
    -------
    SeveralMeasures
        A mapping of measures to identifications; prints as a table, plots itself.

    Raises
    ------
    ValueError, RuntimeError, ImportError, KeyboardInterrupt
        As for :func:`identify`; a measure that is given twice.

    Notes
    -----
    Runs: for the four measures of `benchmarks/validation/shared_runs.py`, 7 parameters, 393, where
    four searches by "sdrm" take 751; three optima are as good as theirs to 0.02 %, and that of
    frechet, which has several, is 4 % above.

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
    if measures is None:
        measures = default_measures(as_points(curve_list(experiments)[0], "P"))
    names = [measure_name(measure) for measure in measures]
    if not names or len(set(names)) != len(names):
        raise ValueError(f"measures is {list(measures)}; give at least one, and none twice")
    space = Space(bounds)
    objectives = [Objective(experiments, measure, **keywords) for measure in measures]
    options = dict(method_options or {})
    plan = Plan(method, options, seed, start, progress, None, None, max_evaluations)
    for measure in measures:
        plan.check(measure)
    found: dict[str, Identification] = {}
    with ExitStack() as stack:
        if store is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="curvewise_"))
            store, version = Path(folder, "runs.db"), version or "of this call"
        models, assemble = models_of(model)
        known: tuple[tuple[Array, Evaluation], ...] = ()
        for name, objective in zip(names, objectives, strict=True):
            study = Study(models, assemble, objective, space, store, version, workers, executor)
            if known:  # a start is given from here on: one search a measure
                plan = replace(
                    plan,
                    start=_best_known(known, study),
                    method_options=_from_near(method, options),
                )
            found[name] = identification_of(study, plan, run_search(study, plan, known))
            known = found[name].kept
        if method == "trust-region":
            _go_on(found, plan, {**_CLOSER, **options}, known)
    return SeveralMeasures(found)


def _go_on(
    found: dict[str, Identification],
    plan: Plan,
    options: Mapping[str, Any],
    known: tuple[tuple[Array, Evaluation], ...],
) -> None:
    """Search again by each measure from what all have found, as long as one of them gains."""
    waiting = list(found)
    for _ in range(_ROUNDS):
        gained = []
        for name in waiting:
            before = found[name]
            left = (
                None if plan.max_evaluations is None else plan.max_evaluations - len(before.history)
            )
            if left is not None and left < 1:
                continue
            again = replace(
                plan,
                start=_best_known(known, before.study),
                method_options=options,
                max_evaluations=left,
            )
            after = identification_of(before.study, again, run_search(before.study, again, known))
            known = after.kept
            found[name] = before.followed_by(after)
            if before.value - after.value > _WORTH_A_ROUND * before.value:
                gained.append(name)
        waiting = gained


def _best_known(known: Sequence[tuple[Array, Evaluation]], study: Study) -> dict[str, float]:
    """Return the parameters of the run that is best under an objective."""
    values = [study.objective.predicted(run.simulations).value for _, run in known]
    return dict(zip(study.space.names, known[int(np.argmin(values))][1].point, strict=True))


def _from_near(method: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options of a search that begins near its end."""
    if method in ("trust-region", "sdrm"):
        return {"initial_range": _WARM_RANGE, **options}
    if method == "sdrm+de":
        return {**options, "sdrm": {"initial_range": _WARM_RANGE, **options.get("sdrm", {})}}
    return dict(options)


def _value(by: Identification, optimum: Identification) -> float:
    """Return an optimum under the measure of another identification."""
    score = by.study.objective.predicted(optimum.simulations)
    return math.nan if score.failures else score.value


def _aligned(rows: list[list[str]]) -> str:
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True)]
        lines.append("  ".join([row[0].ljust(widths[0]), *cells]))
    return "\n".join(lines)
