"""No memory, full disks, damaged files and stores, ends: tests/faults, once and in small.

docs/explanation/guarantees.md has what the long runs of these scripts found.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[2] / "faults"
RUNS = {
    "memory": ["memory.py", "--limits", "2", "--points", "10000"],
    "disks": ["disks.py", "--times", "1"],
    "stores": ["stores.py", "--times", "12"],
    "endings": ["endings.py", "--times", "1", "--only", "exit"],
    "damaged files": ["damaged_files.py", "--times", "30"],
}


@pytest.mark.skipif(sys.platform != "linux", reason="limits of the address space, and of files")
@pytest.mark.parametrize("name", RUNS)
@pytest.mark.nightly
def test_nothing_is_lost(name):
    script, *options = RUNS[name]
    command = [sys.executable, str(SCRIPTS / script), *options]
    run = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
