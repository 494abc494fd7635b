"""The trust region's steps alone: when the region grows and shrinks, and when the search ends."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from curvewise.calibration.trust_region import _descend

REACH = 0.8  # of the region, by every step


class Scripted:
    """A search whose surfaces promise a gain of 1 each time, and whose runs gain what is listed."""

    centre = np.zeros(2)
    value = 10.0

    def __init__(self, gains: Sequence[float]) -> None:
        self.gains = list(gains)
        self.radii: list[float] = []
        self.is_fresh = False

    def lowest(self, radius: float) -> tuple[Any, float]:
        self.radii.append(radius)
        return np.array([0.1 * radius, -REACH * radius]), 1.0 if self.gains else 0.0

    def step(self, candidate: Any) -> float:
        return self.gains.pop(0)

    def renew(self, step: float) -> None:
        self.is_fresh = True


def radii_of(gains: Sequence[float], radius: float) -> list[float]:
    """Return the regions of steps that gain so much of what was promised."""
    search: Any = Scripted(gains)
    evaluations: Any = SimpleNamespace(negligible=0.0)
    finish = _descend(search, evaluations, radius, 0.02, 1e-3, 1e-3, 50)
    assert finish.converged
    assert not search.gains
    radii: list[float] = search.radii
    return radii[: len(gains) + 1]


@pytest.mark.parametrize(
    ("gain", "factor"),
    [
        (1.0, 2.0 * REACH),
        (0.7, 2.0 * REACH),
        (0.69, 1.0),
        (0.1, 1.0),
        (0.09, 0.3 * REACH),
        (-3.0, 0.3 * REACH),
        (-np.inf, 0.3 * REACH),
    ],
)
def test_the_region_follows_how_well_gains_are_predicted(gain, factor):
    assert radii_of([gain], 0.2) == pytest.approx([0.2, 0.2 * factor])


def test_the_region_is_never_more_than_the_bounds():
    assert radii_of([1.0, 1.0], 0.6) == pytest.approx([0.6, 0.96, 1.0])
