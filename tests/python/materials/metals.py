"""Each kind of material with numbers of a metal, for the tests of all materials."""

from __future__ import annotations

from curvewise.materials import (
    ChabocheVoce,
    JohnsonCook,
    Material,
    OhnoWang,
    Swift,
    UpdatedVoceChaboche,
    YoshidaUemori,
)

_STEEL = {"E": 200e3, "yield": 300.0, "Q": 50.0, "b": 8.0}
_BACK = {"C1": 80e3, "gamma1": 400.0, "C2": 5e3, "gamma2": 20.0}
_SHEET = {"E": 200e3, "CB": 420.0, "Y": 300.0, "C": 300.0, "K": 12.0, "RSAT": 150.0, "SB": 120.0}
_SHEET |= {"H": 0.4}
_DECAY = {"Ea": 160e3, "xi": 60.0}

# The materials reach 430 MPa.
METALS: list[tuple[Material, dict[str, float]]] = [
    (ChabocheVoce(0), _STEEL | {"Q": 300.0}),
    (ChabocheVoce(), _STEEL | _BACK),
    (ChabocheVoce(modulus="decaying"), _STEEL | _BACK | _DECAY | {"Q": -50.0, "C2": 9e3}),
    (YoshidaUemori(), _SHEET),
    (
        YoshidaUemori(growth="power", modulus="decaying"),
        _SHEET | _DECAY | {"C1": 0.01, "C2": 0.3},
    ),
    (UpdatedVoceChaboche(), _STEEL | _BACK | {"Q": 100.0, "D": 60.0, "a": 150.0}),
    (JohnsonCook(), {"E": 200e3, "A": 300.0, "B": 600.0, "n": 0.4, "C": 0.02}),
    (
        OhnoWang(),
        _STEEL | {"zeta1": 400.0, "r1": 100.0, "m1": 3.5, "zeta2": 60.0, "r2": 70.0, "m2": 0.6},
    ),
    (Swift(), {"E": 200e3, "K": 720.0, "e0": 0.004, "n": 0.21}),
]
