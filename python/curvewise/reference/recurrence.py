"""A table c[i, j] of two curves whose steps reach over several rows and columns.

    c[i, j] = min over steps of  c[i - rows, j - columns] + constant + sum of weight x cost

added up in this order, where each cost is that of a cell on the way of the step, or one of its
own. A step with an infinite cost is infinite, whatever the cost's weight. What comes before the
first row and the first column is a border, infinite but where a recurrence says otherwise. Filled
row by row, cell by cell, since nothing is faster to check. Time O(n m) times the number of costs,
memory O(n m). The steps of named patterns are those that the library has: they are data, held to
R's dtw by a test.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array

__all__ = ["Recurrence", "Step", "filled", "found_path", "pattern_steps"]

CellCost: TypeAlias = Callable[[int, int], float]


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
    first: float | None = None  # c[0, 0] where paths start there; None where they start before it
    above: Array | float = np.inf  # c[-1, j]
    before: Array | float = np.inf  # c[i, -1]

    def without_costs(self) -> Recurrence:
        """Return the same steps, which cost nothing: c is 0 where a path leads."""
        free = [step._replace(constant=0.0, costs=()) for step in self.steps]
        return self._replace(steps=free, first=None if self.first is None else 0.0)


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
    """Return c in the cells that are inside of the window, and by which step each was reached."""
    n, m = inside.shape
    # table[i + 1, j + 1] is c[i, j].
    table = np.full((n + 1, m + 1), np.inf)
    table[0, 1:], table[1:, 0] = recurrence.above, recurrence.before
    if recurrence.first is None:
        table[0, 0] = 0.0
    taken = np.zeros((n, m), dtype=np.int64)
    for i, j in np.argwhere(inside):
        if i == j == 0 and recurrence.first is not None:
            table[1, 1] = recurrence.first
            continue
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
    return table[1:, 1:], taken


def found_path(
    recurrence: Recurrence,
    inside: npt.NDArray[np.bool_],
    table: Array,
    taken: npt.NDArray[np.int64],
) -> npt.NDArray[np.int64]:
    """Return the path of a filled table: one that steps admit where all are infinite, or none."""
    if table[-1, -1] == np.inf:
        recurrence = recurrence.without_costs()
        table, taken = filled(recurrence, inside)
    if table[-1, -1] == np.inf:
        return np.empty((0, 2), dtype=np.int64)
    return _path_through(recurrence, taken)


def _path_through(recurrence: Recurrence, taken: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Trace the path back from the last cell to the first, or to the border."""
    i, j = taken.shape[0] - 1, taken.shape[1] - 1
    path = []
    while i >= 0 and j >= 0:
        path.append((i, j))
        if i == j == 0:
            break
        step = recurrence.steps[taken[i, j]]
        path += [(i - rows, j - columns) for rows, columns in reversed(step.visited)]
        i, j = i - step.rows, j - step.columns
    return np.array(path[::-1], dtype=np.int64)
