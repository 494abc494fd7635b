"""Points of material with parameters of any size: right, or refused by name; never wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest
from metals import METALS

from curvewise.materials import ChabocheVoce, Material, YoshidaUemori
from curvewise.reference.materials import stress as textbook

USUAL = {"E": 200e3, "Ea": 160e3, "xi": 30.0}
USUAL |= {"yield": 300.0, "Q": 100.0, "b": 8.0, "C1": 80e3, "gamma1": 400.0, "C2": 5e3}
USUAL |= {"gamma2": 20.0, "Y": 300.0, "C": 300.0, "K": 12.0, "RSAT": 150.0, "SB": 120.0, "H": 0.4}
POWER = {"C1": 0.01, "C2": 0.3}
MAY_VANISH = {"xi", "b", "gamma1", "gamma2", "K", "RSAT", "SB", "H"}
MATERIALS: list[Material] = [
    *(ChabocheVoce(k, modulus) for k in (0, 1, 2) for modulus in ("constant", "decaying")),
    *(
        YoshidaUemori(growth, modulus)
        for growth in ("saturating", "power")
        for modulus in ("constant", "decaying")
    ),
]
each_material = pytest.mark.parametrize("material", MATERIALS, ids=repr)


def drawn(material: Material, rng: np.random.Generator, decades: float) -> dict[str, float]:
    """Draw parameters, each up to that many decades from those of a metal."""
    usual = USUAL | (POWER if isinstance(material, YoshidaUemori) else {})
    usual |= {"CB": 1.0}
    found = {name: usual[name] * 10 ** rng.uniform(-decades, decades) for name in material.names}
    for name in [name for name in material.names if name in MAY_VANISH]:
        if rng.random() < 0.05:
            found[name] = 0.0
    if "Q" in found and rng.random() < 0.5:
        found["Q"] = -found["yield"] * rng.uniform(0.01, 0.999)
    if "CB" in found:
        found["CB"] = found["Y"] * (1.0 + 10 ** rng.uniform(-min(decades, 12.0), decades))
    if material.names[-1] == "C2" and isinstance(material, YoshidaUemori):
        found["C2"] = min(found["C2"], 1.0)
    return found


def largest(material: Material, p: dict[str, float], strain: np.ndarray) -> float:
    """Return what the law allows the stress to be."""
    if isinstance(material, ChabocheVoce):
        pairs = [(p[f"C{k}"], p[f"gamma{k}"]) for k in range(1, material.backstresses + 1)]
        back = sum(C / gamma if gamma else math.inf for C, gamma in pairs)
        return p["yield"] + max(p["Q"], 0.0) + back
    share = 1.0
    if material.growth == "power":
        path = np.abs(np.diff(strain, prepend=0.0)).sum()
        share = (p["C1"] + path) ** p["C2"] - p["C1"] ** p["C2"]
    return p["CB"] + share * p["RSAT"] + p["SB"]


def walked(rng: np.random.Generator, points: int = 6) -> np.ndarray:
    """Return a random path of strain."""
    return np.clip(np.cumsum(rng.normal(size=points)) * 10 ** rng.uniform(-4.0, 0.0), -90.0, 90.0)


def difference(
    material: Material, strain: np.ndarray, constants: dict[str, float], name: str, share: float
) -> np.ndarray:
    """Return the change of the stress by a relative change of a parameter."""
    step = share * constants[name]
    above, below = ({**constants, name: constants[name] + d} for d in (step, -step))
    change = material.stress(strain, above) - material.stress(strain, below)
    found: np.ndarray = change / (2.0 * share)
    return found


@each_material
@pytest.mark.parametrize("decades", [1.5, 6.0, 40.0])
def test_stresses_are_within_the_law_and_slopes_finite(material, decades, rounds) -> None:
    rng = np.random.default_rng(20261128)
    within, count = 0, rounds(40 if decades == 6.0 else 150)
    for _ in range(count):
        constants, strain = drawn(material, rng, decades), walked(rng)
        try:
            stress, slopes = material.stress_and_slopes(strain, constants)
        except ValueError as refusal:  # by name
            name, _, why = str(refusal).partition(" is ")
            assert name in material.names
            assert "with these parameters" in why or (name == "H" and why.endswith("at most 1e6"))
            continue
        within += 1
        assert (np.abs(stress) <= (1.0 + 1e-7) * largest(material, constants, strain)).all()
        assert np.isfinite(slopes).all()
    least = {1.5: 1.0, 6.0: 0.6, 40.0: 0.1}  # a metal's are never refused
    assert within >= least[decades] * count


@pytest.mark.parametrize(
    ("material", "usual"),
    [pair for pair in METALS if not isinstance(pair[0], ChabocheVoce | YoshidaUemori)],
    ids=lambda one: str(one)[:40],
)
@pytest.mark.parametrize("decades", [1.0, 6.0, 40.0])
def test_numbers_of_other_materials_are_finite_or_refused_by_name(material, usual, decades) -> None:
    rng = np.random.default_rng(20261201)
    found, refused = 0, []
    for _ in range(100):
        factors = 10.0 ** rng.uniform(-decades, decades, len(usual))
        constants = dict(zip(usual, np.array(list(usual.values())) * factors, strict=True))
        try:
            stress, slopes = material.stress_and_slopes(walked(rng), constants)
        except ValueError as refusal:
            refused.append(str(refusal).partition(" is ")[0])
            continue
        found += 1
        assert np.isfinite(stress).all()
        assert np.isfinite(slopes).all()
    assert found > 5 or decades > 1.0
    assert set(refused) <= set(material.names)


@each_material
def test_a_step_may_be_divided_and_slopes_are_those_of_differences(material, rounds) -> None:
    rng = np.random.default_rng(20261129)
    compared, count = 0, rounds(60)
    for _ in range(count):
        constants, strain = drawn(material, rng, 1.2), walked(rng)
        stress, slopes = material.stress_and_slopes(strain, constants)
        scale = np.abs(stress).max()
        ways = zip(np.r_[0.0, strain], strain, strict=False)
        fine = np.concatenate([np.linspace(a, b, 6)[1:] for a, b in ways])
        np.testing.assert_allclose(
            material.stress(fine, constants)[4::5], stress, rtol=0.0, atol=1e-6 * scale
        )
        for name, slope in zip(material.names, slopes.T, strict=True):
            if not constants[name]:
                continue
            near, far = (difference(material, strain, constants, name, d) for d in (1e-6, 4e-6))
            smooth = np.abs(near - far) <= 1e-5 * scale  # no kink in between
            compared += smooth.sum()
            np.testing.assert_allclose(
                (constants[name] * slope)[smooth], near[smooth], rtol=1e-3, atol=1e-4 * scale
            )
    assert compared > 10 * count


@pytest.mark.parametrize("growth", ["saturating", "power"])
@pytest.mark.parametrize("modulus", ["constant", "decaying"])
def test_steep_motion_of_the_yield_surface_tends_to_a_limit(growth, modulus) -> None:
    """At large C the centres meet at once: the stress is that of the bounding surface."""
    material = YoshidaUemori(growth, modulus)
    constants = {**USUAL, **POWER, "CB": 420.0}
    constants = {name: constants[name] for name in material.names}
    strain = np.array([0.01, -0.01, 0.05, 0.0499, 1.0, 5.0, -5.0])
    before = material.stress(strain, constants | {"C": 1e4})
    changes = []
    for C in 10.0 ** np.arange(5.0, 21.0):
        stress, slopes = material.stress_and_slopes(strain, constants | {"C": C})
        assert (np.abs(stress) <= largest(material, constants, strain)).all()
        assert np.isfinite(slopes).all()
        step = 1e-6 * constants["CB"]
        ends = [
            material.stress(strain, constants | {"C": C, "CB": constants["CB"] + side * step})
            for side in (1, -1)
        ]
        by_CB = slopes[:, material.names.index("CB")]
        np.testing.assert_allclose(by_CB, (ends[0] - ends[1]) / (2.0 * step), rtol=1e-4, atol=1e-4)
        changes.append(np.abs(stress - before).max())
        before = stress
    expected = changes[0] * 0.1 ** np.arange(len(changes))  # an error in proportion to 1 / C
    np.testing.assert_array_less(changes, 1.5 * expected + 1e-6)


@pytest.mark.parametrize("b", [500.0, 790.0, 810.0, 1000.0, 1e4])
@pytest.mark.parametrize("modulus", ["constant", "decaying"])
def test_a_yield_stress_that_falls_faster_than_the_modulus_snaps_back(b, modulus) -> None:
    material = ChabocheVoce(1, modulus)
    constants = USUAL | {"Q": -250.0, "b": b}
    constants = {name: constants[name] for name in material.names}
    strain = np.array([0.001, 0.0016, 0.003, 0.0028, -0.004])
    found = material.stress(strain, constants)
    expected = textbook(material.name, strain, constants, steps=30)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=2e-3)


def test_a_flow_that_would_snap_back_stays_at_its_first_root(rounds) -> None:
    """One long step and many short ones end at the same stress, before and after the jump."""
    rng = np.random.default_rng(20261130)
    jumps, count = 0, rounds(200)
    for _ in range(count):
        material = ChabocheVoce(int(rng.integers(1, 3)))
        Q, b = -rng.uniform(100.0, 299.0), 10 ** rng.uniform(3.5, 5.5)
        constants = {"E": 200e3, "yield": 300.0, "Q": Q, "b": b}
        for k in range(1, material.backstresses + 1):
            constants[f"C{k}"] = abs(Q * b + 200e3) * 10 ** rng.uniform(-0.3, 1.5)
            constants[f"gamma{k}"] = b * 10 ** rng.uniform(-0.5, 3.0)
        strain = 300.0 / 200e3 + np.linspace(0.0, 10 ** rng.uniform(-1.5, 2.0) / b, 25)[1:]
        path = material.stress(strain, constants)
        np.testing.assert_allclose(
            [material.stress([value], constants)[0] for value in strain], path, atol=1e-3
        )
        jumps += (np.diff(path) < -20.0).any()
    assert jumps > 0.05 * count
    # Near the maximum, a step of Halley's is short, and the root is far.
    material = ChabocheVoce(2)
    numbers = (200e3, 300.0, -134.35822243469653, 29895.029526900948, 975111.5889026686)
    numbers += (8571743.408844711, 5279097.752397228, 54211.24129382934)
    constants = dict(zip(material.names, numbers, strict=True))
    assert material.stress([0.0026671517161211454], constants)[0] == pytest.approx(263.1, abs=1.0)


def test_the_reference_agrees_where_the_centres_have_met() -> None:
    material = YoshidaUemori()
    constants = {name: {**USUAL, "CB": 420.0, "C": 2e4, "K": 0.0}[name] for name in material.names}
    strain = [0.02, 0.03, -0.03]
    expected = textbook(material.name, strain, constants, steps=400)
    np.testing.assert_allclose(material.stress(strain, constants), expected, atol=1e-3)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"C": 1e-5, "K": 1e12}, "C is 1e-05; with these parameters the Yoshida-Uemori equations"),
        ({"H": 1e65}, r"H is 1e\+65; it must be at most 1e6"),
    ],
)
def test_what_cannot_be_integrated_is_refused_by_name(change, message) -> None:
    constants = {name: {**USUAL, "CB": 420.0, **change}[name] for name in YoshidaUemori().names}
    with pytest.raises(ValueError, match=message):
        YoshidaUemori().stress([5.0, -0.5, 60.0], constants)


def test_a_slope_that_overflows_is_refused_by_name() -> None:
    material = ChabocheVoce(2, "decaying")
    numbers = (4.16267e-97, 1.1e-135, 2.7e-6, 9.8e-126, 2.3e144, 1.1e6, 1.7e-122, 4.4e136, 9.5e90)
    constants = dict(zip(material.names, (*numbers, 1.3e133), strict=True))
    assert np.isfinite(material.stress([-0.0072], constants)).all()
    with pytest.raises(ValueError, match=r"E is 4.16267e-97; .* the slope of the stress at strain"):
        material.stress_and_slopes([-0.0072], constants)


def test_a_slope_that_overflows_at_a_given_stress_is_refused_by_its_place() -> None:
    material = ChabocheVoce(2, "decaying")
    numbers = (4.16267e-97, 1.1e-135, 2.7e-6, 9.8e-126, 2.3e144, 1.1e6, 1.7e-122, 4.4e136, 9.5e90)
    constants = dict(zip(material.names, (*numbers, 1.3e133), strict=True))
    (stress,) = material.stress([-0.0072], constants)
    with pytest.raises(ValueError, match=r"the slope of the strain at stress\[0\] by"):
        material.response_and_slopes([stress], True, constants)
