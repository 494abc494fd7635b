"""Checks by their extents whether two curves have the same units. O(n + m).

Per cent against a fraction, MPa against Pa: the widths or heights of the two boxes differ by a
factor that no model is wrong by. If they do so in both columns, and not with one curve's columns
exchanged, the columns are swapped.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..curves.inputs import Array

__all__ = ["other_units", "unlike_its_test"]

# Extents that differ by more than the first are probably in different units. If they differ by more
# than the second, one of them is flat to rounding, and no unit is that small.
_FACTOR = 20.0
_FLAT = 1e12
# Part of a curve's extent that may lie on the other side of zero without a change of sign.
_BESIDE_ZERO = 0.05


def other_units(P: Array, Q: Array, axes: Sequence[str], p_name: str, q_name: str) -> list[str]:
    """Return a question for each coordinate whose extents differ 20-fold or more.

    Coordinates in which a curve is flat are skipped: a constant does not show its unit.

    Parameters
    ----------
    P, Q : ndarray, shapes (n, d) and (m, d)
    axes : sequence of str
        The names of the coordinates.
    p_name, q_name : str
        The names of the curves.
    """
    questions = []
    with np.errstate(over="ignore"):
        extents = np.ptp(P, axis=0).tolist(), np.ptp(Q, axis=0).tolist()
    for axis, p, q in zip(axes, *extents, strict=True):
        largest, least = max(p, q), min(p, q)
        if least * _FACTOR <= largest < least * _FLAT:
            questions.append(f"{axis} of {p_name} is {p / q:.3g} times that of {q_name}")
    return [f"{question}; different units?" for question in questions]


def unlike_its_test(test: Array, simulation: Array, axes: Sequence[str]) -> list[str]:
    """Return signs of swapped columns, other units or another sign.

    Each is a question with what to look at. Numbers, and simulations of other dimensions, are not
    checked.

    Parameters
    ----------
    test, simulation : ndarray, shapes (n, d) and (m, d)
    axes : sequence of str
        The names of the coordinates.
    """
    if len(test) < 2 or test.shape[1] != simulation.shape[1]:
        return []
    if _are_swapped(test, simulation):
        return [
            f"{axes[0]} and {axes[1]} of the simulation have each other's extent in the test; "
            "swapped columns?"
        ]
    still = np.ptp(simulation, axis=0) == 0.0
    found = [
        f"{axis} of the simulation does not change; another quantity?"
        for axis, is_still, extent in zip(axes, still, np.ptp(test, axis=0), strict=True)
        if is_still and extent > 0.0
    ]
    found += other_units(test, simulation, axes, "the test", "the simulation")
    found += [
        f"{axis} of the simulation has the opposite sign of the test's; another direction?"
        for axis, p, q in zip(axes, test.T, simulation.T, strict=True)
        if (side := _side(p)) and side == -_side(q)
    ]
    return found


def _are_swapped(P: Array, Q: Array) -> bool:
    """Return whether two columns fit only with those of one curve exchanged."""
    if P.shape[1] != 2:
        return False
    p, q = np.ptp(P, axis=0), np.ptp(Q, axis=0)
    if not (p.all() and q.all()):
        return False
    with np.errstate(over="ignore", divide="ignore", under="ignore"):
        straight, crossed = np.abs(np.log(p / q)), np.abs(np.log(p / q[::-1]))
    most = np.log(_FACTOR)
    return bool(straight.min() >= most and crossed.max() < most)


def _side(values: Array) -> int:
    """Return 1 or -1 for values that are all on one side of zero, else 0."""
    low, high = float(values.min()), float(values.max())
    allowed = _BESIDE_ZERO * (high - low)
    if low == high:
        return 0
    return int(low > -allowed) - int(high < allowed)
