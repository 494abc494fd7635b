"""Differences of y at a common x: what sum_of_squares sums over.

The simulation is interpolated linearly at the experiment's x. That is defined only where neither
turns back, so a hysteresis loop is refused, and where the simulation covers the experiment: what
numpy.interp would make up beyond its ends is no simulation. O(n log m) time.
"""

from __future__ import annotations

import numpy as np

from .._curves import Array

__all__ = ["check_common_x", "differences", "squared_differences"]

# How far, relative to the experiment's extent in x, rounding may put the ends apart.
_SLACK = 1e-9


def check_common_x(P: Array) -> None:
    """Refuse an experiment whose x is not monotonic."""
    if P.shape[1] != 2:
        raise ValueError(f"P has shape {P.shape}; sum_of_squares needs x and y, shape (n, 2)")
    steps = np.diff(P[:, 0])
    if (steps > 0).any() and (steps < 0).any():
        raise ValueError(
            "x of P turns back; sum_of_squares compares at a common x: "
            "use area, dtw or another measure for loops"
        )


def differences(P: Array, Q: Array) -> Array:
    """Return y of Q at P's x, minus y of P.

    Raises
    ------
    ValueError
        Q is not finite, turns back in x, or does not cover P.
    """
    if not np.isfinite(Q).all():
        raise ValueError("the simulation is not finite")
    x, y = Q.T
    if x[0] > x[-1]:
        x, y = x[::-1], y[::-1]
    if (np.diff(x) < 0).any():
        raise ValueError("x of the simulation turns back; sum_of_squares needs it monotonic")
    wanted = P[:, 0]
    low, high = wanted.min(), wanted.max()
    slack = _SLACK * (high - low)
    if x[0] > low + slack or x[-1] < high - slack:
        raise ValueError(
            f"the simulation covers x from {x[0]:.6g} to {x[-1]:.6g}, "
            f"the experiment goes from {low:.6g} to {high:.6g}"
        )
    difference: Array = np.interp(wanted, x, y) - P[:, 1]
    return difference


def squared_differences(P: Array, Q: Array) -> float:
    """Return the sum of the squared differences."""
    return float(np.sum(differences(P, Q) ** 2))
