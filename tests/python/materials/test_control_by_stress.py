"""Materials under stress control: closed forms, the inverse of strain control, slopes, errors."""

from __future__ import annotations

import itertools
import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from metals import METALS

from curvewise import reference
from curvewise.calibration import identify
from curvewise.materials import ChabocheVoce, Material

TURNS = (0.0, 430.0, -400.0, 430.0, -350.0, 0.0)
STRESSES = np.concatenate([np.linspace(a, b, 15)[1:] for a, b in itertools.pairwise(TURNS)])


def constants_of(material: Material, numbers: tuple[float, ...]) -> dict[str, float]:
    return dict(zip(material.names, numbers, strict=True))


def test_one_backstress_ratchets_by_the_closed_form():
    """By ln(1.25) / 200: Lemaitre & Chaboche, "Mechanics of solid materials", section 5.4.4."""
    steel = ChabocheVoce(backstresses=1)
    limit, yielding = 200.0, 300.0
    most, least = yielding + math.sqrt(20e3), -yielding - math.sqrt(15e3)
    assert (limit**2 - (least + yielding) ** 2) == pytest.approx(
        1.25 * (limit**2 - (most - yielding) ** 2)
    )
    constants = constants_of(steel, (200e3, yielding, 0.0, 1.0, 200.0 * limit, 200.0))
    strains = steel.strain([most, least] * 20 + [most], constants)
    assert np.diff(strains[::2]) == pytest.approx(math.log(1.25) / 200.0, rel=1e-11)
    assert np.diff(strains[1::2]) == pytest.approx(math.log(1.25) / 200.0, rel=1e-11)


@pytest.mark.parametrize(("material", "constants"), METALS, ids=lambda one: str(one)[:40])
def test_stress_control_is_the_inverse_of_strain_control(material, constants):
    strains = material.strain(STRESSES, constants)
    assert material.stress(strains, constants) == pytest.approx(STRESSES, abs=1e-9)
    textbook = reference.materials.stress(material.name, strains, constants, steps=400)
    assert textbook == pytest.approx(STRESSES, abs=1e-4)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, len(METALS) - 1), st.lists(st.booleans(), min_size=70, max_size=70))
def test_points_may_give_either(index, choices):
    material, constants = METALS[index]
    by_stress = np.array(choices)
    strains = material.strain(STRESSES, constants)
    answer = material.response(np.where(by_stress, STRESSES, strains), by_stress, constants)
    expected = np.where(by_stress, strains, STRESSES)
    assert answer == pytest.approx(expected, rel=1e-9, abs=1e-8)


@pytest.mark.parametrize(("material", "constants"), METALS, ids=lambda one: str(one)[:40])
def test_where_all_points_give_strains_the_bits_are_those_of_stress(material, constants):
    strains = material.strain(STRESSES, constants)
    stress, slopes = material.stress_and_slopes(strains, constants)
    answer, by_all = material.response_and_slopes(strains, False, constants)
    assert (answer == stress).all()
    assert by_all == pytest.approx(slopes, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(("material", "constants"), METALS, ids=lambda one: str(one)[:40])
def test_slopes_are_those_of_the_response(material, constants):
    by_stress = np.random.default_rng(1).random(STRESSES.size) < 0.6
    given_path = np.where(by_stress, STRESSES, material.strain(STRESSES, constants))
    answer, slopes = material.response_and_slopes(given_path, by_stress, constants)
    assert (answer == material.response(given_path, by_stress, constants)).all()
    for j, name in enumerate(material.names):
        step = 1e-6 * max(abs(constants[name]), 1e-3)
        above, below = (
            material.response(given_path, by_stress, {**constants, name: constants[name] + s})
            for s in (step, -step)
        )
        for points, noise in ((by_stress, 1e-14), (~by_stress, 1e-10)):
            differences = (above - below)[points] / (2.0 * step)
            size = np.abs(differences).max() + noise / step
            assert slopes[points, j] == pytest.approx(differences, abs=1e-5 * size)


def test_scales_of_stress_scale_the_bits():
    material, constants = METALS[1]
    strains = material.strain(STRESSES, constants)
    scales = {p.name: 2.0**10 if p.unit == "stress" else 1.0 for p in material.parameters}
    scaled = {name: number * scales[name] for name, number in constants.items()}
    assert (material.strain(STRESSES * 2.0**10, scaled) == strains).all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda m, c: m.strain([100.0, 900.0], c),
            "the material does not reach stress[1] = 900 with these parameters; hardening ends at",
        ),
        (lambda m, c: m.strain([np.nan], c), "stress[0] is nan; stresses must be finite"),
        (lambda m, c: m.strain([[1.0]], c), "given has shape (1, 1); give one value per point"),
        (lambda m, c: m.response([0.01, 1.0], [True], c), "by_stress has shape (1,) of bool"),
        (lambda m, c: m.response([0.01], "stress", c), "by_stress has shape () of <U6"),
        (lambda m, c: m.response([200.0], False, c), "give strains, 0.01 for 1 %, of at most 100"),
        (lambda m, c: m.driven_by(np.eye(2), control="force"), "control of test 0 is 'force'"),
        (lambda m, c: m.driven_by(np.eye(2), control=["stress"] * 2), "2 entries for 1 tests"),
        (lambda m, c: m.driven_by(np.eye(2), control=[True]), "control of test 0 is of shape (1,)"),
    ],
)
def test_what_makes_no_sense_is_refused(call, message):
    material = ChabocheVoce(backstresses=2)
    numbers = (200e3, 300.0, 50.0, 8.0, 80e3, 400.0, 5e3, 50.0)
    with pytest.raises(ValueError, match=re.escape(message)):
        call(material, constants_of(material, numbers))


def ratcheting_test(seed: int) -> tuple[ChabocheVoce, dict[str, float], np.ndarray]:
    """Return a material, its constants, and a noisy test of 5 cycles under stress control."""
    steel = ChabocheVoce(backstresses=1)
    constants = constants_of(steel, (200e3, 300.0, 30.0, 10.0, 40e3, 200.0))
    turns = [0.0, *[430.0, -380.0] * 5]
    stresses = np.concatenate([np.linspace(a, b, 16)[1:] for a, b in itertools.pairwise(turns)])
    test = np.column_stack((steel.strain(stresses, constants), stresses))
    test[:, 0] += np.random.default_rng(seed).normal(0.0, 2e-5, len(test))
    return steel, constants, test


def test_a_ratcheting_test_is_identified_by_its_area():
    steel, constants, test = ratcheting_test(0)
    model = steel.driven_by(test, control="stress")
    fixed = {"E": constants["E"], "b": constants["b"]}
    bounds = {"yield": (200.0, 400.0), "Q": (0.0, 90.0), "C1": (2e4, 9e4), "gamma1": (90.0, 400.0)}
    found = identify(model, test, {**bounds, **fixed}, measure="area", progress=False)
    said = found.uncertainty()
    for name in bounds:
        assert found.parameters[name] == pytest.approx(constants[name], rel=0.05)
        low, high = said.intervals[name]
        assert low - 0.5 * (high - low) <= constants[name] <= high + 0.5 * (high - low)


def test_a_driven_model_keeps_what_is_given():
    steel, constants, test = ratcheting_test(1)
    by_stress = np.arange(len(test)) % 3 == 0
    (curve,) = steel.driven_by(test, control=by_stress)(constants)
    assert (curve[by_stress, 1] == test[by_stress, 1]).all()
    assert (curve[~by_stress, 0] == test[~by_stress, 0]).all()
    model = steel.driven_by([test, test], control=["strain", by_stress], parts=[slice(5), slice(9)])
    (slopes, mixed) = model.jacobian(constants)
    assert slopes.shape == (5, 2, 6)
    assert mixed.shape == (9, 2, 6)
    assert not slopes[:, 0].any()
    assert not mixed[by_stress[:9], 1].any()
    assert not mixed[~by_stress[:9], 0].any()
    identities = {
        steel.driven_by(test, control=one).identity for one in ("strain", "stress", by_stress)
    }
    assert len(identities) == 3
