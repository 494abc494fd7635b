"""A mesh of CalculiX with a card of several materials: each element once for each of them.

The copies share the nodes of their element, so that they have its strain, and their stresses add
up (`cards.overlay`). Cost: linear in the mesh, and in the number of materials.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from .cards import read_card
from .cards.keyword_file import keyword_of
from .solver_output import lines_of

__all__ = ["overlaid_mesh"]

_SOLID = re.compile(r"C3D(4|6|8|10|15|20)[A-Z]*")
_ON_A_LINE = 16


class _Elements(NamedTuple):
    """A block *ELEMENT: type, set, and of each element its number and nodes."""

    kind: str
    elset: str
    rows: list[list[int]]


class _Keyword(NamedTuple):
    """A keyword line with its place, and the words of its data."""

    keyword: str
    options: dict[str, str]
    place: str
    words: list[str]


def overlaid_mesh(
    mesh: str | os.PathLike[str],
    card: str | os.PathLike[str],
    *,
    elset: str | None = None,
    step: int | None = None,
) -> str:
    r"""Return the elements, sections and materials of a card of CalculiX on a real mesh.

    Parameters
    ----------
    mesh : path-like
        A file with the blocks \*ELEMENT of the mesh, and \*ELSET if `elset` is defined by one.
        Files that it includes are not read.
    card : path-like
        A card of CalculiX, as :meth:`curvewise.materials.Material.card` writes it.
    elset : str, optional
        Set of the elements that have the material (default: all elements of the file). Capitals
        do not count.
    step : int, optional
        Number that is added to the numbers of elements from one copy to the next (default: the
        power of ten above the largest number in the file). Choose it above the numbers of all
        elements of the model.

    Returns
    -------
    str
        Text to include after the mesh (``*INCLUDE, INPUT=...``): the copies with their sets, a
        \*SOLID SECTION for each material, and the card. It replaces the material and the section
        of these elements.

    Raises
    ------
    ValueError
        If the card is not one of CalculiX, the mesh has no such elements, an element is not a
        solid (C3D4 to C3D20) or is incomplete, or `step` makes numbers appear twice.
    OSError
        If a file cannot be read.

    Notes
    -----
    Loads and densities belong to the first copy, whose elements are those of the mesh: elements
    of the other copies carry neither. CalculiX averages stresses at nodes over the elements there;
    the stress of the material is this average times the number of materials.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from curvewise.materials import ChabocheVoce
    >>> from curvewise.solvers import overlaid_mesh
    >>> steel = ChabocheVoce(backstresses=1)
    >>> constants = dict(zip(steel.names, (200e3, 300.0, 0.0, 8.0, 80e3, 400.0)))
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> card, mesh = folder / "card.inp", folder / "mesh.inp"
    >>> _ = card.write_text(steel.card(constants, "calculix", along=[0.01, -0.01]))
    >>> _ = mesh.write_text("*ELEMENT, TYPE=C3D8, ELSET=PART\n7, 1, 2, 3, 4, 5, 6, 7, 8\n")
    >>> text = overlaid_mesh(mesh, card)
    >>> print("\n".join(text.splitlines()[2:6]))
    *ELEMENT,TYPE=C3D8,ELSET=IN_material_2
    17,1,2,3,4,5,6,7,8
    *ELEMENT,TYPE=C3D8,ELSET=IN_material_3
    27,1,2,3,4,5,6,7,8
    """
    found = read_card(card)
    if not found.layers:
        raise ValueError(f"{os.fspath(card)} is a card of {found.solver}; give one of calculix")
    wanted, largest = _wanted(mesh, elset)
    step = 10 ** len(str(largest)) if step is None else step
    if step <= largest:
        raise ValueError(f"step is {step}; give more than {largest}, the largest element number")
    lines = [*_first_set(wanted, found.layers[0].name)]
    for k, layer in enumerate(found.layers[1:], 1):
        for block in wanted:
            lines.append(f"*ELEMENT,TYPE={block.kind},ELSET=IN_{layer.name}")
            for row in block.rows:
                lines += _wrapped([row[0] + k * step, *row[1:]])
    text = Path(card).read_text(encoding="utf-8").rstrip("\n")
    lines.append(text)
    lines += [f"*SOLID SECTION,ELSET=IN_{one.name},MATERIAL={one.name}" for one in found.layers]
    return "\n".join([*lines, ""])


def _first_set(blocks: list[_Elements], name: str) -> Iterator[str]:
    """Return the set of the mesh's own elements."""
    yield f"*ELSET,ELSET=IN_{name}"
    numbers = [row[0] for block in blocks for row in block.rows]
    for start in range(0, len(numbers), _ON_A_LINE):
        yield ",".join(map(str, numbers[start : start + _ON_A_LINE]))


def _wrapped(row: list[int]) -> list[str]:
    """Return an element's lines, each with a comma at its end but the last."""
    parts = [row[i : i + _ON_A_LINE] for i in range(0, len(row), _ON_A_LINE)]
    texts = [",".join(map(str, part)) for part in parts]
    return [f"{text}," for text in texts[:-1]] + texts[-1:]


def _wanted(mesh: str | os.PathLike[str], elset: str | None) -> tuple[list[_Elements], int]:
    """Return the solid elements of a set, and the largest number of all elements of the file."""
    keywords = _keywords(mesh)
    blocks = [_elements(one) for one in keywords if one.keyword == "*ELEMENT"]
    largest = max((row[0] for block in blocks for row in block.rows), default=0)
    if elset is not None:
        members = _members(keywords, blocks, elset.upper())
        chosen = [
            block._replace(rows=[row for row in block.rows if row[0] in members])
            for block in blocks
        ]
        blocks = [block for block in chosen if block.rows]
    if not blocks:
        known = dict.fromkeys(one.options.get("ELSET", "") for one in keywords)
        listed = ", ".join(name for name in known if name) or "none"
        which = "no elements" if elset is None else f"no elements of a set {elset!r}"
        raise ValueError(
            f"{os.fspath(mesh)} has {which}; give the file with the blocks *ELEMENT and a set of "
            f"it (sets: {listed})"
        )
    for block in blocks:
        if not _SOLID.fullmatch(block.kind):
            raise ValueError(
                f"{os.fspath(mesh)} has elements of type {block.kind or 'none'}; overlays need "
                "solids (C3D4 to C3D20): choose a set of these by elset"
            )
    return blocks, largest


def _keywords(mesh: str | os.PathLike[str]) -> list[_Keyword]:
    """Return the keyword lines of a file with their data."""
    found: list[_Keyword] = []
    for place, line in lines_of(mesh):
        text = line.strip()
        if text.startswith("**") or not text:
            continue
        if text.startswith("*"):
            keyword, options = keyword_of(text)
            found.append(_Keyword(keyword, options, place, []))
        elif found:
            found[-1].words.extend(word.strip() for word in text.split(",") if word.strip())
    return found


def _elements(given: _Keyword) -> _Elements:
    """Read a block of elements; of a type that is no solid the numbers alone."""
    kind = given.options.get("TYPE", "").upper()
    numbers = _whole(given)
    solid = _SOLID.fullmatch(kind)
    if solid is None:
        return _Elements(kind, given.options.get("ELSET", "").upper(), [[one] for one in numbers])
    size = 1 + int(solid[1])
    if len(numbers) % size:
        raise ValueError(
            f"{given.place}: the elements of type {kind} have {len(numbers)} numbers, which is not "
            f"a multiple of {size}; complete the block"
        )
    rows = [numbers[i : i + size] for i in range(0, len(numbers), size)]
    return _Elements(kind, given.options.get("ELSET", "").upper(), rows)


def _whole(given: _Keyword) -> list[int]:
    try:
        return [int(word) for word in given.words]
    except ValueError as error:
        raise ValueError(f"{given.place}: {error}; give whole numbers") from None


def _members(keywords: Sequence[_Keyword], blocks: Sequence[_Elements], name: str) -> set[int]:
    """Return the numbers of the elements of a set, and of the sets within it."""
    found = {row[0] for block in blocks if block.elset == name for row in block.rows}
    for one in keywords:
        if one.keyword != "*ELSET" or one.options.get("ELSET", "").upper() != name:
            continue
        if "GENERATE" in one.options:
            numbers = _whole(one)
            size = 3 if len(numbers) % 3 == 0 else 2
            for i in range(0, len(numbers), size):
                first, last, *by = numbers[i : i + size]
                found.update(range(first, last + 1, *by))
            continue
        for word in one.words:
            if word.isdigit():
                found.add(int(word))
            elif word.upper() != name:
                found |= _members(keywords, blocks, word.upper())
    return found
