"""Plane measures where coordinates, or curves, differ by hundreds of orders of magnitude.

The compiled functions and the reference each meet overflow and underflow in different ways. Their
results and errors are the same.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import curvewise
from curvewise import reference

EXPONENTS = [0, 0, 5, 100, 250, 300, -100, -250, -300, 306, -320]
CALLS: list[tuple[str, dict[str, Any]]] = [
    ("pcm", {}),
    ("pcm", {"offsets": 3}),
    ("area", {}),
    ("area", {"spacing": "x", "crossing": "split"}),
    ("area", {"spacing": "arc_length"}),
    ("curve_length", {"scale": "range"}),
    ("curve_length", {"scale": "mean_abs"}),
]


def extreme_curve(rng: np.random.Generator) -> np.ndarray:
    n = rng.integers(2, 9)
    curve = rng.normal(size=(n, 2)).cumsum(axis=0)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        curve *= 10.0 ** rng.choice(EXPONENTS, size=2).astype(float)
        if rng.integers(3) == 0:
            curve += rng.normal(size=2) * 10.0 ** rng.choice([-300.0, 0.0, 9.0, 300.0], size=2)
        if rng.integers(3) == 0:
            curve *= 10.0 ** rng.choice([-200.0, -20.0, 0.0, 150.0, 250.0], size=(n, 1))
    return np.clip(np.nan_to_num(curve), -1.79e308, 1.79e308)


def value_or_error(module: Any, name: str, curves: Any, options: dict[str, Any]) -> Any:
    try:
        return getattr(module, name)(*curves, **options)
    except ValueError as error:
        return str(error)


@pytest.mark.parametrize("seed", range(4))
def test_compiled_and_reference_agree(seed):
    rng = np.random.default_rng(seed)
    for _ in range(60):
        curves = extreme_curve(rng), extreme_curve(rng)
        for name, options in CALLS:
            found = value_or_error(curvewise, name, curves, options)
            expected = value_or_error(reference, name, curves, options)
            if isinstance(found, str) or isinstance(expected, str):
                assert found == expected, (name, curves)
                continue
            # Relative to the box of P, in which pcm's values are measured, 1e-15 is rounding.
            least = 1e-15 if name == "pcm" else 1e-300
            assert found == pytest.approx(expected, rel=1e-9, abs=least), (name, options, curves)


@pytest.mark.parametrize("module", [curvewise, reference])
def test_a_curve_that_is_short_beside_its_distance_has_a_length(module):
    far = (-1e308, -1.7e308), (-1e308, -5e307)
    assert module.pcm(far, [(1e308, 1.7e308), (1.7e308, 1.7e308)]) == np.inf
    P = (9e15, 9e15), (9e15 + 6, 9e15 + 6)
    match = module.pcm_match(P, [(-1e15, -1e15), (-1e15 + 1, -1e15)])
    # In units of P's box: Q has the length 1/6, and is 10^16/6 below and left of P.
    assert match.value == pytest.approx(2**0.5 * 1e16 / 36, rel=1e-12)
    assert match.coverage == pytest.approx(1 / 6 / 2**0.5, rel=1e-15)
    assert match.mapped == "Q"


@pytest.mark.parametrize("module", [curvewise, reference])
def test_lengths_of_a_far_curve_are_not_rounded(module):
    """Scaled first, the steps of Q would be 0 or 1/8."""
    P = np.array([(0.0, 0.0), (3.0, 1.0)])
    Q = np.array([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.5, 0.0)]) + 2.0**51
    assert module.pcm_match(P, Q).coverage == pytest.approx(2.5 / 3 / 2**0.5, rel=1e-14)
