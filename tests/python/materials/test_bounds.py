"""Values read off tests, and the bounds around them: they hold the true parameters, or give a
reason.
"""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from metals import METALS

from curvewise.calibration import Log
from curvewise.calibration.problem.space import Space
from curvewise.curves import turning_points
from curvewise.materials import ChabocheVoce, YoshidaUemori
from curvewise.materials.readings import offset_yield, reading_of, thinned, thinned_cycle

CHABOCHE = ChabocheVoce()
STEEL = dict(zip(CHABOCHE.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0, 5e3, 20.0), strict=True))
SHEET = dict(
    zip(YoshidaUemori().names, (200e3, 420.0, 300.0, 300.0, 12.0, 150.0, 120.0, 0.4), strict=True)
)
TESTS = sorted(
    f"{folder}/{name}"
    for folder, names in {
        "loops": ("dp780_tct_3pct", "dp780_tct_6pct", "eddq_tct_3pct", "eddq_tct_5pct"),
        "cyclic": ("eddq_tc_3pct", "eddq_tc_6pct", "eddq_tc_12pct", "eddq_tension_rd"),
    }.items()
    for name in names
)


def loop(material, parameters, *turns: float, points: int = 200) -> np.ndarray:
    """Return strain and stress from 0 to turn to turn."""
    strain = np.interp(
        np.arange(points * len(turns) + 1) / points, range(len(turns) + 1), (0.0, *turns)
    )
    return np.column_stack((strain, material.stress(strain, parameters)))


@settings(max_examples=20)
@given(
    st.floats(100e3, 250e3),
    st.floats(200.0, 900.0),
    st.floats(-0.25, 0.4),
    st.floats(100.0, 900.0),
)
def test_bounds_hold_what_made_the_loop(E: float, limit: float, share: float, rate: float) -> None:
    made_of = STEEL | {"E": E, "yield": limit, "Q": share * limit, "b": 20.0}
    made_of |= {"C1": 0.5 * limit * rate, "gamma1": rate}
    test = loop(CHABOCHE, made_of, 0.03, -0.03, 0.03)
    assert reading_of(test, "test").moduli == pytest.approx((E,) * 3, rel=0.3)
    bounds = CHABOCHE.bounds_from(test)
    assert tuple(bounds) == CHABOCHE.names
    wide = {name: made_of[name] for name in ("E", "yield", "Q", "b", "gamma1", "C1")}
    space = Space(bounds)
    for name, value in wide.items():
        assert 0.0 < space.place(name, value) < 1.0, name


@pytest.mark.parametrize("modulus", ["constant", "decaying"])
@pytest.mark.parametrize("growth", ["saturating", "power"])
def test_bounds_of_two_surfaces_hold_what_made_the_loop(growth, modulus) -> None:
    material = YoshidaUemori(growth=growth, modulus=modulus)
    made_of = SHEET | {"C1": 0.02, "C2": 0.3, "Ea": 160e3, "xi": 30.0}
    made_of = {name: made_of[name] for name in material.names}
    bounds = material.bounds_from(loop(material, made_of, 0.05, -0.05, 0.05))
    space = Space(bounds)
    places = space.unit(made_of)
    assert (places > 0.0).all()
    assert (places < 1.0).all()


@pytest.mark.parametrize(("material", "constants"), METALS, ids=lambda one: str(one)[:40])
def test_bounds_hold_the_numbers_of_every_material(material, constants) -> None:
    bounds = material.bounds_from(loop(material, constants, 0.05, -0.05, 0.05))
    assert tuple(bounds) == material.names
    places = Space(bounds).unit(constants)
    assert (places > 0.0).all()
    assert (places < 1.0).all()


def test_several_tests_widen_the_bounds() -> None:
    short, long = (loop(CHABOCHE, STEEL, end, -end) for end in (0.01, 0.05))
    alone, both = (CHABOCHE.bounds_from(tests) for tests in ([short], [short, long]))
    assert both["gamma1"].low < alone["gamma1"].low
    assert both["yield"].low <= alone["yield"].low


@pytest.mark.parametrize("material", [ChabocheVoce(modulus="decaying"), YoshidaUemori()])
def test_bounds_over_a_decade_are_logarithmic(material) -> None:
    # The second test says half the modulus of the first: 0.5 of the one to 4 of the other.
    stiff = loop(CHABOCHE, STEEL, 0.02, -0.02)
    soft = loop(CHABOCHE, STEEL | {"E": 100e3}, 0.02, -0.02)
    alone, both = material.bounds_from(stiff), material.bounds_from([stiff, soft])
    assert isinstance(alone["E"], tuple)
    assert isinstance(both["E"], Log)
    assert both["E"].low < alone["E"][0]
    assert both["E"].high == alone["E"][1]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for bounds in (alone, both):
            Space(bounds).warn_of_wide_bounds()


@pytest.mark.parametrize(
    ("test", "message"),
    [
        (loop(CHABOCHE, STEEL, 0.02, -0.02) * (100, 1), "strains of up to 2, which is 200 %"),
        (loop(CHABOCHE, STEEL, 0.001), r"experiments\[0\] is elastic"),
        (loop(CHABOCHE, STEEL, 0.02, -0.02) * (1, -1), "has no straight part"),
        (np.zeros((9, 3)), r"experiments\[0\] has shape \(9, 3\)"),
    ],
)
def test_what_is_no_test_of_a_metal_is_said(test: np.ndarray, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        CHABOCHE.bounds_from(test)


def test_a_test_is_thinned_to_its_turns_and_its_knees() -> None:
    test = loop(CHABOCHE, STEEL, 0.03, -0.03, 0.03, points=2000)
    random = np.random.default_rng(1)
    noisy = test + random.normal(0.0, 1.0, test.shape) * (2e-5, 2.0)
    found = thinned(noisy, "test", 300)
    assert 290 <= len(found) <= 300
    assert np.abs(found[:, 0]).max() == np.abs(noisy[:, 0]).max()
    elastic = found[(found[:, 0] < 0.0015) & (np.arange(len(found)) < 100)]
    assert 15 <= len(elastic) <= 60  # by strain alone they would be 5
    assert thinned(test[::20], "test", 400) is not None


TURNS = (0.03, -0.03, 0.03, -0.03, 0.03)


def noisy(test: np.ndarray, strain: float, stress: float, seed: int = 1) -> np.ndarray:
    """Return a test with normal noise."""
    random = np.random.default_rng(seed)
    return test + random.normal(0.0, 1.0, test.shape) * (strain, stress)


@pytest.mark.parametrize("strain", [1e-5, 5e-5])
def test_a_dense_noisy_test_is_averaged_onto_its_curve(strain: float) -> None:
    test = noisy(loop(CHABOCHE, STEEL, *TURNS, points=20_000), strain, 3.0)
    found = thinned(test, "test", 300)
    assert 290 <= len(found) <= 300
    turns = turning_points(found)
    assert np.abs(found[turns, 0] - TURNS[:-1]).max() < strain / 3.0
    errors = found[:, 1] - CHABOCHE.stress(found[:, 0], STEEL)
    assert errors.std() < 2.0  # a row has at least 3
    assert np.abs(errors[[0, *turns, -1]]).max() < 4.0 * errors.std()
    for branch in np.split(errors, turns):
        assert abs(branch.mean()) < 4.0 * errors.std() / np.sqrt(len(branch))


def test_the_last_cycle_of_a_dense_noisy_test_has_the_history_that_it_had() -> None:
    test = noisy(loop(CHABOCHE, STEEL, *TURNS, points=20_000), 5e-5, 3.0)
    path, part = thinned_cycle(test, "test", 300)
    assert np.abs(path[: part.start, 0] - (0.0, *TURNS[:2])).max() < 5e-5 / 3.0
    cycle = path[part]
    assert 280 <= len(cycle) <= 300
    ends = cycle[[0, *turning_points(cycle), -1], 0]
    assert np.abs(ends - TURNS[2:]).max() < 5e-5 / 3.0
    errors = cycle[:, 1] - CHABOCHE.stress(path[:, 0], STEEL)[part]
    assert errors.std() < 2.0
    assert abs(errors.mean()) < errors.std() / 3.0


@pytest.mark.parametrize(
    ("rows", "strain", "stress"),
    [(2000, 2e-5, 2.0), (20_000, 0.0, 5.0), (20_000, 1e-6, 5.0), (89, 1e-3, 2.0)],
    ids=["steps above the noise", "stress alone", "hardly in strain", "few rows"],
)
def test_a_test_that_is_not_dense_keeps_its_rows(rows: int, strain: float, stress: float) -> None:
    test = noisy(loop(CHABOCHE, STEEL, *TURNS, points=rows), strain, stress)
    found = thinned(test, "test", 300)
    turns = turning_points(test)
    np.testing.assert_array_equal(found[turning_points(found)], test[turns])
    np.testing.assert_array_equal(found[[0, -1]], test[[0, -1]])


@pytest.mark.parametrize("name", TESTS)
def test_measured_loops_are_read_as_steel(name: str, data_dir: Path) -> None:
    test = np.loadtxt(data_dir / f"{name}.csv", delimiter=",")
    reading = reading_of(test, name)
    assert all(80e3 < modulus < 320e3 for modulus in reading.moduli)
    assert 100.0 < reading.yield_stress < reading.stress
    for material in (CHABOCHE, YoshidaUemori()):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            Space(material.bounds_from(test)).warn_of_wide_bounds()  # there are no wide ones


def test_a_first_loading_without_stress_is_refused():
    """A damaged file had one: its yield stress of 0 divided, and ended the command."""
    first = np.column_stack((np.linspace(0.0, 0.01, 20), np.zeros(20)))
    with pytest.raises(ValueError, match="test strains without stress where it is first loaded"):
        offset_yield(first, 200e3, "test")
