"""Results of the functions: immutable records of numpy arrays and numbers.

In a terminal they print their numbers, and the shapes of arrays. In a notebook they show a table
and, if they hold the curves, a plot.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, NamedTuple, SupportsIndex

import numpy as np
import numpy.typing as npt

from .._options import whole_number
from ..curves.arc_length import points_at
from ..drawing.bunch import bunch_figure
from ..drawing.linked_curves import matching_figure, placement_figure
from ..showing.result import Result, Table
from .alignment import Alignment
from .record import Curves, Record, printed

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = [
    "Alignment",
    "AreaQuads",
    "CommonPart",
    "DtwMean",
    "FarthestPoints",
    "Matching",
    "MatrixProfile",
    "PcmMatch",
    "Subsequence",
    "WarpingInfo",
]


class AreaQuads(NamedTuple):
    """The quadrilaterals between two curves and their areas.

    Attributes
    ----------
    quads : ndarray, shape (k, 4, 2)
        Vertices, in the order whose area is given.
    areas : ndarray, shape (k,)
        Their areas, in units of x times units of y.
    """

    quads: npt.NDArray[np.float64]
    areas: npt.NDArray[np.float64]

    def __repr__(self) -> str:
        return printed(self, self._asdict().items())


@dataclass(frozen=True)
class CommonPart:
    """A section of P and a section of Q that are within a distance of each other.

    Attributes
    ----------
    length : float
        The length of the section of P, in units of the ground distance.
    of_p, of_q : slice
        The rows of each section: ``P[part.of_p]`` and ``Q[part.of_q]``. Empty if all pairs of
        points are too far apart.
    """

    length: float
    of_p: slice
    of_q: slice


@dataclass(frozen=True, repr=False)
class FarthestPoints(Record):
    """A Hausdorff distance of polygonal curves with the points that attain it.

    Attributes
    ----------
    distance : float
        The value of the measure.
    distances : ndarray, shape (2,) or (1,)
        The largest distance of a point of P from Q, and that of a point of Q from P unless the
        measure is directed.
    parameters : ndarray, shape (2, 2) or (1, 2)
        For each of them the place on P and the place on Q: the index of a vertex plus a fraction
        of the edge behind it.
    curves : tuple of two ndarrays
        Copies of P and Q.
    """

    distance: float
    distances: npt.NDArray[np.float64]
    parameters: npt.NDArray[np.float64]
    curves: tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] = field(
        repr=False, compare=False
    )

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Points at `parameters`, shape (2, 2, d) or (1, 2, d): for each distance on P and on Q."""
        places = zip(self.curves, self.parameters.T, strict=True)
        return np.stack([points_at(curve, at) for curve, at in places], axis=1)


@dataclass(frozen=True, repr=False)
class Matching(Record, Result):
    """A distance with two walks along the curves that attain it.

    Attributes
    ----------
    distance : float
        The largest pair distance of the walks: the value of the measure. If rounding of the
        parameters increases it, it is rounded up to the next double.
    parameters : ndarray, shape (k, 2)
        Pairs of a parameter of P and one of Q: the index of a vertex plus a fraction of the edge
        behind it. Neither ever decreases. The first are 0 and the last the indices of the last
        points. Between two rows both walks stay on one edge each, at constant speeds.
    curves : tuple of two ndarrays, or None
        Copies of P and Q, for the plot; None in results of :mod:`curvewise.reference`.
    """

    distance: float
    parameters: npt.NDArray[np.float64]
    curves: Curves = field(default=None, repr=False, compare=False)

    def plot(self) -> Picture:
        """Return a matplotlib Figure of the curves and the matched pairs.

        If the curves are missing, or have more than two coordinates, it shows the parameters alone.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        return matching_figure(self.curves, self.parameters)

    picture_shows = "The curves and which points are matched"

    def parts(self) -> Sequence[Table | str]:
        """Return the distance."""
        return [Table([["distance", f"{self.distance:.6g}"]])]


@dataclass(frozen=True, repr=False)
class PcmMatch(Record, Result):
    """Place at which partial curve mapping puts the shorter curve on the longer.

    Attributes
    ----------
    value : float
        The smallest area between the curves (dimensionless: curves scaled by P's box).
    offset : float
        Arc length (scaled) on the longer curve at which the shorter one starts.
    coverage : float
        Length of the shorter curve divided by that of the longer, at most 1 (to 1e-12). A small
        coverage with a small value means that one curve is a part of the other, not that they
        agree.
    mapped : {"P", "Q"}
        The shorter curve, whose vertices are mapped onto the other.
    points : ndarray, shape (k, 2)
        For every vertex of the mapped curve, its point on the other curve, unscaled.
    tolerance : float
        A bound for the excess of `value` over the smallest area of all offsets. For lengths S <= T
        and ``offsets=k`` it is S (T - S) / (2 (k - 1)), or S (T - S) for ``offsets=1``. For
        "continuous" it is 1e-12 S or 1e-13 `value`, whichever is more; a search of more than 2^20
        evaluations ends with a larger tolerance.
    curves : tuple of two ndarrays, or None
        Copies of P and Q, for the plot; None in results of :mod:`curvewise.reference`.
    """

    value: float
    offset: float
    coverage: float
    mapped: Literal["P", "Q"]
    points: npt.NDArray[np.float64]
    tolerance: float
    curves: Curves = field(default=None, repr=False, compare=False)

    def plot(self) -> Picture:
        """Return a matplotlib Figure of the curves and of where the shorter one lies.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        ValueError
            If the curves are missing: the match is that of :mod:`curvewise.reference`.
        """
        if self.curves is None:
            raise ValueError("the match does not know its curves; take that of curvewise.pcm_match")
        return placement_figure(self.curves, self.mapped, self.offset, self.points)

    picture_shows = "The curves and where the shorter lies"

    def parts(self) -> Sequence[Table | str]:
        """Return the value, and where the shorter curve lies."""
        rows = [
            ["value", f"{self.value:.6g}"],
            ["offset on the longer curve, scaled", f"{self.offset:.6g}"],
            ["coverage", f"{100 * self.coverage:.3g} %"],
            ["shorter curve", self.mapped],
        ]
        return [Table(rows)]


@dataclass(frozen=True)
class WarpingInfo:
    """A distance with how much of the table it took, and why.

    Attributes
    ----------
    value : float
        The distance.
    pruned : bool
        Whether a part of the table was skipped. If not, the whole table was filled: because of
        ``prune=False``, because the curves are short, or because the bounds showed early that
        pruning would not help.
    cells_swept : int
        Cells of the table that were computed; some of them may have been computed twice.
    share : float
        `cells_swept` over n m.
    bounds : tuple of float
        A lower and an upper bound of the distance, as they were known before the last step.
    seconds : dict of str to float
        Time by phase, and of "all".
    """

    value: float
    pruned: bool
    cells_swept: int
    share: float
    bounds: tuple[float, float]
    seconds: dict[str, float]


@dataclass(frozen=True, repr=False)
class Subsequence(Record):
    """A run of consecutive points of Q that is like P.

    Attributes
    ----------
    distance : float
        The distance of P and the section, ``Q[start : stop + 1]``.
    start, stop : int
        The first point of the run, and the last.
    path : ndarray of int64, shape (k, 2), or None
        If requested, index pairs ``(i, j)`` as those of :class:`Alignment`: point ``i`` of P is
        matched to point ``j`` of Q.
    """

    distance: float
    start: int
    stop: int
    path: npt.NDArray[np.int64] | None = None


@dataclass(frozen=True, repr=False)
class MatrixProfile(Record):
    """The nearest neighbour of every window of a record.

    Attributes
    ----------
    distances : ndarray, shape (m,)
        The distance of each window from its nearest neighbour; infinite for windows that overlap
        all others.
    indices : ndarray of int64, shape (m,)
        The start of that neighbour, the earliest of equally near ones; -1 if there is none.
    exclusion : int
        Largest distance of the starts of two windows that are not compared.
    """

    distances: npt.NDArray[np.float64]
    indices: npt.NDArray[np.int64]
    exclusion: int

    def motifs(self, k: SupportsIndex = 1) -> list[tuple[int, int]]:
        """Return the closest pairs of a window and its nearest neighbour.

        Parameters
        ----------
        k : int >= 1
            Maximum number of pairs.

        Returns
        -------
        list of (int, int)
            The starts of both windows, the earlier one first. The first pair is the closest of all.
            Each later pair is the closest of those with both windows further than `exclusion` from
            the windows of earlier pairs. Of equal distances the earlier window comes first.

        Raises
        ------
        ValueError
            If `k` is not a positive whole number.
        """
        pairs = zip(range(len(self.indices)), self.indices.tolist(), strict=True)
        chosen = self._apart([(i, j) for i, j in pairs if j >= 0], self.distances, k)
        return [(min(pair), max(pair)) for pair in chosen]

    def discords(self, k: SupportsIndex = 1) -> list[int]:
        """Return the windows that are furthest from their nearest neighbours.

        Parameters
        ----------
        k : int >= 1
            Maximum number of windows.

        Returns
        -------
        list of int
            The starts of the windows. Each later window is the furthest of those further than
            `exclusion` from earlier ones. Of equal distances the earlier window comes first.

        Raises
        ------
        ValueError
            If `k` is not a positive whole number.
        """
        having = np.flatnonzero(self.indices >= 0).tolist()
        return [i for (i,) in self._apart([(i,) for i in having], -self.distances, k)]

    def _apart(
        self, groups: Sequence[tuple[int, ...]], keys: npt.NDArray[np.float64], k: SupportsIndex
    ) -> list[tuple[int, ...]]:
        """Return the first `k` groups, by the key of their first window, that lie apart."""
        count = whole_number("k", k, 1, "give a whole number >= 1")
        is_free = np.ones(len(self.indices), dtype=np.bool_)
        chosen: list[tuple[int, ...]] = []
        for group in sorted(groups, key=lambda group: keys[group[0]]):
            if is_free[list(group)].all():
                chosen.append(group)
                for start in group:
                    is_free[max(start - self.exclusion, 0) : start + self.exclusion + 1] = False
            if len(chosen) == count:
                break
        return chosen


@dataclass(frozen=True, repr=False)
class DtwMean(Record, Result):
    """The mean of curves under dtw or soft_dtw.

    Attributes
    ----------
    curve : ndarray, shape (n, d)
        The mean; it has the number of points of the initial curve.
    costs : ndarray
        The weighted sum of the dtw distances from the curves, with squared ground distances, or of
        soft_dtw: for the initial curve, and for the mean after every step. It never rises.
    converged : bool
        Whether the last step lowered the sum by no more than the tolerance.
    curves : tuple of ndarrays
        Copies of the curves for the plot (some of many curves); empty in results of
        :mod:`curvewise.reference`.
    """

    curve: npt.NDArray[np.float64]
    costs: npt.NDArray[np.float64]
    converged: bool
    curves: tuple[npt.NDArray[np.float64], ...] = field(default=(), repr=False, compare=False)

    def plot(self) -> Picture:
        """Return a matplotlib Figure of the curves and their mean, in two coordinates at most.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        return bunch_figure(self.curves, self.curve, "mean")

    picture_shows = "The curves and their mean"

    def parts(self) -> Sequence[Table | str]:
        """Return the sum at the beginning and at the end, and whether it still fell."""
        rows = [
            ["sum of distances", f"{self.costs[-1]:.6g}"],
            ["of the initial curve", f"{self.costs[0]:.6g}"],
            ["moves", f"{len(self.costs) - 1}"],
            ["converged", "yes" if self.converged else "no"],
        ]
        return [Table(rows)]
