"""LS-DYNA: *MAT_125 (Yoshida-Uemori) and *MAT_103 (Chaboche).

*MAT_125 uses the same parameters: SC1 = SC2 = C, E(p) = E - (E - EA) (1 - exp(-COE p)), and IOPT =
1 for R = RSAT ((C1 + p)^C2 - C1^C2). Its anisotropy R = 1 is von Mises. *MAT_103 has up to two back
stresses. Its stress in tension is SIGY + QR1 (1 - exp(-CR1 p)) + QX1 (1 - exp(-CX1 p)) + QX2 (...),
so QX = C / gamma and CX = gamma. The quotient is rounded, and a back stress without recall cannot
be written. Cards have the long format with fields of 20 columns: the "+" behind the keyword
requests it, whatever the deck.
"""

from __future__ import annotations

from collections.abc import Sequence

from .content import CardContent, CardFormat, CardLaw, as_field

__all__ = ["FORMAT"]

_WIDTH = 20


def _yoshida(content: CardContent) -> list[str]:
    p = content.parameters
    first: list[str | float] = ["1", "&density", p["E"], content.poisson, 1.0, "0", "0"]
    decays, power = "xi" in p, "C2" in p
    return [
        *_title("KINEMATIC_HARDENING_TRANSVERSELY_ANISOTROPIC", content),
        *_card("MID RO E PR R HCLID OPT", first),
        *_card(
            "CB Y SC1 K RSAT SB H SC2",
            [p["CB"], p["Y"], p["C"], p["K"], p["RSAT"], p["SB"], p["H"], p["C"]],
        ),
        *_card(
            "EA COE IOPT C1 C2",
            [
                p["Ea"] if decays else 0.0,
                p["xi"] if decays else 0.0,
                "1" if power else "0",
                p["C1"] if power else 0.0,
                p["C2"] if power else 0.0,
            ],
        ),
    ]


def _chaboche(content: CardContent) -> list[str]:
    p, backstresses = content.parameters, content.backstresses
    if len(backstresses) > 2:
        raise ValueError(
            f"LS-DYNA's *MAT_103 has up to two back stresses, not {len(backstresses)}; fit with "
            "backstresses=2"
        )
    terms = [0.0, 0.0, 0.0, 0.0]
    for k, (C, gamma) in enumerate(backstresses):
        if C != 0.0 and gamma == 0.0:
            raise ValueError(
                f"LS-DYNA's *MAT_103 has no back stress without recall, and gamma{k + 1} is 0; fit "
                "with bounds above 0 for it"
            )
        terms[2 * k : 2 * k + 2] = [C / gamma if C else 0.0, gamma]
    return [
        "$ QX = C / gamma, which is rounded, and CX = gamma",
        *_title("ANISOTROPIC_VISCOPLASTIC", content),
        *_card(
            "MID RO E PR SIGY FLAG LCSS ALPHA",
            ["1", "&density", p["E"], content.poisson, p["yield"], "0", "0", 0.0],
        ),
        *_card("QR1 CR1 QR2 CR2 QX1 CX1 QX2 CX2", [p["Q"], p["b"], 0.0, 0.0, *terms]),
        *_card("VK VM R00 R45 R90 L M N", [0.0, 0.0]),
        *_card("AOPT FAIL NUMINT MACF", [0.0, 0.0, 0.0, "1"]),
        *_card("XP YP ZP A1 A2 A3", [0.0] * 6),
        *_card("V1 V2 V3 D1 D2 D3 BETA", [0.0] * 7),
    ]


def _johnson_cook(content: CardContent) -> list[str]:
    p = content.parameters
    rate = float(str(content.options["reference_rate"]))
    return [
        *_title("SIMPLIFIED_JOHNSON_COOK", content),
        *_card("MID RO E PR VP", ["1", "&density", p["E"], content.poisson, 1.0]),
        *_card(
            "A B N C PSFAIL SIGMAX SIGSAT EPS0",
            [p["A"], p["B"], p["n"], p["C"], 0.0, 0.0, 0.0, rate],
        ),
    ]


def _title(keyword: str, content: CardContent) -> list[str]:
    return [
        "$ the density: *PARAMETER with R density, or write it in the place of &density",
        f"*MAT_{keyword}_TITLE+",
        content.name,
    ]


def _card(names: str, fields: Sequence[str | float]) -> list[str]:
    """Return a line of fields in columns of 20; missing ones are blank."""
    texts = [field if isinstance(field, str) else as_field(field, _WIDTH) for field in fields]
    head = "".join(name.rjust(_WIDTH) for name in names.split())
    return ["$#" + head[2:], "".join(text.rjust(_WIDTH) for text in texts)]


FORMAT = CardFormat(
    solver="ls-dyna",
    title="LS-DYNA",
    comment="$",
    laws={
        "yoshida-uemori": CardLaw(
            "*MAT_125",
            "LS-DYNA Keyword User's Manual, Volume II, "
            "*MAT_KINEMATIC_HARDENING_TRANSVERSELY_ANISOTROPIC (*MAT_125)",
            _yoshida,
            {"growth": ("power",), "modulus": ("decaying",)},
        ),
        "chaboche-voce": CardLaw(
            "*MAT_103",
            "LS-DYNA Keyword User's Manual, Volume II, *MAT_ANISOTROPIC_VISCOPLASTIC (*MAT_103)",
            _chaboche,
        ),
        "johnson-cook": CardLaw(
            "*MAT_098",
            "LS-DYNA Keyword User's Manual, Volume II, *MAT_SIMPLIFIED_JOHNSON_COOK (*MAT_098)",
            _johnson_cook,
        ),
    },
    width=_WIDTH,
    suffix=".k",
)
