"""The branches of tests, and which of them go the same way again: the cycles of a fatigue test.

Branches lie between the turning points of x. Five or more of one test that go between like ends
(within a tenth of the test's range), in either direction, are cycles: what a model has wrong in one
branch it has wrong in the others at the same part of the way, with the opposite sign where they go
the other way, since metals harden nearly alike in tension and compression. So each point of such a
branch has a place: the branch's way in x is divided into equal parts, which all like branches
share. A test of fewer, such as loading, reversal and reloading, has no places. Cost: O(n) a test.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from ...curves import turning_points
from ...curves.inputs import Array

__all__ = ["PARTS", "Branches", "branches_of_tests"]

PARTS = 16
"""Places of a branch."""
_LIKE = 0.1  # of the range of x, by which the ends of like branches differ at most
_FEWEST = 5  # like branches: two cycles and a half

Places: TypeAlias = npt.NDArray[np.int64]


class Branches(NamedTuple):
    """The branches of all tests, of all points one test after the other.

    Attributes
    ----------
    slices : list of slice
        From turning point to turning point.
    places : ndarray of int, shape (points,), or None
        Of each point, `PARTS` of each way that is gone repeatedly; -1 where a branch is like no
        other. None where all are.
    signs : ndarray, shape (points,), or None
        -1 where a branch goes against the first of those like it, 1 elsewhere.
    ways : int
        How many ways are gone repeatedly.
    """

    slices: list[slice]
    places: Places | None = None
    signs: Array | None = None
    ways: int = 0

    def gathered(self, columns: Array) -> Array:
        """Return columns, of shape (points, k), added up by place, shape (ways, PARTS, k)."""
        sums = np.zeros((self.ways * PARTS, columns.shape[1]))
        if self.places is not None and self.signs is not None:
            (repeated,) = np.nonzero(self.places >= 0)
            signed = self.signs[repeated, np.newaxis] * columns[repeated]
            np.add.at(sums, self.places[repeated], signed)
        return sums.reshape(self.ways, PARTS, -1)

    def spread(self, values: Array) -> Array:
        """Return the values of its place at each point; of shape (ways * PARTS, k), (points, k)."""
        points = np.zeros((self.slices[-1].stop, values.shape[1]))
        if self.places is not None and self.signs is not None:
            (repeated,) = np.nonzero(self.places >= 0)
            points[repeated] = self.signs[repeated, np.newaxis] * values[self.places[repeated]]
        return points


def branches_of_tests(tests: Sequence[Array]) -> Branches:
    """Return the branches between turning points, and the places of those that repeat."""
    slices: list[slice] = []
    places = np.full(sum(map(len, tests)), -1)
    signs = np.ones(len(places))
    first = ways = 0
    for test in tests:
        turns = [0, len(test)]
        if test.shape[1] > 1 and np.ptp(test[:, 0]) > 0:
            turns[1:1] = turning_points(test).tolist()
        branches = [slice(a, b) for a, b in itertools.pairwise(turns)]
        slices += [slice(first + branch.start, first + branch.stop) for branch in branches]
        for group in _like_branches(test[:, 0], branches):
            for branch in group:
                points = slice(first + branch.start, first + branch.stop)
                places[points] = PARTS * ways + _parts(test[branch, 0])
                signs[points] = _sign(test[:, 0], branch) * _sign(test[:, 0], group[0])
            ways += 1
        first += len(test)
    return Branches(slices, places, signs, ways) if ways else Branches(slices)


def _like_branches(x: Array, branches: Sequence[slice]) -> list[list[slice]]:
    """Return the groups of `_FEWEST` branches or more that go between like ends."""
    groups: list[list[slice]] = []
    near = _LIKE * float(np.ptp(x))
    for branch in branches:
        for group in groups:
            ends, like = np.sort(_ends(x, branch)), np.sort(_ends(x, group[0]))
            if np.abs(ends - like).max() <= near:
                group.append(branch)
                break
        else:
            groups.append([branch])
    return [group for group in groups if len(group) >= _FEWEST]


def _ends(x: Array, branch: slice) -> Array:
    """Return x where a branch begins and where the next one does, or x ends."""
    return x[[branch.start, min(branch.stop, len(x) - 1)]]


def _sign(x: Array, branch: slice) -> float:
    """Return 1 where x grows along a branch, and -1 where it does not."""
    first, last = _ends(x, branch)
    return 1.0 if last > first else -1.0


def _parts(x: Array) -> Places:
    """Return which part of a branch's way each of its points is in, from 0."""
    way = float(x[-1] - x[0])
    if way == 0.0:
        return np.zeros(len(x), dtype=np.int64)
    parts: Places = np.clip((x - x[0]) / way * PARTS, 0, PARTS - 1).astype(np.int64)
    return parts
