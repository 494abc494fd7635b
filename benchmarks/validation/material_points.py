"""Material points of kinematic hardening, along strains that are given: models of milliseconds."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from curvewise import datasets

Parameters = Mapping[str, float]
BackStresses = Callable[[Parameters], Sequence[tuple[float, float]]]

# One back stress to find and one that is given.
THREE = {"E": 200e3, "yield": 300.0, "C": 80e3}
THREE_BOUNDS = {"E": (150e3, 260e3), "yield": (150.0, 500.0), "C": (20e3, 200e3)}
# Two back stresses to find, in bounds for tests of sheet steels.
SIX_BOUNDS = {
    "E": (150e3, 230e3),
    "yield": (200.0, 1000.0),
    "C1": (10e3, 500e3),
    "gamma1": (50.0, 2000.0),
    "C2": (500.0, 50e3),
    "gamma2": (0.0, 200.0),
}


def strain_path(*turns: float, points: int) -> np.ndarray:
    """Return strains from turn to turn, the last one left out, with as many points in each leg."""
    legs = itertools.pairwise(turns)
    return np.concatenate([np.linspace(a, b, points, endpoint=False) for a, b in legs])


def of_three(p: Parameters) -> Sequence[tuple[float, float]]:
    return (p["C"], 400.0), (5e3, 20.0)


def of_six(p: Parameters) -> Sequence[tuple[float, float]]:
    return (p["C1"], p["gamma1"]), (p["C2"], p["gamma2"])


def of_seven(p: Parameters) -> Sequence[tuple[float, float]]:
    return (*of_six(p), (p["C3"], 0.0))


def material_point(
    back_stresses: BackStresses, *strains: np.ndarray
) -> Callable[[Parameters], list[np.ndarray]]:
    """Return a model: a curve for each of the strains."""

    def model(p: Parameters) -> list[np.ndarray]:
        return [
            np.column_stack(
                (
                    strain,
                    datasets.kinematic_hardening(
                        strain,
                        youngs_modulus=p["E"],
                        yield_stress=p["yield"],
                        backstresses=back_stresses(p),
                    ),
                )
            )
            for strain in strains
        ]

    return model
