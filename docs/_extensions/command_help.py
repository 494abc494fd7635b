"""The help of the command line, as it prints it: ``.. command-help:: compare``."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx


class CommandHelp(Directive):
    """The help of a command, or without an argument that of curvewise itself."""

    optional_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Run the command with --help, in a terminal of 90 columns."""
        text = subprocess.run(
            [sys.executable, "-m", "curvewise", *self.arguments, "--help"],
            check=True,
            capture_output=True,
            text=True,
            encoding="utf-8",
            env=os.environ | {"COLUMNS": "90", "PYTHONUTF8": "1", "NO_COLOR": "1"},
        ).stdout
        return [nodes.literal_block(text, text, language="none")]


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the directive."""
    app.add_directive("command-help", CommandHelp)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
