"""Code_Aster: VMIS_CIN1_CHAB and VMIS_CIN2_CHAB, laws of one and of two back stresses.

The laws are R(p) = R_I + (R_0 - R_I) exp(-B p), C(p) = C_I (1 + (K - 1) exp(-W p)) and gamma(p) =
G_0 (A_I + (1 - A_I) exp(-B p)). K = 1, W = 0 and A_I = 1 make C and gamma constants. The back
stress is X = 2/3 C a, with da = d(eps_p) - gamma a dp. The command file is Python, so R_I is
written as the sum of yield and Q without loss of digits.
"""

from __future__ import annotations

from .content import CardContent, CardFormat, CardLaw

__all__ = ["FORMAT"]


def _write(content: CardContent) -> list[str]:
    p, backstresses = content.parameters, content.backstresses
    if len(backstresses) not in (1, 2):
        raise ValueError(
            f"Code_Aster has Chaboche's law with one or two back stresses, not {len(backstresses)};"
            " fit with backstresses=2, or take the card of MFront, which Code_Aster runs"
        )
    law = f"CIN{len(backstresses)}_CHAB"
    constants = {"R_0": repr(p["yield"]), "R_I": f"{p['yield']!r} + {p['Q']!r}", "B": repr(p["b"])}
    for k, (C, gamma) in enumerate(backstresses, 1):
        number = str(k) if len(backstresses) > 1 else ""
        constants[f"C{number}_I"], constants[f"G{number}_0"] = repr(C), repr(gamma)
    constants |= {"K": "1.0", "W": "0.0", "A_I": "1.0"}
    return [
        f"# COMPORTEMENT=_F(RELATION='VMIS_{law}', DEFORMATION='GDEF_LOG', ...)",
        "mater = DEFI_MATERIAU(",
        f"    ELAS=_F(E={p['E']!r}, NU={content.poisson!r}),",
        f"    {law}=_F({', '.join(f'{name}={value}' for name, value in constants.items())}),",
        ")",
    ]


FORMAT = CardFormat(
    solver="code_aster",
    title="Code_Aster",
    comment="#",
    laws={
        "chaboche-voce": CardLaw(
            "CIN1_CHAB, CIN2_CHAB",
            "Code_Aster U4.43.01, DEFI_MATERIAU, CIN1_CHAB and CIN2_CHAB; R5.03.04, "
            "Chaboche's elasto-viscoplastic laws",
            _write,
        )
    },
    suffix=".comm",
)
