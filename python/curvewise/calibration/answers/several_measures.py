"""The result of `identify_each`: parameters by several measures."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...drawing.loops import loops_and_places
from ...showing.result import Result, Table
from ..report.page import write_report
from .identification import Identification

if TYPE_CHECKING:
    from ...drawing.picture import Picture

__all__ = ["SeveralMeasures"]


class SeveralMeasures(Mapping[str, Identification], Result):
    """Result of `identify_each`: an :class:`Identification` for every measure.

    Attributes
    ----------
    runs : int
        Number of model runs in all searches together.
    optima : ndarray, shape (measures, measures)
        Row i has the optimum of measure i under every measure (the paper's Table 4); nan where
        one refuses.
    """

    def __init__(self, found: Mapping[str, Identification]) -> None:
        self._identifications = dict(found)
        self.runs = sum(one.runs for one in self._identifications.values())
        self.optima = np.array(
            [[_value(two, one) for two in found.values()] for one in found.values()]
        )

    def __getitem__(self, measure: str) -> Identification:
        return self._identifications[measure]

    def __iter__(self) -> Iterator[str]:
        return iter(self._identifications)

    def __len__(self) -> int:
        return len(self._identifications)

    @property
    def spread(self) -> dict[str, tuple[float, float]]:
        """The smallest and the largest value of every parameter, over the measures."""
        names = self._first.parameters
        columns = {name: [one.parameters[name] for one in self.values()] for name in names}
        return {name: (min(column), max(column)) for name, column in columns.items()}

    def __repr__(self) -> str:
        return f"SeveralMeasures({', '.join(self._identifications)}: {self.runs} runs)"

    picture_shows = "The loops of every measure, and the parameters"

    def parts(self) -> Sequence[Table | str]:
        """Return the parameters by measure with their spread, and every optimum by every measure.

        The spread is the distance of the smallest and the largest between the bounds, in %: of a
        parameter that is searched for on a logarithmic scale, on that scale.
        """
        space = self._first.problem.space
        rows = [
            [measure, *(f"{value:.5g}" for value in one.parameters.values())]
            for measure, one in self.items()
        ]
        spread = ["spread, % of bounds"]
        for name, ends in self.spread.items():
            if name in space.bounds:
                low, high = (space.place(name, end) for end in ends)
                spread.append(f"{100.0 * (high - low):.2g}")
            else:
                spread.append("")
        optima = [
            [measure, *(f"{value:.5g}" for value in row), f"{one.runs}"]
            for (measure, one), row in zip(self.items(), self.optima, strict=True)
        ]
        return [
            Table([*rows, spread], ["", *self.spread]),
            Table(optima, ["optimum of", *self, "runs"]),
            f"{self.runs} runs of the model",
        ]

    def table(self) -> str:
        """Return the parameters by measure, and every optimum by every measure, as `str` does."""
        return str(self)

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
        objective = self._first.problem.objective
        return loops_and_places(
            self._first.experiments,
            {measure: one.simulations for measure, one in self.items()},
            {measure: _places(one) for measure, one in self.items()},
            objective.axes(names),
            objective.titles,
        )

    def report(self, path: str | os.PathLike[str]) -> None:
        """Write one HTML report of all identifications.

        Parameters
        ----------
        path : path-like
            The file; an existing file is replaced.

        Raises
        ------
        ImportError, ValueError, OSError
            As for :meth:`Identification.report`.
        """
        write_report(path, [one.record() for one in self._identifications.values()])

    @property
    def _first(self) -> Identification:
        return next(iter(self.values()))


def _places(identification: Identification) -> dict[str, float]:
    """Return where each parameter is between its bounds."""
    space = identification.problem.space
    return dict(zip(space.names, space.unit_of(identification.parameters).tolist(), strict=True))


def _value(by: Identification, optimum: Identification) -> float:
    """Return an optimum under the measure of another identification."""
    score = by.problem.objective.predicted(optimum.simulations)
    return math.nan if score.failures else score.value
