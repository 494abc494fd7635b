"""CalculiX: tables of one back stress, or an overlay of several elements.

CalculiX's one back stress has a modulus that depends on the accumulated plastic strain alone, so it
forgets nothing when the load turns: recall (gamma) cannot be given. Without recall a card is that
law itself, except that Voce's curve is its chords. With recall it is an overlay (`overlay`), which
follows the material along paths of strain, and elsewhere less well. Both for finite strains
(NLGEOM).

G. Dhondt, CalculiX CrunchiX User's Manual 2.20, *PLASTIC and *CYCLIC HARDENING.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from .content import CardContent, CardFormat, CardLaw, SolverCard, TabulatedLayer, as_field
from .keyword_file import Block
from .overlay import Path, best_overlay, with_increments

__all__ = ["FORMAT", "card_of"]

_WIDTH = 20  # ccx reads 20 characters of a field
_CHORDS = 24  # for a saturating curve: their error is below 0.1 % of its increase
_FAR = 100.0  # plastic strain at which the line of kinematic hardening ends
_TITLE = re.compile(r"curvewise card for CalculiX: (\w+)$")
_PARAMETER = re.compile(r"(\w+) = ([^\s:]+)")


def _write(content: CardContent) -> list[str]:
    recall = any(C != 0.0 and gamma != 0.0 for C, gamma in content.backstresses)
    layers, notes = _overlay(content) if recall else ([_own_law(content)], _OWN_LAW)
    lines = [f"** {note}" for note in (*notes, *_ALWAYS)]
    for layer in layers:
        lines += [
            f"*MATERIAL,NAME={layer.name}",
            "*ELASTIC",
            f"{as_field(layer.modulus, _WIDTH)},{as_field(layer.poisson, _WIDTH)}",
            "*PLASTIC,HARDENING=COMBINED",
            *_rows(layer.kinematic),
            "*CYCLIC HARDENING",
            *_rows(layer.isotropic),
        ]
    return lines


_ALWAYS = (
    "use *STEP,NLGEOM: without it, CalculiX 2.20 moves the yield surface the wrong way",
    "CalculiX needs a *SOLID SECTION,ELSET=...,MATERIAL=... for each material",
)
_OWN_LAW = ("no back stress has recall, so this is CalculiX's own law; Voce's curve is in chords",)


def _own_law(content: CardContent) -> TabulatedLayer:
    p = content.parameters
    slope = sum(C for C, _ in content.backstresses)
    return TabulatedLayer(
        content.name,
        p["E"],
        content.poisson,
        ((p["yield"], 0.0), (p["yield"] + slope * _FAR, _FAR)),
        _chords(p["yield"], p["Q"] / p["yield"], p["b"]),
    )


def _overlay(content: CardContent) -> tuple[list[TabulatedLayer], Sequence[str]]:
    p = content.parameters
    paths = []
    for strain in map(with_increments, content.along):
        stress = content.stress(strain)
        elastic = stress / p["E"]
        lateral = -content.poisson * elastic - 0.5 * (strain - elastic)
        paths.append(Path(strain, lateral, stress))
    own = (p["Q"] / p["yield"], p["b"])
    found = best_overlay(paths, p["E"], p["yield"] / p["E"], own, content.poisson)
    count = len(found.modulus)
    layers = []
    for k in range(count):
        modulus = float(found.modulus[k])
        yields = modulus * float(found.yield_strain[k])
        layers.append(
            TabulatedLayer(
                f"{content.name}_{k + 1}",
                modulus,
                content.poisson,
                ((yields, 0.0), (yields, _FAR)),
                _chords(yields, float(found.growth[k]), float(found.rate[k])),
            )
        )
    low = min(float(path.axial.min()) for path in paths)
    high = max(float(path.axial.max()) for path in paths)
    return layers, (
        "CalculiX has one back stress and no recall of it. This is an overlay: repeat each",
        f"element {count} times on the same nodes, one for each of the {count} materials below.",
        "Exact: Young's modulus and Poisson's ratio. Approximate: what comes after yielding, by",
        f"{100 * found.error:.2f} % of the loop's height",
        f"along {'the paths' if len(paths) > 1 else 'a path'} of strain between {low:.4g} and "
        f"{high:.4g} (uniaxial); along other paths by several per cent.",
    )


def _chords(stress: float, growth: float, rate: float) -> tuple[tuple[float, float], ...]:
    """Return points of stress (1 + growth (1 - exp(-rate p))), of equal errors between them."""
    if growth == 0.0 or rate == 0.0:
        return ((stress, 0.0), (stress, _FAR))
    strain = [2.0 * math.log(_CHORDS / (_CHORDS - i)) / rate for i in range(_CHORDS)]
    strain.append(40.0 / rate)
    return tuple((stress * (1.0 - growth * math.expm1(-rate * p)), p) for p in strain)


def _rows(table: Sequence[tuple[float, float]]) -> list[str]:
    return [f"{as_field(stress, _WIDTH)},{as_field(strain, _WIDTH)}" for stress, strain in table]


def card_of(materials: dict[str, list[Block]], comments: Sequence[str]) -> SolverCard:
    """Return a card of CalculiX: the parameters that its comments state, and its tables."""
    layers = tuple(_layer(layer, blocks) for layer, blocks in materials.items())
    titles = [match[1] for comment in comments if (match := _TITLE.match(comment))]
    if len(titles) != 1:
        raise ValueError(
            f"{len(titles)} comments begin with 'curvewise card for CalculiX'; give the file of "
            "one card as it was written"
        )
    stated = [_PARAMETER.match(comment) for comment in comments]
    parameters = {match[1]: float(match[2]) for match in stated if match}
    total = math.fsum(layer.modulus for layer in layers)
    if not np.isclose(parameters.get("E", math.nan), total, rtol=1e-9, atol=0.0):
        raise ValueError(
            f"the materials' moduli add up to {total!r}, and the comments state E = "
            f"{parameters.get('E', 'nothing')}; one of them was changed: write the card again"
        )
    return SolverCard("calculix", titles[0], parameters, layers[0].poisson, layers)


def _layer(name: str, blocks: Sequence[Block]) -> TabulatedLayer:
    found = {block.keyword: block.numbers for block in blocks}
    try:
        modulus, poisson = found["*ELASTIC"]
        kinematic, isotropic = _pairs(found["*PLASTIC"]), _pairs(found["*CYCLICHARDENING"])
    except (KeyError, ValueError):
        raise ValueError(
            f"the material {name} has other numbers than a card; write the card again"
        ) from None
    return TabulatedLayer(name, modulus, poisson, kinematic, isotropic)


def _pairs(numbers: Sequence[float]) -> tuple[tuple[float, float], ...]:
    return tuple(zip(numbers[::2], numbers[1::2], strict=True))


FORMAT = CardFormat(
    solver="calculix",
    title="CalculiX",
    comment="**",
    laws={
        "chaboche-voce": CardLaw(
            "*PLASTIC, HARDENING=COMBINED",
            "CalculiX CrunchiX User's Manual 2.20, *PLASTIC and *CYCLIC HARDENING",
            _write,
        )
    },
    width=_WIDTH,
)
