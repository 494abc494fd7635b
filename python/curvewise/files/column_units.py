"""Units of columns, from their names or from a row of units.

A unit is in brackets behind a name ("Strain (%)"), behind a slash or a comma, as the last word
("stress_MPa"), or in a separate row. Capitals and the encoding of µ and ² do not matter.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any
from unicodedata import normalize

__all__ = [
    "FORCES",
    "LENGTHS",
    "STRAINS",
    "STRESSES",
    "TIMES",
    "VOLTAGES",
    "bare_name",
    "factor_of",
    "in_mpa",
    "titled",
    "unit_of",
    "units_row",
]

# Factors of strains in each unit.
STRAINS = {
    **dict.fromkeys(("-", "1", "mm/mm", "m/m", "in/in", "μm/μm"), 1.0),
    **dict.fromkeys(("%", "percent", "per cent", "prozent", "pct"), 1e-2),
    **dict.fromkeys(("‰", "permille", "mm/m", "millistrain", "mε"), 1e-3),
    **dict.fromkeys(("μm/m", "um/m", "με", "μe", "ue", "microstrain", "μstrain", "ustrain"), 1e-6),
}
# Stresses, forces, lengths and times in MPa, N, mm and s.
STRESSES = {
    **dict.fromkeys(("mpa", "n/mm2", "n/mm^2", "n/mm**2", "mn/m2", "mn/m^2"), 1.0),
    **dict.fromkeys(("gpa", "kn/mm2", "kn/mm^2"), 1e3),
    **dict.fromkeys(("pa", "n/m2", "n/m^2"), 1e-6),
    **{"kpa": 1e-3, "bar": 0.1, "psi": 0.006894757, "ksi": 6.894757, "kgf/mm2": 9.80665},
}
FORCES = {"n": 1.0, "kn": 1e3, "lbf": 4.448222, "kip": 4448.222, "kgf": 9.80665, "dan": 10.0}
LENGTHS = {
    **{"mm": 1.0, "cm": 10.0, "m": 1e3},
    **dict.fromkeys(("μm", "um"), 1e-3),
    **dict.fromkeys(("in", "inch"), 25.4),
}
TIMES = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0}
VOLTAGES = ("v", "mv")
_OTHERS = ("hz", "°c", "k", "cycles")
_KNOWN = {*STRAINS, *STRESSES, *FORCES, *LENGTHS, *TIMES, *VOLTAGES, *_OTHERS}
# Words that are units only in brackets or in a row of units.
_WORDS = {"-", "1", "bar", "in", "min", "sec", "cycles", "inch"}
_TEMPERATURES = {"c", "f", "°f", "deg c"}
_IN_BRACKETS = re.compile(r"[(\[{<]\s*([^()\[\]{}<>]*?)\s*[)\]}>]\s*$")
_LAST_WORD = re.compile(r"(?:[\s_,;:/]|\bin )\s*([^\s_,;:]+)$")


def unit_of(name: str) -> str:
    """Return the unit at the end of a column's name; "" if it is missing.

    Examples
    --------
    >>> from curvewise.files.column_units import unit_of
    >>> [unit_of(name) for name in ("Strain (%)", "stress_MPa", "Force / kN", "strain, true")]
    ['%', 'mpa', 'kn', '']
    """
    if "×" in name:  # it was multiplied
        return ""
    text = normalize("NFKC", name).casefold().strip()
    if (found := _IN_BRACKETS.search(text)) and found[1] in _KNOWN:
        return found[1]
    if "%" in text:
        return "%"
    for word in (text, *(match[1] for match in re.finditer(_LAST_WORD, text))):
        if word in _KNOWN and word not in _WORDS and len(word) > 1:
            return word
    return next((word for word in STRAINS if len(word) > 4 and word in text), "")


def in_mpa(units: str) -> float | None:
    """Return how many MPa a unit of stress is, or None if it is not known."""
    return STRESSES.get(normalize("NFKC", units).casefold().strip())


def factor_of(given: float | str, units: str = "MPa") -> float:
    """Return a factor, given as a number or as the unit that it converts.

    Parameters
    ----------
    given : float or str
        A number, or the unit of a column. Strain is converted to a fraction, stress to `units`,
        force to N, and length to mm.
    units : str
        The unit of stresses.

    Raises
    ------
    ValueError
        If it is neither a number nor a known unit.

    Examples
    --------
    >>> from curvewise.files.column_units import factor_of
    >>> [factor_of(one) for one in ("0.01", "%", "GPa", "kN")]
    [0.01, 0.01, 1000.0, 1000.0]
    """
    try:
        return float(given)
    except ValueError:
        pass
    word = normalize("NFKC", str(given)).casefold().strip()
    if word in STRESSES:
        if (target := in_mpa(units)) is None:
            raise ValueError(
                f"the factor is {given!r}, which cannot be converted to {units!r}; give a number"
            )
        return STRESSES[word] / target
    for known in (STRAINS, FORCES, LENGTHS):
        if word in known:
            return known[word]
    raise ValueError(
        f"the factor is {given!r}; give a number, or a unit such as %, µm/m, kN, mm, psi or GPa"
    )


def bare_name(name: str) -> str:
    """Return the name of a column without capitals, blanks, hyphens, underscores and its unit.

    Examples
    --------
    >>> from curvewise.files.column_units import bare_name
    >>> [bare_name(name) for name in ("Strain 1 (%)", "stress_MPa", "Force / kN", "True Strain")]
    ['strain1', 'stress', 'force', 'truestrain']
    """
    text = normalize("NFKC", name).casefold().strip()
    if (found := _IN_BRACKETS.search(text)) and (found[1] in _KNOWN or found[1] in _TEMPERATURES):
        text = text[: found.start()]
    else:
        for found in re.finditer(_LAST_WORD, text):
            if found[1] in _KNOWN and found[1] not in _WORDS and len(found[1]) > 1:
                text = text[: found.start()]
                break
    return re.sub(r"[\s_/,;:-]+", "", text) or re.sub(r"\s+", "", name.casefold())


def units_row(rows: Sequence[Sequence[Any]], names: Sequence[str]) -> list[str]:
    """Return the row of a header that has the units of its columns, brackets removed; or nothing.

    Parameters
    ----------
    rows : sequence of sequences
        The header.
    names : sequence of str
        The row of it that has the names.
    """
    for row in rows:
        texts = [str(cell).strip() for cell in row]
        bare = [
            text[1:-1].strip() if re.match(r"[(\[{<].*[)\]}>]$", text) else text for text in texts
        ]
        filled = [normalize("NFKC", text).casefold() for text in bare if text]
        known = [text for text in filled if text in _KNOWN]
        if texts != list(names) and 2 * len(known) > len(filled):
            return bare
    return []


def titled(name: str, unit: str) -> str:
    """Return a name with the unit of its column, if it has not any in itself."""
    return f"{name} [{unit}]" if unit and not unit_of(name) else name
