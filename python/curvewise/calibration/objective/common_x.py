"""Differences of y at common x, at common time, or point by point.

The measure "sum_of_squares" sums their squares. The simulation is interpolated linearly at the
experiment's x, or at its time or step if the curves have such a column. This requires that neither
curve reverses in that column, so a hysteresis loop is rejected over x. The simulation must also
cover the experiment, because values that numpy.interp extrapolates are not simulated. A model that
is driven by the experiment's x, such as a material point with the measured strains, is compared
point by point instead, even for loops. O(n log m) time.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from ...curves.inputs import Array
from ...curves.thinning import Rows

__all__ = [
    "Abscissa",
    "check_common_x",
    "difference_slopes",
    "differences",
    "squared_differences",
    "squared_differences_and_gradient",
    "y_column",
]

Abscissa: TypeAlias = int | Literal["points"]

# Rounding difference of the ends that is tolerated, relative to the experiment's extent in x.
_SLACK = 1e-9
# Largest difference between x of two points that are compared one by one. A solver's seven digits
# and its own measure of strain pass, another path does not.
_SAME_X = 0.01


def y_column(abscissa: Abscissa) -> int:
    """Return the column that is compared: the second, or the first if that is the abscissa."""
    return 0 if abscissa == 1 else 1


def check_common_x(P: Array, abscissa: Abscissa = 0) -> None:
    """Refuse an experiment whose x, or other column that y is a function of, is not monotonic."""
    if abscissa == "points":
        if P.shape[1] < 2:
            raise ValueError(f"P has shape {P.shape}; sum_of_squares needs x and y, shape (n, 2)")
        return
    if abscissa == 0 and P.shape[1] != 2:
        raise ValueError(
            f"P has shape {P.shape}; sum_of_squares needs x and y, shape (n, 2), or a third column "
            "such as time, abscissa=2"
        )
    if not (isinstance(abscissa, int) and 0 <= abscissa < P.shape[1]) or P.shape[1] < 2:
        raise ValueError(
            f"abscissa is {abscissa!r}; P has the columns 0 to {P.shape[1] - 1}, or give 'points'"
        )
    steps = np.diff(P[:, abscissa])
    if (steps > 0).any() and (steps < 0).any():
        if abscissa:
            raise ValueError(f"column {abscissa} of P reverses; give one that grows, such as time")
        raise ValueError(
            "x of P reverses; sum_of_squares compares at a common x: use area, dtw or another "
            "measure for loops, or abscissa='points' if the simulation has the points of P"
        )


def differences(P: Array, Q: Array, *, abscissa: Abscissa = 0) -> Array:
    """Return y of Q at P's x, or at its column `abscissa`, or point by point, minus y of P.

    Raises
    ------
    ValueError
        If Q is not finite, reverses in x, or does not cover P. Point by point, if its x differs
        from P's.
    """
    if not np.isfinite(Q).all():
        raise ValueError("the simulation is not finite")
    if abscissa == "points":
        return _point_by_point(P, Q)
    name = "x" if abscissa == 0 else f"column {abscissa}"
    x, y = Q[:, abscissa], Q[:, y_column(abscissa)]
    if x[0] > x[-1]:
        x, y = x[::-1], y[::-1]
    if (np.diff(x) < 0).any():
        raise ValueError(f"{name} of the simulation reverses; sum_of_squares needs it monotonic")
    wanted = P[:, abscissa]
    low, high = wanted.min(), wanted.max()
    slack = _SLACK * (high - low)
    if x[0] > low + slack or x[-1] < high - slack:
        raise ValueError(
            f"the simulation covers {name} from {x[0]:.6g} to {x[-1]:.6g}, "
            f"the experiment goes from {low:.6g} to {high:.6g}"
        )
    difference: Array = np.interp(wanted, x, y) - P[:, y_column(abscissa)]
    return difference


def _point_by_point(P: Array, Q: Array) -> Array:
    """Return y of Q minus y of P, which have the same x."""
    if len(Q) != len(P):
        raise ValueError(
            f"the simulation has {len(Q)} points and the experiment {len(P)}; abscissa='points' "
            "compares them one by one"
        )
    apart = np.abs(Q[:, 0] - P[:, 0]) / (np.ptp(P[:, 0]) or 1.0)
    if (apart > _SAME_X).any():
        i = int(np.argmax(apart))
        raise ValueError(
            f"x of the simulation is off by {100.0 * apart[i]:.3g} % of the experiment's extent at "
            f"point {i}; abscissa='points' needs a model that is driven by the experiment's x"
        )
    difference: Array = Q[:, 1] - P[:, 1]
    return difference


def squared_differences(P: Array, Q: Array, *, abscissa: Abscissa = 0) -> float:
    """Return the sum of the squared differences."""
    return float(np.sum(differences(P, Q, abscissa=abscissa) ** 2))


def squared_differences_and_gradient(
    P: Array, Q: Array, *, abscissa: Abscissa = 0
) -> tuple[float, Array]:
    """Return the sum of the squared differences and its derivative by every coordinate of Q."""
    difference = differences(P, Q, abscissa=abscissa)
    gradient = np.zeros_like(Q)
    if abscissa == "points":
        gradient[:, y_column(abscissa)] = 2.0 * difference
        return float(difference @ difference), gradient
    place = _place(P, Q, abscissa)
    for rows, part in place.ends:
        np.add.at(gradient[:, y_column(abscissa)], rows, 2.0 * difference * part)
        np.add.at(gradient[:, abscissa], rows, -2.0 * difference * part * place.slope)
    return float(difference @ difference), gradient


def difference_slopes(P: Array, Q: Array, directions: Array, *, abscissa: Abscissa = 0) -> Array:
    """Return how fast the differences change as Q moves.

    Parameters
    ----------
    P, Q
        As for `differences`, which accepts them.
    directions : ndarray, shape (len(Q), d, k)
        The directions in which Q moves.

    Returns
    -------
    ndarray, shape (len(P), k)
    """
    by_y: Array = directions[:, y_column(abscissa)]
    if abscissa == "points":
        return by_y
    place = _place(P, Q, abscissa)
    total = np.zeros((len(P), directions.shape[2]))
    for rows, part in place.ends:
        along = by_y[rows] - place.slope[:, np.newaxis] * directions[rows, abscissa]
        total += part[:, np.newaxis] * along
    return total


class _Place(NamedTuple):
    """The places of the experiment's points on a simulation.

    Attributes
    ----------
    ends : two of (ndarray of int, ndarray)
        The points of the simulation before and after each, and their parts in it.
    slope : ndarray
        The slope of y there.
    """

    ends: tuple[tuple[Rows, Array], tuple[Rows, Array]]
    slope: Array


def _place(P: Array, Q: Array, abscissa: int) -> _Place:
    """Return between which points of Q those of P are."""
    count = len(Q)
    rows = np.arange(count)
    if Q[0, abscissa] > Q[-1, abscissa]:
        rows = rows[::-1]
    x, y = Q[rows, abscissa], Q[rows, y_column(abscissa)]
    wanted = P[:, abscissa]
    before = np.clip(np.searchsorted(x, wanted, side="right") - 1, 0, max(count - 2, 0))
    after = np.minimum(before + 1, count - 1)
    length = x[after] - x[before]
    length = np.where(length > 0, length, 1.0)
    share = np.clip((wanted - x[before]) / length, 0.0, 1.0)
    slope = (y[after] - y[before]) / length
    return _Place(((rows[before], 1.0 - share), (rows[after], share)), slope)
