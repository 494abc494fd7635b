"""Where the scripts of this room find what they share: tests, results, and two other rooms' files.

Importing this module makes the files of ../speed (timing) and ../reproduction (problems)
importable.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
DATA = Path(os.environ.get("CURVEWISE_DATA", ROOT.parent / "shared" / "data"))
LOOPS = DATA / "loops"
RESULTS = HERE / "results"
BUILD = ROOT / "build"  # not under version control

sys.path[1:1] = [str(HERE.parent / room) for room in ("speed", "reproduction")]
