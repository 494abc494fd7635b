"""``curvewise demo``: the built-in pair of hysteresis loops, compared and drawn."""

from __future__ import annotations

import argparse
from typing import Any

from ..comparing.comparison import compare
from ..datasets import hysteresis_pair
from .shown import print_table, require_matplotlib, write_picture

__all__ = ["add_demo"]


def add_demo(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser("demo", help="compare two generated hysteresis loops")
    command.set_defaults(run=_demo)
    command.add_argument("--output", metavar="FILE", default="curvewise_demo.png")


def _demo(arguments: argparse.Namespace) -> int:
    require_matplotlib()
    comparison = compare(*hysteresis_pair())
    names = ["experiment (generated)", "simulation (generated)"]
    print_table(comparison, names, ["", ""])
    write_picture(comparison, arguments.output)
    print(f"\npicture: {arguments.output}")
    return 0
