"""A tension–compression test of a sheet, as a single C3D8 hexahedron in CalculiX.

Every test has a cube of its own, of unit length, pulled and pushed along x by given displacements,
free to contract; all cubes are in one deck. The finite-strain formulation (NLGEOM) is used: the
displacement is exp(true strain) - 1, and the true stress is the reaction over the current area.
Without NLGEOM, ccx 2.20 moves the yield surface the wrong way: with linear kinematic hardening of
1000 MPa the stress at 3 % strain falls below the yield stress.

Material. CalculiX has one back stress, whose modulus depends on the accumulated plastic strain, so
that a single element shows no transient after a reversal of the load. The material is therefore an
overlay (J. F. Besseling, J. Appl. Mech. 25 (1958) 529–536): several elements on the same nodes,
which share the strain and add their stresses, each with combined hardening of its own. The softer
ones yield early again after a reversal, which is the Bauschinger effect. Parameters, stresses in
MPa:

    E               Young's modulus
    yield, Q, g     the virgin curve, yield + Q (1 - exp(-g p)) at the plastic strain p, which the
                    layers follow with straight lines
    H               linear kinematic hardening of all layers together
    R, b            growth of all yield stresses by 1 + R (1 - exp(-b p)), p of that layer

:func:`integrate` is the same law without finite elements and for small strains, to verify the
deck.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from curvewise.calibration import CommandModel

Array: TypeAlias = npt.NDArray[np.float64]

POISSON = 0.3
REFINEMENT = 8  # points per increment: measures that look at points should not see increments

# Plastic strains at which the layers yield one after the other.
_YIELDING = np.array([0.0, *np.geomspace(6e-4, 0.03, 6)])
_LAYERS = range(len(_YIELDING))
# Accumulated plastic strains of the table of isotropic hardening; ccx extends it as a constant.
_ISOTROPIC = np.array([0.0, *np.geomspace(1e-3, 1.0, 30)])
_TIMEOUT = 300.0  # seconds, of a run that takes less than one: machines are busy


class Layers(NamedTuple):
    """What the layers are made of: one number for each, in MPa; `hardening` at `_ISOTROPIC`."""

    modulus: Array
    yield_stress: Array
    kinematic: float
    hardening: Array


def layers(parameters: Mapping[str, float]) -> Layers:
    """Return the layers that follow the virgin curve of the parameters."""
    p = parameters
    stress = p["yield"] + p["Q"] * (1.0 - np.exp(-p["g"] * _YIELDING))
    strain = _YIELDING + stress / p["E"]
    # Where a layer begins to yield, the slope of the sum falls by that layer's modulus.
    slopes = np.diff(stress, prepend=0.0) / np.diff(strain, prepend=0.0)
    modulus = -np.diff(slopes, append=0.0)
    growth = 1.0 + p["R"] * (1.0 - np.exp(-p["b"] * _ISOTROPIC))
    return Layers(modulus, modulus * strain, p["H"] / len(_LAYERS), growth)


class CubeModel:
    """The tests as a model: parameters in, a curve of true strain and stress for each test out.

    Parameters
    ----------
    paths : sequence of ndarray, shape (increments + 1,)
        The true strains that each cube goes through, from 0.
    folder : path
        Where the template is written and the runs are made; those that failed stay there.
    """

    def __init__(self, paths: Sequence[Array], folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        template = folder / "cubes.inp"
        self.deck = deck(paths, [(f"MATERIAL_{k}", _placeholders(k)) for k in _LAYERS])
        template.write_text(self.deck)
        self._solver = CommandModel(
            template,
            ["ccx", "-i", "cubes"],
            partial(read_curves, increments=[len(path) - 1 for path in paths]),
            parameters=[f"{name}_{k}" for k in _LAYERS for name in ("E", "kinematic", "isotropic")],
            timeout=_TIMEOUT,
            environment={"OMP_NUM_THREADS": "1"},
            scratch=folder,
        )
        self.identity = self._solver.identity  # what a store knows the runs by

    def __call__(self, parameters: Mapping[str, float]) -> list[Array]:
        """Run CalculiX."""
        made_of = layers(parameters)
        values: dict[str, float | str] = {}
        for k, (modulus, stress) in enumerate(
            zip(made_of.modulus, made_of.yield_stress, strict=True)
        ):
            values[f"E_{k}"] = float(modulus)
            kinematic = [(stress, 0.0), (stress + made_of.kinematic, 1.0)]
            values[f"kinematic_{k}"] = _table(kinematic)
            values[f"isotropic_{k}"] = _table(
                zip(stress * made_of.hardening, _ISOTROPIC, strict=True)
            )
        curves = self._solver(values)
        assert isinstance(curves, list)
        return curves


def _table(rows: Iterable[tuple[float, float]]) -> str:
    return "\n".join(f"{stress:.8g},{strain:.8g}" for stress, strain in rows)


def _placeholders(k: int) -> list[str]:
    """Return the material of a layer, with placeholders."""
    return [
        f"*MATERIAL,NAME=MATERIAL_{k}",
        "*ELASTIC",
        f"<<E_{k}:.8g>>,{POISSON}",
        "*PLASTIC,HARDENING=COMBINED",
        f"<<kinematic_{k}>>",
        "*CYCLIC HARDENING",
        f"<<isotropic_{k}>>",
    ]


def deck(paths: Sequence[Array], materials: Sequence[tuple[str, Sequence[str]]]) -> str:
    """Return the input deck: of each test a layer of each material, given by name and lines."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    corners += [(x, y, 1) for x, y, _ in corners]
    lines = ["*NODE"]
    for test, (i, xyz) in itertools.product(range(len(paths)), enumerate(corners, 1)):
        lines.append(f"{8 * test + i},{','.join(map(str, xyz))}")
    for k, (material, made_of) in enumerate(materials):
        lines.append(f"*ELEMENT,TYPE=C3D8,ELSET=LAYER_{k}")
        for test in range(len(paths)):
            nodes = ",".join(str(8 * test + i) for i in range(1, 9))
            lines.append(f"{len(materials) * test + k + 1},{nodes}")
        lines += [*made_of, f"*SOLID SECTION,ELSET=LAYER_{k},MATERIAL={material}"]
    increments = max(map(len, paths)) - 1
    loads, output = [], []
    for test, path in enumerate(paths):
        at = 8 * test
        # A test with fewer increments than the others stays where it ends.
        stretch = np.pad(np.expm1(path), (0, increments + 1 - len(path)), mode="edge")
        lines += [
            f"*NSET,NSET=PULLED_{test}",
            ",".join(str(at + i) for i in (2, 3, 6, 7)),
            f"*NSET,NSET=CORNER_{test}",
            str(at + 7),
            "*BOUNDARY",
            *(f"{at + i},1" for i in (1, 4, 5, 8)),
            *(f"{at + i},2" for i in (1, 2, 5, 6)),
            *(f"{at + i},3" for i in (1, 2, 3, 4)),
            f"*AMPLITUDE,NAME=PATH_{test}",
            *(f"{time},{u:.9g}" for time, u in enumerate(stretch)),
        ]
        loads += [f"*BOUNDARY,AMPLITUDE=PATH_{test}", f"PULLED_{test},1,1,1."]
        output += [f"*NODE PRINT,NSET=PULLED_{test},TOTALS=ONLY", "RF"]
        output += [f"*NODE PRINT,NSET=CORNER_{test}", "U"]
    # One increment for every point of the path, so that the turning points are met.
    lines += [f"*STEP,NLGEOM,INC={increments}", "*STATIC,DIRECT", f"1.,{increments}."]
    return "\n".join([*lines, *loads, *output, "*END STEP", ""])


def read_curves(folder: Path, increments: Sequence[int]) -> list[Array]:
    """Return true strain and stress of every test, from the reactions and displacements printed.

    Raises
    ------
    ValueError
        CalculiX has not printed every increment.
    """
    printed: dict[str, list[list[float]]] = {}
    rows: list[list[float]] = []
    for line in (folder / "cubes.dat").read_text().splitlines():
        words = line.split()
        if "set" in words:
            rows = printed.setdefault(words[words.index("set") + 1], [])
        elif words:
            rows.append([float(word) for word in words])
    curves = []
    for test, count in enumerate(increments):
        force = np.array(printed.get(f"PULLED_{test}", []))[:count]
        corner = np.array(printed.get(f"CORNER_{test}", []))[:count]
        if not len(force) == len(corner) == count:
            raise ValueError(f"test {test} has {len(force)} increments of {count}")
        _, ux, uy, uz = corner.T
        stress = force[:, 0] / ((1.0 + uy) * (1.0 + uz))
        curve = np.vstack([(0.0, 0.0), np.column_stack([np.log1p(ux), stress])])
        curves.append(_refined(curve))
    return curves


def _refined(curve: Array) -> Array:
    """Return the curve with every segment cut into `REFINEMENT` equal parts."""
    old = np.arange(len(curve))
    new = np.linspace(0, len(curve) - 1, REFINEMENT * (len(curve) - 1) + 1)
    return np.column_stack([np.interp(new, old, column) for column in curve.T])


def by_increment(curve: Array) -> Array:
    """Return the points of a curve that are ends of increments."""
    return curve[::REFINEMENT]


def integrate(parameters: Mapping[str, float], path: Array) -> Array:
    """Return the stress along a path of strain: the overlay of layers, for small strains.

    Backward Euler as in ccx, but for uniaxial stress: a layer is described by the difference of
    axial and lateral stress, and the lateral strain is the one at which the lateral stresses of
    all layers add up to 0.
    """
    made_of = layers(parameters)
    shear = made_of.modulus / (2.0 * (1.0 + POISSON))
    bulk = made_of.modulus / (3.0 * (1.0 - 2.0 * POISSON))
    states = [_State(0.0, 0.0, 0.0) for _ in _LAYERS]

    def respond(axial: float, lateral: float) -> tuple[float, float, list[_State]]:
        after, total, sideways = [], 0.0, 0.0
        for k, state in enumerate(states):
            radius = partial(_interpolated, values=made_of.yield_stress[k] * made_of.hardening)
            difference, new = _return_mapping(
                state, axial - lateral, shear[k], made_of.kinematic, radius
            )
            pressure = bulk[k] * (axial + 2.0 * lateral)
            total += pressure + 2.0 / 3.0 * difference
            sideways += pressure - difference / 3.0
            after.append(new)
        return total, sideways, after

    stress = np.zeros(len(path))
    for i, axial in enumerate(path[1:], 1):
        around = -0.5 * axial
        lateral = brentq(
            lambda x, axial=axial: respond(axial, x)[1], around - 0.01, around + 0.01, xtol=1e-14
        )
        stress[i], _, states[:] = respond(axial, lateral)
    return stress


class _State(NamedTuple):
    """Axial plastic strain, back stress and accumulated plastic strain of a layer."""

    plastic: float
    back: float
    accumulated: float


def _interpolated(strain: float, values: Array) -> float:
    return float(np.interp(strain, _ISOTROPIC, values))


def _return_mapping(
    state: _State,
    difference: float,
    shear: float,
    kinematic: float,
    radius: Callable[[float], float],
) -> tuple[float, _State]:
    """Return the difference of axial and lateral stress, and the state, for one of the strains."""
    trial = 2.0 * shear * (difference - 1.5 * state.plastic)
    over = abs(trial - state.back)

    def excess(step: float) -> float:
        return over - (3.0 * shear + kinematic) * step - radius(state.accumulated + step)

    if excess(0.0) <= 0.0:
        return trial, state
    step = brentq(excess, 0.0, over / (3.0 * shear), xtol=1e-15)
    signed = math.copysign(step, trial - state.back)
    return trial - 3.0 * shear * signed, _State(
        state.plastic + signed, state.back + kinematic * signed, state.accumulated + step
    )
