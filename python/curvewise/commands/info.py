"""``curvewise info``: version, compiler, and instruction sets."""

from __future__ import annotations

import argparse
from typing import Any

from ..installation import build_info

__all__ = ["add_info"]


def add_info(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser("info", help="show version, compiler and instruction sets")
    command.set_defaults(run=_info)


def _info(arguments: argparse.Namespace) -> int:
    for key, value in build_info().items():
        text = " ".join(value) if isinstance(value, list) else value
        print(f"{key.replace('_', ' '):<16}  {text}")
    return 0
