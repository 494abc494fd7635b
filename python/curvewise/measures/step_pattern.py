"""Step patterns: the steps of a warping path, and the weights of their cells.

The compiled library defines the named patterns (step_pattern.hpp) and compiles them into the steps
of its recurrence. This module reads them and defines custom ones, in R's notation (Giorgino 2009).
A row is a cell that a step visits: its step, the rows and columns that it lies behind the step's
end, and its weight. The first row of a step has the weight -1.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, Literal, SupportsFloat, SupportsIndex, TypeAlias

from .._core import rabiner_juang, step_patterns
from .._options import StepPatternName, check_choice, whole_number
from ..drawing.steps import steps_figure
from ..showing.result import Result, Table

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["StepPattern", "Steps", "may_be_negative"]

Row: TypeAlias = tuple[int, int, int, float]
Normalization: TypeAlias = Literal["NA", "N", "M", "N+M"]


@dataclass(frozen=True)
class StepPattern(Result):
    """The steps of warping paths, in R's notation.

    Attributes
    ----------
    rows : tuple of (int, int, int, float)
        A tuple for each cell that a step visits: the number of the step, the rows and the columns
        that the cell lies behind the step's end, and its weight. The first cell of a step is its
        beginning, with the weight -1. At most 8 rows and columns behind.
    normalization : {"NA", "N", "M", "N+M"}
        The divisor of ``normalize=True``: the weight that all paths share. "NA" if they differ.

    Notes
    -----
    For ``step_pattern`` of :func:`curvewise.dtw`, as R's ``stepPattern`` for its ``dtw``. Of equal
    steps a path takes the first.

    A weight may be negative. Distances may then be below 0, and a `cutoff` or a `radius` may be
    negative too. A step is infinite if a cell of infinite ground distance takes part in it with a
    weight other than 0. Sums beyond the range of a double are inf or -inf. No distance is nan.

    Examples
    --------
    >>> import curvewise
    >>> print(curvewise.StepPattern.named("symmetricP1"))
    c[i, j] = min(
        c[i-1, j-2] + 2 d[i, j-1] + d[i, j],
        c[i-1, j-1] + 2 d[i, j],
        c[i-2, j-1] + 2 d[i-1, j] + d[i, j],
    ), normalised by N+M
    >>> knight = curvewise.StepPattern([(1, 1, 2, -1), (1, 0, 0, 1), (2, 2, 1, -1), (2, 0, 0, 1)])
    >>> curvewise.dtw([0, 1, 2, 3], [0, 2, 3, 3, 3], step_pattern=knight)
    inf
    """

    rows: Sequence[tuple[SupportsIndex, SupportsIndex, SupportsIndex, SupportsFloat]]
    normalization: Normalization = "NA"

    picture_shows = "The cells that each step visits, and their weights"

    def __post_init__(self) -> None:
        check_choice("normalization", self.normalization, ("NA", "N", "M", "N+M"))
        object.__setattr__(self, "rows", _checked(self.rows))

    @classmethod
    def named(cls, name: StepPatternName) -> StepPattern:
        """Return the pattern of that name, as :func:`curvewise.dtw` takes it."""
        patterns = step_patterns()
        check_choice("step_pattern", name, patterns)
        return cls(*patterns[name])

    @classmethod
    def rabiner_juang(
        cls, type: int, weight: Literal["a", "b", "c", "d"] = "d", *, smoothed: bool = False
    ) -> StepPattern:
        """Return a pattern of Rabiner & Juang, "Fundamentals of Speech Recognition" (1993), 4.7.

        Parameters
        ----------
        type : int
            The set of steps, 1 to 7.
        weight : {"a", "b", "c", "d"}
            The weight of a move of some rows and columns: the fewer of both, the more, the rows, or
            their sum.
        smoothed : bool
            Whether all moves of a step weigh as much as they do on average.
        """
        return cls(*rabiner_juang(whole_number("type", type, 1, "1 to 7", 7), weight, smoothed))

    def steps(self) -> list[list[tuple[int, int, float]]]:
        """Return of each step (rows, columns, weight) of its cells, from where it begins."""
        rows: Iterable[Row] = self.rows  # type: ignore[assignment]  # checked
        return [[row[1:] for row in step] for _, step in groupby(rows, key=lambda row: row[0])]

    def parts(self) -> Sequence[Table | str]:
        """Return the recurrence."""
        return [str(self)]

    def __str__(self) -> str:
        lines = [f"    {' + '.join(_written(step))},\n" for step in self.steps()]
        end = "" if self.normalization == "NA" else f", normalised by {self.normalization}"
        return f"c[i, j] = min(\n{''.join(lines)}){end}"

    def plot(self) -> Picture:
        """Return a matplotlib Figure of the steps.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        return steps_figure(self.steps())


Steps: TypeAlias = StepPatternName | StepPattern


def may_be_negative(step_pattern: object) -> bool:
    """Return whether an option is a pattern with a negative weight: distances may be below 0."""
    if not isinstance(step_pattern, StepPattern):
        return False
    return any(weight < 0 for step in step_pattern.steps() for *_, weight in step[1:])


def _checked(rows: Iterable[Sequence[SupportsIndex | SupportsFloat]]) -> tuple[Row, ...]:
    try:
        # Values that are not numbers are refused here, whatever their type.
        checked = tuple((int(s), int(i), int(j), float(w)) for s, i, j, w in rows)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ValueError("rows are of four numbers: step, rows, columns, weight") from None
    if not checked:
        raise ValueError("rows is empty; a pattern has at least one step")
    starts = [next(step)[3] for _, step in groupby(checked, key=lambda row: row[0])]
    if starts != [-1.0] * len(starts):
        raise ValueError("the first row of each step has the weight -1, and is where it begins")
    return checked


def _written(step: Sequence[tuple[int, int, float]]) -> list[str]:
    def cell(name: str, rows: int, columns: int) -> str:
        return f"{name}[i{-rows if rows else ''}, j{-columns if columns else ''}]"

    (rows, columns, _), *visited = step
    costs = [
        cell("d", *place) if weight == 1 else f"{weight:.3g} {cell('d', *place)}"
        for *place, weight in visited
        if weight != 0
    ]
    return [cell("c", rows, columns), *costs]
