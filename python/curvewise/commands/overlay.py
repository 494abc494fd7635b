"""``curvewise overlay MESH CARD``: a card of CalculiX with several materials on a real mesh."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add_overlay"]


def add_overlay(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser(
        "overlay",
        help="put a CalculiX card of several materials on a mesh: one element for each material",
        description="Write the copies of a mesh's elements that a material card of CalculiX needs, "
        "with their sections and the card. Include the file after the mesh, in place of the "
        "material and the section of these elements.",
    )
    command.set_defaults(run=_overlay)
    command.add_argument("mesh", metavar="MESH", help="file with the blocks *ELEMENT of the mesh")
    command.add_argument("card", metavar="CARD", help="card, such as fit/card_calculix.inp")
    command.add_argument(
        "--elset", metavar="NAME", help="set of elements of the material (default: all of the file)"
    )
    command.add_argument(
        "--step",
        type=int,
        metavar="N",
        help="number added to element numbers from copy to copy (default: the power of ten above "
        "the largest in the file)",
    )
    command.add_argument(
        "--output",
        metavar="FILE",
        default="overlay.inp",
        help="file to write (default: overlay.inp)",
    )


def _overlay(arguments: argparse.Namespace) -> int:
    from ..solvers import overlaid_mesh

    text = overlaid_mesh(arguments.mesh, arguments.card, elset=arguments.elset, step=arguments.step)
    Path(arguments.output).write_text(text, encoding="utf-8")
    count = text.count("\n*SOLID SECTION")
    print(f"written: {arguments.output}, {count} materials; *INCLUDE,INPUT={arguments.output}")
    return 0
