"""Points of isotropic hardening: every step is the exact solution, in the arithmetic of mpmath."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from curvewise.materials import JohnsonCook, Material, Swift

mp = pytest.importorskip("mpmath", reason="no mpmath: pip install mpmath").mp
STEEL = {"E": 2.1e5, "A": 310.0, "B": 480.0, "n": 0.33, "C": 0.017}


def exact_stresses(
    E: float, yield_stress: Callable[[Any], Any], strains: np.ndarray
) -> list[float]:
    """Return the stresses, each step solved by bisection; the plastic strain adds up."""
    plastic = stress = last = mp.mpf(0)
    found = []
    for strain in map(mp.mpf, strains):
        stress += E * (strain - last)
        last = strain
        if abs(stress) > yield_stress(plastic):
            low, high = mp.mpf(0), (abs(stress) - yield_stress(plastic)) / E
            for _ in range(120):
                middle = (low + high) / 2
                is_above = middle + (yield_stress(plastic + middle) - abs(stress)) / E > 0
                low, high = (low, middle) if is_above else (middle, high)
            plastic += low
            stress = mp.sign(stress) * yield_stress(plastic)
        found.append(float(stress))
    return found


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    ("material", "constants", "yield_stress"),
    [
        (JohnsonCook(rate=1e3), STEEL, lambda p: (310 + 480 * p**0.33) * (1 + 0.017 * mp.log(1e3))),
        (Swift(), {"E": 7e4, "K": 540.0, "e0": 1e-5, "n": 0.2}, lambda p: 540 * (1e-5 + p) ** 0.2),
    ],
    ids=["johnson-cook", "swift"],
)
def test_a_step_is_the_solution_of_its_equation(
    material: Material,
    constants: Mapping[str, float],
    yield_stress: Callable[[Any], Any],
    seed: int,
) -> None:
    strains = np.cumsum(np.random.default_rng(seed).normal(0.0, 0.01, 25))
    with mp.workdps(30):
        exact = exact_stresses(constants["E"], yield_stress, strains)
    np.testing.assert_allclose(material.stress(strains, constants), exact, rtol=0, atol=1e-12 * 540)
