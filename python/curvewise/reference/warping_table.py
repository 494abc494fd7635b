"""The dynamic-programming table c[i, j] of two curves, and its path.

dtw and frechet share this code. A cell c[i, j] depends on the ground distance d of P[i] and Q[j]
and on three cells: up, left and diagonal. Each measure defines how. The cells of an anti-diagonal i
+ j = s depend on earlier ones only, and are computed at once. Time and memory O(n m); a path takes
O(n + m).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array

__all__ = ["filled_table", "traced_path"]


def filled_table(
    ground: Array,
    cell: Callable[[Array, Array, Array, Array], Array],
    *,
    open_begin: bool = False,
) -> Array:
    """Return c of `ground`, where c[i, j] is ``cell(d, up, left, diagonal)``.

    With `open_begin` a path may begin in each cell of the first row.
    """
    n, m = ground.shape
    # table[i + 1, j + 1] is c[i, j]: with a border of inf, the first row and column need no special
    # case. Above an open first row the border is 0: a path may begin in each of its cells.
    table = np.full((n + 1, m + 1), np.inf)
    if open_begin:
        table[0, :] = 0.0
    table[1, 1] = ground[0, 0]
    with np.errstate(over="ignore"):
        for s in range(1, n + m - 1):
            i = np.arange(max(0, s - m + 1), min(s, n - 1) + 1)
            j = s - i
            up, left, diagonal = table[i, j + 1], table[i + 1, j], table[i, j]
            table[i + 1, j + 1] = cell(ground[i, j], up, left, diagonal)
    return table[1:, 1:]


def traced_path(
    table: Array,
    end: int,
    is_diagonal: Callable[[int, int], bool],
    *,
    open_begin: bool = False,
) -> npt.NDArray[np.int64]:
    """Trace the path back from the last row's column `end`.

    ``is_diagonal(i, j)`` returns, for a cell behind the first row and column, whether it was
    reached from c[i-1, j-1]. If not, the smaller of the other two is taken; of equal ones c[i-1,
    j].
    """
    i, j = len(table) - 1, end
    path = [(i, j)]
    while i > 0 or (j > 0 and not open_begin):
        if i > 0 and j > 0 and is_diagonal(i, j):
            i, j = i - 1, j - 1
        elif j == 0 or (i > 0 and table[i - 1, j] <= table[i, j - 1]):
            i -= 1
        else:
            j -= 1
        path.append((i, j))
    return np.array(path[::-1], dtype=np.int64)
