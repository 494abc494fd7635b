"""Whether two curves are in the same units, as far as their extents tell. Time O(n + m).

Per cent against a fraction, MPa against Pa: the widths or heights of the two boxes differ by a
factor that no model is wrong by.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..curves.inputs import Array

__all__ = ["other_units"]

# Extents that differ by more than the first are probably in different units. If they differ by more
# than the second, one of them is flat to rounding, and no unit is that small.
_FACTOR = 20.0
_FLAT = 1e12


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
