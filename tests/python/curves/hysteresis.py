"""Records whose loops have closed forms: ellipses, bilinear and Masing hysteresis."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np


def ellipse(a: float, k: float, b: float, cycles: float, phase: float = 0.0) -> np.ndarray:
    """Return x = a sin t, y = k x + b cos t: loops of area pi a b, 2000 points each."""
    t = phase + np.linspace(0.0, 2.0 * np.pi * cycles, round(2000 * cycles) + 1)
    return np.column_stack((a * np.sin(t), k * a * np.sin(t) + b * np.cos(t)))


def driven(ends: Sequence[float], points: int) -> np.ndarray:
    """Return straight lines between ends, `points` steps each."""
    parts = [np.linspace(a, b, points + 1)[1:] for a, b in pairwise(ends)]
    return np.concatenate(([ends[0]], *parts))


def bilinear(x: np.ndarray, stiffness: float, yield_force: float, hardening: float) -> np.ndarray:
    """Return x with the force of kinematic bilinear hysteresis; `hardening` is a part of k."""
    force = np.zeros_like(x)
    plastic, limit = 0.0, yield_force * (1.0 - hardening)
    for i, value in enumerate(x):
        trial = (1.0 - hardening) * stiffness * (value - plastic)
        slip = np.clip(trial, -limit, limit)
        plastic = value - slip / ((1.0 - hardening) * stiffness)
        force[i] = slip + hardening * stiffness * value
    return np.column_stack((x, force))


def masing(tips: Sequence[float], E: float, K: float, n: float, points: int) -> np.ndarray:
    """Return a loading to the first stress and branches between the stresses that follow.

    The skeleton is Ramberg and Osgood's, s / E + (s / K)^(1/n); branches are twice as large.
    """

    def skeleton(stress: np.ndarray) -> np.ndarray:
        return stress / E + np.sign(stress) * (np.abs(stress) / K) ** (1.0 / n)

    stress = np.linspace(0.0, tips[0], points + 1)
    parts = [np.column_stack((skeleton(stress), stress))]
    for a, b in pairwise(tips):
        change = np.linspace(0.0, b - a, points + 1)[1:]
        strain = parts[-1][-1, 0] + 2.0 * skeleton(0.5 * change)
        parts.append(np.column_stack((strain, a + change)))
    return np.concatenate(parts)
