"""Checks of given parameters: names, and units by the modulus. O(n)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .._bounds import Below, Bounds, Log, Tied
from .._names import did_you_mean
from .._option_names import called, command_of
from ..calibration.problem.tables import digits
from ..curves.named_curve import name_of_test
from ..files.column_units import STRESSES, in_mpa
from ..materials.readings import reading_of

__all__ = ["check_units", "checked_names", "modulus_of"]

# A factor above all errors of a modulus in the right unit; kN/mm2 and psi are 1000 and 145 MPa's.
_OTHER_UNIT = 30.0
# Units in which people give moduli; a factor between two of them, and how near it must be.
_UNITS = ("GPa", "ksi", "psi", "MPa", "kPa", "Pa")
_OTHER_MODULUS, _SAME = 3.0, 1.35
# Limits of plausible yield stresses, as fractions of the largest stress.
_MOST_YIELD, _LEAST_YIELD = 1.2, 300.0


def checked_names(
    names: Sequence[str], fixed: Mapping[str, float] | None, bounds: Bounds | None
) -> tuple[dict[str, float], dict[str, Any]]:
    """Return fixed and bounded parameters; raise ValueError for an unknown name."""
    known, own = dict(fixed or {}), dict(bounds or {})
    for option, given in ((_fixed(), known), (called("bounds"), own)):
        if unknown := [name for name in given if name not in names]:
            raise ValueError(
                f"{option} has no parameter of the material: {unknown[0]!r}"
                f"{did_you_mean(unknown, names)} ({', '.join(names)})"
            )
    if twice := [name for name in own if name in known]:
        raise ValueError(
            f"{twice[0]!r} is in {_fixed()} and in {called('bounds')}; give one of them"
        )
    return known, own


def _fixed() -> str:
    return command_of("fix") or "fixed"


def check_units(bounds: Bounds, tests: Sequence[Any], units: str, yield_stress: str) -> None:
    """Refuse a modulus or a yield stress in another unit than the stresses of the tests.

    Parameters
    ----------
    bounds : mapping
        Numbers and bounds of parameters, as for `identify`.
    tests : sequence of array_like, shape (n, 2)
        Strain and stress.
    units : str
        The unit of the stresses.
    yield_stress : str
        Name of the yield stress among the parameters; "" without one.

    Raises
    ------
    ValueError
        If a modulus is far from that of the tests, or equals it in another unit. If a yield stress
        is above the largest stress, or far below it.
    """
    read = modulus_of(tests)
    for name in ("E", "Ea"):
        low, high = _ends(bounds.get(name))
        near = min(max(read, low), high)
        if not low > 0.0:
            continue
        factor = max(read / near, near / read)
        other = _unit_that_explains(low, high, read, units) if factor > _OTHER_MODULUS else ""
        if not other and factor <= _OTHER_UNIT:
            continue
        raise ValueError(
            f"{name} is {near:.6g} {units}, and the tests show a modulus of {digits(read, 4)}: a "
            f"factor of {factor:.4g}; give it in the unit of their stresses "
            f"({f'{other} for {units}' if other else 'other units'}?)"
        )
    largest = max(reading_of(test, name_of_test(test, i)).stress for i, test in enumerate(tests))
    low, high = _ends(bounds.get(yield_stress))
    if low > _MOST_YIELD * largest or 0.0 < high < largest / _LEAST_YIELD:
        value = low if low > largest else high
        raise ValueError(
            f"{yield_stress} is {value:.6g} {units}, and the largest stress of the tests is "
            f"{digits(largest, 4)}; give it in the unit of their stresses"
        )


def _ends(given: Any) -> tuple[float, float]:
    """Return the ends of bounds, or a number twice; 0 and 0 without bounds."""
    if given is None or isinstance(given, Tied):
        return 0.0, 0.0
    if isinstance(given, (Log, Below)):
        return given.low, given.high
    low, high = np.ravel(given)[[0, -1]].tolist()
    return low, high


def _unit_that_explains(low: float, high: float, read: float, units: str) -> str:
    """Return the unit in which bounds of a modulus would hold the one that was read, or ""."""
    if (target := in_mpa(units)) is None:
        return ""
    for unit in _UNITS:
        factor = STRESSES[unit.casefold()] / target
        if low * factor / _SAME < read < high * factor * _SAME:
            return unit
    return ""


def modulus_of(tests: Sequence[Any]) -> float:
    """Return the slope with which tests unload, or that of first loading: the middle one."""
    moduli = [reading_of(test, name_of_test(test, i)).moduli for i, test in enumerate(tests)]
    unloading = [slope for one in moduli for slope in one[1:]]
    return float(np.median(unloading or [one[0] for one in moduli]))
