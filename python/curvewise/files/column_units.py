"""The units that the header of a file gives its columns: in their names, or in a row of units.

A unit stands in brackets behind a name ("Strain (%)"), behind a slash or a comma, as its last word
("stress_MPa"), or in a row of its own. Capitals do not count, nor how µ and ² are encoded.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any
from unicodedata import normalize

__all__ = ["FORCES", "LENGTHS", "STRAINS", "STRESSES", "titled", "unit_of", "units_row"]

# What strains of each unit are multiplied by.
STRAINS = {
    **dict.fromkeys(("-", "1", "mm/mm", "m/m", "in/in", "μm/μm"), 1.0),
    **dict.fromkeys(("%", "percent", "per cent", "prozent", "pct"), 1e-2),
    **dict.fromkeys(("‰", "permille", "mm/m", "millistrain", "mε"), 1e-3),
    **dict.fromkeys(("μm/m", "um/m", "με", "μe", "ue", "microstrain", "μstrain", "ustrain"), 1e-6),
}
# Stresses and forces in MPa and N.
STRESSES = {
    **dict.fromkeys(("mpa", "n/mm2", "n/mm^2", "n/mm**2", "mn/m2", "mn/m^2"), 1.0),
    **dict.fromkeys(("gpa", "kn/mm2", "kn/mm^2"), 1e3),
    **dict.fromkeys(("pa", "n/m2", "n/m^2"), 1e-6),
    **{"kpa": 1e-3, "bar": 0.1, "psi": 0.006894757, "ksi": 6.894757, "kgf/mm2": 9.80665},
}
FORCES = {"n": 1.0, "kn": 1e3, "lbf": 4.448222, "kip": 4448.222, "kgf": 9.80665, "dan": 10.0}
LENGTHS = ("mm", "μm", "um", "cm", "m", "in", "inch")
_OTHERS = ("s", "sec", "ms", "min", "h", "hz", "v", "mv", "°c", "k", "cycles")
_KNOWN = {*STRAINS, *STRESSES, *FORCES, *LENGTHS, *_OTHERS}
# Words that are units only in brackets or in a row of units.
_WORDS = {"-", "1", "bar", "in", "min", "sec", "cycles", "inch"}
_IN_BRACKETS = re.compile(r"[(\[{<]\s*([^()\[\]{}<>]*?)\s*[)\]}>]\s*$")
_LAST_WORD = re.compile(r"(?:[\s_,;:/]|\bin )\s*([^\s_,;:]+)$")


def unit_of(name: str) -> str:
    """Return the unit that the name of a column ends with, as it is known here; "" if it has none.

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
