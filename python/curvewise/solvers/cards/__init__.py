"""Material cards: a material's numbers as the lines that a solver reads.

`FORMATS` has one record for each solver, with its names of the models and its limitations. Cards of
Abaqus and CalculiX can be read back; their files have the same keywords.
"""

from __future__ import annotations

import os
import re

from ..._names import did_you_mean
from . import abaqus, ansys, calculix, code_aster, ls_dyna, mfront
from .content import CardContent, SolverCard, TabulatedLayer
from .flow_tables import TABLES, flow_table
from .keyword_file import blocks_of, materials_of

__all__ = [
    "FORMATS",
    "TABLES",
    "CardContent",
    "SolverCard",
    "TabulatedLayer",
    "card_text",
    "flow_table",
    "read_card",
]

FORMATS = {
    form.solver: form
    for form in (
        abaqus.FORMAT,
        ansys.FORMAT,
        ls_dyna.FORMAT,
        calculix.FORMAT,
        mfront.FORMAT,
        code_aster.FORMAT,
    )
}
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,69}")


def card_text(content: CardContent, solver: str) -> str:
    """Return the card of a material for a solver; the errors are `Material.card`'s."""
    if solver not in FORMATS:
        raise ValueError(
            f"solver is {solver!r}; give one of {', '.join(map(repr, FORMATS))}"
            f"{did_you_mean([solver], FORMATS)}"
        )
    if not _NAME.fullmatch(content.name):
        raise ValueError(
            f"name is {content.name!r}; all solvers take a letter, and then up to 69 letters, "
            "digits and underscores"
        )
    form = FORMATS[solver]
    if lack := form.lack(content):
        raise ValueError(f"{form.title} has no {lack}; {_remedy(content)}")
    return form.text(content)


def _remedy(content: CardContent) -> str:
    """Return which solvers have a material, or what to do if none has it."""
    having = [form for form in FORMATS.values() if content.material in form.laws]
    whole = [form for form in having if not form.lack(content)]
    if whole:
        listed = (f"{form.title} ({form.laws[content.material].keywords})" for form in whole)
        return f"fit another material, or write the card of {' or '.join(listed)}"
    if having:
        return "fit with the default of this option"
    return "fit another material, or write a user material"


def read_card(path: str | os.PathLike[str], *, name: str | None = None) -> SolverCard:
    """Read a material card of Abaqus or CalculiX.

    Parameters
    ----------
    path : path-like
        A card that :meth:`curvewise.materials.Material.card` has written; for Abaqus also any input
        file with combined hardening by parameters.
    name : str, optional
        The name of the material, required if a file of Abaqus has several.

    Returns
    -------
    SolverCard
        The card; its parameters are the doubles that were written.

    Raises
    ------
    ValueError
        If the material does not exist, or lacks these keywords. If the numbers of a card of
        CalculiX differ from those in its comments.
    OSError
        If the file cannot be read.

    Notes
    -----
    Linear in the size of the file. Abaqus' numbers are those of its data lines. CalculiX's tables
    do not determine the parameters; they are read from the comments and checked by the sum of the
    moduli.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from curvewise.materials import ChabocheVoce
    >>> from curvewise.solvers import read_card
    >>> steel = ChabocheVoce(backstresses=1)
    >>> constants = dict(zip(steel.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0)))
    >>> file = pathlib.Path(tempfile.mkdtemp(), "steel.inp")
    >>> _ = file.write_text(steel.card(constants, "abaqus"))
    >>> read_card(file).parameters == constants
    True
    """
    blocks, comments = blocks_of(path)
    materials = materials_of(blocks)
    combined = {
        material: found
        for material, found in materials.items()
        if any(block.options.get("HARDENING", "").upper() == "COMBINED" for block in found)
    }
    by_parameters = {
        material: found
        for material, found in combined.items()
        if any(block.options.get("DATATYPE", "").upper() == "PARAMETERS" for block in found)
    }
    try:
        if combined and not by_parameters:
            return calculix.card_of(combined, comments)
        if name is None and len(by_parameters) == 1:
            name = next(iter(by_parameters))
        if name not in by_parameters:
            known = ", ".join(by_parameters) or "none"
            raise ValueError(
                f"materials with combined hardening by parameters: {known}; "
                f"{'give one as name' if name is None else f'none is called {name!r}'}"
            )
        return abaqus.card_of(name, by_parameters[name])
    except ValueError as error:
        raise ValueError(f"{os.fspath(path)}: {error}") from None
