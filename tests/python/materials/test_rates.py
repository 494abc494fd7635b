"""Tests at several rates of strain: closed form, slopes, a fit, and errors."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

from curvewise.fitting import fit_material
from curvewise.materials import ChabocheVoce, JohnsonCook

STEEL = {"E": 200e3, "A": 350.0, "B": 275.0, "n": 0.36, "C": 0.022}
RATES = (0.001, 1.0, 1000.0)
STRAIN = np.concatenate(([0.0], np.geomspace(1e-3, 0.12, 40)))


def curves_at(rates: tuple[float, ...]) -> list[np.ndarray]:
    materials = (JohnsonCook(rate=rate) for rate in rates)
    return [np.column_stack((STRAIN, material.stress(STRAIN, STEEL))) for material in materials]


@pytest.mark.parametrize("rate", RATES)
def test_a_stress_is_that_of_the_formula(rate: float) -> None:
    stress = JohnsonCook(rate=rate).stress(STRAIN, STEEL)
    p = STRAIN - stress / 200e3
    yields = p > 1e-12
    formula = (350.0 + 275.0 * p[yields] ** 0.36) * (1.0 + 0.022 * math.log(rate))
    np.testing.assert_allclose(stress[yields], formula, rtol=1e-9)
    assert yields.sum() > 20
    scaled = JohnsonCook(rate=2.0 * rate, reference_rate=2.0)
    np.testing.assert_array_equal(scaled.stress(STRAIN, STEEL), stress)


@pytest.mark.parametrize("n", [0.05, 0.1, 0.36, 1.0])
def test_first_plastic_strains_of_any_exponent(n: float) -> None:
    """A step that ends a little behind the yield point has a plastic strain of many zeros."""
    constants = STEEL | {"n": n}
    strain = 350.0 / 200e3 * (1.0 + np.geomspace(1e-9, 1e-2, 15))
    (single,) = np.array([JohnsonCook().stress([one], constants) for one in strain]).T
    stress, slopes = JohnsonCook().stress_and_slopes(strain, constants)
    np.testing.assert_allclose(stress, single, rtol=1e-9)
    assert (stress <= 200e3 * strain * (1.0 + 1e-15)).all()
    assert np.isfinite(slopes).all()


def test_each_test_has_its_rate_in_values_slopes_and_stores() -> None:
    tests = curves_at(RATES)
    model = pickle.loads(pickle.dumps(JohnsonCook().driven_by(tests, rates=RATES)))
    for curve, test in zip(model(STEEL), tests, strict=True):
        np.testing.assert_array_equal(curve, test)
    by_C = [slopes[-1, 1, model.material.names.index("C")] for slopes in model.jacobian(STEEL)]
    assert by_C[0] < 0.0
    assert by_C[1] == 0.0
    assert by_C[2] > 0.0
    same = JohnsonCook().driven_by(tests, rates=[1.0, 1.0, 1.0])
    assert same.identity != model.identity


def test_a_fit_of_several_rates_finds_all_parameters() -> None:
    fit = fit_material(curves_at(RATES), JohnsonCook(), rates=RATES, progress=False)
    assert fit.parameters == pytest.approx(STEEL, rel=1e-3)
    assert not fit.doubts


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: JohnsonCook(rate=0.0).names, "a rate of strain is 0; give a positive number"),
        (lambda: ChabocheVoce().driven_by(np.eye(2), rates=[1.0]), "ChabocheVoce has no rate of"),
        (lambda: JohnsonCook().driven_by(np.eye(2), rates=RATES), "rates has 3 entries for 1 test"),
        (lambda: JohnsonCook().driven_by(np.eye(2), rates=[0.0]), "a rate of strain is 0; give a"),
        (lambda: JohnsonCook().stress([0.0], STEEL | {"n": 0.01}), "n is 0.01; give a number from"),
        (
            lambda: JohnsonCook(rate=1e-30).stress([0.0], STEEL),
            "C is 0.022; at a rate of 1e-30, nothing is left of the yield stress",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(call, message) -> None:
    with pytest.raises(ValueError, match=message):
        call()
