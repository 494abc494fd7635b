"""A distance with the path that attains it, and what the path makes of the curves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, SupportsFloat

import numpy as np
import numpy.typing as npt

from ..drawing.linked_curves import alignment_figure
from ..showing.result import Result, Table
from .along_path import By, Onto, average_along, values_onto
from .record import Curves, Record

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["Alignment"]


@dataclass(frozen=True, repr=False)
class Alignment(Record, Result):
    """A distance with the path that attains it.

    Attributes
    ----------
    distance : float
        The value of the measure.
    path : ndarray of int64, shape (k, 2)
        Index pairs ``(i, j)``: point ``i`` of P is matched to point ``j`` of Q. Each step is
        (1, 0), (0, 1) or (1, 1). Empty if a step pattern admits no path; `distance` is then inf.
    curves : tuple of two ndarrays, or None
        Copies of P and Q, for the plot; None in results of :mod:`curvewise.reference`.
    """

    distance: float
    path: npt.NDArray[np.int64]
    curves: Curves = field(default=None, repr=False, compare=False)

    def plot(self) -> Picture:
        """Return a matplotlib Figure of the curves and the pairs of the path.

        If the curves are missing, or have more than two coordinates, it shows the path alone.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        return alignment_figure(self.curves, self.path)

    def warped(
        self, values: npt.ArrayLike, *, by: By = "mean", onto: Onto = "Q"
    ) -> npt.NDArray[np.float64]:
        """Return P, or other values at its points, on the index of Q.

        Parameters
        ----------
        values : array_like, shape (n, c) or (n,)
            P itself, or other columns with one row for each point of P: times, other channels.
        by : {"mean", "first"}
            Value at a point of Q with several partners: their mean, or the first partner alone.
        onto : {"Q", "P"}
            Curve whose index the values get. With "P", `values` has one row for each point of Q.

        Returns
        -------
        ndarray, shape (m, c) or (m,)
            One row for each point of Q. An unmatched point of Q between two matched points gets a
            linear interpolation. Points before the first pair of the path and behind the last are
            NaN. An alignment of :mod:`curvewise.reference` ends with the path.

        Raises
        ------
        ValueError
            If `by` or `onto` is unknown, `values` has another number of rows, or the path is empty.
        TypeError
            If `values` does not hold real numbers.

        Notes
        -----
        Time and memory O(k c + m c) for a path of k pairs.

        Examples
        --------
        >>> import curvewise
        >>> P, Q = [0, 1, 2, 2.5, 6], [0, 2, 6]
        >>> alignment = curvewise.dtw_path(P, Q)
        >>> alignment.path.tolist()
        [[0, 0], [1, 0], [2, 1], [3, 1], [4, 2]]
        >>> alignment.warped(P)
        array([0.5 , 2.25, 6.  ])
        >>> alignment.warped(P, by="first")
        array([0., 2., 6.])
        >>> alignment.warped(Q, onto="P")
        array([0., 0., 2., 2., 6.])
        """
        return values_onto(self.path, values, by, onto, self._sizes())

    def mapping(
        self, *, by: By = "mean", onto: Onto = "Q"
    ) -> Callable[[npt.ArrayLike], npt.NDArray[np.float64]]:
        """Return the warping as a function of the position on Q.

        Parameters
        ----------
        by : {"mean", "first"}
            Position for a point of Q with several partners: their mean, or the first partner.
        onto : {"Q", "P"}
            Curve on which positions are given to the function. The function returns positions on
            the other curve.

        Returns
        -------
        callable
            A function of an array of positions, which returns an array of the same shape. A
            position is the index of a point plus a fraction of the way to the next point. The
            function is linear between points, and NaN outside the path.

        Raises
        ------
        ValueError
            If `by` or `onto` is unknown, or the path is empty.

        Notes
        -----
        With "mean", the positions at the points of Q are those of ``warp`` in R's dtw.

        Examples
        --------
        >>> import curvewise
        >>> alignment = curvewise.dtw_path([0, 1, 2, 2.5, 6], [0, 2, 6])
        >>> to_p = alignment.mapping()
        >>> to_p([0, 1, 1.5, 2, 3])
        array([0.5 , 2.5 , 3.25, 4.  ,  nan])
        """
        sizes = self._sizes()
        source = sizes[0] if onto == "Q" else sizes[1]
        positions = values_onto(self.path, np.arange(source), by, onto, sizes)
        inside = np.flatnonzero(~np.isnan(positions))
        known = positions[inside]

        def position(at: npt.ArrayLike) -> npt.NDArray[np.float64]:
            places = np.asarray(at, dtype=np.float64)
            return np.asarray(np.interp(places, inside, known, left=np.nan, right=np.nan))

        return position

    def average(
        self, P: npt.ArrayLike, Q: npt.ArrayLike, *, weight: SupportsFloat = 0.5
    ) -> npt.NDArray[np.float64]:
        """Return the average of two curves along the path.

        Parameters
        ----------
        P, Q : array_like, shapes (n, c) and (m, c), or (n,) and (m,)
            The curves, or other columns at their points.
        weight : float from 0 to 1
            Share of Q.

        Returns
        -------
        ndarray, shape (k, c) or (k,)
            ``(1 - weight) * P[i] + weight * Q[j]`` for each pair (i, j) of the path.

        Raises
        ------
        ValueError
            If `weight` is not from 0 to 1, rows or columns differ in number, or the path is empty.
        TypeError
            If P or Q does not hold real numbers.

        Notes
        -----
        Gupta et al. (1996), "Nonlinear alignment and averaging for estimating the evoked
        potential". For more than two curves see :func:`curvewise.dtw_mean`.

        Examples
        --------
        >>> import curvewise
        >>> P, Q = [0, 1, 4], [0, 4, 4]
        >>> alignment = curvewise.dtw_path(P, Q)
        >>> alignment.path.tolist()
        [[0, 0], [1, 0], [2, 1], [2, 2]]
        >>> alignment.average(P, Q)
        array([0. , 0.5, 4. , 4. ])
        """
        return average_along(self.path, P, Q, weight, self._sizes())

    def _sizes(self) -> list[int]:
        """Return the numbers of points of P and Q: those that the path reaches, if unknown."""
        if self.curves is None:
            return [int(last) + 1 for last in self.path[-1:].ravel()] or [0, 0]
        return [len(curve) for curve in self.curves]

    picture_shows = "The curves and which points are matched"

    def parts(self) -> Sequence[Table | str]:
        """Return the distance, and how long the path is."""
        rows = [["distance", f"{self.distance:.6g}"], ["pairs of points", f"{len(self.path)}"]]
        return [Table(rows)]
