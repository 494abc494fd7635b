"""The parameters by several measures, side by side: what `identify_each` returns."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...drawing import figures as drawing
from ...drawing.loops import drawn, labels
from ...drawing.palette import GROUND_COLOUR, series_colours
from ...showing.notebook import paragraph, picture, table
from ..report.page import write_report
from .identification import Identification

if TYPE_CHECKING:
    from ...drawing.picture import Picture

__all__ = ["SeveralMeasures"]


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
        parameters, optima = self.rows()
        return "\n".join(
            [
                table(parameters[1:], parameters[0]),
                table(optima[1:], optima[0]),
                paragraph(f"{self.runs} runs of the model"),
                picture(self.plot, "The loops of every measure, and the parameters"),
            ]
        )

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
        axes = first.problem.objective.axes(names)
        titles = first.problem.objective.titles
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
        write_report(path, [one.record() for one in self._found.values()])

    def _draw_parameters(self, ax: Any) -> None:
        """Draw every parameter within its bounds, a row each."""
        bounds = next(iter(self._found.values())).bounds
        rows = range(len(bounds))
        ax.hlines(rows, 0.0, 1.0, color=GROUND_COLOUR, linewidth=4, zorder=0)
        for colour, one in zip(series_colours(len(self)), self._found.values(), strict=True):
            units = one.problem.space.unit_of(one.parameters)
            ax.plot(units, rows, "o", color=colour, markersize=5, markerfacecolor="none")
        ax.set_yticks(list(rows), list(bounds))
        ax.invert_yaxis()
        ax.set(xlim=(-0.03, 1.03), xlabel="place between the bounds", title="Parameters")


def _value(by: Identification, optimum: Identification) -> float:
    """Return an optimum under the measure of another identification."""
    score = by.problem.objective.predicted(optimum.simulations)
    return math.nan if score.failures else score.value


def _aligned(rows: list[list[str]]) -> str:
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True)]
        lines.append("  ".join([row[0].ljust(widths[0]), *cells]))
    return "\n".join(lines)
