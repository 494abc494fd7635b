"""MFront: the brick StandardElastoViscoPlasticity.

Its rules are X = 2/3 C a with da = d(eps_p) - D a dp for Armstrong and Frederick, and Prager
without recall. Voce's radius is R = Rinf + (R0 - Rinf) exp(-b p). The yield stress is a separate
rule ("Linear" without slope). The radii of several rules add up, so Q is written unchanged.
Swift's radius is R0 ((p + p0) / p0)^n.
"""

from __future__ import annotations

from .content import CardContent, CardFormat, CardLaw

__all__ = ["FORMAT"]


def _write(content: CardContent) -> list[str]:
    p = content.parameters
    rules = [
        f'isotropic_hardening : "Linear" {{R0 : {p["yield"]!r}}}',
        f'isotropic_hardening : "Voce" {{R0 : 0.0, Rinf : {p["Q"]!r}, b : {p["b"]!r}}}',
    ]
    if "D" in p:
        fall = f"R0 : 0.0, Rinf : {-p['D']!r}, b : {p['a']!r}"
        rules.append(f'isotropic_hardening : "Voce" {{{fall}}}')
    for C, gamma in content.backstresses:
        rules.append(
            f'kinematic_hardening : "Armstrong-Frederick" {{C : {C!r}, D : {gamma!r}}}'
            if gamma
            else f'kinematic_hardening : "Prager" {{C : {C!r}}}'
        )
    return _behaviour(content, rules)


def _swift(content: CardContent) -> list[str]:
    p = content.parameters
    radius = repr(p["K"] * p["e0"] ** p["n"])
    numbers = f"R0 : {radius}, p0 : {p['e0']!r}, n : {p['n']!r}"
    lines = _behaviour(content, [f'isotropic_hardening : "Swift" {{{numbers}}}'])
    return ["// R0 = K e0^n, which is rounded", *lines]


def _behaviour(content: CardContent, rules: list[str]) -> list[str]:
    p = content.parameters
    elastic = f"young_modulus : {p['E']!r}, poisson_ratio : {content.poisson!r}"
    return [
        "@DSL Implicit;",
        f"@Behaviour {content.name};",
        "@Epsilon 1.e-14;",
        "@Theta 1;",
        "@Brick StandardElastoViscoPlasticity{",
        f'  stress_potential : "Hooke" {{{elastic}}},',
        '  inelastic_flow : "Plastic" {',
        '    criterion : "Mises",',
        *(f"    {rule}{',' if i < len(rules) else ''}" for i, rule in enumerate(rules, 1)),
        "  }",
        "};",
    ]


FORMAT = CardFormat(
    solver="mfront",
    title="MFront",
    comment="//",
    laws={
        "chaboche-voce": CardLaw(
            "StandardElastoViscoPlasticity",
            "TFEL/MFront, Description of the StandardElastoViscoPlasticity brick: "
            "Linear, Voce, Prager, Armstrong-Frederick",
            _write,
        ),
        "updated-voce-chaboche": CardLaw(
            "StandardElastoViscoPlasticity",
            "TFEL/MFront, Description of the StandardElastoViscoPlasticity brick: "
            "Linear, Voce, Prager, Armstrong-Frederick",
            _write,
        ),
        "swift": CardLaw(
            "StandardElastoViscoPlasticity",
            "TFEL/MFront, Description of the StandardElastoViscoPlasticity brick: Swift",
            _swift,
        ),
    },
    suffix=".mfront",
)
