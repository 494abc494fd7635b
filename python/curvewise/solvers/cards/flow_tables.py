"""Tables of true stress over plastic strain, for solvers that take them: isotropic hardening.

Abaqus Keywords Guide, PLASTIC; G. Dhondt, CalculiX CrunchiX User's Manual 2.20, PLASTIC; LS-DYNA
Keyword User's Manual, Volume II, MAT_PIECEWISE_LINEAR_PLASTICITY (MAT_024); Ansys Mechanical APDL
Material Reference, TB,PLASTIC with MISO.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import NamedTuple

from ..._names import did_you_mean
from .content import as_field

__all__ = ["TABLES", "flow_table"]

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,69}")
_WIDTH = 20
_MOST_ROWS = 200  # of CalculiX 2.20


class _Flow(NamedTuple):
    """A material: its name, elastic constants, and rows of plastic strain and stress."""

    name: str
    modulus: float
    poisson: float
    rows: list[tuple[float, float]]


def flow_table(
    solver: str,
    name: str,
    modulus: float,
    poisson: float,
    plastic: Sequence[float],
    stress: Sequence[float],
    comments: Sequence[str],
) -> str:
    """Return a solver's material with a table of stress over plastic strain.

    Parameters
    ----------
    solver : {"abaqus", "calculix", "ls-dyna", "ansys"}
    name : str
    modulus, poisson : float
    plastic, stress : sequence of float
        Ascending, from a plastic strain of 0 on.
    comments : sequence of str
        Lines for the top.

    Raises
    ------
    ValueError
        If the solver is unknown, or the name or Poisson's ratio makes no sense.
    """
    if solver not in TABLES:
        raise ValueError(
            f"solver is {solver!r}; give one of {', '.join(map(repr, TABLES))}"
            f"{did_you_mean([solver], TABLES)}"
        )
    if not _NAME.fullmatch(name):
        raise ValueError(
            f"name is {name!r}; give a letter, then up to 69 letters, digits and underscores"
        )
    if not -1.0 < poisson < 0.5:
        raise ValueError(f"poisson is {poisson}; give a ratio between -1 and 0.5")
    mark, write = TABLES[solver]
    rows = [(p, s) for p, s in zip(plastic, stress, strict=True) if math.isfinite(p + s)]
    head = [f"{mark} {line}" for line in comments]
    return "\n".join([*head, *write(_Flow(name, modulus, poisson, rows)), ""])


def _keywords(flow: _Flow) -> list[str]:
    return [
        f"*MATERIAL,NAME={flow.name}",
        "*ELASTIC",
        f"{as_field(flow.modulus, _WIDTH)},{as_field(flow.poisson, _WIDTH)}",
        "*PLASTIC",
        *(f"{as_field(s, _WIDTH)},{as_field(p, _WIDTH)}" for p, s in flow.rows),
    ]


def _ls_dyna(flow: _Flow) -> list[str]:
    def line(*fields: str | float) -> str:
        texts = [one if isinstance(one, str) else as_field(one, _WIDTH) for one in fields]
        return "".join(text.rjust(_WIDTH) for text in texts)

    return [
        "$ the density: *PARAMETER with R density, or write it in the place of &density",
        "*MAT_PIECEWISE_LINEAR_PLASTICITY_TITLE+",
        flow.name,
        line("1", "&density", flow.modulus, flow.poisson, flow.rows[0][1], 0.0, 0.0, 0.0),
        line(0.0, 0.0, "1", "0", 0.0),
        line(*[0.0] * 8),
        line(*[0.0] * 8),
        "*DEFINE_CURVE_TITLE",
        f"{flow.name}: true stress over plastic strain",
        f"{1:>10}{0:>10}{1.0:>10}{1.0:>10}{0.0:>10}{0.0:>10}{0:>10}",
        *(line(p, s) for p, s in flow.rows),
    ]


def _ansys(flow: _Flow) -> list[str]:
    return [
        "card_mat = 1  ! the material's number",
        f"MP,EX,card_mat,{flow.modulus!r}",
        f"MP,PRXY,card_mat,{flow.poisson!r}",
        f"TB,PLASTIC,card_mat,1,{len(flow.rows)},MISO",
        *(f"TBPT,DEFI,{p!r},{s!r}" for p, s in flow.rows),
    ]


TABLES: dict[str, tuple[str, Callable[[_Flow], list[str]]]] = {
    "abaqus": ("**", _keywords),
    "calculix": ("**", _keywords),
    "ls-dyna": ("$", _ls_dyna),
    "ansys": ("!", _ansys),
}
"""Of each solver what begins a comment, and what writes the lines below."""
