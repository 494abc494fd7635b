"""Whether the strains and stresses of a test are in the units of a fit, as far as it tells.

A name or a row of units may show another unit, or a modulus that is unusual for materials. Nothing
is converted: the user is asked, and answers with factors. Cost: linear in the test.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from .._option_names import called
from ..curves.column_roles import is_time
from ..curves.foreign_curves import warn
from ..curves.named_curve import known_names, name_of_test
from ..files.column_units import (
    FORCES,
    LENGTHS,
    STRAINS,
    STRESSES,
    TIMES,
    VOLTAGES,
    in_mpa,
    unit_of,
)
from ..materials.readings import reading_of, strain_and_stress

__all__ = ["Doubt", "UnitsWarning", "doubt_of", "warn_of_units"]

Asking: TypeAlias = Literal["command", "study", "python"]

_PLAUSIBLE = (1e3, 1e6)  # MPa: moduli that are not asked about
_FRACTION = 0.5  # the largest plausible strain
_USUAL = (3e4, 4.5e5)  # MPa: range of moduli of usual materials
_EXPLAINING = {1.0: "", 1e-2: "per cent", 1e-3: "mm/m", 1e-6: "µm/m"}
_STRESS_UNITS = {
    "": "",
    "pa": "Pa",
    "kpa": "kPa",
    "mpa": "MPa",
    "gpa": "GPa or kN/mm²",
    "psi": "psi",
    "ksi": "ksi",
}


# The options that resolve each doubt, on the command line, in a study and in Python.
_OPTIONS = {
    "factors": "give {flag} {}{}",
    "gauge_length": "give {flag}, in mm",
    "area": "give {flag}, in mm²",
}
_KEYS = {
    "factors": "give factors = [{}]{}",
    "gauge_length": "give gauge_length, in mm",
    "area": "give area, in mm²",
}
_KEYWORDS = {
    "factors": "multiply its columns (read_curve: factors=[{}]{})",
    "gauge_length": "give the gauge length in mm (prepare: gauge_length=)",
    "area": "give the area in mm² (prepare: area=)",
}


class UnitsWarning(UserWarning):
    """A test seems to have other units than a fit takes."""


class Doubt(NamedTuple):
    """A question about the units of a test.

    Attributes
    ----------
    found : str
        The observation.
    factors : tuple of str
        The factors of strain and stress in that case: numbers, or letters.
    where : str
        The definition of the letters, or "".
    is_other : bool
        Whether a column is neither strain nor stress, in any unit.
    sizes : tuple of str
        The required data of the specimen: its area, its gauge length.
    """

    found: str
    factors: tuple[str, str]
    where: str
    is_other: bool = False
    sizes: tuple[str, ...] = ()

    def asked(self, by: Asking) -> str:
        """Return what seems to be, and what to write if so and if not.

        Parameters
        ----------
        by : {"command", "study", "python"}
            Who asks: the words are those of options, of keys or of keywords.
        """
        right = "they are strain and stress" if self.is_other else "its units are right"
        if by == "command":
            other = f"name others: {called('columns')} STRAIN STRESS"
            way = other if self.is_other else self._way(_OPTIONS)
            return f"{self.found}; {way}, or {called('factors')} 1 1 if {right}"
        if by == "study":
            other = 'name others: columns = ["STRAIN", "STRESS"]'
            way = other if self.is_other else self._way(_KEYS)
            return f"{self.found}; {way}, or factors = [1, 1] if {right}"
        if self.is_other:
            return f"{self.found}; if so, read others (read_curve: columns=[...])"
        return f"{self.found}; if so, {self._way(_KEYWORDS)}"

    def _way(self, words: dict[str, str]) -> str:
        """Return what to give, in the words of options, keys or keywords."""
        ways = []
        if set(self.factors) != {"1"}:
            listed = (" " if words is _OPTIONS else ", ").join(self.factors)
            ways.append(words["factors"].format(listed, self.where, flag=called("factors")))
        ways += [words[size].format(flag=called(size)) for size in self.sizes]
        return " and ".join(ways)


def doubt_of(test: Any, units: str) -> Doubt | None:
    """Return the question about a test, by its names or its modulus.

    Parameters
    ----------
    test : array_like
        Strain and stress; a curve that was read from a file has the names of its columns.
    units : str
        The unit of the stresses of the fit.
    """
    names = known_names(test)
    known = _by_names(names, units) if len(names) == 2 else None
    return known or _by_modulus(test, units)


def warn_of_units(tests: Sequence[Any], units: str) -> None:
    """Warn of each test whose units are doubtful."""
    for i, test in enumerate(tests):
        if doubt := doubt_of(test, units):
            said = f"{name_of_test(test, i)}: {doubt.asked('python')}"
            warn(UnitsWarning(f"{said}; if not, ignore this UnitsWarning"))


def _by_names(names: Sequence[str], units: str) -> Doubt | None:
    """Return what the names of two columns, or a row of units, say of them."""
    found, factors, where, sizes = [], ["1", "1"], [], []
    strain, stress = map(unit_of, names)
    is_volts = stress in VOLTAGES or "volt" in names[1].casefold()
    if is_time(names[0]) or strain in TIMES:
        found.append(_seems("strain", names[0], "a time"))
        if is_volts:
            found.append(_seems("stress", names[1], "a voltage"))
        return Doubt(", and ".join(found), ("1", "1"), "", is_other=True)
    if STRAINS.get(strain, 1.0) != 1.0:
        factors[0] = f"{STRAINS[strain]:g}"
        found.append(_seems("strain", names[0], f"in {_EXPLAINING[STRAINS[strain]]}"))
    elif strain in LENGTHS:
        sizes.append("gauge_length")
        found.append(_seems("strain", names[0], "a length"))
    target = in_mpa(units)
    if target is not None and STRESSES.get(stress, target) != target:
        factors[1] = f"{STRESSES[stress] / target:.7g}"
        found.append(_seems("stress", names[1], f"in other units than {units}"))
    elif target is not None and stress in FORCES:
        sizes.append("area")
        found.append(_seems("stress", names[1], "a force"))
    elif is_volts:
        factors[1] = "F2"
        where.append(f"F2 = {units} per volt")
        found.append(_seems("stress", names[1], "a voltage"))
    if not found:
        return None
    letters = f" with {' and '.join(where)}" if where else ""
    return Doubt(", and ".join(found), (factors[0], factors[1]), letters, sizes=tuple(sizes))


def _seems(what: str, name: str, unit: str) -> str:
    return f"the {what} is in column {name!r}, which seems to be {unit}"


def _by_modulus(test: Any, units: str) -> Doubt | None:
    """Return a question if the slope of a test does not suit a usual material."""
    target = in_mpa(units)
    if target is None:
        return None
    try:
        points = strain_and_stress(test, "test")
        # Strains that are not fractions are refused when they are read.
        scale = 1e-6 if np.abs(points[:, 0]).max() > _FRACTION else 1.0
        moduli = reading_of(points * (scale, 1.0), "test").moduli
    except ValueError:  # not a test that a fit takes, which says so
        return None
    modulus = scale * float(np.median(moduli))
    if _PLAUSIBLE[0] <= modulus * target <= _PLAUSIBLE[1]:
        return None
    found = f"its modulus is {modulus:.4g} {units}, outside 1 to 1,000 GPa"
    explained = sorted(
        (_Explanation(strain, stress) for strain in _EXPLAINING for stress in _STRESS_UNITS),
        key=_Explanation.changes,
    )
    explained = [
        one
        for one in explained
        if _USUAL[0] <= modulus * STRESSES.get(one.stress, target) / one.strain <= _USUAL[1]
    ]
    if not explained:
        return Doubt(found, ("F1", "F2"), " with the factors of its units, 1 / area of a force")
    first = explained[0]
    alike = [str(one) for one in explained if one.changes() == first.changes()]
    factors = f"{first.strain:g}", f"{STRESSES.get(first.stress, target) / target:.7g}"
    return Doubt(f"{found}, as it would be with {' or '.join(alike)}", factors, "")


class _Explanation(NamedTuple):
    """Units of strain, by their factor, and of stress, that would explain a modulus."""

    strain: float
    stress: str

    def changes(self) -> int:
        return (self.strain != 1.0) + bool(self.stress)

    def __str__(self) -> str:
        said = [f"strains in {_EXPLAINING[self.strain]}"] if self.strain != 1.0 else []
        said += [f"stresses in {_STRESS_UNITS[self.stress]}"] if self.stress else []
        return " and ".join(said)
