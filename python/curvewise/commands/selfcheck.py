"""``curvewise selfcheck``: every kernel of this machine against the reference."""

from __future__ import annotations

import argparse
import sys
from typing import Any

__all__ = ["add_selfcheck"]


def add_selfcheck(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser("selfcheck", help="check every kernel on this machine")
    command.set_defaults(run=_selfcheck)


def _selfcheck(arguments: argparse.Namespace) -> int:
    from .kernel_check import run

    return 0 if run(sys.stdout) else 1
