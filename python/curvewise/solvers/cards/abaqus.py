"""Abaqus: combined hardening by its parameters.

Abaqus uses the same C, gamma, Q and b. The law is dX = C (sigma - X) / sigma0 dp - gamma X dp,
which is C d(eps_p) - gamma X dp under uniaxial load. The yield stress is sigma0 + Q (1 - exp(-b
p)). A data line has up to eight numbers of up to 20 characters each.
"""

from __future__ import annotations

from collections.abc import Sequence

from .content import CardContent, CardFormat, CardLaw, SolverCard, as_field
from .keyword_file import Block

__all__ = ["FORMAT", "card_of"]

_WIDTH = 20
_ON_A_LINE = 8
_MOST_BACKSTRESSES = 10


def _write(content: CardContent) -> list[str]:
    p, backstresses = content.parameters, content.backstresses
    if not 1 <= len(backstresses) <= _MOST_BACKSTRESSES:
        raise ValueError(
            f"Abaqus' combined hardening has 1 to {_MOST_BACKSTRESSES} back stresses, not "
            f"{len(backstresses)}; fit with as many"
        )
    return [
        f"*MATERIAL, NAME={content.name}",
        "*ELASTIC",
        *_data([p["E"], content.poisson]),
        "*PLASTIC, HARDENING=COMBINED, DATA TYPE=PARAMETERS, "
        f"NUMBER BACKSTRESSES={len(backstresses)}",
        *_data([p["yield"], *(number for pair in backstresses for number in pair)]),
        "*CYCLIC HARDENING, PARAMETERS",
        *_data([p["yield"], p["Q"], p["b"]]),
    ]


def _data(numbers: Sequence[float]) -> list[str]:
    fields = [as_field(number, _WIDTH) for number in numbers]
    starts = range(0, len(fields), _ON_A_LINE)
    return [", ".join(fields[i : i + _ON_A_LINE]) for i in starts]


def card_of(name: str, blocks: Sequence[Block]) -> SolverCard:
    """Return the card of a material of an Abaqus file from the keywords below its name."""
    found = {block.keyword: block for block in blocks}
    try:
        modulus, poisson = found["*ELASTIC"].numbers
        stress, *kinematic = found["*PLASTIC"].numbers
        again, growth, rate = found["*CYCLICHARDENING"].numbers
        complete = len(kinematic) == 2 * int(found["*PLASTIC"].options["NUMBERBACKSTRESSES"])
    except (KeyError, ValueError):
        complete = False
    if not complete:
        raise ValueError(
            f"the material {name} has other numbers than E and Poisson's ratio under *ELASTIC, the "
            "yield stress and each C and gamma under *PLASTIC, and three numbers under *CYCLIC "
            "HARDENING; write these, for one temperature"
        )
    if again != stress:
        raise ValueError(
            f"the material {name} has a yield stress of {stress!r} under *PLASTIC and of {again!r} "
            "under *CYCLIC HARDENING; give one"
        )
    parameters = {"E": modulus, "yield": stress, "Q": growth, "b": rate}
    for i, number in enumerate(kinematic):
        parameters[f"{'gamma' if i % 2 else 'C'}{i // 2 + 1}"] = number
    return SolverCard("abaqus", name, parameters, poisson)


FORMAT = CardFormat(
    solver="abaqus",
    title="Abaqus",
    comment="**",
    laws={
        "chaboche-voce": CardLaw(
            "*PLASTIC, HARDENING=COMBINED",
            "Abaqus Keywords Guide, *PLASTIC and *CYCLIC HARDENING; Materials Guide, "
            "Models for metals subjected to cyclic loading",
            _write,
        )
    },
    width=_WIDTH,
)
