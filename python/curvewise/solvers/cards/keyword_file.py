"""Input files of Abaqus and CalculiX, as far as materials go: keywords, and the numbers below them.

Keyword lines begin with one asterisk, comments with two; case and blanks do not count. Cost: linear
in the file.
"""

from __future__ import annotations

import os
from typing import NamedTuple

from ..solver_output import as_number, lines_of

__all__ = ["Block", "blocks_of", "keyword_of", "materials_of"]


class Block(NamedTuple):
    """A keyword line and its data.

    Attributes
    ----------
    keyword : str
        The keyword in capitals and without spaces, "*CYCLICHARDENING".
    options : dict of str to str
        The options; names like the keyword, values unchanged.
    numbers : list of float
        All numbers below, line by line.
    """

    keyword: str
    options: dict[str, str]
    numbers: list[float]


# Keywords below *MATERIAL whose data are read.
_READ = ("*ELASTIC", "*PLASTIC", "*CYCLICHARDENING")


def blocks_of(path: str | os.PathLike[str]) -> tuple[list[Block], list[str]]:
    """Return the keyword lines of a file with their numbers, and its comments."""
    blocks: list[Block] = []
    comments: list[str] = []
    for place, line in lines_of(path):
        text = line.strip()
        if text.startswith("**"):
            comments.append(text[2:].strip())
        elif text.startswith("*"):
            blocks.append(Block(*keyword_of(text), []))
        elif blocks and blocks[-1].keyword in _READ:
            words = [word.strip() for word in text.split(",")]
            blocks[-1].numbers.extend(as_number(word, place) for word in words if word)
    return blocks, comments


def keyword_of(line: str) -> tuple[str, dict[str, str]]:
    """Return the keyword of a line in capitals, and its options by name."""
    keyword, *options = line.split(",")
    pairs = [option.partition("=") for option in options]
    return _plain(keyword), {_plain(name): value.strip().strip('"') for name, _, value in pairs}


def _plain(word: str) -> str:
    return "".join(word.upper().split())


def materials_of(blocks: list[Block]) -> dict[str, list[Block]]:
    """Return the blocks below each *MATERIAL by its name."""
    materials: dict[str, list[Block]] = {}
    current: list[Block] = []
    for block in blocks:
        if block.keyword == "*MATERIAL":
            current = materials.setdefault(block.options.get("NAME", ""), [])
        elif block.keyword in _READ:
            current.append(block)
    return materials
