"""Which parameters of a fitted material are not to be used, and what would determine them.

Intervals follow from the points that were compared, and do not know what these points cannot show:
a test that never reverses does not tell one hardening from the other, and a stabilised cycle does
not tell the yield stress from its growth. Where intervals leave parameters open and the model is
far from the tests, a closer model comes first. Else the tests have shown too little: a test that
hardly yields wants a larger amplitude, tests of one amplitude want another one, short tests more
cycles. Cost: linear in the tests.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..calibration import Identification, Uncertainty
from ..calibration.problem.tables import digits
from ..calibration.records.search_record import Doubt
from ..calibration.report.misfit import SYSTEMATIC, scatter_share
from ..curves.inputs import Array
from ..curves.turns import turning_points
from ..materials import Material
from .driven_tests import Cycles
from .wider_bounds import Beyond

__all__ = ["doubts_of"]

# Beyond it a fitted modulus is no longer the slope with which a test unloads.
_SAME_MODULUS = 0.1
_FAR = 0.01  # root mean square deviation, of the range of stress
_LITTLE, _ENOUGH = 0.002, 0.01  # plastic strain amplitudes that tell little, and that tell much
_SAME_SIZE = 0.8  # of the largest amplitude
_CYCLES = 20
_ELASTIC = ("E", "Ea", "xi")  # with the yield stress, parameters that tension alone shows


def doubts_of(
    tests: Sequence[Array],
    found: Identification,
    uncertainty: Uncertainty | None,
    *,
    material: Material,
    modulus_read: float,
    cycles: Cycles,
    beyond: Beyond | None,
    beginning: str = "",
) -> list[Doubt]:
    """Return which parameters are not to be used, with a reason each, after doubts of the tests.

    Parameters
    ----------
    tests, found, uncertainty, material, modulus_read, cycles, beyond, beginning
        As those of a :class:`MaterialFit`.
    """
    open_names = []
    if uncertainty is not None:
        open_names = [
            name
            for name, is_good in uncertainty.determined.items()
            if not is_good and name not in uncertainty.at_bounds
        ]
    doubts = [
        *_of_tension(tests, found, material, open_names),
        *_of_one_cycle(found, material, cycles),
        *_of_modulus(found, modulus_read),
        *_of_bounds(beyond),
    ]
    doubted: set[str] = set()
    kept = [Doubt((), f"{beginning}.")] if beginning else []
    for names, sentence in doubts:
        if own := tuple(name for name in names if name not in doubted):
            kept.append(Doubt(own, sentence))
            doubted |= set(own)
    left = tuple(name for name in open_names if name not in doubted)
    if left:
        kept.append(Doubt(left, f"{_remedy(tests, found)}."))
    return kept


def _remedy(tests: Sequence[Array], found: Identification) -> str:
    """Return what would determine parameters that intervals leave open."""
    pairs = zip(tests, found.simulations, strict=True)
    if any(_is_model_error(test, made) for test, made in pairs):
        return (
            "not determined, since the model cannot follow the tests closely enough. Use a model "
            "that follows them more closely"
        )
    sizes = [float(np.abs(test[:, 0]).max()) for test in tests]
    yielding = max(_plastic_strain(test, found.parameters["E"]) for test in tests)
    if yielding < _LITTLE:
        wanted = f"a larger amplitude, ± {_per_cent(max(sizes) + _ENOUGH)} or more"
    elif min(sizes) > _SAME_SIZE * max(sizes):
        wanted = f"a second amplitude, ± {_per_cent(max(sizes) / 2)}"
    elif max(turning_points(test).size for test in tests) < 2 * _CYCLES:
        wanted = f"more cycles, {_CYCLES} of ± {_per_cent(max(sizes))}"
    else:
        return "not determined by the tests. No further test is known that would tell"
    return f"not determined by the tests. Add a test of {wanted}"


def _is_model_error(test: Array, simulation: Array) -> bool:
    """Return whether a model is far from a test, and not because the test scatters."""
    residual = test[:, 1] - simulation[:, 1]
    rms = float(np.sqrt(np.mean(residual**2)))
    return rms > _FAR * float(np.ptp(test[:, 1])) and scatter_share(residual) <= SYSTEMATIC


def _plastic_strain(test: Array, modulus: float) -> float:
    return float(np.ptp(test[:, 0] - test[:, 1] / modulus) / 2.0)


def _per_cent(strain: float) -> str:
    return f"{100.0 * strain:.2g} %"


def _of_tension(
    tests: Sequence[Array], found: Identification, material: Material, open_names: Sequence[str]
) -> list[Doubt]:
    """Doubt both kinds of hardening where no test reverses, unless one of them is known."""
    if not material.has_kinematic_hardening or any(turning_points(test).size for test in tests):
        return []
    shown = (*_ELASTIC, material.yield_stress)
    hardening = tuple(name for name in found.bounds if name not in shown)
    growth = [name for name in hardening if name in material.isotropic]
    is_split = bool(material.isotropic)
    if not hardening or (is_split and (not growth or len(growth) == len(hardening))):
        return []
    return [
        Doubt(
            tuple(name for name in found.bounds if name in hardening or name in open_names),
            "the test never reverses, so that it does not tell hardening that grows the yield "
            "surface from hardening that moves it. Together they hold for loading in one direction "
            "alone. Add a test with reversed loading.",
        )
    ]


def _of_one_cycle(found: Identification, material: Material, cycles: Cycles) -> list[Doubt]:
    """Doubt the yield stress and its growth where a stabilised cycle alone has to tell them."""
    size, none = material.yield_stress, material.isotropic
    growth = next(iter(none), "")
    if cycles != "last" or growth not in found.bounds or size not in found.bounds:
        return []
    fixed = " and ".join(f"{name} = {value:g}" for name, value in none.items())
    command = " ".join(f"{name}={value:g}" for name, value in none.items())
    return [
        Doubt(
            tuple(name for name in (size, *none) if name in found.bounds),
            f"the last cycle shows the sum of {size} and {growth} alone. Compare all cycles of a "
            f"test that starts from the virgin state. Or fix {fixed} (--fix {command}): {size} is "
            "then the size of the stabilised cycle.",
        )
    ]


def _of_modulus(found: Identification, modulus_read: float) -> list[Doubt]:
    """Doubt a modulus that is not the one with which the tests unload."""
    parameters = found.parameters
    moduli = [parameters[name] for name in ("E", "Ea") if name in parameters]
    low, high = min(moduli) * (1.0 - _SAME_MODULUS), max(moduli) * (1.0 + _SAME_MODULUS)
    if "E" not in found.bounds or low <= modulus_read <= high:
        return []
    share = 100.0 * (parameters["E"] / modulus_read - 1.0)
    return [
        Doubt(
            ("E",),
            f"it is {abs(share):.0f} % {'above' if share > 0 else 'below'} "
            f"{digits(modulus_read, 4)}, the unloading slope of the tests. E compensates for an "
            "effect that the model does not have. If you know E, fix it (--fix E=206e3).",
        )
    ]


def _of_bounds(beyond: Beyond | None) -> list[Doubt]:
    """Doubt parameters that run beyond any bounds."""
    if beyond is None or (beyond.matters and not beyond.still):
        return []
    names = tuple(beyond.still or beyond.sides)
    return [
        Doubt(
            names,
            "the fit is the same to 1 % wherever it is beyond the bounds that were read off the "
            "tests. They do not determine it."
            if not beyond.still
            else "it runs to the end of bounds 10,000 times as wide as the tests suggest. Give "
            "bounds of your own (--bounds NAME=LOW:HIGH).",
        )
    ]
