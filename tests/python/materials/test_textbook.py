"""The compiled points of material against a textbook's integration in plain numpy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from metals import METALS

from curvewise.materials import ChabocheVoce, Material, YoshidaUemori
from curvewise.reference.materials import stress as textbook

share = st.integers(4, 20).map(lambda twentieths: twentieths / 20)
PATHS = [(0.03, -0.03, 0.03), (-0.01, 0.004, -0.02), (0.011, 0.008, 0.023, -0.004)]


def strains(turns: tuple[float, ...]) -> np.ndarray:
    ways = zip((0.0, *turns), turns, strict=False)
    return np.concatenate([np.linspace(a, b, 7)[1:] for a, b in ways])


def between(low: float, high: float, place: float) -> float:
    return low * (high / low) ** place


@st.composite
def steels(draw: st.DrawFn, material: Material, usual: dict[str, float]) -> dict[str, float]:
    """Draw parameters as metals have them."""
    low_and_high = {
        "E": (60e3, 230e3), "Ea": (50e3, 200e3), "xi": (5.0, 100.0),
        "yield": (100.0, 700.0), "Q": (1.0, 300.0), "b": (0.5, 100.0),
        "C1": (1e3, 3e5), "gamma1": (1.0, 1e3), "C2": (1e3, 1e5), "gamma2": (1.0, 100.0),
        "Y": (100.0, 500.0), "CB": (510.0, 700.0), "C": (10.0, 600.0), "K": (1.0, 50.0),
        "RSAT": (1.0, 400.0), "SB": (1.0, 300.0), "H": (0.01, 1.2),
    }  # fmt: skip
    if not isinstance(material, ChabocheVoce | YoshidaUemori):
        low_and_high = {name: (0.5 * value, 2.0 * value) for name, value in usual.items()}
    if isinstance(material, YoshidaUemori):
        low_and_high |= {"C1": (1e-3, 0.1), "C2": (0.1, 1.0)}
    found = {name: between(*low_and_high[name], draw(share)) for name in material.names}
    if isinstance(material, ChabocheVoce) and draw(st.booleans()):
        found["Q"] = -0.3 * found["yield"]
    return found


@pytest.mark.parametrize(
    ("material", "usual"),
    [(ChabocheVoce(1, modulus="decaying"), {}), *METALS],
)
@given(data=st.data(), turns=st.sampled_from(PATHS))
@settings(max_examples=6, deadline=None)
def test_the_compiled_points_are_those_of_the_textbook(
    material: Material,
    usual: dict[str, float],
    data: st.DataObject,
    turns: tuple[float, ...],
) -> None:
    constants = data.draw(steels(material, usual))
    strain = strains(turns)
    expected = textbook(material.name, strain, constants, steps=60)
    found = material.stress(strain, constants)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-5 * np.abs(expected).max())


def test_the_textbook_is_of_fourth_order() -> None:
    steel = ChabocheVoce(1)
    constants = dict(zip(steel.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True))
    strain = np.array([0.02, -0.02])
    exact = steel.stress(strain, constants)
    errors = [
        np.abs(textbook(steel.name, strain, constants, steps=n) - exact).max() for n in (80, 160)
    ]
    assert errors[1] < errors[0] / 10
