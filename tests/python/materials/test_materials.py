"""Material points from Python: values, derivatives, models for identify, and errors."""

from __future__ import annotations

import itertools
import pickle

import numpy as np
import pandas
import pytest
from metals import METALS

import curvewise
from curvewise.calibration import identify
from curvewise.materials import ChabocheVoce, YoshidaUemori

STEEL = {"E": 200e3, "yield": 300.0, "Q": -50.0, "b": 8.0, "C1": 80e3, "gamma1": 400.0}
STEEL |= {"C2": 5e3, "gamma2": 20.0}
SHEET = {"E": 200e3, "CB": 420.0, "Y": 300.0, "C": 300.0, "K": 12.0, "RSAT": 150.0, "SB": 120.0}
SHEET |= {"H": 0.4}
POWER = {"C1": 0.01, "C2": 0.3}
each_material = pytest.mark.parametrize(("material", "constants"), METALS)


def path(*turns: float, points: int = 53) -> np.ndarray:
    """Return strains from 0 to turn to turn, `points` on each way."""
    ways = zip((0.0, *turns), turns, strict=False)
    return np.concatenate([np.linspace(a, b, points + 1)[1:] for a, b in ways])


# yielding begins at none of these strains, because there is a kink
STRAIN = path(0.031, -0.029, 0.027)


def test_chaboche_without_voce_is_the_model_of_the_datasets() -> None:
    constants = STEEL | {"Q": 0.0, "b": 0.0}
    expected = curvewise.datasets.kinematic_hardening(
        STRAIN, backstresses=((80e3, 400.0), (5e3, 20.0))
    )
    np.testing.assert_allclose(ChabocheVoce().stress(STRAIN, constants), expected, rtol=1e-12)


def test_values_saturate_where_the_theory_says() -> None:
    # Far out: yield + Q + C1/gamma1 + C2/gamma2, and CB + RSAT + SB.
    chaboche = ChabocheVoce().stress([5.0], STEEL)
    np.testing.assert_allclose(chaboche, 300 - 50 + 200 + 250, rtol=1e-12)
    np.testing.assert_allclose(YoshidaUemori().stress([5.0], SHEET), 690, rtol=1e-9)


def test_sheet_is_elastic_until_it_yields_and_at_once_after_a_reversal() -> None:
    strain = np.array([0.001, 0.0015, 0.05, 0.049, 0.0485])
    stress = YoshidaUemori().stress(strain, SHEET)
    np.testing.assert_allclose(stress[:2], 200e3 * strain[:2], rtol=1e-15)
    np.testing.assert_allclose(np.diff(stress[2:]), 200e3 * np.diff(strain[2:]), rtol=1e-12)


@pytest.mark.parametrize("H", [0.0, 0.4, 1.0, 1.2])
def test_first_loading_ends_at_the_bounding_surface_by_the_power_law(H: float) -> None:
    constants = SHEET | POWER | {"K": 60.0, "C": 2000.0, "H": H}
    strain = np.linspace(0.1, 0.5, 50)
    stress = YoshidaUemori(growth="power").stress(strain, constants)
    p = strain - stress / 200e3
    grown = 150.0 * ((0.01 + p) ** 0.3 - 0.01**0.3)
    moved = 120.0 * -np.expm1(-60.0 * p)
    # The yield surface's centre stays behind by what the bounding surface's motion leaves it.
    np.testing.assert_allclose(stress, 420.0 + grown + moved, rtol=5e-4)


def test_cycles_without_growth_become_one_odd_loop() -> None:
    strain = path(*(0.02, -0.02) * 20, 0.02, points=80)
    loop = YoshidaUemori().stress(strain, SHEET | {"RSAT": 0.0})[-161:]
    np.testing.assert_allclose(loop[:81], -loop[80:], atol=1e-3)


def test_growth_stagnates_the_longer_after_a_reversal_the_larger_H() -> None:
    ends = [
        abs(YoshidaUemori().stress([0.06, -0.06], SHEET | {"H": H})[-1])
        for H in (0.0, 0.5, 1.0, 1.2)
    ]
    assert all(first > second + 1.0 for first, second in itertools.pairwise(ends))


@each_material
def test_slopes_are_those_of_the_stress(material, constants) -> None:
    stress, slopes = material.stress_and_slopes(STRAIN, constants)
    np.testing.assert_array_equal(stress, material.stress(STRAIN, constants))
    assert slopes.shape == (len(STRAIN), len(material.names))
    for name, slope in zip(material.names, slopes.T, strict=True):
        step = 1e-5 * constants[name]
        above, below = ({**constants, name: constants[name] + side * step} for side in (1, -1))
        change = material.stress(STRAIN, above) - material.stress(STRAIN, below)
        difference = change / (2 * step)
        np.testing.assert_allclose(slope, difference, atol=1e-3 * abs(difference).max())


def test_slopes_do_not_grow_where_the_stress_stands_still() -> None:
    numbers = (392836.737346712, 117.375652, 27.275234, 50740.324677, 1.294879, 441.329, 0.0, 0.4)
    constants = dict(zip(YoshidaUemori().names, numbers, strict=True))
    stress, slopes = YoshidaUemori().stress_and_slopes(path(0.25, points=300), constants)
    np.testing.assert_allclose(stress[10:], 117.375652, rtol=1e-9)
    by = dict(zip(YoshidaUemori().names, slopes[-1], strict=True))
    assert by["CB"] == pytest.approx(1.0, abs=1e-9)
    assert all(abs(by[name]) < 1e-9 for name in ("E", "Y", "C", "K", "H"))


@pytest.mark.parametrize(
    ("modulus", "mean", "points"), [("constant", 0.055, 297), ("decaying", 0.05, 299)]
)
def test_slopes_do_not_grow_where_the_centres_have_met(modulus, mean, points) -> None:
    material = YoshidaUemori(modulus=modulus)
    numbers = {"E": 115e3, "CB": 253.2, "Y": 165.2, "C": 59138.9, "K": 0.05315, "RSAT": 1427.8}
    constants = {**numbers, "SB": 1579.1, "H": 0.957, "Ea": 90e3, "xi": 40.0}
    constants = {name: constants[name] for name in material.names}
    strain = mean * (1.0 - np.cos(2.0 * np.pi * np.arange(points) / (points - 1)))
    slopes = material.stress_and_slopes(strain, constants)[1]
    largest = np.abs(slopes * list(constants.values())).max(axis=0)
    assert (largest < 1000.0).all()  # MPa by a relative change


@each_material
def test_a_path_may_be_subdivided_and_mirrored(material, constants) -> None:
    stress = material.stress(STRAIN, constants)
    fine = material.stress(path(0.031, -0.029, 0.027, points=530), constants)[9::10]
    np.testing.assert_allclose(stress, fine, atol=1e-7)
    np.testing.assert_array_equal(material.stress(-STRAIN, constants), -stress)


@each_material
def test_any_layout_of_strains(material, constants) -> None:
    expected = material.stress(STRAIN, constants)
    wide = np.repeat(STRAIN, 2)
    for strain in (wide[::2], STRAIN.astype(">f8"), list(STRAIN), STRAIN[::-1].copy()[::-1]):
        np.testing.assert_array_equal(material.stress(strain, constants), expected)


@each_material
def test_every_parameter_is_named_with_its_unit(material, constants) -> None:
    assert set(material.names) == set(constants)
    assert {parameter.unit for parameter in material.parameters} <= {"stress", "-"}
    assert all(parameter.meaning for parameter in material.parameters)


def test_a_material_driven_by_loops_is_a_model() -> None:
    material = ChabocheVoce(backstresses=1)
    truth = {name: STEEL[name] for name in material.names} | {"Q": 0.0, "b": 1.0}
    loop = np.column_stack((STRAIN, material.stress(STRAIN, truth)))
    model = pickle.loads(pickle.dumps(material.driven_by([loop, loop[:40]])))
    curves = model(truth)
    np.testing.assert_array_equal(curves[0], loop)
    assert [curve.shape for curve in curves] == [(159, 2), (40, 2)]
    assert [slopes.shape for slopes in model.jacobian(truth)] == [(159, 2, 6), (40, 2, 6)]
    bounds = truth | {"yield": (200.0, 400.0), "C1": (20e3, 120e3), "gamma1": (100.0, 700.0)}
    found = identify(material.driven_by(loop), loop, bounds, progress=False)
    assert found.parameters == pytest.approx(truth, rel=2e-3)


def test_loops_of_any_kind_drive_a_material() -> None:
    strain, stress = [0.0, 0.01, -0.01], [0.0, 300.0, -300.0]
    table = pandas.DataFrame({"strain": strain, "stress": stress})
    for loop in (table, table.to_numpy(), table.to_numpy().tolist(), [table]):
        assert [path.tolist() for path in ChabocheVoce().driven_by(loop).strains] == [strain]
    masked = np.ma.array(strain, mask=[0, 1, 0])
    with pytest.raises(TypeError, match="strain is a masked array"):
        ChabocheVoce().stress(masked, STEEL)
    with pytest.raises(ValueError, match=r"experiments\[1\] has shape \(3, 3\); give strain and"):
        ChabocheVoce().driven_by([table, np.zeros((3, 3))])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ChabocheVoce().stress([[0.0]], STEEL), r"strain has shape \(1, 1\)"),
        (lambda: ChabocheVoce().stress([0.0, np.nan], STEEL), r"strain\[1\] is nan"),
        (lambda: ChabocheVoce().stress([3.0, 200.0], STEEL), r"strain\[1\] is 200; give strains"),
        (lambda: ChabocheVoce().stress([0.0], STEEL | {"Q": -300.0}), "Q is -300; a yield stress"),
        (lambda: ChabocheVoce().stress([0.0], STEEL | {"E": 0.0}), "E is 0; it must be above 0"),
        (lambda: ChabocheVoce().stress([0.0], STEEL | {"gama1": 1.0}), "no parameter 'gama1'; did"),
        (lambda: ChabocheVoce(1).stress([0.0], {"E": 1.0}), "needs yield, Q, b, C1, gamma1"),
        (lambda: YoshidaUemori().stress([0.0], SHEET | {"CB": 300.0}), "CB is 300; the bounding"),
        (lambda: ChabocheVoce(modulus="other").names, "unknown modulus 'other'; choose from"),
        (lambda: ChabocheVoce(-1).names, "backstresses is -1"),
    ],
)
def test_what_makes_no_sense_is_refused(call, message) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_a_model_that_has_run_is_the_same_to_a_store() -> None:
    """Nothing that a run leaves behind is part of what a model is told by."""
    model = ChabocheVoce(backstresses=1).driven_by([(0.0, 0.0), (0.01, 300.0)])
    before = pickle.dumps(model)
    model(dict(zip(model.material.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True)))
    assert pickle.dumps(model) == before
