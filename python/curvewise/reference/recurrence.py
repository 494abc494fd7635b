"""A table c[i, j] of two curves whose steps reach over several rows and columns.

    c[i, j] = min over steps of  c[i - rows, j - columns] + constant + sum of weight x cost

added up in this order. Each cost belongs to a cell on the way of the step, or to the step itself. A
step with an infinite cost is infinite, whatever the weight. The cells before the first row and the
first column form a border, which is infinite unless a recurrence defines it. The table is filled
row by row, cell by cell, which is the easiest order to check. Time O(n m) times the number of
costs, memory O(n m). The steps of named patterns are those of the library: they are data, checked
by a test against R's dtw.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array

__all__ = ["EndOf", "Recurrence", "Step", "filled", "found_path", "last_cell", "pattern_steps"]

CellCost: TypeAlias = Callable[[int, int], float]
EndOf: TypeAlias = Callable[[Array], tuple[int, int]]
START: Final = -1


class Step(NamedTuple):
    """From the cell before to the next one."""

    rows: int
    columns: int
    constant: float
    costs: Sequence[tuple[float, CellCost]]  # weights, and costs of the cell (i, j) that is reached
    visited: Sequence[tuple[int, int]] = ()  # cells between both, behind the one that is reached


class Recurrence(NamedTuple):
    """Steps, and what lies before the first row and the first column."""

    steps: Sequence[Step]
    # Cells in which paths may start, with their costs; None if paths start before the first cell.
    starts: Mapping[tuple[int, int], float] | None = None
    above: Array | float = np.inf  # c[-1, j]
    before: Array | float = np.inf  # c[i, -1]

    def without_costs(self) -> Recurrence:
        """Return the same steps, which cost nothing: c is 0 where a path leads."""
        free = [step._replace(constant=0.0, costs=()) for step in self.steps]
        starts = None if self.starts is None else dict.fromkeys(self.starts, 0.0)
        return self._replace(steps=free, starts=starts)


def pattern_steps(
    steps: Sequence[Sequence[tuple[int, int, float]]], penalty: float, ground: Array
) -> list[Step]:
    """Return the steps of a pattern over a table of ground distances."""

    def cost(rows: int, columns: int) -> CellCost:
        return lambda i, j: float(ground[i - rows, j - columns])

    result = []
    for (rows, columns, _), *cells in steps:
        costs = [(weight, cost(*place)) for *place, weight in cells if weight != 0]
        between = [(i, j) for i, j, _ in cells if (i, j) not in ((0, 0), (rows, columns))]
        result.append(Step(rows, columns, penalty * (rows != columns), costs, between))
    return result


def filled(
    recurrence: Recurrence, inside: npt.NDArray[np.bool_]
) -> tuple[Array, npt.NDArray[np.int64]]:
    """Return c inside the window, and each cell's last step or `START`.

    A path starts in a cell if every path from elsewhere is at least as expensive.
    """
    n, m = inside.shape
    # table[i + 1, j + 1] is c[i, j].
    table = np.full((n + 1, m + 1), np.inf)
    table[0, 1:], table[1:, 0] = recurrence.above, recurrence.before
    if recurrence.starts is None:
        table[0, 0] = 0.0
    starts = recurrence.starts or {}
    taken = np.zeros((n, m), dtype=np.int64)
    for i, j in np.argwhere(inside):
        for number, step in enumerate(recurrence.steps):
            row, column = i + 1 - step.rows, j + 1 - step.columns
            if row < 0 or column < 0 or table[row, column] == np.inf:
                continue
            value = float(table[row, column])
            value = value + step.constant if step.constant else value
            for weight, cost in step.costs:
                added = cost(i, j)
                value = value + (weight * added if added < np.inf else added)
            if value < table[i + 1, j + 1]:  # which nan is not: a sum that overflows both ways
                table[i + 1, j + 1], taken[i, j] = value, number
        if starts.get((i, j), np.nan) <= table[i + 1, j + 1]:
            table[i + 1, j + 1], taken[i, j] = starts[i, j], START
    return table[1:, 1:], taken


def last_cell(table: Array) -> tuple[int, int]:
    """Return where a path ends that leaves nothing out."""
    return table.shape[0] - 1, table.shape[1] - 1


def found_path(
    recurrence: Recurrence,
    inside: npt.NDArray[np.bool_],
    table: Array,
    taken: npt.NDArray[np.int64],
    end_of: EndOf = last_cell,
) -> npt.NDArray[np.int64]:
    """Return the path of a filled table; any admissible path if all are infinite.

    Return an empty path if an admissible one does not exist.
    """
    if table[end_of(table)] == np.inf:
        recurrence = recurrence.without_costs()
        table, taken = filled(recurrence, inside)
    if table[end_of(table)] == np.inf:
        return np.empty((0, 2), dtype=np.int64)
    return _path_through(recurrence, taken, end_of(table))


def _path_through(
    recurrence: Recurrence, taken: npt.NDArray[np.int64], end: tuple[int, int]
) -> npt.NDArray[np.int64]:
    """Trace the path back from its end to where it starts, or to the border."""
    i, j = end
    path = []
    while i >= 0 and j >= 0:
        path.append((i, j))
        if i == j == 0 or taken[i, j] == START:
            break
        step = recurrence.steps[taken[i, j]]
        path += [(i - rows, j - columns) for rows, columns in reversed(step.visited)]
        i, j = i - step.rows, j - step.columns
    return np.array(path[::-1], dtype=np.int64)
