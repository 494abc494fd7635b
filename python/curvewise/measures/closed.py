"""dtw and frechet of closed curves: what ``closed=True`` computes.

A closed curve begins nowhere. A walk goes once around both curves, by steps of one point of either
or of both, and returns to the pair at which it began. The value is the least sum, or the least
maximum, of the distances of its pairs.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from .._core import closed_dtw, closed_dtw_path, closed_frechet, closed_frechet_path
from ..curves.inputs import Array, as_curves
from ..curves.named_curve import copied
from .results import Alignment

__all__ = ["around", "closed_alignment", "closed_value"]

Closable = Literal["dtw", "frechet"]
_VALUES = {"dtw": closed_dtw, "frechet": closed_frechet}
_PATHS = {"dtw": closed_dtw_path, "frechet": closed_frechet_path}


def closed_value(measure: Closable, P: Any, Q: Any, ground: dict[str, Any], cutoff: Any) -> float:
    """Return the distance of two closed curves; `ground` has the metric, p and radius."""
    P, Q = as_curves(P, Q)
    return _VALUES[measure](P, Q, ground | {"cutoff": cutoff})


def closed_alignment(measure: Closable, P: Any, Q: Any, ground: dict[str, Any]) -> Alignment:
    """Return the distance with the pairs of points that attain it."""
    A, B = as_curves(P, Q)
    return Alignment(*_PATHS[measure](A, B, ground), (copied(P, A), copied(Q, B)))


def around(curve: Array, turns: int) -> Array:
    """Return the points of a closed curve on its way around, and the first of them again."""
    closes = len(curve) > 1 and np.array_equal(curve[0], curve[-1])
    ring = curve[:-1] if closes else curve
    return np.concatenate([ring] * turns + [ring[:1]])
