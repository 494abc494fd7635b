"""The problems of benchmarks/paper, a folder beside this one: they serve here, too."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "paper"))

cube = import_module("calculix_cube")
femu = import_module("femu_calculix")
problems = import_module("problems")
