"""Averages of a dense, noisy record, with reversals located from both sides.

If the noise of the driving column exceeds its step from row to row, a single row says little and an
extreme is an extreme of the noise. The record is cut into blocks of rows over which the column
moves by at most its noise. The blocks' means are smoothed by quadratics in the row, branch by
branch. The smoother uses the dyadic partition with the least penalised sum of squares (D. L.
Donoho, "CART and best-ortho-basis: a connection", Annals of Statistics 25, 1997). A reversal lies
where the quadratics of its two branches meet. O(n log n) time and O(n) memory.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .checks import Turns
from .inputs import Array
from .turns import turning_points

__all__ = ["averaged", "averaged_turns"]

_FEWEST_ROWS = 16  # of a window in which noise and speed are read
_WINDOWS = 60  # most windows in a branch of the median length
_BACK = 0.25  # share of steps that do not go forward, from which on they are noise
_FASTEST = 3.0  # largest step of a dense record, in deviations of its noise
_LOUDEST = 0.05  # largest noise of a record that is averaged, as a share of its range
_SHORTEST = 12  # fewest blocks of a branch
_LEAF = 4  # fewest blocks of a quadratic
_PENALTY = 12.0  # variances that a further quadratic must gain: 0.7 % of chi-squared, 3 degrees
_GAPS = (12, 4, 0)  # blocks on either side of a reversal that are left out while it is located
_ZOOMS = 4  # on where two quadratics meet: each to a 25th
_LINE = 4  # blocks of the line that ends a branch: its end varies as much as one block


class _Branch(NamedTuple):
    """A branch in blocks.

    Attributes
    ----------
    rows, centres : ndarray, shape (n,)
        Centres of the blocks: on equal steps, and of the whole rows that each has.
    driving : ndarray, shape (n,)
        The smoothed driving column at `rows`.
    parts : ndarray of int, shape (n,)
        Number of blocks in the quadratic that smoothed a block.
    means : ndarray, shape (n, d - 1)
        Means of the other columns.
    """

    rows: Array
    centres: Array
    driving: Array
    parts: npt.NDArray[np.int64]
    means: Array

    def driven_to(self, at: Array, end: int) -> Array:
        """Return the first (0) or last (-1) quadratic at some rows, from three of its values."""
        three = slice(0, 3) if end == 0 else slice(-3, None)
        a, b, c = self.rows[three]
        u, v, w = self.driving[three]
        first, second = (v - u) / (b - a), (w - v) / (c - b)
        value: Array = u + (at - a) * (first + (at - b) * (second - first) / (c - a))
        return value

    def reach(self, end: int) -> float:
        """Return how many rows the first (0) or last (-1) quadratic has."""
        return float(self.parts[end] * (self.rows[1] - self.rows[0]))

    def means_at(self, row: float, end: int) -> Array:
        """Return the means at a row, by a line through the first (0) or last (-1) blocks."""
        some = slice(0, _LINE) if end == 0 else slice(-_LINE, None)
        rows, means = self.centres[some], self.means[some]
        away = rows - rows.mean()
        slope = away @ means / (away @ away)
        value: Array = means.mean(axis=0) + (row - rows.mean()) * slope
        return value


def averaged(record: Array, turns: Turns, reversal: float = 0.1) -> tuple[Array, Turns] | None:
    """Return a dense record as means of blocks of rows, and where it turns; None if it is sparse.

    Parameters
    ----------
    record : ndarray, shape (n, d)
        The first column drives the others.
    turns : sequence of int
        The rows with its extremes, as `turning_points` returns them.
    reversal : float
        The smallest reversal that counts, as it was for `turns`.
    """
    found = _located(record, turns, reversal)
    if found is None:
        return None
    branches, places, reached = found
    return _joined(branches, [0.0, *places, len(record) - 1.0], reached)


def averaged_turns(record: Array, turns: Turns, reversal: float = 0.1) -> Turns | None:
    """Return the rows at which the averages of a dense record turn; None if it is sparse.

    Parameters
    ----------
    record, turns, reversal
        As for `averaged`.
    """
    found = _located(record, turns, reversal)
    return None if found is None else np.rint(found[1]).astype(np.int64)


def _located(
    record: Array, turns: Turns, reversal: float
) -> tuple[list[_Branch], list[float], list[float]] | None:
    """Return the branches of a dense record, the rows where they meet, and the values there."""
    branch = float(np.median(np.diff([0, *turns, len(record)])))
    window = max(_FEWEST_ROWS, int(branch / _WINDOWS))
    if branch < 4 * window:
        return None
    noise, speeds = _noise_and_speeds(record[:, 0], window)
    step = max(float(np.median(speeds)), float(speeds.max()) / _FASTEST)
    if not step < noise < _LOUDEST * float(np.ptp(record[:, 0])):
        return None
    size = max(1.0, noise / float(speeds.max()))
    least = noise**2 * _rows_alike(record[:, 0], noise, float(speeds.mean())) / size
    if branch < _SHORTEST * size:
        return None
    (whole,) = _branches(record, [0, len(record)], size, 0, least)
    found = turning_points(whole.driving, reversal=reversal)
    if len(found) != len(turns):
        return None
    widest = 0.5 * reversal * float(np.ptp(whole.driving))  # half of what a reversal has
    alike = min(2.0 * noise / math.sqrt(size), widest)
    places = [_middle(whole, turn, alike) for turn in found.tolist()]
    for left_out in _GAPS:
        ends = [0, *map(round, places), len(record)]
        shortest = min(b - a for a, b in pairwise(ends))
        if shortest < _SHORTEST * size:
            return None
        gap = math.ceil(min(left_out * size, shortest / 8))
        branches = _branches(record, ends, size, gap, least)
        places, reached = _reversals(branches, ends[1:-1], max(gap, size), 0.1 * noise)
    return branches, places, reached


def _noise_and_speeds(column: Array, rows: int) -> tuple[float, Array]:
    """Return the noise of a column, 0 if it goes forward, and the speed in each window of rows."""
    windows = column[: len(column) // rows * rows].reshape(-1, rows)
    basis = _quadratics(rows)
    shares = windows @ basis
    squares = ((windows - shares @ basis.T) ** 2).sum(axis=1)
    slopes = shares[:, 1] * (basis[-1, 1] - basis[0, 1]) / (rows - 1)
    back = (np.diff(windows, axis=1) * np.sign(slopes)[:, np.newaxis] <= 0.0).mean(axis=1)
    noise = math.sqrt(float(np.median(squares)) / (rows - 3)) if np.median(back) > _BACK else 0.0
    return noise, np.abs(slopes)


def _rows_alike(column: Array, noise: float, speed: float) -> float:
    """Return how many rows share an error: 1, or those of one step of a converter."""
    steps = np.median(np.diff(column) == 0.0) > 0.0
    return max(1.0, math.sqrt(12.0) * noise / speed) if steps else 1.0


def _quadratics(rows: int) -> Array:
    """Return an orthonormal basis of constants, lines and parabolas on equal steps, (rows, 3)."""
    t = np.arange(rows) - 0.5 * (rows - 1)
    basis = np.column_stack((np.ones(rows), t, t * t - np.mean(t * t)))
    found: Array = basis / np.sqrt((basis**2).sum(axis=0))
    return found


def _branches(
    record: Array, ends: Sequence[int], size: float, gap: int, least: float
) -> list[_Branch]:
    """Return the sections between reversals, without `gap` rows at their ends."""
    blocks, squares = [], []
    for a, b in pairwise(ends):
        first, last = a + (gap if a > 0 else 0), b - (gap if b < len(record) else 0)
        count = (last - first) / size
        doublings = int(math.log2(count / _LEAF))
        leaf = int(count / 2**doublings)
        even = np.linspace(first, last, (leaf << doublings) + 1)
        edges = even.round().astype(np.intp)
        sums = np.add.reduceat(record[:last], edges[:-1], axis=0)
        means = sums / np.diff(edges)[:, np.newaxis]
        blocks.append((leaf, even, edges, means))
        parts, basis = means[:, 0].reshape(-1, 2 * leaf), _quadratics(2 * leaf)
        squares.append(((parts - parts @ basis @ basis.T) ** 2).sum(axis=1) / (2 * leaf - 3))
    penalty = _PENALTY * max(least, float(np.median(np.concatenate(squares))))
    return [
        _Branch(
            _centres(even), _centres(edges), *_smoothed(means[:, 0], leaf, penalty), means[:, 1:]
        )
        for leaf, even, edges, means in blocks
    ]


def _centres(edges: npt.NDArray[Any]) -> Array:
    centres: Array = 0.5 * (edges[:-1] + edges[1:] - 1.0)
    return centres


def _smoothed(values: Array, leaf: int, penalty: float) -> tuple[Array, npt.NDArray[np.int64]]:
    """Return the quadratics of the best dyadic partition from `leaf` blocks on, and its parts."""
    rows, fitted, sizes = leaf, values, np.full(len(values), leaf)
    cost = np.full(2 * len(values) // leaf, np.inf)
    while rows <= len(values):
        parts, basis = values.reshape(-1, rows), _quadratics(rows)
        whole = parts @ basis @ basis.T
        price = ((parts - whole) ** 2).sum(axis=1) + penalty
        halves = cost.reshape(-1, 2).sum(axis=1)
        joined = np.repeat(price <= halves, rows)
        fitted, sizes = np.where(joined, whole.ravel(), fitted), np.where(joined, rows, sizes)
        cost, rows = np.minimum(price, halves), 2 * rows
    return fitted, sizes


def _middle(whole: _Branch, turn: int, alike: float) -> float:
    """Return the middle row around a reversal with equal values on both sides."""
    apart = np.flatnonzero(np.abs(whole.driving - whole.driving[turn]) > alike)
    after = int(np.searchsorted(apart, turn))
    return 0.5 * float(whole.rows[apart[after - 1]] + whole.rows[apart[after]])


def _reversals(
    branches: Sequence[_Branch], turns: Sequence[int], reach: float, alike: float
) -> tuple[list[float], list[float]]:
    """Return where neighbouring branches meet, and the largest value that both reach there."""
    places, reached = [], []
    for (before, after), turn in zip(pairwise(branches), turns, strict=True):
        way = 1.0 if before.driving[-1] > before.driving[0] else -1.0
        far = max(reach, 0.25 * min(before.reach(-1), after.reach(0)))
        place = float(turn)
        for _ in range(_ZOOMS):
            near = np.append(place + np.linspace(-far, far, 101), turn)
            both = np.minimum(way * before.driven_to(near, -1), way * after.driven_to(near, 0))
            place, far = float(near[np.argmax(both)]), 0.04 * far
        places.append(place if both.max() > both[-1] + alike else float(turn))
        reached.append(way * float(both.max()))
    return places, reached


def _joined(
    branches: Sequence[_Branch], rows: Sequence[float], reached: Sequence[float]
) -> tuple[Array, Turns]:
    """Return the blocks with the ends of the branches between them, and where the turns are."""
    first, last = branches[0], branches[-1]
    driving = [
        float(first.driven_to(np.array(rows[0]), 0)),
        *reached,
        float(last.driven_to(np.array(rows[-1]), -1)),
    ]
    pieces = [_point(driving[0], first.means_at(rows[0], 0))]
    for k, branch in enumerate(branches):
        column = np.interp(branch.centres, branch.rows, branch.driving)
        column = np.clip(column, min(driving[k : k + 2]), max(driving[k : k + 2]))
        means = branch.means_at(rows[k + 1], -1)
        if k + 1 < len(branches):
            means = 0.5 * (means + branches[k + 1].means_at(rows[k + 1], 0))
        pieces += [np.column_stack((column, branch.means)), _point(driving[k + 1], means)]
    counts = np.cumsum([len(branch.rows) + 1 for branch in branches])
    return np.concatenate(pieces), counts[:-1].astype(np.int64)


def _point(driving: float, means: Array) -> Array:
    return np.concatenate(([driving], means))[np.newaxis]
