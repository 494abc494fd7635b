"""Ansys Mechanical APDL: TB,CHABOCHE with TB,NLISO,,,,VOCE.

Chaboche's constants are sigma0, C1, gamma1, C2, gamma2 and so on. The law is dX = 2/3 C d(eps_p) -
gamma X dp for tensors, and C d(eps_p) - gamma X dp under uniaxial load. Voce's constants are
sigma0, R0, Rinf, b: sigma0 + R0 p + Rinf (1 - exp(-b p)). TBDATA takes six constants per line.
"""

from __future__ import annotations

from collections.abc import Sequence

from .content import CardContent, CardFormat, CardLaw

__all__ = ["FORMAT"]

_ON_A_LINE = 6


def _write(content: CardContent) -> list[str]:
    p, backstresses = content.parameters, content.backstresses
    lines = [
        "card_mat = 1  ! the material's number",
        f"MP,EX,card_mat,{p['E']!r}",
        f"MP,PRXY,card_mat,{content.poisson!r}",
    ]
    if backstresses:
        lines.append(f"TB,CHABOCHE,card_mat,1,{len(backstresses)}")
        lines += _tbdata([p["yield"], *(number for pair in backstresses for number in pair)])
    if p["Q"] or not backstresses:  # Chaboche's law alone has a constant yield stress
        lines.append("TB,NLISO,card_mat,1,,VOCE")
        lines += _tbdata([p["yield"], 0.0, p["Q"], p["b"]])
    return lines


def _tbdata(constants: Sequence[float]) -> list[str]:
    return [
        f"TBDATA,{start + 1},{','.join(map(repr, constants[start : start + _ON_A_LINE]))}"
        for start in range(0, len(constants), _ON_A_LINE)
    ]


FORMAT = CardFormat(
    solver="ansys",
    title="Ansys",
    comment="!",
    laws={
        "chaboche-voce": CardLaw(
            "TB,CHABOCHE",
            "Ansys Mechanical APDL Material Reference, Nonlinear kinematic hardening "
            "(TB,CHABOCHE) and Voce law (TB,NLISO,,,,VOCE)",
            _write,
        )
    },
    suffix=".mac",
)
