"""Ohno and Wang's material against closed forms, and what it is for: it ratchets less."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from curvewise.materials import ChabocheVoce, OhnoWang

Array = npt.NDArray[np.float64]
STEEL = {"E": 200e3, "yield": 300.0, "Q": 0.0, "b": 1.0}


def back(zeta: float, r: float, m: float) -> dict[str, float]:
    return STEEL | {"zeta1": zeta, "r1": r, "m1": m}


def response_of(x: Array, p: Array, r: float) -> tuple[Array, Array]:
    """Return strain and stress where X is r x after the plastic strain p."""
    stress = STEEL["yield"] + r * x
    return p + stress / STEEL["E"], stress


@given(
    st.floats(1.0, 1e5),
    st.floats(1.0, 300.0),
    st.lists(st.floats(1e-6, 0.2), min_size=1),
    st.data(),
)
@settings(derandomize=True, deadline=None)
def test_first_loading(zeta: float, r: float, strains: list[float], data: st.DataObject) -> None:
    """With m of 1, X is r tanh(zeta p); with m of 0, that of Armstrong and Frederick."""
    p = np.cumsum(strains)
    m = data.draw(st.sampled_from([0.0, 1.0]))
    x = np.tanh(zeta * p) if m else -np.expm1(-zeta * p)
    strain, stress = response_of(x, p, r)
    found = OhnoWang(1).stress(strain, back(zeta, r, m))
    assert found == pytest.approx(stress, rel=1e-12)
    if m == 0:
        chaboche = STEEL | {"C1": zeta * r, "gamma1": zeta}
        assert found == pytest.approx(ChabocheVoce(1).stress(strain, chaboche), rel=1e-12)


@pytest.mark.parametrize("m", [0.0, 0.3, 1.0, 4.0, 300.0, 1e9])
def test_unloading_is_linear_and_reloading_is_the_same_curve(m: float) -> None:
    """From the limit -r back to 0, X rises by zeta r p; from there it is that of first loading."""
    zeta, r, E = 50.0, 100.0, STEEL["E"]
    constants = back(zeta, r, m)
    first = np.array([0.01, 0.02, 0.05])
    limit = -1.0  # strain at which X is -r to rounding
    start = OhnoWang(1).stress([limit], constants)[0]
    assert start == pytest.approx(-STEEL["yield"] - r, rel=1e-14)
    half = 0.5 / zeta
    strain = limit + 2 * STEEL["yield"] / E + half + 0.5 * r / E
    found = OhnoWang(1).stress([limit, strain], constants)[1]
    assert found == pytest.approx(STEEL["yield"] - 0.5 * r, rel=1e-12)
    zero = limit + (2 * STEEL["yield"] + r) / E + 1 / zeta
    path = [limit, *(zero + first)]
    again = OhnoWang(1).stress(path, constants)[1:]
    expected = OhnoWang(1).stress(first + STEEL["yield"] / E, constants)
    assert again == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("m", [0.0, 0.7, 3.0, 40.0])
def test_steps_of_any_length(m: float) -> None:
    constants = back(700.0, 120.0, m) | {"Q": -60.0, "b": 25.0}
    turns = [0.0, 0.02, -0.015, 0.003, -0.002, 0.05]
    fine = np.concatenate([np.linspace(a, b, 300)[1:] for a, b in pairwise(turns)])
    at_turns = OhnoWang(1).stress(fine, constants)[298::299]
    assert OhnoWang(1).stress(turns[1:], constants) == pytest.approx(at_turns, rel=1e-12)


@pytest.mark.parametrize("m", [0.3, 2.0, 8.0, 40.0])
def test_slopes_at_every_part_of_the_course(m: float) -> None:
    """Of back stresses below 0, from 0 to half of the limit, and beyond, to eight digits."""
    constants = back(50.0, 100.0, m) | {"Q": 40.0, "b": 12.0}
    strain = np.cumsum([0.004, 0.003, 0.006, 0.02, -0.01, -0.004, -0.003, 0.008, 0.006])
    slopes = OhnoWang(1).stress_and_slopes(strain, constants)[1]
    for name, slope in zip(OhnoWang(1).names, slopes.T, strict=True):
        step = 1e-3 * constants[name]
        # Of fourth order.
        difference = sum(
            weight * OhnoWang(1).stress(strain, constants | {name: constants[name] + k * step})
            for k, weight in ((-2, 1 / 12), (-1, -2 / 3), (1, 2 / 3), (2, -1 / 12))
        )
        assert slope == pytest.approx(difference / step, rel=1e-8, abs=1e-8 * np.abs(slope).max())


def drift(material: OhnoWang | ChabocheVoce, constants: dict[str, float]) -> float:
    """Return the strain that cycles between 380 and -340 MPa leave each time, at last."""
    stress = np.array([380.0, -340.0] * 60)
    strain = material.strain(stress, constants)
    return float(strain[-2] - strain[-4])


def test_it_ratchets_less() -> None:
    chaboche = drift(ChabocheVoce(1), STEEL | {"C1": 40e3, "gamma1": 400.0})
    drifts = [drift(OhnoWang(1), back(400.0, 100.0, m)) for m in (0.0, 2.0, 8.0, 100.0)]
    # Of one back stress, by Armstrong and Frederick, a cycle: both branches closed in p.
    a, b = 80.0, -40.0
    closed = np.log((100 - b) / (100 - a)) - np.log((100 + a) / (100 + b))
    assert chaboche == pytest.approx(closed / 400.0, rel=1e-9)
    assert chaboche > drifts[0] > drifts[1] > drifts[2] > drifts[3] >= 0
    assert drifts[3] < 1e-9


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"r1": 0.0}, "r1 is 0; it must be above 0"),
        ({"m1": -1.0}, "m1 is -1; it must be at least 0"),
        ({"Q": -300.0}, "Q is -300; a yield stress of 300 would soften to nothing"),
        ({"Q": -100.0, "b": 2e3}, "b is 2000; the yield stress would fall faster than E"),
    ],
)
def test_errors(changed: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        OhnoWang(1).stress([0.01], back(400.0, 100.0, 3.0) | changed)
